#include "io/scene/part_names.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

int32_t hk_part_names_create(int64_t count, struct hk_part_names *names) {
  names->part = hk_new(count, sizeof *names->part);
  names->sorted = hk_new(count, sizeof *names->sorted);
  if (names->part == NULL || names->sorted == NULL) return HOOKE_NO_MEMORY;
  names->count = count;
  return HOOKE_OK;
}

int32_t hk_part_names_set(struct hk_part_names *names, int64_t number, const char *name) {
  struct hk_named_part *part = &names->part[number];
  part->number = number;
  part->name = hk_copy_text(name);
  names->sorted[number] = part;
  return part->name ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static int compare(const void *a, const void *b) {
  const struct hk_named_part *one = *(struct hk_named_part *const *)a,
                             *other = *(struct hk_named_part *const *)b;
  const int order = strcmp(one->name, other->name);
  return order ? order : (one->number > other->number) - (one->number < other->number);
}

void hk_part_names_sort(struct hk_part_names *names) {
  qsort(names->sorted, (size_t)names->count, sizeof *names->sorted, compare);
}

void hk_part_names_release(struct hk_part_names *names) {
  for (int64_t k = 0; k < names->count; k++)
    hk_free(names->part[k].name);
  hk_free(names->part);
  hk_free(names->sorted);
  *names = (struct hk_part_names){.count = 0};
}

struct hk_named_part *hk_part_names_find(const struct hk_part_names *names, const char *name) {
  int64_t low = 0, high = names->count;
  while (low < high) {
    const int64_t middle = low + (high - low) / 2;
    if (strcmp(names->sorted[middle]->name, name) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  return low < names->count && strcmp(names->sorted[low]->name, name) == 0 ? names->sorted[low] : NULL;
}
