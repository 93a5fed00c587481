/* The pieces of the run loop: what is the same for every method (run.c), internal steps of an
 * error-controlled one (run_adaptive.c), going on from a place that another run came to (resume.c), and
 * frames after divergence (run_beyond.c). */
#pragma once

#include "integrate/integrator.h"

enum { HOOKE_CHECK_STEPS = 1000 };

/* HOOKE_BAD_VALUE for a state of another size, and for a whole run without a duration. Restart threads in a
 * child of fork(). */
int32_t hk_run_check_state(const hooke_integrator *integrator, const hooke_state *state);
int32_t hk_run_check_whole(const hooke_integrator *integrator, const hooke_state *state);

/* Moves driven particles to their prescribed positions at the time of the state, whatever the caller wrote
 * there. */
int32_t hk_run_place_driven(hooke_integrator *integrator, hooke_state *state);
/* The start of a run at `state`, as step 0. */
int32_t hk_run_begin(hooke_integrator *integrator, hooke_state *state);
/* The same at a later state of a run, whose initial one stays. */
int32_t hk_run_begin_later(hooke_integrator *integrator, hooke_state *state);
/* From there, or from the current point, to the end of its schedule. */
int32_t hk_run_to_end(hooke_integrator *integrator, hooke_state *state);
/* With a fixed step: continues to step `last` with checks, step observers and checkpoints, and frames every
 * `frame_steps` and at the end of the schedule (0: none). `shows`: 1 if `state` should receive the result; 0:
 * checks and observers use it. */
int32_t hk_run_fixed(hooke_integrator *integrator, hooke_state *state, int64_t last, int64_t frame_steps,
                     int32_t shows);
/* Records the outcome, for a diagnosis, with the state at which a solver gave up. Returns `status`. */
int32_t hk_run_end(hooke_integrator *integrator, hooke_state *state, int32_t status);

/* hooke_integrator_run() without what may come after divergence, which trials do not want. */
int32_t hk_run_whole(hooke_integrator *integrator, hooke_state *state);
/* Where a run ended with `status`, as divergence, and its options ask for it: shows the frames beyond.
 * Whatever comes of them, the integrator and the state are as they were, and so is the message. Returns
 * `status`. */
int32_t hk_run_beyond(hooke_integrator *integrator, hooke_state *state, int32_t status);
/* `count` steps of a fixed-step method, with progress told in between. */
int32_t hk_run_take_fixed_steps(hooke_integrator *integrator, int64_t count);

/* Springs that pass through length zero: begins to count them at time t, and counts those of a step
 * between two times. */
void hk_passages_begin(hooke_integrator *integrator, double t);
int32_t hk_passages_count(hooke_integrator *integrator, double from, double to);

/* Shows the state to an observer, if there is one; the second as the next frame. */
int32_t hk_run_observe(hooke_integrator *integrator, const struct hk_watch *watch, const hooke_state *state);
int32_t hk_run_report(hooke_integrator *integrator, hooke_state *state);
/* Reports progress after so many steps, if it is due: HOOKE_STOPPED. */
int32_t hk_run_tell(hooke_integrator *integrator, int64_t steps);
/* Stores the solution at time t, the bits of a frame's time being t itself; `checked` if
 * hk_divergence_check() follows. */
int32_t hk_run_store(hooke_integrator *integrator, double t, hooke_state *state, int32_t checked);

/* The same two for error-controlled methods: to the end, and so many internal steps. */
int32_t hk_run_adaptive(hooke_integrator *integrator, hooke_state *state);
int32_t hk_run_internal_steps(hooke_integrator *integrator, hooke_state *state, int64_t steps, int32_t shows);
/* With error control and the option `checkpoint`: keeps the state, at which the method has just restarted, as
 * the point from which the run can continue. HOOKE_NO_MEMORY. */
int32_t hk_run_keep_restart(hooke_integrator *integrator, const hooke_state *state);

/* The smallest number j >= 1 with t0 + j every > t. */
int64_t hk_run_first_after(double t0, double every, double t);
