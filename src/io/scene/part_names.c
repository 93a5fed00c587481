#include "io/scene/part_names.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

int32_t hooke_part_names_create(int64_t count, struct hooke_part_names *names) {
  names->part = hooke_new(count, sizeof *names->part);
  names->sorted = hooke_new(count, sizeof *names->sorted);
  if (names->part == NULL || names->sorted == NULL) return HOOKE_NO_MEMORY;
  names->count = count;
  return HOOKE_OK;
}

int32_t hooke_part_names_set(struct hooke_part_names *names, int64_t number, const char *name) {
  struct hooke_named_part *part = &names->part[number];
  part->number = number;
  part->name = hooke_copy_text(name);
  names->sorted[number] = part;
  return part->name ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static int compare(const void *a, const void *b) {
  const struct hooke_named_part *one = *(struct hooke_named_part *const *)a,
                                *other = *(struct hooke_named_part *const *)b;
  const int order = strcmp(one->name, other->name);
  return order ? order : (one->number > other->number) - (one->number < other->number);
}

void hooke_part_names_sort(struct hooke_part_names *names) {
  qsort(names->sorted, (size_t)names->count, sizeof *names->sorted, compare);
}

void hooke_part_names_release(struct hooke_part_names *names) {
  for (int64_t k = 0; k < names->count; k++)
    hooke_free(names->part[k].name);
  hooke_free(names->part);
  hooke_free(names->sorted);
  *names = (struct hooke_part_names){.count = 0};
}

struct hooke_named_part *hooke_part_names_find(const struct hooke_part_names *names, const char *name) {
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
