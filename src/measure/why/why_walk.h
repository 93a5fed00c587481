/* The steps of a run that blew up once more, to be shown: those before the trouble, and those after it, which
 * no check ends. */
#pragma once

#include "integrate/integrator.h"

/* Where steps can be taken again from. */
struct hk_why_start {
  hooke_state *state; /* NULL: nothing was kept */
  struct hk_standing standing;
};

/* Keeps the first state of a run that ended, or a later one where the way from there is long. Without room
 * nothing is kept. HOOKE_NO_MEMORY. */
int32_t hk_why_start_keep(const hooke_integrator *run, struct hk_why_start *start);
void hk_why_start_release(struct hk_why_start *start);

/* Sees the state at the k-th of the times that were asked for. Anything but 0 ends the walk. */
typedef int32_t hk_why_see(int64_t k, const hooke_state *state, void *ctx);

/* Takes the steps of `run`, options with a fixed step, from the start on and shows the states nearest to
 * `count` times, ascending, as long as their numbers are finite. Callbacks are called again. The statuses of
 * hooke_integrator_create(), of callbacks and of what `see` returns below 0. */
int32_t hk_why_walk(const hooke_system *system, const struct hk_why_start *start, const hooke_options *run,
                    int64_t count, const double *time, hk_why_see *see, void *ctx);
