/* A method cannot certify itself: an error that it makes at every step is in no difference of its own runs.
 */
#include "measure/estimate/estimate.h"

#include "core/print.h"
#include "measure/counted_work/work.h"

#include <math.h>

static const double APART = 10.0; /* times the error: another method that is farther away contradicts */
enum { LEAST_STEPS = 20, HALVINGS = 3 };
static const int64_t MOST_PARTICLES = 10000; /* of beginnings: their judges may take more memory than runs */
static const double SAFE = 0.5;              /* of the bound: a stable step that resolves the motion */
static const double TOLERANCE = 1e-9, TIGHTER = 0.1; /* of error-controlled judges */

static const char OTHER[] = "error, another method";

static const char *method_of(const struct hk_estimate *e) {
  return hooke_options_text(e->options, "method");
}

/* Of bodies there is none. HOOKE_NO_MEMORY. */
static int32_t find_bound(const struct hk_estimate *e, const char *method, double *bound) {
  const int32_t status = hooke_step_bound(e->system, method, hooke_state_position(e->start), bound);
  if (status != HOOKE_OK || !(*bound > 0.0)) *bound = INFINITY;
  return status == HOOKE_NO_MEMORY ? status : HOOKE_OK;
}

/* ---- over the whole run ---- */

/* The method that judges whole runs, which every build has, or one that judges this one, where it does not
 * take the system; or NULL. */
static const char *whole_judge(const struct hk_estimate *e) {
  const char *judge = hk_method_find(method_of(e))->judge;
  while (judge && !hk_method_suits(judge, e->system))
    judge = hk_method_find(judge)->judge;
  return judge;
}

/* The smallest step from that of the run on that costs no more than the run; NaN if it is not stable. */
static double judge_step(const struct hk_estimate *e, const char *judge, double limit) {
  const double step = hk_estimate_value(e->options);
  for (double least = step; least <= limit; least *= 2.0) {
    const double value = hk_estimate_fit_step(e, least);
    if (isnan(value) || value > limit) return NAN;
    const int64_t steps = (int64_t)round(e->duration / value);
    if (!(hk_work_of_steps(e->system, judge, steps) > e->work * (1.0 + 1e-9)))
      return hk_work_at_least(e->system, judge, steps) > e->left ? NAN : value;
  }
  return NAN;
}

/* 1 if the method of a row judged the whole run. */
static int32_t judge_whole(struct hk_estimate *e, int32_t *judged) {
  struct hk_distance from;
  const char *judge = whole_judge(e);
  double limit = INFINITY;
  *judged = 0;
  int32_t status = judge ? find_bound(e, judge, &limit) : HOOKE_OK;
  const double step = judge && status == HOOKE_OK ? judge_step(e, judge, limit) : NAN;
  if (isnan(step)) return status;
  const struct hk_rerun rerun = {judge, step, e->duration, e->apart, OTHER, 0.7, 0.3, NULL, NULL, NULL};
  status = hk_estimate_compare(e, &rerun, e->kept.count, &from);
  *judged = !isnan(from.of[0]);
  if (from.of[0] > e->error[0]) {
    e->rms = fmax(e->rms, from.rms);
    e->by = "other-method";
  }
  for (int32_t n = 0; n <= e->wants.count; n++)
    if (from.of[n] > e->error[n]) hk_estimate_know(e, n, from.of[n]);
  return status;
}

/* ---- over its beginning ---- */

/* The number of kept frames up to the first one after some steps. */
static int64_t beginning(const struct hk_estimate *e) {
  const double frames = ceil(LEAST_STEPS / e->steps * e->duration / e->apart * (1.0 - 1e-9));
  return (int64_t)fmin((double)e->kept.count, 1.0 + fmax(1.0, frames));
}

static const char *beginning_judge(const struct hk_estimate *e) {
  const char *row = hk_method_find(method_of(e))->checked_by, *judge = row ? row : hk_rk4.name;
  const int few = e->system->particle_count <= MOST_PARTICLES;
  return few && hooke_method_is_built(judge) ? judge : NULL;
}

static int32_t find_first_value(const struct hk_estimate *e, const char *judge, double *value) {
  double bound;
  *value = TOLERANCE;
  if (hooke_method_is_adaptive(judge)) return HOOKE_OK;
  const int32_t status = find_bound(e, judge, &bound);
  *value = e->apart / ceil(e->apart / fmin(e->duration / e->steps, SAFE * bound));
  return status;
}

static void contradict(struct hk_estimate *e, const char *judge) {
  hk_print(e->reason, sizeof e->reason, "another method, %s, says otherwise", judge);
  for (int32_t n = 0; n <= e->wants.count; n++)
    e->error[n] = NAN;
  e->rms = e->known_until = NAN;
  e->by = NULL;
}

/* The other method is refined until it is close enough. It contradicts if it does not come closer. */
static int32_t judge_beginning(struct hk_estimate *e) {
  const char *judge = beginning_judge(e);
  const int64_t frames = beginning(e);
  double value, first = NAN;
  int32_t status = judge ? find_first_value(e, judge, &value) : HOOKE_OK;
  for (int k = 0; judge && status == HOOKE_OK && k <= HALVINGS; k++) {
    struct hk_distance from;
    const double duration = e->kept.time[frames - 1] - e->kept.time[0];
    const struct hk_rerun rerun = {judge, value, duration, fmin(e->apart, duration), OTHER, 0.7, 0.1,
                                   NULL,  NULL,  NULL};
    status = hk_estimate_compare(e, &rerun, frames, &from);
    if (status != HOOKE_OK || isnan(from.of[0]) || from.of[0] <= APART * e->error[0]) break;
    if (k == 0) first = from.of[0];
    if (k == HALVINGS && from.of[0] > 0.5 * first) contradict(e, judge);
    value *= hooke_method_is_adaptive(judge) ? TIGHTER : 0.5;
  }
  return status;
}

int32_t hk_estimate_by_other_method(struct hk_estimate *e) {
  int32_t judged;
  const int32_t status = judge_whole(e, &judged);
  return status == HOOKE_OK && !judged ? judge_beginning(e) : status;
}
