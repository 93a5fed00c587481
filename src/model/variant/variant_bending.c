/* A group of triples of a variant that its parts do not add. */
#include "model/system.h"
#include "model/variant/variant.h"

#include "core/memory.h"

/* Renumbers the triples from `first` to before `end` whose particles are all present; returns their number.
 */
static int64_t collect(const struct hk_variant_maker *maker, int64_t first, int64_t end, int64_t *ends,
                       double *coefficient) {
  struct hk_triples at = {.bending = &maker->from->rest->bending};
  struct hk_triple triple;
  int64_t count = 0;
  for (int64_t k = 0; k < end && hk_next_triple(&at, &triple); k++) {
    int32_t there = k >= first;
    for (int e = 0; e < 3 && there; e++) {
      ends[3 * count + e] = maker->map->to[triple.particle[e]];
      there = ends[3 * count + e] >= 0;
    }
    const int64_t *t = ends + 3 * count;
    if (!there || t[0] == t[1] || t[1] == t[2] || t[0] == t[2]) continue;
    coefficient[count++] = triple.coefficient;
  }
  return count;
}

int32_t hk_variant_keep_bending(struct hk_variant_maker *maker, const struct hk_group *group, int64_t first) {
  int64_t *ends = hk_new(3 * group->count + 3, sizeof *ends);
  double *coefficient = hk_new(group->count, sizeof *coefficient);
  int32_t status = ends && coefficient ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    const int64_t count = collect(maker, first, first + group->count, ends, coefficient);
    if (count > 0)
      status = hooke_system_add_bending(maker->made, group->name, count, ends, count, coefficient);
  }
  hk_free(ends);
  hk_free(coefficient);
  return status;
}
