/* The table of kinds, and the steps that all builders share: size, mass, springs of a family, pins. */
#include "parts/part.h"

#include "parts/material.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct hooke_part_kind *const kinds[] = {&hk_part_rope, &hk_part_cloth, &hk_part_lattice,
                                                      &hk_part_mesh, &hk_part_strand};
enum { KIND_COUNT = sizeof kinds / sizeof kinds[0] };

static const struct hk_option_row family_rows[] = {
    HOOKE_OPTION("stiffness", HOOKE_OPTION_NOT_NEGATIVE("N"), NULL,
                 "force at double length, of the strain law", .required = 1, .example = "50"),
    HOOKE_OPTION("damping", HOOKE_OPTION_NOT_NEGATIVE("N s"), "0", "damping along the spring"),
    HOOKE_OPTION("damping_ratio", HOOKE_OPTION_NOT_NEGATIVE(NULL), NULL,
                 "damping over the critical one of two inner particles on the spring, instead of damping"),
    HOOKE_SCALE_OPTIONS,
    HOOKE_OPTION("compression", .type = HOOKE_OPTION_FLAG, "true", "false: the springs only pull"),
};

const struct hk_option_table hk_part_family = {"springs of a part", HOOKE_OPTION_ROWS(family_rows)};

const char *hooke_part_kind(int64_t kind, const char *what) {
  if (kind < 0 || kind >= KIND_COUNT) return NULL;
  if (strcmp(what, "name") == 0) return kinds[kind]->table->name;
  return strcmp(what, "summary") == 0 ? kinds[kind]->summary : NULL;
}

static const struct hooke_part_kind *find_kind(const char *name) {
  for (int k = 0; k < KIND_COUNT; k++) {
    if (name && strcmp(kinds[k]->table->name, name) == 0) return kinds[k];
  }
  char known[128] = "", shown[HOOKE_OPTION_SHOWN];
  for (int k = 0; k < KIND_COUNT; k++)
    hk_append(known, sizeof known, "%s%s", k ? ", " : "", kinds[k]->table->name);
  if (name) hk_option_show(name, (int64_t)strlen(name), shown);
  if (name)
    hk_fail(HOOKE_BAD_VALUE, "kind", "there is no kind of part called \"%s\"; allowed: %s", shown, known);
  else
    hk_fail(HOOKE_BAD_VALUE, "kind", "is required but missing; allowed: %s", known);
  return NULL;
}

const struct hk_option_table *hk_part_find(const char *name) {
  const struct hooke_part_kind *found = find_kind(name);
  return found ? found->table : NULL;
}

const struct hk_option_table *hk_part_table(int64_t k) {
  return k < KIND_COUNT ? kinds[k]->table : NULL;
}

static int32_t cells(const hooke_options *options, int64_t cells[3]) {
  const int32_t axes = (int32_t)hooke_options_number_count(options, "size");
  if (axes == 0) cells[0] = (int64_t)hooke_options_number(options, "segments");
  for (int32_t a = 0; a < axes; a++)
    cells[a] = (int64_t)hooke_options_numbers(options, "size")[a] - 1;
  return axes > 0 ? axes : 1;
}

int32_t hk_part_set_cells(hooke_options *options, const int64_t cells[3]) {
  const int64_t axes = hooke_options_number_count(options, "size");
  double size[3];
  if (axes == 0) return hooke_options_set_number(options, "segments", (double)cells[0]);
  for (int64_t a = 0; a < axes; a++)
    size[a] = (double)cells[a] + 1.0;
  return hooke_options_set_numbers(options, "size", axes, size);
}

const struct hk_part_grid hk_part_sized = {cells, hk_part_set_cells};

int64_t hk_part_named_end(const struct hk_part *part, const char *word, int64_t k) {
  if (k > 0) return -1;
  return strcmp(word, "start") == 0 ? 0 : part->count - 1;
}

double hk_part_if_family(const struct hk_part *part, const char *family, double count) {
  return hk_options_has_family(part->options, family) ? count : 0.0;
}

int32_t hk_part_new_positions(struct hk_part *part, struct hk_more more, const char *what,
                              double **position) {
  *position = NULL;
  const int32_t status = hk_system_check_size(part->system, more, what);
  if (status != HOOKE_OK) return status;
  part->count = (int64_t)more.particles;
  *position = hk_new(3 * part->count, sizeof(double));
  return *position ? HOOKE_OK : HOOKE_NO_MEMORY;
}

/* Options of a spring group with the values of a family. */
static int32_t material(const struct hk_part *part, const char *family, int by_ratio, int64_t count,
                        const int64_t *ends, const double *rest_length, hooke_options **options) {
  static const char *const keys[] = {"stiffness", "damping", "rest_scale", "stiffness_scale", "compression"};
  int32_t status = hk_options_create(&hk_spring_options, options);
  for (size_t k = 0; status == HOOKE_OK && k < sizeof keys / sizeof keys[0]; k++) {
    char dotted[64];
    hk_print(dotted, sizeof dotted, "%s.%s", family, keys[k]);
    status = hk_options_set_value(*options, keys[k], part->options, dotted);
  }
  if (status == HOOKE_OK && by_ratio)
    status = hk_part_set_damping(part, family, count, ends, rest_length, *options);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(*options, "rest_length", count, rest_length);
  return status;
}

/* Number of rest lengths (and dampings) needed: one if all are equal to the bit. */
static int64_t count_given(const struct hk_part *part, int by_ratio, int64_t count,
                           const double *rest_length) {
  if (by_ratio && part->inner_mass == 0.0) return count; /* the masses differ, too */
  int64_t same = 1;
  while (same < count && rest_length[same] == rest_length[0])
    same++;
  return same == count ? 1 : count;
}

