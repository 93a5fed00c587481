#include "model/variant/variant.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/callbacks.h"
#include "model/check_value.h"
#include "model/generalized.h"
#include "model/system.h"

#include <string.h>

void hk_variant_release(struct hk_variant *variant) {
  hk_free(variant->scale);
  memset(variant, 0, sizeof *variant);
}

static int64_t flags_of(const hooke_system *system) {
  return system->group_count + system->springs->count + system->particle_count + 2 * system->part_count;
}

static int64_t factors_of(const hooke_system *system) {
  return system->part_count + 2 * system->group_count + system->particle_count + 2 * system->springs->count;
}

/* One block: numbers, then flags. */
int32_t hk_variant_create(const hooke_system *system, struct hk_variant *variant) {
  const int64_t factors = factors_of(system);
  *variant =
      (struct hk_variant){.drag = 1.0, .scale = hk_new(factors + flags_of(system) / 8 + 1, sizeof(double))};
  if (variant->scale == NULL) return HOOKE_NO_MEMORY;
  variant->factor[HOOKE_KAPPA] = variant->scale + system->part_count;
  variant->factor[HOOKE_GAMMA] = variant->factor[HOOKE_KAPPA] + system->group_count;
  variant->single[HOOKE_KAPPA] = variant->factor[HOOKE_GAMMA] + system->group_count;
  variant->single[HOOKE_GAMMA] = variant->single[HOOKE_KAPPA] + system->springs->count;
  variant->mass = variant->single[HOOKE_GAMMA] + system->springs->count;
  variant->group = (uint8_t *)(variant->scale + factors);
  variant->spring = variant->group + system->group_count;
  variant->particle = variant->spring + system->springs->count;
  variant->part = variant->particle + system->particle_count;
  variant->rigid = variant->part + system->part_count;
  for (int64_t k = 0; k < factors; k++)
    variant->scale[k] = 1.0;
  return HOOKE_OK;
}

static void join(int64_t count, uint8_t *flag, const uint8_t *other) {
  for (int64_t k = 0; k < count; k++)
    flag[k] |= other[k];
}

void hk_variant_join(const hooke_system *system, struct hk_variant *variant, const struct hk_variant *other) {
  join(HOOKE_FORCES, variant->without, other->without);
  variant->damping |= other->damping;
  variant->compression |= other->compression;
  join(flags_of(system), variant->group, other->group);
  for (int64_t k = 0; k < factors_of(system); k++)
    variant->scale[k] *= other->scale[k];
  variant->drag *= other->drag;
}

/* 1 if a part adds the group and is left out, or is a body, which has nothing inside but feels drag. */
static int32_t goes_with_part(const struct hk_variant *variant, const struct hk_group *group) {
  return group->from_part &&
         (variant->part[group->part] || (variant->rigid[group->part] && !group->force->is_drag));
}

static int32_t covers_groups(const hooke_system *system, const struct hk_variant *variant,
                             const struct hk_variant *other) {
  int64_t first = 0;
  for (int64_t g = 0; g < system->group_count; first += system->group[g++].count) {
    const struct hk_group *group = &system->group[g];
    if (variant->group[g] || goes_with_part(variant, group)) continue;
    if (other->group[g]) return 0;
    for (int64_t s = first; s < first + group->count && group->force->kind & HOOKE_LOOPED; s++) {
      if (other->spring[s] && !variant->spring[s]) return 0;
    }
  }
  return 1;
}

int32_t hk_variant_covers(const hooke_system *system, const struct hk_variant *variant,
                          const struct hk_variant *other) {
  int32_t covered = other->damping <= variant->damping && other->compression <= variant->compression;
  for (int32_t k = 0; k < HOOKE_FORCES && covered; k++)
    covered = other->without[k] <= variant->without[k];
  for (int64_t k = 0; k < system->part_count && covered; k++)
    covered = variant->part[k] ||
              (!other->part[k] && other->scale[k] == 1.0 && other->rigid[k] <= variant->rigid[k]);
  for (int64_t p = 0; p < system->particle_count && covered; p++)
    covered = other->particle[p] <= variant->particle[p];
  return covered && covers_groups(system, variant, other);
}

/* In a part of another resolution all springs remain. */
static int32_t is_split(const hooke_system *system, const struct hk_variant *variant, int64_t g,
                        int64_t first) {
  const struct hk_group *group = &system->group[g];
  if (!group->from_part || !(group->force->kind & HOOKE_LOOPED) || variant->group[g] ||
      goes_with_part(variant, group))
    return 0;
  if (variant->scale[group->part] != 1.0 || group->count == 0) return 0;
  const uint8_t *spring = variant->spring + first;
  return memchr(spring, 0, (size_t)group->count) != NULL && memchr(spring, 1, (size_t)group->count) != NULL;
}

