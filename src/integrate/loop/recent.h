/* The last states of a run that passed the check, and its initial one, as far as a small memory holds them.
 */
#pragma once

#include "model/state.h"

enum { HOOKE_MOST_RECENT = 8 };

/* A ring, so that keeping one more costs one copy, like keeping the last one alone. */
struct hk_recent {
  hooke_state *state[HOOKE_MOST_RECENT];
  int64_t step[HOOKE_MOST_RECENT]; /* steps since the run began */
  hooke_state *first; /* initial state of the run; NULL if it is not known, or there is no space for it */
  hooke_state *first_kept;
  int32_t capacity, count, newest;
};

/* Allocates space for at least `least` (0 or 1) states of `size` numbers in q. HOOKE_NO_MEMORY. */
int32_t hk_recent_create(int64_t size, int32_t has_v, int32_t least, struct hk_recent *recent);
/* If there is no space, the one state that counts as kept has no copy: this allocates space for one, without
 * its numbers. */
int32_t hk_recent_extend(int64_t size, int32_t has_v, struct hk_recent *recent);
void hk_recent_release(struct hk_recent *recent);
int64_t hk_recent_memory(const struct hk_recent *recent);

/* The initial state of a run that continues from elsewhere; NULL: unknown. */
void hk_recent_set_first(struct hk_recent *recent, const hooke_state *first);
/* Slot for the state after this step, for the caller to write; NULL: no space. A second state after the same
 * step replaces the first. */
hooke_state *hk_recent_next(struct hk_recent *recent, int64_t step);
/* The same with a copy of `state`. */
void hk_recent_keep(struct hk_recent *recent, const hooke_state *state, int64_t step);

/* The state kept `back` before the newest (0: the newest itself), and its step; NULL if there is none, or no
 * space. */
const hooke_state *hk_recent_state(const struct hk_recent *recent, int64_t back, int64_t *step);