static int32_t add_group(struct hk_part *part, const char *family, int by_ratio, int64_t count,
                         const int64_t *ends, const double *rest_length) {
  const int64_t given = count_given(part, by_ratio, count, rest_length);
  char *name = hk_part_group_name(part, family);
  if (name == NULL) return HOOKE_NO_MEMORY;
  hooke_options *options = NULL;
  int32_t status = material(part, family, by_ratio, given, ends, rest_length, &options);
  if (status == HOOKE_OK)
    status = hk_system_add_springs(part->system,
                                   &(struct hk_addition){&hk_force_springs, name, count, ends, options, 1});
  hooke_options_destroy(options);
  hk_free(name);
  return status;
}

static int32_t check_rest_length(const char *family, double length) {
  if (length > 0.0 && isfinite(length)) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, family,
                 "its springs would have a rest length of %g m; allowed: finite "
                 "and > 0, so let the ends and edges of the part lie apart",
                 length);
}

int32_t hk_part_add_pairs(struct hk_part *part, const char *family, int64_t count, const int64_t *ends,
                          const double *rest_length) {
  if (!hk_options_has_family(part->options, family)) return HOOKE_OK;
  int32_t status = hk_part_check_damping(part, family);
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++)
    status = check_rest_length(family, rest_length[k]);
  if (status != HOOKE_OK || count == 0) return status;
  status = add_group(part, family, hk_part_is_given(part, family, "damping_ratio"), count, ends, rest_length);
  return status == HOOKE_OK ? status : hk_fail_within(status, "%s", family);
}

static int32_t pin_numbers(const struct hk_part *part) {
  const int64_t count = hooke_options_number_count(part->options, "pinned");
  const double *number = hooke_options_numbers(part->options, "pinned");
  for (int64_t k = 0; k < count; k++) {
    if (number[k] >= (double)part->count) {
      const int32_t status = hk_fail_index(NULL, "the part has no particle", number[k], part->count);
      return hk_fail_within(status, "pinned[%lld]", (long long)k);
    }
    const int64_t particle = part->first + (int64_t)number[k];
    int32_t status = hooke_system_pin(part->system, 1, &particle);
    if (status != HOOKE_OK) return status;
  }
  return HOOKE_OK;
}

static int32_t pin_words(const struct hooke_part_kind *kind, const struct hk_part *part) {
  const char *rest = hooke_options_text(part->options, "pinned");
  int64_t length, offset;
  for (const char *at; (at = hk_option_next_word(&rest, &length));) {
    char word[32];
    snprintf(word, sizeof word, "%.*s", (int)length, at);
    for (int64_t k = 0; (offset = kind->named(part, word, k)) >= 0; k++) {
      const int64_t particle = part->first + offset;
      int32_t status = hooke_system_pin(part->system, 1, &particle);
      if (status != HOOKE_OK) return status;
    }
  }
  return HOOKE_OK;
}

static int32_t make_rigid(const struct hk_part *part, int64_t number) {
  if (hooke_options_number(part->options, "rigid") == 0.0) return HOOKE_OK;
  int64_t *particles = hk_new(part->count, sizeof *particles);
  if (particles == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < part->count; k++)
    particles[k] = part->first + k;
  const int32_t status = hk_system_add_body(part->system, part->name, part->count, particles, 0, number);
  hk_free(particles);
  return status;
}

static int32_t build(const struct hooke_part_kind *kind, struct hk_part *part) {
  int32_t status = hk_options_check_required(part->options);
  if (status == HOOKE_OK) status = kind->build(part);
  if (status == HOOKE_OK) status = pin_numbers(part);
  if (status == HOOKE_OK) status = pin_words(kind, part);
  if (status == HOOKE_OK) status = hk_set_gravity_factor(part->system, part->first, part->options);
  return status;
}

int32_t hooke_system_add_part(hooke_system *system, const char *kind, const char *name,
                              const hooke_options *options, int64_t *first, int64_t *count) {
  const struct hooke_part_kind *found = find_kind(kind);
  if (found == NULL) return HOOKE_BAD_VALUE;
  int32_t status = hk_options_require(options, found->table, "options", kind);
  if (status == HOOKE_OK) status = hk_system_require_open(system);
  if (status != HOOKE_OK) return status;

  const struct hk_system_mark mark = hk_system_mark(system);
  const int64_t number = system->part_count++;
  char unnamed[64];
  snprintf(unnamed, sizeof unnamed, "%s%lld", kind, (long long)number);
  struct hk_part part = {.system = system, .name = name && name[0] ? name : unnamed, .options = options};
  status = build(found, &part);
  if (status == HOOKE_OK) status = make_rigid(&part, number);
  if (status == HOOKE_OK) {
    const struct hk_part_record record = {.add = hooke_system_add_part,
                                          .grid = found->grid,
                                          .kind = found->table->name,
                                          .first = part.first,
                                          .count = part.count};
    status = hk_part_record_keep(system, record, part.name, options);
  }
  if (status != HOOKE_OK) {
    hk_system_roll_back(system, mark);
    return status;
  }
  if (first) *first = part.first;
  if (count) *count = part.count;
  return HOOKE_OK;
}

int64_t hooke_system_part_count(const hooke_system *system, const char *part, const char *what) {
  for (int64_t k = 0; k < system->part_count; k++) {
    if (strcmp(system->part[k].name, part) != 0) continue;
    if (strcmp(what, "particles") == 0) return system->part[k].count;
    return strcmp(what, "before") == 0 ? system->part[k].first : -1;
  }
  return -1;
}
