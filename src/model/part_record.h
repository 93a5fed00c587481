/* Record of the parts of a system, so that another system can be made from it with a part changed. */
#pragma once

#include "hooke/system.h"

/* hooke_system_add_part(), which belongs to a higher layer. */
typedef int32_t hk_part_add(hooke_system *system, const char *kind, const char *name,
                            const hooke_options *options, int64_t *first, int64_t *count);

/* Grid of a kind whose particles form one: number of cells along each axis, one less than particles; the
 * first axis is the fastest. Returns the number of axes, 1 to 3. */
struct hk_part_grid {
  int32_t (*cells)(const hooke_options *options, int64_t cells[3]);
  int32_t (*set_cells)(hooke_options *options, const int64_t cells[3]);
};

struct hk_part_record {
  hk_part_add *add;
  const struct hk_part_grid *grid; /* NULL: not a grid */
  const char *kind;
  char *name;
  hooke_options *options;
  int64_t first, count; /* particles */
  int64_t pinned;       /* number of pinned particles by its options */
};

/* Records the part that is being added, with copies of `name` and `options`. HOOKE_NO_MEMORY. */
int32_t hk_part_record_keep(hooke_system *system, struct hk_part_record record, const char *name,
                            const hooke_options *options);
/* Number of its particles that are pinned. */
int64_t hk_part_record_pinned(const hooke_system *system, const struct hk_part_record *record);
void hk_part_record_release(struct hk_part_record *record);