int64_t hk_variant_next_split(const hooke_system *system, const struct hk_variant *variant, int64_t group) {
  int64_t first = 0;
  for (int64_t g = 0; g < system->group_count; first += system->group[g++].count) {
    if (g >= group && is_split(system, variant, g, first)) return g;
  }
  return -1;
}

/* 1 if single springs of the group have factors; `first` is its first member's number. */
static int32_t has_singles(const struct hk_variant_maker *maker, const struct hk_group *group,
                           int64_t first) {
  for (int64_t s = first; s < first + group->count && group->force->kind & HOOKE_LOOPED; s++)
    if (maker->variant->single[HOOKE_KAPPA][s] != 1.0 || maker->variant->single[HOOKE_GAMMA][s] != 1.0)
      return 1;
  return 0;
}

int32_t hk_variant_breaks_up(const struct hk_variant_maker *maker, const struct hk_group *group,
                             int64_t first) {
  if (!(group->force->kind & HOOKE_LOOPED) || maker->map->part[group->part].axes > 0 ||
      maker->variant->rigid[group->part])
    return 0;
  return group->count > 0 && (memchr(maker->variant->spring + first, 1, (size_t)group->count) != NULL ||
                              has_singles(maker, group, first));
}

/* Renumbers a member for the variant; 0 if a particle is missing or may not be held, or two have become one.
 */
static int32_t renumber(const struct hk_variant_maker *maker, const struct hk_group *group, int64_t k) {
  for (int e = 0; e < group->force->member_particles; e++) {
    const int64_t to = maker->map->to[group->particle[e][k]];
    if (to < 0 || (group->force->on_free && maker->made->constrained[to])) return 0;
    group->particle[e][k] = (int32_t)to;
    for (int other = 0; other < e && !group->force->is_drag; other++) /* a segment repeats its end */
      if (group->particle[other][k] == (int32_t)to) return 0;
  }
  return 1;
}

/* The members from `first` on that remain, with the factors of their group. */
static void collect(const struct hk_variant_maker *maker, int64_t first, const double factor[2],
                    struct hk_group *kept) {
  const uint8_t *spring = kept->force->kind & HOOKE_LOOPED ? maker->variant->spring + first : NULL;
  const int64_t count = kept->count;
  kept->force->recall(maker->from, first, kept);
  kept->count = 0;
  for (int64_t k = 0; k < count; k++) {
    if ((spring && spring[k]) || !renumber(maker, kept, k)) continue;
    if (k != kept->count) hk_group_swap(kept, k, kept->count);
    for (int n = HOOKE_KAPPA; n <= HOOKE_GAMMA; n++)
      if (kept->number[n])
        kept->number[n][kept->count] *= factor[n] * (spring ? maker->variant->single[n][first + k] : 1.0);
    kept->count++;
  }
  if (maker->variant->damping && kept->number[HOOKE_GAMMA] && kept->count > 0)
    memset(kept->number[HOOKE_GAMMA], 0, (size_t)kept->count * sizeof(double));
}

/* Options as given find the rest lengths of springs to a part at another resolution. */
static int32_t take_options(const struct hk_variant_maker *maker, const hooke_options *from,
                            const double factor[2], struct hk_group *kept) {
  int32_t status = hooke_options_copy(from, &kept->options);
  if (status != HOOKE_OK || !(kept->force->kind & HOOKE_LOOPED)) return status;
  status = hk_variant_scale_options(kept->options, "", factor);
  if (status == HOOKE_OK && maker->variant->damping) status = hooke_options_unset(kept->options, "damping");
  if (status == HOOKE_OK && maker->variant->damping)
    status = hooke_options_unset(kept->options, "damping_ratio");
  if (status == HOOKE_OK && maker->variant->compression)
    status = hooke_options_set_number(kept->options, "compression", 0.0);
  return status == HOOKE_OK ? hk_springs_find_material(maker->made, kept->options, kept) : status;
}

int hk_variant_frees_clamps(const struct hk_variant_maker *maker, int64_t part) {
  for (int64_t g = 0; g < maker->from->group_count; g++) {
    const struct hk_group *group = &maker->from->group[g];
    if (maker->variant->group[g] && group->from_part && group->part == part &&
        (group->force == &hk_force_bending || group->force == &hk_force_anchor))
      return 1;
  }
  return 0;
}

