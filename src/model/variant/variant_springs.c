/* A group of springs of a variant that its parts do not add. */
#include "model/force/spring.h"
#include "model/variant/variant.h"

#include "core/memory.h"

/* The springs from `first` on that remain, of as many as `kept` counts, in the numbering of the variant. */
static void collect(const struct hk_variant_maker *maker, int64_t first, struct hk_group *kept,
                    int64_t *ends) {
  const struct hk_springs *springs = maker->from->springs;
  const int64_t end = first + kept->count;
  kept->count = 0;
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    if (run->first + run->count <= first || run->first >= end) continue;
    for (int64_t k = 0; k < run->count; k++) {
      if (maker->variant->spring[run->first + k]) continue; /* a run belongs to one group */
      const struct hk_spring spring = hk_run_spring(run, k);
      const int64_t head = maker->map->to[spring.head], tail = maker->map->to[spring.tail];
      if (head < 0 || tail < 0 || head == tail) continue;
      const int64_t at = kept->count++;
      kept->particle[0][at] = (int32_t)(ends[2 * at] = head);
      kept->particle[1][at] = (int32_t)(ends[2 * at + 1] = tail);
      kept->number[HOOKE_KAPPA][at] = spring.kappa;
      kept->number[HOOKE_GAMMA][at] = maker->variant->damping ? 0.0 : spring.gamma;
      kept->number[HOOKE_REST_LENGTH][at] = spring.rest_length;
    }
  }
}

static int32_t given(const struct hk_variant *variant, const hooke_options *from, hooke_options **options) {
  int32_t status = hooke_options_copy(from, options);
  if (status == HOOKE_OK && variant->damping) status = hooke_options_unset(*options, "damping");
  if (status == HOOKE_OK && variant->compression) {
    status = hooke_options_set_number(*options, "compression", 0.0);
  }
  return status;
}

int32_t hk_variant_breaks_up(const struct hk_variant_maker *maker, const struct hk_group *group,
                             int64_t first) {
  if (!(group->force->kind & HOOKE_LOOPED) || maker->map->part[group->part].axes > 0 ||
      maker->variant->rigid[group->part])
    return 0;
  for (int64_t k = 0; k < group->count; k++) {
    if (maker->variant->spring[first + k]) return 1;
  }
  return 0;
}

/* Options as given find the rest lengths of springs to a part at another resolution. A group whose springs
 * all have neither stiffness nor damping keeps its place. */
int32_t hk_variant_keep_springs(struct hk_variant_maker *maker, const struct hk_group *group, int64_t first) {
  struct hk_group kept = {.force = &hk_force_springs,
                          .count = group->count,
                          .pull_only = group->pull_only || maker->variant->compression};
  hooke_options *options = NULL;
  int64_t *ends = hk_new(2 * group->count, sizeof *ends);
  int32_t status = ends ? hk_group_allocate(&kept, group->name, 2, 3, 0) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) collect(maker, first, &kept, ends);
  const int32_t stays = kept.count > 0 || group->count == 0;
  if (status == HOOKE_OK && group->options) status = given(maker->variant, group->options, &options);
  if (status == HOOKE_OK && options && stays)
    status = hooke_system_add_springs(maker->made, group->name, kept.count, ends, options);
  if (status == HOOKE_OK && !options && stays)
    status = hk_system_add_group(maker->made, &kept);
  else
    hk_group_release(&kept);
  hooke_options_destroy(options);
  hk_free(ends);
  return status;
}
