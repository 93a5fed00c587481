/* Distinguishes a model that gains energy itself from a step that is too large: where another altitude of a
 * tetrahedron becomes the shortest its energy jumps, by the same amount at any step. So the run is tried at
 * smaller and smaller steps, and then with damping. */
#include "measure/why/why_trial.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "model/force/altitude.h"

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
  return system->altitudes->count > 0 && system->force == NULL && system->drive_count == 0;
}

/* ---- at smaller steps ---- */

static int32_t refine(const struct hk_trials *trials, int k, hooke_options *run) {
  const hooke_options *given = trials->inquiry->run->options;
  if (!isnan(trials->step)) return hooke_options_set_number(run, "step", trials->step / FINER[k]);
  static const char *const names[] = {"rtol", "atol", "atol_velocity"};
  int32_t status = HOOKE_OK;
  for (int j = 0; j < 3 && status == HOOKE_OK; j++) {
    const double number = hooke_options_number(given, names[j]) / TIGHTER[k];
    status = hooke_options_set_number(run, names[j], j == 0 ? fmax(TIGHTEST, number) : number);
  }
  return status;
}

/* 1 if the run with smaller steps diverges, too. */
static int32_t diverges_finer(struct hk_trials *trials, int k, int32_t *diverges) {
  struct hk_change change;
  struct hk_trial trial = {.reached = NAN};
  int32_t status = hk_change_begin(&change, "step");
  if (status == HOOKE_OK) status = refine(trials, k, change.run);
  if (status == HOOKE_OK) status = hk_trials_try(trials, trials->inquiry->system, &change, &trial);
  *diverges = trial.diverged;
  hk_change_drop(&change);
  return status;
}

int32_t hk_inquiry_gains(struct hk_inquiry *inquiry, int32_t *gains) {
  struct hk_trials trials;
  *gains = 0;
  if (!may_gain(inquiry) || (inquiry->violation.found && inquiry->violation.time <= inquiry->run->t0))
    return HOOKE_OK;
  int32_t status = hk_trials_begin(inquiry, &trials);
  *gains = status == HOOKE_OK && trials.duration > 0.0 && !trials.late;
  hk_budget_lend(&inquiry->budget, 0.5);
  for (int k = 0; k < FINER_TRIES && status == HOOKE_OK && *gains; k++)
    status = diverges_finer(&trials, k, gains);
  *gains = *gains && !inquiry->budget.spent;
  inquiry->cut |= inquiry->budget.spent;
  hk_inquiry_end_part(inquiry, "whether smaller steps gain energy, too");
  hk_trials_release(&trials);
  return status;
}

/* ---- with damping ---- */

/* Does the run with the change, of the same system with damping `times` the stiffness of its altitude
 * springs. */
static int32_t try_damped(struct hk_trials *trials, double times, const struct hk_change *change,
                          struct hk_trial *trial) {
  hooke_system damped = *trials->inquiry->system;
  struct hk_tetrahedron *own = hk_new(damped.altitudes->count, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  memcpy(own, damped.altitudes->tetrahedron, (size_t)damped.altitudes->count * sizeof *own);
  for (int64_t k = 0; k < damped.altitudes->count; k++)
    own[k].damping = fmax(own[k].damping, times * own[k].stiffness);
  struct hk_altitudes altitudes = {damped.altitudes->count, 1, own};
  damped.altitudes = &altitudes;
  const int32_t status = hk_trials_try(trials, &damped, change, trial);
  hk_free(own);
  return status;
}

/* Damping itself needs smaller steps, so one smaller by the factor `finer` is tried, too. */
static int32_t try_damping(struct hk_trials *trials, double times, double finer) {
  char *text = trials->inquiry->suggestion, step[64] = "";
  struct hk_change change;
  struct hk_trial trial = {.reached = NAN};
  int32_t status = hk_change_begin(&change, "step");
  if (status == HOOKE_OK && finer > 1.0) {
    status = hooke_options_set_number(change.run, "step", trials->step / finer);
    hk_print(step, sizeof step, ", with a step of %.6g s,", trials->step / finer);
  }
  if (status == HOOKE_OK) status = try_damped(trials, times, &change, &trial);
  if (status == HOOKE_OK && trial.proof[0]) {
    hk_print(
        text, sizeof trials->inquiry->suggestion,
        "damping of altitude springs of %.3g s times their stiffness%s takes out what their jumps give%s",
        times, step, trial.proof);
  }
  hk_change_drop(&change);
  return status;
}

int32_t hk_trials_try_damping(struct hk_trials *trials) {
  const struct hk_inquiry *inquiry = trials->inquiry;
  const int adaptive = isnan(trials->step);
  const double unit = adaptive ? PART_OF_TIME * (inquiry->why->noticed - inquiry->run->t0) : trials->step;
  int32_t status = HOOKE_OK;
  for (int k = 0; k < 2 * DAMPING_TRIES && status == HOOKE_OK && !inquiry->suggestion[0]; k++) {
    if (adaptive && k >= DAMPING_TRIES) break;
    status = try_damping(trials, DAMPING[k % DAMPING_TRIES] * unit, k < DAMPING_TRIES ? 1.0 : FINER[0]);
  }
  return status;
}