/* Clamps that the part no longer adds; those of another resolution go with its bending. */
static int keeps_clamps(const struct hk_variant_maker *maker, const struct hk_group *group) {
  return group->force == &hk_force_anchor && maker->map->part[group->part].axes == 0 &&
         !maker->variant->rigid[group->part] && hk_variant_frees_clamps(maker, group->part);
}

/* Adds a group that no part adds; `first` is the number of its first member. Members keep their numbers, but
 * for springs whose options are known. A group whose members all have neither stiffness nor damping keeps its
 * place. */
static int32_t keep_group(const struct hk_variant_maker *maker, const struct hk_group *group, int64_t first) {
  const int64_t g = group - maker->from->group;
  const double factor[2] = {maker->variant->factor[HOOKE_KAPPA][g], maker->variant->factor[HOOKE_GAMMA][g]};
  struct hk_group kept = {.force = group->force,
                          .count = group->count,
                          .pull_only =
                              group->pull_only || (maker->variant->compression && hk_group_resists(group))};
  int32_t status = hk_curve_copy(group->curve, kept.pull_only, &kept.curve);
  if (status == HOOKE_OK && kept.curve && factor[0] != 1.0) status = hk_curve_scale(&kept.curve, factor[0]);
  if (status == HOOKE_OK) status = hk_group_allocate(&kept, group->name);
  if (status == HOOKE_OK) collect(maker, first, factor, &kept);
  if (status == HOOKE_OK) status = hk_scaling_copy(group->scaling, &kept.scaling);
  if (status == HOOKE_OK && group->options && !has_singles(maker, group, first))
    status = take_options(maker, group->options, factor, &kept);
  if (status == HOOKE_OK && (kept.count > 0 || group->count == 0))
    return hk_system_add_group(maker->made, &kept);
  hk_group_release(&kept);
  return status;
}

/* Groups that no part adds: explicit ones, and the remainder of those of parts. */
static int32_t keep_groups(struct hk_variant_maker *maker) {
  const hooke_system *from = maker->from;
  const struct hk_force_row *force = NULL;
  int32_t status = HOOKE_OK;
  int64_t first = 0;
  for (int64_t g = 0; g < from->group_count && status == HOOKE_OK; first += from->group[g++].count) {
    const struct hk_group *group = &from->group[g];
    if (group->force != force) first = 0;
    force = group->force;
    const int by_part = group->from_part && !maker->variant->loose &&
                        !hk_variant_breaks_up(maker, group, first) && !keeps_clamps(maker, group);
    if (maker->variant->group[g] || by_part) continue;
    status = keep_group(maker, group, first);
  }
  return status;
}

static int32_t copy_others(const struct hk_variant_maker *maker) {
  int32_t status = HOOKE_OK;
  for (int32_t k = 0; hk_force_table(k) && status == HOOKE_OK; k++)
    if (hk_force_table(k)->copy && !maker->variant->without[k]) status = hk_force_table(k)->copy(maker);
  return status;
}

static int32_t copy_names(const struct hk_variant_maker *maker) {
  const struct hk_system_rest *from = maker->from->rest;
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < from->name_count && status == HOOKE_OK; k++) {
    const int64_t to = maker->map->to[from->name[k].particle];
    if (to >= 0) status = hooke_system_name_particle(maker->made, from->name[k].text, to);
  }
  return status;
}

static int32_t copy_movers(const struct hk_variant_maker *maker) {
  int32_t status = HOOKE_OK;
  for (int32_t k = 0; hk_coordinates_table(k) && status == HOOKE_OK; k++)
    status = hk_coordinates_table(k)->copy(maker);
  return status;
}

/* Rigid bodies take it as far as their pins let them. */
static void add_velocity(hooke_system *made, const double velocity[3]) {
  if (velocity[0] == 0.0 && velocity[1] == 0.0 && velocity[2] == 0.0) return;
  for (int64_t i = 0; i < 3 * made->particle_count; i++)
    if (!made->constrained[i / 3]) made->velocity[i] += velocity[i % 3];
  for (int64_t k = 0; k < made->bodies->count; k++)
    made->bodies->body[k].project = 1;
}

