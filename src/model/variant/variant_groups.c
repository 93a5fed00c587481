/* A group of a variant that its parts do not add. */
#include "model/system.h"
#include "model/variant/variant.h"

#include "core/status.h"

#include <string.h>

int32_t hk_variant_breaks_up(const struct hk_variant_maker *maker, const struct hk_group *group,
                             int64_t first) {
  if (!(group->force->kind & HOOKE_LOOPED) || maker->map->part[group->part].axes > 0 ||
      maker->variant->rigid[group->part])
    return 0;
  return group->count > 0 && memchr(maker->variant->spring + first, 1, (size_t)group->count) != NULL;
}

/* Renumbers a member for the variant; 0 if a particle is missing, or two have become one. */
static int32_t renumber(const struct hk_variant_maker *maker, const struct hk_group *group, int64_t k) {
  for (int e = 0; e < group->force->member_particles; e++) {
    const int64_t to = maker->map->to[group->particle[e][k]];
    if (to < 0) return 0;
    group->particle[e][k] = (int32_t)to;
    for (int other = 0; other < e; other++)
      if (group->particle[other][k] == (int32_t)to) return 0;
  }
  return 1;
}

/* The members from `first` on that remain. */
static void collect(const struct hk_variant_maker *maker, int64_t first, struct hk_group *kept) {
  const uint8_t *spring = kept->force->kind & HOOKE_LOOPED ? maker->variant->spring + first : NULL;
  const int64_t count = kept->count;
  kept->force->recall(maker->from, first, kept);
  kept->count = 0;
  for (int64_t k = 0; k < count; k++) {
    if ((spring && spring[k]) || !renumber(maker, kept, k)) continue;
    if (k != kept->count) hk_group_swap(kept, k, kept->count);
    kept->count++;
  }
  if (maker->variant->damping && kept->number[HOOKE_GAMMA] && kept->count > 0)
    memset(kept->number[HOOKE_GAMMA], 0, (size_t)kept->count * sizeof(double));
}

/* Options as given find the rest lengths of springs to a part at another resolution. */
static int32_t take_options(const struct hk_variant_maker *maker, const hooke_options *from,
                            struct hk_group *kept) {
  int32_t status = hooke_options_copy(from, &kept->options);
  if (status == HOOKE_OK && maker->variant->damping) status = hooke_options_unset(kept->options, "damping");
  if (status == HOOKE_OK && maker->variant->compression)
    status = hooke_options_set_number(kept->options, "compression", 0.0);
  return status == HOOKE_OK ? hk_springs_find_material(maker->made, kept->options, kept) : status;
}

/* A group whose members all have neither stiffness nor damping keeps its place. */
int32_t hk_variant_keep_group(const struct hk_variant_maker *maker, const struct hk_group *group,
                              int64_t first) {
  struct hk_group kept = {.force = group->force,
                          .count = group->count,
                          .pull_only =
                              group->pull_only || (maker->variant->compression && hk_group_resists(group))};
  int32_t status = hk_group_allocate(&kept, group->name);
  if (status == HOOKE_OK) collect(maker, first, &kept);
  if (status == HOOKE_OK && group->options) status = take_options(maker, group->options, &kept);
  if (status == HOOKE_OK && (kept.count > 0 || group->count == 0))
    return hk_system_add_group(maker->made, &kept);
  hk_group_release(&kept);
  return status;
}
