/* A group of springs of a variant that its parts do not add. */
#include "model/variant/variant.h"

#include "core/memory.h"

#include <string.h>

/* Springs of one group that remain, in the numbering of the variant. */
struct staying {
  int64_t count;
  int64_t *ends;                       /* 2 count */
  double *kappa, *gamma, *rest_length; /* count each */
  int32_t pull_only;
};

static void release(struct staying *staying) {
  hk_free(staying->ends);
  hk_free(staying->kappa);
  hk_free(staying->gamma);
  hk_free(staying->rest_length);
}

static int32_t room(int64_t count, struct staying *staying) {
  staying->ends = hk_new(2 * count, sizeof(int64_t));
  staying->kappa = hk_new(count, sizeof(double));
  staying->gamma = hk_new(count, sizeof(double));
  staying->rest_length = hk_new(count, sizeof(double));
  return staying->ends && staying->kappa && staying->gamma && staying->rest_length ? HOOKE_OK
                                                                                   : HOOKE_NO_MEMORY;
}

static void collect(const struct hk_variant_maker *maker, int64_t first, int64_t end,
                    struct staying *staying) {
  const struct hk_springs *springs = &maker->from->springs;
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    if (run->first + run->count <= first || run->first >= end) continue;
    for (int64_t k = 0; k < run->count; k++) {
      if (maker->variant->spring[run->first + k]) continue; /* a run belongs to one group */
      const struct hk_spring spring = hk_run_spring(run, k);
      const int64_t head = maker->map->to[spring.head], tail = maker->map->to[spring.tail];
      if (head < 0 || tail < 0 || head == tail) continue;
      const int64_t at = staying->count++;
      staying->ends[2 * at] = head;
      staying->ends[2 * at + 1] = tail;
      staying->kappa[at] = spring.kappa;
      staying->gamma[at] = maker->variant->damping ? 0.0 : spring.gamma;
      staying->rest_length[at] = spring.rest_length;
      staying->pull_only = spring.pull_only || maker->variant->compression;
    }
  }
}

/* One number if all are equal to the bit. */
static int32_t set_shortest(hooke_options *options, const char *name, int64_t count, const double *value) {
  int64_t same = 1;
  while (same < count && memcmp(&value[same], &value[0], sizeof *value) == 0)
    same++;
  return hooke_options_set_numbers(options, name, same == count ? 1 : count, value);
}

static int32_t material(const struct staying *staying, hooke_options **options) {
  int32_t status = hk_options_create(&hk_spring_options, options);
  if (status == HOOKE_OK) status = hooke_options_set_text(*options, "law", "length");
  if (status == HOOKE_OK) status = set_shortest(*options, "stiffness", staying->count, staying->kappa);
  if (status == HOOKE_OK) status = set_shortest(*options, "damping", staying->count, staying->gamma);
  if (status == HOOKE_OK)
    status = set_shortest(*options, "rest_length", staying->count, staying->rest_length);
  if (status == HOOKE_OK && staying->pull_only)
    status = hooke_options_set_number(*options, "compression", 0.0);
  return status;
}

static int32_t given(const struct hk_variant *variant, const hooke_options *from, hooke_options **options) {
  int32_t status = hooke_options_copy(from, options);
  if (status == HOOKE_OK && variant->damping) status = hooke_options_unset(*options, "damping");
  if (status == HOOKE_OK && variant->compression) {
    status = hooke_options_set_number(*options, "compression", 0.0);
  }
  return status;
}

static int32_t add_staying(struct hk_variant_maker *maker, const struct hk_group *group, int64_t first) {
  struct staying staying = {.count = 0};
  hooke_options *options = NULL;
  int32_t status = room(group->count, &staying);
  if (status == HOOKE_OK) {
    collect(maker, first, first + group->count, &staying);
    if (staying.count > 0) {
      status =
          group->options ? given(maker->variant, group->options, &options) : material(&staying, &options);
    }
  }
  if (status == HOOKE_OK && options) {
    status = hooke_system_add_springs(maker->made, group->name, staying.count, staying.ends, options);
  }
  hooke_options_destroy(options);
  release(&staying);
  return status;
}

/* A group whose springs all have neither stiffness nor damping keeps its place. */
static int32_t add_empty_group(struct hk_variant_maker *maker, const struct hk_group *group) {
  hooke_options *options = NULL;
  int32_t status = hk_options_create(&hk_spring_options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "stiffness", 0.0);
  if (status == HOOKE_OK) status = hooke_system_add_springs(maker->made, group->name, 0, NULL, options);
  hooke_options_destroy(options);
  return status;
}

int32_t hk_variant_breaks_up(const struct hk_variant_maker *maker, const struct hk_group *group,
                             int64_t first) {
  if (group->force != &hk_force_springs || maker->map->part[group->part].axes > 0 ||
      maker->variant->rigid[group->part])
    return 0;
  for (int64_t k = 0; k < group->count; k++) {
    if (maker->variant->spring[first + k]) return 1;
  }
  return 0;
}

int32_t hk_variant_keep_springs(struct hk_variant_maker *maker, const struct hk_group *group, int64_t first) {
  return group->count == 0 ? add_empty_group(maker, group) : add_staying(maker, group, first);
}
