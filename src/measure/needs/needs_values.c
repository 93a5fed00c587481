/* What is watched, in a variant, where its particles and springs may have other numbers, or be left out. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"

#include <math.h>

/* 1 if a quantity that was read in the variant, too, is of the same particle, or ends of a spring, there. */
static int32_t is_same(const struct hk_variant_map *map, const struct hk_watched *old,
                       const hooke_system *made, const struct hk_watched *now) {
  const int64_t *to = map->to;
  if (old->what->of == HOOKE_WATCHED_SUPPORT)
    return hk_variant_is_same(map, old->particle) && to[old->particle] == now->particle;
  if (old->what->of != HOOKE_WATCHED_SPRING || old->group) return old->what->of != HOOKE_WATCHED_PARTICLE;
  const struct hk_spring a = hk_springs_find(map->from->springs, old->spring, HOOKE_AS_GIVEN),
                         b = hk_springs_find(made->springs, now->spring, HOOKE_AS_GIVEN);
  return hk_variant_is_same(map, a.head) && hk_variant_is_same(map, a.tail) && to[a.head] == b.head &&
         to[a.tail] == b.tail;
}

int32_t hk_needs_move_watched(const struct hk_needs *needs, const struct hk_needs_trial *trial,
                              struct hk_watched_list *moved) {
  *moved = (struct hk_watched_list){.system = trial->system};
  for (int64_t k = 0; k < needs->watched.count; k++) {
    const struct hk_watched *old = &needs->watched.item[k];
    const int32_t status = hk_watched_read(moved, "want", old->text);
    if (status == HOOKE_NO_MEMORY) return status;
    if (status == HOOKE_OK && trial->map &&
        !is_same(trial->map, old, trial->system, &moved->item[moved->count - 1]))
      hk_free(moved->item[--moved->count].text);
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
    const int64_t at = hk_watched_find(moved, watched->text);
    double value = at < 0 ? NAN : now[at];
    if (trial->map && watched->what->of == HOOKE_WATCHED_PARTICLE) {
      hk_variant_place(trial->map, watched->particle, q, place);
      value = place[watched->what->axis];
    }
    hk_watched_series_of(&path->values, k)[path->recorded - 1] = value;
  }
}
