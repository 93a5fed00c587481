/* The parts of a scene by name, in a sorted index. */
#ifndef HOOKE_IO_SCENE_PART_NAMES_H
#define HOOKE_IO_SCENE_PART_NAMES_H

#include "hooke/base.h"

struct hk_named_part {
  char *name; /* owned */
  int64_t number, first, count;
};

struct hk_part_names {
  int64_t count;
  struct hk_named_part *part; /* by number */
  struct hk_named_part **sorted;
};

/* Allocates an index for `count` parts, to be named one by one and then sorted. HOOKE_NO_MEMORY. */
int32_t hk_part_names_create(int64_t count, struct hk_part_names *names);
int32_t hk_part_names_set(struct hk_part_names *names, int64_t number, const char *name);
void hk_part_names_sort(struct hk_part_names *names);
void hk_part_names_release(struct hk_part_names *names);

/* First part of this name; NULL if there is none. */
struct hk_named_part *hk_part_names_find(const struct hk_part_names *names, const char *name);

#endif
