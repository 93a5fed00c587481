/* A group of tetrahedra of a variant that its parts do not add. */
#include "model/force/altitude.h"
#include "model/variant/variant.h"

#include "core/memory.h"

/* Renumbers a tetrahedron for the variant and takes over its springs; 0 if a corner is missing, or two have
 * become one. */
static int32_t take_over(const struct hk_variant_maker *maker, struct hk_tetrahedron *t) {
  for (int e = 0; e < 4; e++) {
    const int64_t to = maker->map->to[t->particle[e]];
    if (to < 0) return 0;
    t->particle[e] = (int32_t)to;
    for (int other = 0; other < e; other++) {
      if (t->particle[other] == t->particle[e]) return 0;
    }
  }
  if (maker->variant->damping) t->damping = 0.0;
  if (maker->variant->compression) t->pull_only = 1;
  return 1;
}

int32_t hk_variant_keep_altitude(struct hk_variant_maker *maker, const struct hk_group *group,
                                 int64_t first) {
  const struct hk_tetrahedron *from = maker->from->altitudes->tetrahedron + first;
  struct hk_tetrahedron *tetrahedron = hk_new(group->count, sizeof *tetrahedron);
  if (tetrahedron == NULL) return HOOKE_NO_MEMORY;
  int64_t count = 0;
  for (int64_t k = 0; k < group->count; k++) {
    tetrahedron[count] = from[k];
    count += take_over(maker, &tetrahedron[count]);
  }
  int32_t status = HOOKE_OK;
  if (count > 0) status = hk_system_add_tetrahedra(maker->made, group->name, 0, count, tetrahedron);
  hk_free(tetrahedron);
  return status;
}
