/* Spurious heat of a run: a damped motion too fast for the step overshoots rest, its velocity reverses from
 * one step to the next, and damping and drag then dissipate more energy than is available. */
#include "measure/estimate/estimate.h"

#include "core/memory.h"
#include "measure/counted_work/work.h"
#include "measure/trial/balance.h"
#include "model/medium.h"
#include "model/particles.h"

#include <math.h>
#include <string.h>

enum { MOST_STEPS = 1024, LEAST_STEPS = 8, APART = 8 /* steps between two residuals */ };
static const double SHARE = 0.01, LEAST_WORK = 0.02; /* of the run's counted work, or [s], for a slice */
static const double SUMS = 10.0;                     /* evaluations of forces that the sums of a step take */

struct slice {
  const hooke_system *system;
  hooke_system calm; /* the same without wind, in which differences of velocities are velocities */
  struct hk_medium medium;
  struct hk_balance balance;
  double *difference[4]; /* velocities, 3n each: the last velocity, and halved first to third differences */
  double power[4];       /* at the last states */
  double reversing;      /* U [J] */
  double residual[MOST_STEPS / APART];
  int64_t steps;
  int32_t status;
};

static int32_t begin(struct slice *s, const hooke_state *state) {
  const int64_t size = hooke_state_size(state);
  double *block = hk_new(4 * size, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  for (int k = 0; k < 4; k++)
    s->difference[k] = block + k * size;
  memcpy(block, hooke_state_velocity(state), (size_t)size * sizeof(double));
  const int32_t status = hk_balance_begin(&s->balance, s->system, state);
  s->power[0] = s->balance.power_out;
  return status;
}

/* Adds the velocity after a step of `step` [s]. */
static void add_reversing(struct slice *s, const hooke_state *state, double step) {
  const double *v = hooke_state_velocity(state);
  double least = s->balance.power_out;
  for (int64_t k = 0; k < hooke_state_size(state); k++) {
    double new = v[k];
    for (int d = 0; d < 4; d++) {
      const double old = s->difference[d][k];
      s->difference[d][k] = new;
      new = 0.5 * (new - old);
    }
  }
  s->power[++s->steps % 4] = least;
  for (int k = 0; k < 4; k++)
    least = fmin(least, s->power[k]);
  if (s->steps < 3) return;
  const double reversing = hooke_system_dissipated_power_at(&s->calm, hooke_state_time(state),
                                                            hooke_state_position(state), s->difference[3]);
  s->reversing += step * fmin(least, reversing);
}

static int32_t see(int64_t step, const hooke_state *state, void *ctx) {
  struct slice *s = ctx;
  const double time = s->balance.time;
  s->status = step == 0 ? begin(s, state) : hk_balance_step(&s->balance, state);
  if (s->status != HOOKE_OK || step == 0) return s->status != HOOKE_OK;
  add_reversing(s, state, hooke_state_time(state) - time);
  if (step % APART != 0) return 0;
  hk_balance_close(&s->balance, state);
  s->residual[step / APART - 1] = s->balance.residual;
  return 0;
}

static double excess_of(const struct slice *s, double scale) {
  const int64_t count = s->steps / APART;
  double least = s->reversing;
  if (s->steps < LEAST_STEPS) return NAN;
  for (int64_t k = count / 2; k < count; k++)
    least = fmin(least, s->residual[k]);
  return least > 0.0 ? least / (scale + fabs(s->balance.work)) : 0.0;
}

/* A slice from `from` on; NULL: from the initial state. */
static int32_t look(struct hk_estimate *e, const hooke_state *from) {
  const double step = hk_estimate_value(e->options);
  const double left = e->duration - (from ? hooke_state_time(from) - e->begin : 0.0);
  const double of_step = SUMS * hk_work_of_evaluation(e->system) + e->work / fmax(1.0, e->steps);
  const double affordable = floor(fmax(LEAST_WORK, SHARE * e->work) / of_step / APART) * APART;
  const double count = fmin(fmin(MOST_STEPS, fmax(APART, affordable)), round(left / step));
  struct slice s = {.system = e->system, .calm = *e->system, .medium = *e->system->medium};
  s.medium.blows = 0;
  s.calm.medium = &s.medium;
  const char *method = hooke_options_text(e->options, "method");
  const struct hk_rerun rerun = {method, step, count * step, step, "error, heat", 1.0, 0.0, from, see, &s};
  struct hk_frames none = {.system = e->system};
  if (count < LEAST_STEPS) return HOOKE_OK;
  int32_t status = hk_estimate_rerun(e, &rerun, &none);
  if (status == HOOKE_STOPPED && s.status != HOOKE_OK) status = s.status;
  e->heat_excess = fmax(e->heat_excess, excess_of(&s, e->soundness.scale + e->soundness.swing));
  hk_balance_release(&s.balance);
  hk_free(s.difference[0]);
  return status;
}

int32_t hk_estimate_heat(struct hk_estimate *e) {
  const char *method = hooke_options_text(e->options, "method");
  /* without inertia velocities follow the forces, and nothing reverses them */
  if (hooke_method_is_adaptive(method) || e->system->force || e->system->overdamped) return HOOKE_OK;
  int32_t status = look(e, NULL);
  if (status == HOOKE_OK && isnan(e->late_after)) status = look(e, e->late);
  return status;
}
