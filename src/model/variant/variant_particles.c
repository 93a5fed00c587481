/* Particles of a variant: parts from their options, with changes, and the others one by one. */
#include "model/group.h"
#include "model/start.h"
#include "model/variant/variant.h"

#include "core/memory.h"

#include <stdio.h>
#include <string.h>

/* "bend" of "cloth.bend" */
static const char *family_of(const char *group) {
  const char *dot = strrchr(group, '.');
  return dot ? dot + 1 : group;
}

/* Removes families of which groups or single springs are left out; the remaining ones are added later, as
 * groups. */
static int32_t leave_families_out(const struct hk_variant_maker *maker, int64_t part,
                                  hooke_options *options) {
  const hooke_system *from = maker->from;
  int64_t first = 0;
  for (int64_t g = 0; g < from->group_count; first += from->group[g++].count) {
    const struct hk_group *group = &from->group[g];
    if (!group->from_part || group->part != part) continue;
    const int32_t out = maker->variant->group[g] || hk_variant_breaks_up(maker, group, first);
    const int is_clamp = group->force == &hk_force_anchor;
    const int32_t status =
        out ? hooke_options_unset(options, is_clamp ? "clamped" : family_of(group->name)) : HOOKE_OK;
    if (status != HOOKE_OK) return status;
  }
  return hk_variant_frees_clamps(maker, part) ? hooke_options_unset(options, "clamped") : HOOKE_OK;
}

static int ends_in(const char *name, const char *ending) {
  const size_t length = strlen(name), end = strlen(ending);
  return length > end && strcmp(name + length - end, ending) == 0;
}

/* Multiplies the numbers of an option that is set. */
static int32_t scale_option(hooke_options *options, const char *family, const char *key, double factor) {
  char name[64];
  snprintf(name, sizeof name, "%s%s", family, key);
  if (factor == 1.0 || !hooke_options_is_set(options, name)) return HOOKE_OK;
  const int64_t count = hooke_options_number_count(options, name);
  double *value = hk_new(count, sizeof *value);
  for (int64_t k = 0; k < count && value; k++)
    value[k] = factor * hooke_options_numbers(options, name)[k];
  const int32_t status = value ? hooke_options_set_numbers(options, name, count, value) : HOOKE_NO_MEMORY;
  hk_free(value);
  return status;
}

int32_t hk_variant_scale_options(hooke_options *options, const char *family, const double factor[2]) {
  static const char *const keys[] = {"stiffness", "curve.force", "curve.coefficients", "damping",
                                     "damping_ratio"};
  int32_t status = HOOKE_OK;
  for (int k = 0; k < 5 && status == HOOKE_OK; k++)
    status = scale_option(options, family, keys[k], factor[k < 3 ? HOOKE_KAPPA : HOOKE_GAMMA]);
  return status;
}

/* Stiffness and damping of the families of groups that have factors. */
static int32_t scale_families(const struct hk_variant_maker *maker, int64_t part, hooke_options *options) {
  int32_t status = HOOKE_OK;
  for (int64_t g = 0; g < maker->from->group_count && status == HOOKE_OK; g++) {
    const struct hk_group *group = &maker->from->group[g];
    const double factor[2] = {maker->variant->factor[HOOKE_KAPPA][g], maker->variant->factor[HOOKE_GAMMA][g]};
    char family[64];
    if (!group->from_part || group->part != part) continue;
    snprintf(family, sizeof family, "%s.", family_of(group->name));
    status = group->force == &hk_force_bending ? scale_option(options, "bending", "", factor[HOOKE_KAPPA])
                                               : hk_variant_scale_options(options, family, factor);
  }
  return status;
}

/* Damping and compression of all present families. */
static int32_t change_families(const struct hk_variant *variant, hooke_options *options) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < hooke_options_row_count(options) && status == HOOKE_OK; k++) {
    const char *name = hooke_options_row(options, k, "name");
    char family[64];
    snprintf(family, sizeof family, "%.*s", (int)strcspn(name, "."), name);
    if (!hk_options_has_family(options, family)) continue;
    if (variant->damping && (ends_in(name, ".damping") || ends_in(name, ".damping_ratio"))) {
      status = hooke_options_unset(options, name);
    } else if (variant->compression && ends_in(name, ".compression")) {
      status = hooke_options_set_number(options, name, 0.0);
    }
  }
  return status;
}

/* Removes pins of parts by number; hk_variant_constrain() pins the corresponding particles. */
static int32_t change_resolution(const struct hk_part_record *record, const struct hk_variant_part *part,
                                 hooke_options *options) {
  int32_t status = record->grid->set_cells(options, part->made);
  if (status == HOOKE_OK && hooke_options_number_count(options, "pinned") > 0) {
    status = hooke_options_unset(options, "pinned");
  }
  return status;
}

