/* What is watched, in a variant: its particles and springs have other numbers there, or are left out. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "model/system.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* The group from `number` on, of that name, with its first spring; NULL at the end. */
static const struct hk_group *next_group(const hooke_system *system, const char *name, int64_t *number,
                                         int64_t *first) {
  for (; *number < hk_system_groups_of(system, &hk_force_springs);
       *first += system->group[(*number)++].count) {
    const struct hk_group *group = &system->group[*number];
    if (group->name && name && strcmp(group->name, name) == 0 && group->count > 0) return group;
  }
  return NULL;
}

static const char *group_of(const hooke_system *system, int64_t spring) {
  int64_t g = 0;
  while (spring >= system->group[g].count)
    spring -= system->group[g++].count;
  return system->group[g].name;
}

/* The spring of the variant in a group of the same name between the same particles; -1: none. */
static int64_t find_spring(const struct hk_variant_map *map, const hooke_system *made, int64_t spring) {
  const struct hk_spring old = hk_springs_find(map->from->springs, spring, HOOKE_AS_GIVEN);
  const char *name = group_of(map->from, spring);
  if (!hk_variant_is_same(map, old.head) || !hk_variant_is_same(map, old.tail)) return -1;
  const struct hk_group *group;
  for (int64_t g = 0, first = 0; (group = next_group(made, name, &g, &first)); first += group->count, g++) {
    for (int64_t k = first; k < first + group->count; k++) {
      const struct hk_spring now = hk_springs_find(made->springs, k, HOOKE_AS_GIVEN);
      if (now.head == map->to[old.head] && now.tail == map->to[old.tail]) return k;
    }
  }
  return -1;
}

/* 1 if the variant has it. */
static int32_t move(const struct hk_variant_map *map, const hooke_system *made, struct hk_watched *watched) {
  int64_t g = 0, first = 0;
  switch (watched->what->of) {
  case HOOKE_WATCHED_SUPPORT:
    if (!hk_variant_is_same(map, watched->particle)) return 0;
    watched->particle = map->to[watched->particle];
    return made->constrained[watched->particle] && made->bodies->of[watched->particle] < 0;
  case HOOKE_WATCHED_SPRING:
    if (watched->group) return next_group(made, watched->group, &g, &first) != NULL;
    watched->spring = find_spring(map, made, watched->spring);
    return watched->spring >= 0;
  default:
    return watched->what->of == HOOKE_WATCHED_SCENE;
  }
}

int32_t hk_needs_move_watched(const struct hk_needs *needs, const struct hk_needs_trial *trial,
                              struct hk_watched_list *moved) {
  const struct hk_watched_list *list = &needs->watched;
  *moved = (struct hk_watched_list){.system = trial->system, .count = list->count};
  moved->item = hk_new(list->count, sizeof *moved->item);
  if (moved->item == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < list->count; k++) {
    moved->item[k] = list->item[k];
    if (trial->map && !move(trial->map, trial->system, &moved->item[k])) moved->item[k].what = NULL;
  }
  return HOOKE_OK;
}

void hk_needs_keep_values(const struct hk_needs *needs, const struct hk_needs_trial *trial,
                          const struct hk_watched_list *moved, const hooke_state *state,
                          struct hk_needs_path *path) {
  const double *q = hooke_state_position(state);
  double *now = path->values.now, place[3];
  if (needs->watched.count == 0) return;
  hk_watched_values(moved, hooke_state_time(state), q, hooke_state_velocity(state), now);
  for (int64_t k = 0; k < needs->watched.count; k++) {
    const struct hk_watched *watched = &needs->watched.item[k];
    if (trial->map && watched->what->kind == HOOKE_WATCHED_COORDINATE) {
      hk_variant_place(trial->map, watched->particle, q, place);
      now[k] = place[watched->what->axis];
    }
    hk_watched_series_of(&path->values, k)[path->recorded - 1] = now[k];
  }
}
