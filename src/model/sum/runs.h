/* Sorts members of groups into runs by their numbers: consecutive members whose particles advance by one have
 * a constant offset and need no index; numbers equal to the bit along a run need no arrays. */
#pragma once

#include "hooke/system.h"
#include "model/group.h"

/* Particles and numbers of the members of runs that look them up. */
struct hk_stored {
  int64_t indexed, mixed; /* members with stored particles, and with stored numbers */
  int32_t *particle[HOOKE_MEMBER_PARTICLES];
  double *number[HOOKE_GROUP_NUMBERS];
};
void hk_stored_release(struct hk_stored *stored);
void hk_stored_drop_numbers(struct hk_stored *stored);
int64_t hk_stored_memory(const struct hk_force_row *force, const struct hk_stored *stored);

/* What becomes a run: members of a group, and where those particles and numbers that are looked up are. */
struct hk_piece {
  const struct hk_group *group;
  int64_t from, count;
  int indexed, mixed;
  const int32_t *particle[HOOKE_MEMBER_PARTICLES];
  const double *number[HOOKE_GROUP_NUMBERS];
};
typedef void hk_run_add(hooke_system *system, const struct hk_piece *piece);

/* Makes the array of runs, of `size` bytes each, and calls `add` for one after the other, to fill them.
 * HOOKE_NO_MEMORY, after releasing the force. */
int32_t hk_runs_commit(hooke_system *system, const struct hk_force_row *force, const struct hk_group *group,
                       int64_t count, struct hk_stored *stored, void **run, size_t size, hk_run_add *add);

/* The run of member `number`: the last of `count` runs, `size` bytes apart, that begins with it or before it.
 * `first`: the member of that name of the first run; 0 without any. */
int64_t hk_runs_find(const int64_t *first, int64_t count, size_t size, int64_t number);
