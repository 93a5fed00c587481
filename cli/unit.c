#include "unit.h"
#include "print.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_EXPONENT = 99999, ROOM_PER_LETTER = 24 };

static const struct unit {
  const char *base, *name;
  int exponent; /* a power of ten, or */
  double factor;
} units[] = {
    {"m", "m", 0, 0},   {"m", "km", 3, 0},  {"m", "cm", -2, 0},  {"m", "mm", -3, 0},
    {"m", "um", -6, 0}, {"m", "nm", -9, 0}, {"s", "s", 0, 0},    {"s", "ms", -3, 0},
    {"s", "us", -6, 0}, {"s", "ns", -9, 0}, {"s", "min", 0, 60}, {"s", "h", 0, 3600},
};
enum { UNIT_COUNT = sizeof units / sizeof units[0] };

int32_t cli_unit_has_others(const char *base) {
  return strcmp(base, "m") == 0 || strcmp(base, "s") == 0;
}

const char *cli_unit_list(const char *base, char list[HOOKE_UNIT_LIST_SIZE]) {
  list[0] = '\0';
  for (int i = 0; i < UNIT_COUNT; i++) {
    size_t used = strlen(list);
    if (strcmp(units[i].base, base) != 0) continue;
    snprintf(list + used, HOOKE_UNIT_LIST_SIZE - used, "%s%s", used ? ", " : "", units[i].name);
  }
  return list;
}

static const struct unit *find_unit(const char *base, const char *word, size_t length) {
  for (int i = 0; i < UNIT_COUNT; i++) {
    if (strcmp(units[i].base, base) == 0 && strlen(units[i].name) == length &&
        strncmp(units[i].name, word, length) == 0)
      return &units[i];
  }
  return NULL;
}

/* ---- a number and its unit ---- */

struct number {
  size_t mantissa; /* length of sign, digits and point; 0: not a number */
  size_t length;   /* including the exponent */
  long exponent;
};

static size_t count_digits(const char *text) {
  size_t count = 0;
  while (isdigit((unsigned char)text[count]))
    count++;
  return count;
}

static struct number scan_number(const char *text) {
  struct number number = {0, 0, 0};
  size_t at = text[0] == '-' || text[0] == '+';
  size_t whole = count_digits(text + at), part = 0;
  at += whole;
  if (text[at] == '.') {
    part = count_digits(text + at + 1);
    at += part + 1;
  }
  if (whole + part == 0) return number;
  number.mantissa = number.length = at;
  if (text[at] != 'e' && text[at] != 'E') return number;
  size_t sign = text[at + 1] == '-' || text[at + 1] == '+';
  size_t digits = count_digits(text + at + 1 + sign);
  if (digits == 0) return number;
  number.exponent = strtol(text + at + 1, NULL, 10);
  if (number.exponent > MOST_EXPONENT) number.exponent = MOST_EXPONENT;
  if (number.exponent < -MOST_EXPONENT) number.exponent = -MOST_EXPONENT;
  number.length = at + 1 + sign + digits;
  return number;
}

static void write_in_base(const char *text, const struct number *number, const struct unit *unit, char *to) {
  if (unit->factor > 0) {
    char digits[HOOKE_NUMBER_SIZE];
    sprintf(to, "%s", cli_format_number(strtod(text, NULL) * unit->factor, digits));
  } else {
    sprintf(to, "%.*se%ld", (int)number->mantissa, text, number->exponent + unit->exponent);
  }
}

char *cli_unit_read(const char *text, const char *base, char word[HOOKE_UNIT_WORD_SIZE]) {
  char *read = malloc(ROOM_PER_LETTER * (strlen(text) + 1));
  char *to = read;
  word[0] = '\0';
  while (to && *text) {
    struct number number = scan_number(text);
    const char *name = text + number.length + strspn(text + number.length, " \t");
    size_t length = strcspn(name, ", \t");
    if (number.mantissa && name[0] && !strchr("0123456789+-.,", name[0])) {
      const struct unit *unit = find_unit(base, name, length);
      if (!unit) {
        snprintf(word, HOOKE_UNIT_WORD_SIZE, "%.*s",
                 (int)(length < HOOKE_UNIT_WORD_SIZE ? length : HOOKE_UNIT_WORD_SIZE), name);
        free(read);
        return NULL;
      }
      write_in_base(text, &number, unit, to);
      to += strlen(to);
      text = name + length;
    }
    /* remainder of an item without unit, and its separator */
    size_t rest = strcspn(text, ", \t");
    rest += strspn(text + rest, ", \t");
    memcpy(to, text, rest);
    to += rest;
    text += rest;
  }
  if (to) *to = '\0';
  return read;
}
