/* Increase of the time of a step due to an ingredient. */
#include "measure/cost/cost.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

/* A block is long against the clock's resolution and short against disturbances of the machine. Loading and
 * checking the state is not timed; a few steps a block are worth it. */
static const double BLOCK = 1e-3; /* [s] */
enum { FEWEST_STEPS = 4, MOST_STEPS = 1000, FEWEST_ROUNDS = 2, BLOCKS_OF_ROUND = 3 };

int32_t hk_timed_create(const hooke_system *system, const hooke_options *run, struct hk_timed *timed) {
  *timed = (struct hk_timed){.best = {INFINITY, INFINITY}};
  const int32_t status = hooke_integrator_create(system, run, &timed->integrator);
  return status == HOOKE_OK ? hooke_state_create(system, &timed->state) : status;
}

void hk_timed_release(struct hk_timed *timed) {
  hooke_integrator_destroy(timed->integrator);
  hooke_state_destroy(timed->state);
  memset(timed, 0, sizeof *timed);
}

/* One block; `nanoseconds` of a step, infinite if none was taken. A run that diverges has taken its steps
 * nevertheless. */
static int32_t run_block(struct hk_timed *timed, const hooke_state *start, int64_t steps,
                         double *nanoseconds) {
  hooke_integrator *it = timed->integrator;
  int32_t status = hooke_state_copy(start, timed->state);
  const double seconds = hooke_integrator_number(it, "wall_seconds");
  const int64_t before = hooke_integrator_count(it, "steps");
  if (status == HOOKE_OK) status = hooke_integrator_step(it, timed->state, steps);
  const int64_t taken = hooke_integrator_count(it, "steps") - before;
  *nanoseconds = taken > 0 ? 1e9 * (hooke_integrator_number(it, "wall_seconds") - seconds) / (double)taken
                           : (double)INFINITY;
  return status == HOOKE_DIVERGED || status == HOOKE_SOLVER_FAILED ? HOOKE_OK : status;
}

static int32_t time_block(struct hk_timed *timed, int series, const hooke_state *start, int64_t steps) {
  double nanoseconds;
  const int32_t status = run_block(timed, start, steps, &nanoseconds);
  timed->best[series] = fmin(timed->best[series], nanoseconds);
  return status;
}

int32_t hk_timed_compare(struct hk_timed *full, struct hk_timed *lean, const hooke_state *start,
                         double seconds) {
  const double begun = hk_clock_seconds();
  double first;
  int32_t status = run_block(full, start, FEWEST_STEPS, &first);
  const double block = fmin(BLOCK, seconds / (BLOCKS_OF_ROUND * FEWEST_ROUNDS));
  const double wanted = ceil(block / (1e-9 * first));
  const int64_t steps = (int64_t)fmax(FEWEST_STEPS, fmin(MOST_STEPS, wanted));
  full->best[0] = full->best[1] = INFINITY;
  for (int64_t round = 0; status == HOOKE_OK; round++) {
    if (round >= FEWEST_ROUNDS && hk_clock_seconds() - begun > seconds) break;
    status = time_block(full, 0, start, steps);
    if (status == HOOKE_OK) status = time_block(lean, 0, start, steps);
    if (status == HOOKE_OK) status = time_block(full, 1, start, steps);
  }
  return status;
}