static int32_t make(const hooke_system *from, const struct hk_variant *variant, hooke_system **made,
                    struct hk_variant_map *map) {
  struct hk_variant_maker maker = {from, variant, NULL, map};
  *map = (struct hk_variant_map){.from = from};
  *made = NULL;
  int32_t status = hooke_system_create(&maker.made);
  if (status == HOOKE_OK) maker.made->rest->memory_limit = from->rest->memory_limit;
  if (status == HOOKE_OK) maker.made->overdamped = from->overdamped;
  if (status == HOOKE_OK)
    maker.made->rest->linear.of_velocities = variant->loose && hk_system_is_not_linear(from);
  if (status == HOOKE_OK) status = hk_variant_add_particles(&maker);
  if (status == HOOKE_OK) status = hk_start_copy(&maker);
  if (status == HOOKE_OK) status = hk_variant_constrain(&maker);
  if (status == HOOKE_OK) status = keep_groups(&maker);
  if (status == HOOKE_OK) status = copy_names(&maker);
  if (status == HOOKE_OK) status = copy_movers(&maker);
  if (status == HOOKE_OK) status = copy_others(&maker);
  if (status == HOOKE_OK && !from->overdamped) status = hk_medium_copy_wind(&maker); /* there it is a force */
  if (status == HOOKE_OK) {
    add_velocity(maker.made, variant->velocity);
  }
  if (status == HOOKE_OK) status = hooke_system_commit(maker.made);
  if (status == HOOKE_OK) {
    *made = maker.made;
  } else {
    hooke_system_destroy(maker.made);
    hk_variant_map_release(map);
  }
  return status;
}

/* What is measured on variants would be wrong if they lost something unasked. */
static int32_t require_whole(const hooke_system *from) {
  struct hk_variant nothing;
  struct hk_variant_map map;
  hooke_system *copy = NULL;
  int32_t status = hk_variant_create(from, &nothing);
  if (status == HOOKE_OK) status = make(from, &nothing, &copy, &map);
  hk_variant_release(&nothing);
  if (status != HOOKE_OK) return status;
  const char *different = hk_system_difference(from, copy);
  hk_variant_map_release(&map);
  hooke_system_destroy(copy);
  if (different)
    return hk_fail(HOOKE_INTERNAL, NULL,
                   "a copy of the scene loses or changes its %s, so nothing "
                   "is known of variants of it; this is a defect of hooke",
                   different);
  from->rest->is_copied_whole = 1;
  return HOOKE_OK;
}

int32_t hk_variant_make(const hooke_system *from, const struct hk_variant *variant, hooke_system **made,
                        struct hk_variant_map *map) {
  *map = (struct hk_variant_map){.from = from};
  *made = NULL;
  int32_t status = hk_system_require_committed(from);
  if (status == HOOKE_OK && !from->rest->is_copied_whole) status = require_whole(from);
  return status == HOOKE_OK ? make(from, variant, made, map) : status;
}

static int32_t check_taken(const hooke_system *system, int64_t count, const int64_t *particles) {
  const int32_t called = hk_system_calls_back(system) | system->rest->called;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_system_require_scene(system, "system", "");
  if (status != HOOKE_OK) return status;
  if (system->bodies->count > 0)
    return hk_fail(HOOKE_UNSUITED, "system", "has the rigid body \"%.40s\"; a part of it takes none",
                   system->bodies->body[0].name);
  if (called)
    return hk_fail(HOOKE_UNSUITED, "system", "has callbacks (%s); a part of it takes none",
                   hk_callbacks_text(called));
  status = hk_system_check_particles(system, "particles", count, particles, 0);
  for (int64_t k = 1; k < count && status == HOOKE_OK; k++)
    if (particles[k] <= particles[k - 1])
      status = hk_fail(HOOKE_BAD_VALUE, "particles", "%lld after %lld; allowed: ascending numbers",
                       (long long)particles[k], (long long)particles[k - 1]);
  return status;
}

int32_t hooke_system_take(const hooke_system *system, int64_t count, const int64_t *particles,
                          hooke_system **taken) {
  struct hk_variant variant;
  struct hk_variant_map map;
  int32_t status = check_taken(system, count, particles);
  if (status == HOOKE_OK) status = hk_variant_create(system, &variant);
  if (status != HOOKE_OK) return status;
  variant.loose = 1;
  memset(variant.particle, 1, (size_t)system->particle_count);
  for (int64_t k = 0; k < count; k++)
    variant.particle[particles[k]] = 0;
  status = hk_variant_make(system, &variant, taken, &map);
  if (status == HOOKE_OK) hk_variant_map_release(&map);
  hk_variant_release(&variant);
  return status;
}
