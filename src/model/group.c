#include "model/group.h"

#include "core/memory.h"
#include "model/force/scaling.h"
#include "model/system.h"

#include <string.h>

int32_t hk_group_allocate(struct hk_group *group, const char *name) {
  int there = (group->name = hk_copy_text(name)) != NULL;
  for (int32_t k = 0; k < group->force->member_particles; k++)
    there &= (group->particle[k] = hk_new(group->count, sizeof(int32_t))) != NULL;
  for (int32_t k = 0; k < HOOKE_GROUP_NUMBERS; k++)
    if (group->force->width[k] > 0)
      there &= (group->number[k] = hk_new(group->force->width[k] * group->count, sizeof(double))) != NULL;
  return there ? HOOKE_OK : HOOKE_NO_MEMORY;
}

void hk_group_release_columns(struct hk_group *group) {
  for (int k = 0; k < HOOKE_MEMBER_PARTICLES; k++)
    hk_free(group->particle[k]);
  for (int k = 0; k < HOOKE_GROUP_NUMBERS; k++)
    hk_free(group->number[k]);
  hk_free(group->ratio);
  group->ratio = NULL;
  memset(group->particle, 0, sizeof group->particle);
  memset(group->number, 0, sizeof group->number);
}

void hk_group_release(struct hk_group *group) {
  hk_group_release_columns(group);
  hk_free(group->name);
  hooke_options_destroy(group->options);
  hk_curve_destroy(group->curve);
  hk_scaling_release(group->scaling);
  memset(group, 0, sizeof *group);
}

/* ---- dropping ---- */

static void swap_numbers(double *number, int64_t a, int64_t b) {
  const double kept = number[a];
  number[a] = number[b];
  number[b] = kept;
}

void hk_group_swap(struct hk_group *group, int64_t a, int64_t b) {
  for (int e = 0; e < group->force->member_particles; e++) {
    const int32_t kept = group->particle[e][a];
    group->particle[e][a] = group->particle[e][b];
    group->particle[e][b] = kept;
  }
  for (int k = 0; k < HOOKE_GROUP_NUMBERS; k++) {
    const int32_t width = group->force->width[k];
    for (int64_t w = 0; w < width; w++)
      swap_numbers(group->number[k], width * a + w, width * b + w);
  }
  if (group->ratio) swap_numbers(group->ratio, a, b);
}

int32_t hk_group_resists(const struct hk_group *group) {
  const struct hk_option_table *options = group->force->options;
  return !group->pull_only && options && hk_options_find(options, "compression") != NULL;
}

static int acts(const struct hk_group *group, int64_t k, const hooke_system *system) {
  if (group->force->on_free)
    return !system->constrained[group->particle[0][k]]; /* not in a body that is held */
  const double *kappa = group->number[HOOKE_KAPPA], *gamma = group->number[HOOKE_GAMMA];
  return group->force->is_drag || group->curve || kappa[k] != 0.0 || (gamma && gamma[k] != 0.0);
}

/* 1 if all particles of a member are in one body, and pull on nothing else. */
static int is_inside(const struct hk_group *group, int64_t k, const struct hk_bodies *bodies) {
  const int32_t body = bodies->of ? bodies->of[group->particle[0][k]] : -1;
  int inside = body >= 0 && group->force->member_particles > 1 && !group->force->is_drag;
  for (int32_t j = 1; j < group->force->member_particles && inside; j++)
    inside = bodies->of[group->particle[j][k]] == body;
  return inside;
}

void hk_group_drop(struct hk_group *group, const hooke_system *system) {
  const double *gamma = group->number[HOOKE_GAMMA];
  int64_t acting = 0;
  group->damped = 0;
  for (int64_t k = 0; k < group->count; k++) {
    const int inside = is_inside(group, k, system->bodies);
    group->inside += inside;
    if (inside || !acts(group, k, system)) continue;
    group->damped |= gamma && gamma[k] != 0.0;
    if (k != acting) hk_group_swap(group, k, acting);
    acting++;
  }
  group->dropped = group->count - acting;
  group->count = acting;
}

void hk_group_take_back(struct hk_group *group) {
  group->count += group->dropped;
  group->dropped = group->inside = 0;
}

/* ---- the table ---- */

static int comes_before(const struct hk_group *a, const struct hk_group *b) {
  const int32_t one = hk_force_number(a->force), other = hk_force_number(b->force);
  return one != other ? one < other : a->from_part < b->from_part;
}

int32_t hk_system_add_group(hooke_system *system, struct hk_group *group) {
  const int64_t count = system->group_count;
  const int32_t status = hk_room((void **)&system->group, count, sizeof *system->group);
  if (status != HOOKE_OK) {
    hk_group_release(group);
    return status;
  }
  int64_t slot = count;
  while (slot > 0 && comes_before(group, &system->group[slot - 1]))
    slot--;
  memmove(system->group + slot + 1, system->group + slot, (size_t)(count - slot) * sizeof *system->group);
  system->group[slot] = *group;
  system->group_count++;
  system->rest->member_total[hk_force_number(group->force)] += group->count;
  return HOOKE_OK;
}

void hk_system_remove_groups(hooke_system *system, int64_t part) {
  int64_t kept = 0;
  for (int64_t g = 0; g < system->group_count; g++) {
    struct hk_group *group = &system->group[g];
    if (group->from_part && group->part >= part) {
      system->rest->member_total[hk_force_number(group->force)] -= group->count;
      hk_group_release(group);
    } else {
      system->group[kept++] = *group;
    }
  }
  system->group_count = kept;
}

/* First group of the forces from `number` on. */
static int64_t first_from(const hooke_system *system, int32_t number) {
  int64_t low = 0, high = system->group_count;
  while (low < high) {
    const int64_t middle = low + (high - low) / 2;
    if (hk_force_number(system->group[middle].force) < number)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

int64_t hk_system_first_group(const hooke_system *system, const struct hk_force_row *force) {
  return first_from(system, hk_force_number(force));
}

int64_t hk_system_groups_of(const hooke_system *system, const struct hk_force_row *force) {
  const int32_t number = hk_force_number(force);
  return first_from(system, number + 1) - first_from(system, number);
}

const struct hk_group *hk_system_group(const hooke_system *system, const struct hk_force_row *force,
                                       int64_t k) {
  const int64_t g = hk_system_first_group(system, force) + k;
  return k >= 0 && g < system->group_count && system->group[g].force == force ? &system->group[g] : NULL;
}

const struct hk_group *hk_system_last_group(const hooke_system *system, const struct hk_force_row *force) {
  return hk_system_group(system, force, hk_system_groups_of(system, force) - 1);
}

int64_t hk_system_members_of(const hooke_system *system, const struct hk_force_row *force) {
  int64_t count = 0;
  for (int64_t g = 0; g < system->group_count; g++)
    count += force == NULL || system->group[g].force == force ? system->group[g].count : 0;
  return count;
}
