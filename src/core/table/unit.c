#include "core/table/unit.h"

#include "core/memory.h"
#include "core/print.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_EXPONENT = 99999, EXPONENT_SIZE = 16, LONGEST_UNIT = 8 };

/* A unit is 10^exponent bases, or so many as `factor` says if that is not 0; each of the prefixes makes
 * another. */
static const struct {
  const char *base, *name, *prefixes;
  int32_t exponent;
  double factor;
} units[] = {
    {"Hz", "Hz", "km", 0, 0},       {"m", "m", "kcmun", 0, 0},
    {"m", "angstrom", "", -10, 0},  {"m", "in", "", 0, 0.0254},
    {"m", "ft", "", 0, 0.3048},     {"s", "s", "munpf", 0, 0},
    {"s", "min", "", 0, 60},        {"s", "h", "", 0, 3600},
    {"kg", "kg", "", 0, 0},         {"kg", "t", "", 3, 0},
    {"kg", "g", "mu", -3, 0},       {"kg", "lb", "", 0, 0.45359237},
    {"kg/m", "kg/m", "", 0, 0},     {"kg/m", "g/m", "m", -3, 0},
    {"kg/m^2", "kg/m^2", "", 0, 0}, {"kg/m^2", "g/m^2", "", -3, 0},
    {"kg/m^3", "kg/m^3", "", 0, 0}, {"kg/m^3", "g/cm^3", "", 3, 0},
    {"N", "N", "Mkmun", 0, 0},      {"N", "lbf", "", 0, 4.4482216152605},
    {"N/m", "N/m", "Mk", 0, 0},     {"N/m", "N/mm", "", 3, 0},
    {"N/m", "N/cm", "", 2, 0},      {"N/m", "mN/m", "", -3, 0},
    {"N/m", "Pa m", "k", 0, 0},     {"N s", "N s", "km", 0, 0},
    {"N s/m", "N s/m", "km", 0, 0}, {"N s/m", "N s/mm", "", 3, 0},
    {"N s/m", "kg/s", "", 0, 0},    {"N m", "N m", "mu", 0, 0},
    {"N m^2", "N m^2", "km", 0, 0}, {"N m^2", "N mm^2", "", -6, 0},
    {"m/s", "m/s", "kcmu", 0, 0},   {"m/s", "km/h", "", 0, 1.0 / 3.6},
    {"m/s^2", "m/s^2", "cm", 0, 0}, {"m/s^2", "g0", "", 0, 9.80665},
    {"rad", "rad", "m", 0, 0},      {"rad", "deg", "", 0, 0.017453292519943295},
    {"MB", "MB", "", 0, 0},         {"MB", "GB", "", 3, 0},
    {"MB", "kB", "", -3, 0},        {"GB", "GB", "", 0, 0},
    {"GB", "TB", "", 3, 0},         {"GB", "MB", "", -3, 0},
    {"J", "J", "Mkmun", 0, 0},
};
enum { UNIT_COUNT = sizeof units / sizeof units[0] };

static const char prefixes[] = "Mkcmunpf";
static const int32_t exponents[] = {6, 3, -2, -3, -6, -9, -12, -15};

/* Each base stands before a blank and a bracket, or before a comma or the end. */
static int is_one_of(const char *bases, const char *base) {
  const size_t length = strlen(base);
  for (const char *at = bases; at && *at;) {
    if (strncmp(at, base, length) == 0) {
      const char *after = at + length;
      if (*after == '\0' || *after == ',' || strncmp(after, " (", 2) == 0) return 1;
    }
    at = strstr(at, ", ");
    if (at) at += 2;
  }
  return 0;
}

struct hk_unit hk_unit_find(const char *bases, const char *name, int64_t length) {
  for (int k = 0; k < UNIT_COUNT; k++) {
    const size_t own = strlen(units[k].name), prefix = (size_t)length == own + 1;
    if (prefix ? !strchr(units[k].prefixes, name[0]) : (size_t)length != own) continue;
    if (memcmp(units[k].name, name + prefix, own) != 0 || !is_one_of(bases, units[k].base)) continue;
    const int32_t more = prefix ? exponents[strchr(prefixes, name[0]) - prefixes] : 0;
    return (struct hk_unit){units[k].base, units[k].exponent + more, units[k].factor};
  }
  return (struct hk_unit){NULL, 0, 0.0};
}

void hk_unit_list(const char *bases, char *list, int64_t size) {
  list[0] = '\0';
  for (int k = 0; k < UNIT_COUNT; k++) {
    if (!is_one_of(bases, units[k].base)) continue;
    hk_append(list, (size_t)size, "%s%s", list[0] ? ", " : "", units[k].name);
    for (const char *prefix = units[k].prefixes; *prefix; prefix++)
      hk_append(list, (size_t)size, ", %c%s", *prefix, units[k].name);
  }
}

/* ---- texts ---- */

/* Length of the longest unit that stands here alone, or of what stands in its place. */
static int64_t scan_unit(const char *bases, const char *text, int64_t length) {
  for (int64_t most = length < LONGEST_UNIT ? length : LONGEST_UNIT; most > 0; most--) {
    if (most < length && !strchr(",; \t", text[most])) continue;
    if (hk_unit_find(bases, text, most).base) return most;
  }
  int64_t end = 0;
  while (end < length && !strchr(",; \t", text[end]))
    end++;
  return end;
}

struct hk_quantity hk_unit_scan(const char *bases, const char *text, int64_t length) {
  int64_t mantissa, unit = hk_number_scan(text, length, &mantissa);
  struct hk_quantity found = {unit, unit};
  while (unit < length && (text[unit] == ' ' || text[unit] == '\t'))
    unit++;
  if (mantissa > 0 && unit < length && !strchr("0123456789+-.,;", text[unit]))
    found.whole = unit + scan_unit(bases, text + unit, length - unit);
  return found;
}

enum hk_number_result hk_unit_parse(const char *text, int64_t length, const struct hk_unit *unit,
                                    double *value) {
  if (unit->exponent == 0) {
    const enum hk_number_result result = hk_number_parse(text, length, value);
    if (result == HOOKE_NUMBER_FINE && unit->factor > 0) *value *= unit->factor;
    return result == HOOKE_NUMBER_FINE && isinf(*value) ? HOOKE_NUMBER_TOO_LARGE : result;
  }
  int64_t mantissa;
  hk_number_scan(text, length, &mantissa);
  char *scaled = hk_new(length + EXPONENT_SIZE, 1);
  if (scaled == NULL) return HOOKE_NUMBER_NO_MEMORY;
  memcpy(scaled, text, (size_t)length);
  scaled[length] = '\0';
  long exponent = mantissa < length ? strtol(scaled + mantissa + 1, NULL, 10) : 0;
  if (exponent > MOST_EXPONENT) exponent = MOST_EXPONENT;
  if (exponent < -MOST_EXPONENT) exponent = -MOST_EXPONENT;
  snprintf(scaled + mantissa, EXPONENT_SIZE, "e%ld", exponent + unit->exponent);
  const enum hk_number_result result = hk_number_parse(scaled, (int64_t)strlen(scaled), value);
  hk_free(scaled);
  return result;
}
