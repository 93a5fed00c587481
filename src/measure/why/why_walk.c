#include "measure/why/why_walk.h"

#include "integrate/loop/run_loop.h"
#include "model/group.h"

#include <math.h>
#include <string.h>

/* Particles and springs times steps on the way, and numbers that are kept, at most. */
static const double LONGEST_WAY = 3e8;
static const int64_t MOST_NUMBERS = 6000000;

/* The first state, else the oldest of the recent ones that is near enough, else the newest. */
static const hooke_state *choose(const hooke_integrator *run, int64_t *step) {
  const double size = (double)(run->system->particle_count + hk_system_members_of(run->system, NULL));
  *step = 0;
  if (run->recent.first && (double)run->k * size <= LONGEST_WAY) return run->recent.first;
  for (int64_t back = run->recent.count - 1; back > 0; back--) {
    const hooke_state *state = hk_recent_state(&run->recent, back, step);
    if ((double)(run->k - *step) * size <= LONGEST_WAY) return state;
  }
  return hk_recent_state(&run->recent, 0, step);
}

int32_t hk_why_start_keep(const hooke_integrator *run, struct hk_why_start *start) {
  int64_t step;
  hk_why_start_release(start);
  if (run->method->adaptive || run->size > MOST_NUMBERS) return HOOKE_OK;
  const hooke_state *from = choose(run, &step);
  int32_t status = hk_state_create_sized(hk_integrator_numbers(run), 1, &start->state);
  if (status == HOOKE_OK) status = hooke_state_copy(from, start->state);
  start->standing = run->standing;
  start->standing.k = step;
  start->standing.t = *from->t;
  start->standing.frames = 0;
  return status;
}

void hk_why_start_release(struct hk_why_start *start) {
  hooke_state_destroy(start->state);
  *start = (struct hk_why_start){.state = NULL};
}

/* At the start: as the run itself stood there, so that the same step gives the same bits, or anew with
 * another one. */
static int32_t begin(hooke_integrator *it, const struct hk_why_start *start, hooke_state *state) {
  const double begun = start->standing.t0 + (double)start->standing.k * it->schedule.step;
  const int32_t status = hooke_state_copy(start->state, state);
  if (status != HOOKE_OK) return status;
  return begun == start->standing.t ? hk_integrator_stand(it, &start->standing, state)
                                    : hk_run_begin(it, state);
}

/* With these options, whose schedule does not matter here and need not fit the step. */
static int32_t make(const hooke_system *system, const hooke_options *run, hooke_integrator **it) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_copy(run, &options);
  const double step = hooke_options_number(run, "step");
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "duration", step);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "every", step);
  if (status == HOOKE_OK) status = hooke_integrator_create(system, options, it);
  hooke_options_destroy(options);
  return status;
}

/* On to a time; 0 where numbers overflow before, or the solver of a step gives up. */
static int32_t reach(hooke_integrator *it, double time, int32_t *status) {
  const int64_t steps = llround((time - it->t0) / it->schedule.step) - it->k;
  if (steps > 0) *status = hk_run_take_fixed_steps(it, steps);
  const int ended = *status == HOOKE_SOLVER_FAILED;
  if (ended) *status = HOOKE_OK;
  return !ended && *status == HOOKE_OK && hk_motion_is_finite(it);
}

int32_t hk_why_walk(const hooke_system *system, const struct hk_why_start *start, const hooke_options *run,
                    int64_t count, const double *time, hk_why_see *see, void *ctx) {
  hooke_integrator *it = NULL;
  hooke_state *state = NULL;
  int32_t status = make(system, run, &it), seen = 0;
  if (status == HOOKE_OK) status = hk_state_create_sized(hk_integrator_numbers(it), 1, &state);
  if (status == HOOKE_OK) status = begin(it, start, state);
  for (int64_t k = 0; k < count && status == HOOKE_OK && seen == 0; k++) {
    if (!reach(it, time[k], &status)) break;
    status = it->method->steps->store(it, it->t, state);
    *state->t = it->t;
    if (status == HOOKE_OK) seen = see(k, state, ctx);
  }
  hooke_state_destroy(state);
  hooke_integrator_destroy(it);
  return seen < 0 ? seen : status;
}
