/* Ladders: steps from the safe bound down by halves, tolerances by tenths; and how long they take. */
#include "integrate/method.h"
#include "measure/study/study.h"

#include "core/clock.h"
#include "core/number.h"
#include "core/status.h"
#include "measure/limit/explicit_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COARSEST_EXPONENT = 3 };             /* rtol 1e-3 */
static const double FARTHEST_BELOW = 128.0; /* maximum factor from the safe step of symplectic Euler */
static const double MOST_STEPS = 1e8;       /* of a row, unless its step is given */

int32_t hk_study_is_adaptive(const struct hk_study *study, int32_t method) {
  return hooke_method_is_adaptive(study->method[method]);
}

static int32_t points_of(const struct hk_study *study) {
  return (int32_t)hooke_options_number(study->m->options, "points");
}

/* The step nearest to `step` that divides frames and duration evenly. */
static double fitting_step(const struct hk_study *study, double step) {
  return study->unit / fmax(1.0, ceil(study->unit / step * (1.0 - 1e-12)));
}

/* NaN if none is known. */
static double bound_of(const struct hk_study *study, const char *method, const double *q) {
  double bound = NAN;
  if (hooke_step_bound(study->m->system, method, q, &bound) != HOOKE_OK || isinf(bound)) return NAN;
  return bound;
}

/* A step that is certainly stable, and solves nothing if that is cheaper. For a method without one, or with a
 * very small one due to the bound, a fraction of the step of explicit Euler. */
static int32_t safe_step(const struct hk_study *study, const char *method, const double *q, double *step) {
  double bound = bound_of(study, method, q);
  const double other = bound_of(study, hk_method_of_euler(study->m->system), q);
  if (bound == 0.0) bound = other;
  if (bound < other / FARTHEST_BELOW) bound = other / FARTHEST_BELOW;
  *step = bound > 0.0 ? bound : study->unit;
  return hk_step_cheapest(study->m->system, method, step);
}

int32_t hk_study_find_safe_steps(struct hk_study *study) {
  hooke_state *state = NULL;
  int32_t status = hooke_state_create(study->m->system, &state);
  for (int32_t m = 0; m < study->method_count && status == HOOKE_OK; m++) {
    double step = study->unit;
    if (hk_study_is_adaptive(study, m)) continue;
    status = safe_step(study, study->method[m], hooke_state_position(state), &step);
    study->safe_step[m] = fitting_step(study, fmin(study->unit, step));
  }
  hooke_state_destroy(state);
  return status;
}

/* From twice the safe step, which may still be stable, since the bound is not sharp. */
static double fixed_ladder(const struct hk_study *study, int32_t method, int32_t k) {
  const double safe = study->safe_step[method];
  const double start = safe < study->unit ? fitting_step(study, fmin(study->unit, 2.0 * safe)) : safe;
  const int32_t above = start > safe;
  const double step = k == 0 ? start : study->unit / (round(study->unit / safe) * exp2((double)(k - above)));
  return k < points_of(study) + above && study->duration / step <= MOST_STEPS ? step : NAN;
}

static double given(const hooke_options *options, const char *name, int32_t k) {
  const int64_t count = hooke_options_number_count(options, name);
  return k < count ? hooke_options_numbers(options, name)[k] : NAN;
}

double hk_study_ladder(const struct hk_study *study, int32_t method, int32_t k) {
  const int32_t adaptive = hk_study_is_adaptive(study, method);
  const char *own = adaptive ? "tolerances" : "steps";
  if (study->once) return k == 0 ? hooke_options_number(study->m->run, adaptive ? "rtol" : "step") : NAN;
  if (hooke_options_is_set(study->m->options, own)) return given(study->m->options, own, k);
  if (!adaptive) return fixed_ladder(study, method, k);
  /* a quotient of integers is the nearest double to a power of ten, a product of powers is not */
  return k < points_of(study) ? 1.0 / pow(10.0, (double)(COARSEST_EXPONENT + k)) : NAN;
}

/* ---- checking ---- */

static int32_t check_list(const hooke_options *options, const char *name) {
  const int64_t count = hooke_options_number_count(options, name);
  const double *value = hooke_options_numbers(options, name);
  for (int64_t k = 1; k < count; k++) {
    if (value[k] < value[k - 1]) continue;
    char where[64];
    snprintf(where, sizeof where, "%s[%lld]", name, (long long)k);
    return hk_fail(HOOKE_BAD_VALUE, where, "%g is not below %g; a ladder goes from coarse to fine", value[k],
                   value[k - 1]);
  }
  return HOOKE_OK;
}

static int32_t check_steps(const struct hk_study *study) {
  const int64_t count = hooke_options_number_count(study->m->options, "steps");
  for (int64_t k = 0; k < count; k++) {
    const double step = hooke_options_numbers(study->m->options, "steps")[k];
    if (hk_step_is_whole(study->every / step) && hk_step_is_whole(study->duration / step)) continue;
    char where[64], fitting[HOOKE_NUMBER_SIZE];
    snprintf(where, sizeof where, "steps[%lld]", (long long)k);
    hk_number_print(fitting_step(study, step), fitting);
    return hk_fail(
        HOOKE_BAD_VALUE, where,
        "every %.6g s and duration %.6g s are not whole multiples of %.6g s; a step near it that fits is %s",
        study->every, study->duration, step, fitting);
  }
  return HOOKE_OK;
}

const char *hk_study_chosen_ladder(const struct hk_study *study) {
  static const char *const of_ladders[] = {"points", "steps", "tolerances"};
  for (int k = 0; k < 3; k++)
    if (hooke_options_is_set(study->m->options, of_ladders[k])) return of_ladders[k];
  return NULL;
}

int32_t hk_study_check_ladder(struct hk_study *study) {
  const char *chosen = hk_study_chosen_ladder(study);
  if (study->once && chosen)
    return hk_fail(HOOKE_BAD_VALUE, chosen, "is not for `once`, which takes the step of the run");
  if (study->once) return HOOKE_OK;
  int32_t status = hk_step_unit(study->duration, study->every, &study->unit);
  if (status == HOOKE_OK) status = check_list(study->m->options, "steps");
  if (status == HOOKE_OK) status = check_steps(study);
  return status == HOOKE_OK ? check_list(study->m->options, "tolerances") : status;
}

/* ---- progress ---- */

int32_t hk_study_tell_row(double fraction, void *ctx) {
  struct hk_study *study = ctx;
  const int32_t value = hk_stage_tell(fraction, &study->stage);
  if (value != 0 || hk_clock_seconds() < study->deadline) return value;
  study->late = 1;
  return 1;
}