/* Factors of gravity at the points of another resolution, from those around them. */
static int32_t change_factors(const double *factor, const struct hk_variant_part *part,
                              hooke_options *options) {
  struct hk_variant_part back = {.axes = part->axes};
  int64_t corner[8], count = 1;
  double weight[8];
  for (int32_t a = 0; a < part->axes; a++) {
    back.cells[a] = part->made[a];
    back.made[a] = part->cells[a];
    count *= part->made[a] + 1;
  }
  double *made = hk_new(count, sizeof *made);
  for (int64_t p = 0; p < count && made; p++) {
    const int32_t corners = hk_variant_corners(&back, p, corner, weight);
    for (int32_t c = 0; c < corners; c++)
      made[p] += weight[c] * factor[corner[c]];
  }
  const int32_t status =
      made ? hooke_options_set_numbers(options, "gravity_factor", count, made) : HOOKE_NO_MEMORY;
  hk_free(made);
  return status;
}

/* Of particles that a variant has as they are, in whatever way they have their factor. */
static int32_t copy_factors(const struct hk_variant_maker *maker) {
  const double *factor = maker->from->gravity_factor;
  int32_t status = HOOKE_OK;
  for (int64_t p = 0; p < maker->from->particle_count && factor && status == HOOKE_OK; p++)
    if (hk_variant_is_same(maker->map, p))
      status = hooke_system_set_gravity_factor(maker->made, maker->map->to[p], 1, 1, &factor[p]);
  return status;
}

static int32_t add_part(struct hk_variant_maker *maker, int64_t k) {
  const struct hk_part_record *record = &maker->from->part[k];
  struct hk_variant_part *part = &maker->map->part[k];
  const double scale = maker->variant->scale[k];
  hooke_options *options = NULL;
  part->axes = scale != 1.0 ? hk_variant_cells(record, scale, part->cells, part->made) : 0;
  int32_t status = hooke_options_copy(record->options, &options);
  if (status == HOOKE_OK && part->axes > 0) status = change_resolution(record, part, options);
  if (status == HOOKE_OK && part->axes > 0 && maker->from->gravity_factor)
    status = change_factors(maker->from->gravity_factor + record->first, part, options);
  if (status == HOOKE_OK) status = scale_families(maker, k, options);
  if (status == HOOKE_OK) status = leave_families_out(maker, k, options);
  if (status == HOOKE_OK) status = change_families(maker->variant, options);
  if (status == HOOKE_OK && maker->variant->rigid[k])
    status = hooke_options_set_number(options, "rigid", 1.0);
  if (status == HOOKE_OK) {
    status = record->add(maker->made, record->kind, record->name, options, &part->first, &part->count);
  }
  hooke_options_destroy(options);
  for (int64_t p = 0; p < record->count && status == HOOKE_OK; p++) {
    maker->map->to[record->first + p] = part->first + (part->axes > 0 ? hk_variant_nearest(part, p) : p);
    if (part->axes == 0) maker->made->mass[part->first + p] *= maker->variant->mass[record->first + p];
  }
  return status;
}

/* Adds those from `first` to before `end`, which belong to no part. */
static int32_t add_alone(struct hk_variant_maker *maker, int64_t first, int64_t end) {
  const hooke_system *from = maker->from;
  const double *given = hk_undeformed_position(from);
  int32_t status = HOOKE_OK;
  while (first < end && status == HOOKE_OK) {
    int64_t stop = first;
    while (stop < end && !maker->variant->particle[stop])
      stop++;
    int64_t added = 0;
    if (stop > first) {
      status = hooke_system_add_particles(maker->made, stop - first, given + 3 * first,
                                          from->velocity ? from->velocity + 3 * first : NULL, stop - first,
                                          from->mass + first, &added);
    }
    for (int64_t p = first; p < stop && status == HOOKE_OK; p++) {
      maker->map->to[p] = added + p - first;
      maker->made->mass[maker->map->to[p]] *= maker->variant->mass[p];
    }
    if (stop < end) maker->map->to[stop] = -1;
    first = stop + 1;
  }
  return status;
}

int32_t hk_variant_add_particles(struct hk_variant_maker *maker) {
  const hooke_system *from = maker->from;
  maker->map->to = hk_new(from->particle_count, sizeof *maker->map->to);
  maker->map->part = hk_new(from->part_count, sizeof *maker->map->part);
  if (!maker->map->to || !maker->map->part) return HOOKE_NO_MEMORY;
  int64_t next = 0;
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < from->part_count && status == HOOKE_OK && !maker->variant->loose; k++) {
    const struct hk_part_record *record = &from->part[k];
    status = add_alone(maker, next, record->first);
    next = record->first + record->count;
    if (!maker->variant->part[k]) {
      if (status == HOOKE_OK) status = add_part(maker, k);
      continue;
    }
    maker->map->part[k].first = -1;
    for (int64_t p = record->first; p < next; p++)
      maker->map->to[p] = -1;
  }
  if (status == HOOKE_OK) status = add_alone(maker, next, from->particle_count);
  return status == HOOKE_OK ? copy_factors(maker) : status;
}
