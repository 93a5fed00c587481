/* Distinguishes a model that gains energy itself from a step that is too large: where another altitude of a
 * tetrahedron becomes the shortest its energy jumps, by the same amount at any step. So the run is tried at
 * smaller and smaller steps, and then with damping. */
#include "measure/why/why_trial.h"

#include "core/memory.h"
#include "core/print.h"
#include "model/force/altitude.h"
#include "model/force/force.h"

#include <math.h>
#include <string.h>

/* Factors on the step, or on the tolerances. */
static const double FINER[] = {4.0, 16.0}, TIGHTER[] = {1e2, 1e4};
static const double TIGHTEST = 1e-12;
/* Damping over stiffness, in steps or, for a method that chooses those, in the time until the failure. */
static const double DAMPING[] = {2.0, 8.0, 32.0, 128.0}, PART_OF_TIME = 1e-4;
enum { FINER_TRIES = 2, DAMPING_TRIES = 4 };

static int32_t may_gain(const struct hk_inquiry *inquiry) {
  const hooke_system *system = inquiry->system;
  return system->altitudes->count > 0 && system->force == NULL && !hk_system_takes_work(system);
}

/* ---- at smaller steps ---- */

static void refine(struct hk_change *change, const struct hk_trials *trials, int k) {
  static const char *const names[] = {"rtol", "atol", "atol_velocity"};
  if (!isnan(trials->step)) hk_change_number(change, "step", trials->step / FINER[k]);
  for (int j = 0; j < 3 && isnan(trials->step); j++) {
    const double number = hooke_options_number(trials->inquiry->run->options, names[j]) / TIGHTER[k];
    hk_change_number(change, names[j], j == 0 ? fmax(TIGHTEST, number) : number);
  }
}

/* 1 if the run with smaller steps diverges, too. */
static int32_t diverges_finer(struct hk_trials *trials, int k) {
  struct hk_change change;
  struct hk_trial trial;
  hk_change_begin(trials, &change, "step");
  refine(&change, trials, k);
  hk_trials_try(trials, trials->inquiry->system, &change, &trial);
  hk_change_drop(&change);
  return trial.diverged;
}

int32_t hk_inquiry_gains(struct hk_inquiry *inquiry, int32_t *gains) {
  struct hk_trials trials;
  *gains = 0;
  if (!may_gain(inquiry) || (inquiry->violation.found && inquiry->violation.time <= inquiry->run->t0))
    return HOOKE_OK;
  hk_trials_begin(inquiry, &trials);
  *gains = trials.status == HOOKE_OK && trials.duration > 0.0 && !trials.late;
  hk_budget_lend(&inquiry->budget, 0.5);
  for (int k = 0; k < FINER_TRIES && *gains; k++)
    *gains = diverges_finer(&trials, k);
  *gains = *gains && !inquiry->budget.spent;
  inquiry->cut |= inquiry->budget.spent;
  hk_inquiry_end_part(inquiry, "whether smaller steps gain energy, too");
  hk_trials_release(&trials);
  return trials.status;
}

/* ---- with damping ---- */

/* Does the run with the change, of the same system with damping `times` the stiffness of its altitude
 * springs. */
static void try_damped(struct hk_trials *trials, double times, const struct hk_change *change,
                       struct hk_trial *trial) {
  hooke_system damped = *trials->inquiry->system;
  const int64_t count = damped.altitudes->count;
  struct hk_tetrahedron *own = hk_new(count, sizeof *own);
  struct hk_altitudes altitudes = {count, 1, own};
  if (own)
    memcpy(own, damped.altitudes->tetrahedron, (size_t)count * sizeof *own);
  else
    trials->status = HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count && own; k++)
    own[k].damping = fmax(own[k].damping, times * own[k].stiffness);
  damped.altitudes = &altitudes;
  hk_trials_try(trials, &damped, change, trial);
  hk_free(own);
}

/* Damping itself needs smaller steps, so one smaller by the factor `finer` is tried, too. */
static void try_damping(struct hk_trials *trials, double times, double finer) {
  char *text = trials->inquiry->suggestion, step[64] = "";
  struct hk_change change;
  struct hk_trial trial;
  hk_change_begin(trials, &change, "step");
  if (finer > 1.0) {
    hk_change_number(&change, "step", trials->step / finer);
    hk_print(step, sizeof step, ", with a step of %.6g s,", trials->step / finer);
  }
  try_damped(trials, times, &change, &trial);
  if (trial.proof[0]) {
    hk_print(
        text, sizeof trials->inquiry->suggestion,
        "damping of altitude springs of %.3g s times their stiffness%s takes out what their jumps give%s",
        times, step, trial.proof);
  }
  hk_change_drop(&change);
}

void hk_trials_try_damping(struct hk_trials *trials) {
  const struct hk_inquiry *inquiry = trials->inquiry;
  const int adaptive = isnan(trials->step);
  const double unit = adaptive ? PART_OF_TIME * (inquiry->why->noticed - inquiry->run->t0) : trials->step;
  const int tries = adaptive ? DAMPING_TRIES : 2 * DAMPING_TRIES;
  for (int k = 0; k < tries && trials->status == HOOKE_OK && !inquiry->suggestion[0]; k++)
    try_damping(trials, DAMPING[k % DAMPING_TRIES] * unit, k < DAMPING_TRIES ? 1.0 : FINER[0]);
}
