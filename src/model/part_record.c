#include "model/part_record.h"

#include "core/memory.h"
#include "core/table/option.h"
#include "model/particles.h"

#include <string.h>

int64_t hk_part_record_pinned(const hooke_system *system, const struct hk_part_record *record) {
  int64_t pinned = 0;
  for (int64_t p = record->first; p < record->first + record->count; p++)
    pinned += system->constrained[p] == HOOKE_IS_PINNED;
  return pinned;
}

int32_t hk_part_record_keep(hooke_system *system, struct hk_part_record record, const char *name,
                            const hooke_options *options) {
  const int64_t last = system->part_count - 1;
  record.pinned = hk_part_record_pinned(system, &record);
  record.name = hk_copy_text(name);
  int32_t status = record.name ? hooke_options_copy(options, &record.options) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hk_room((void **)&system->part, last, sizeof record);
  if (status == HOOKE_OK)
    system->part[last] = record;
  else
    hk_part_record_release(&record);
  return status;
}

void hk_part_record_release(struct hk_part_record *record) {
  hk_free(record->name);
  hooke_options_destroy(record->options);
  memset(record, 0, sizeof *record);
}
