/* The error of a run from runs of its method at other steps or tolerances: Roache's grid convergence index
 * (Perspective: a method for uniform reporting of grid refinement studies, J. Fluids Eng. 116, 1994). With d
 * the largest distance of the run from the one at half the step, p the smaller of the order of the method and
 * the one seen with a third run, the error is F d/(1 - 2^-p). */
#include "measure/estimate/estimate.h"

#include "core/print.h"
#include "integrate/method.h"
#include "model/state.h"
#include "model/system.h"

#include <math.h>
#include <stddef.h>

static const double LONG = 10.0;                /* [s] of counted work */
static const double FACTOR = 10.0, POWER = 0.7; /* of tolerances, and how errors scale with them */
static const double LEAST_POWER = 0.5, MOST_POWER = 1.5, LOOSEST = 0.1, TIGHTEST = 1e-14;
static const double ORDERS_APART = 0.4, LEAST_ORDER = 0.05, ORDERS_ABOVE = 1.0;
static const double SMALL = 1e-3; /* of a bound: no order is needed below, where the first is assumed */
static const double LOST = 0.1;   /* of the size of a motion: beyond, a distance alone tells no error */
/* safety factors: where the order is the expected one, and where it is another or not seen */
static const double SURE = 1.25, SURE_TOLERANCE = 1.5, UNSURE = 3.0;
static const double MOST_WORK = 4.0, MOMENT = 0.01; /* of other runs in all, in times of the run, or [s] */

static const char TOO_LONG[] =
    "the run is too long, or its tolerance too tight, for a finer one, and coarser ones do not tell";

static struct hk_distance no_distance(void) {
  struct hk_distance none = {.rms = NAN};
  for (int32_t n = 0; n < HOOKE_ERRORS; n++)
    none.of[n] = NAN;
  return none;
}

double hk_estimate_value(const hooke_options *options) {
  const int32_t adaptive = hooke_method_is_adaptive(hooke_options_text(options, "method"));
  return hooke_options_number(options, adaptive ? "rtol" : "step");
}

static const struct hk_method *method_of(const struct hk_estimate *e) {
  return hk_method_find(hooke_options_text(e->options, "method"));
}

/* ---- other runs ---- */

struct run {
  struct hk_estimate *estimate;
  const struct hk_rerun *rerun;
};

static void start_from(hooke_state *state, void *ctx) {
  const struct run *run = ctx;
  hooke_state_copy(run->rerun->from ? run->rerun->from : run->estimate->start, state);
}

static int32_t tell(double fraction, void *ctx) {
  const struct run *run = ctx;
  const struct hk_rerun *rerun = run->rerun;
  return hk_measurement_tell(run->estimate->measurement, rerun->done + rerun->fraction * fraction,
                             rerun->what);
}

static int32_t show(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  const struct hk_rerun *rerun = ((const struct run *)ctx)->rerun;
  (void)frame;
  return rerun->observer ? rerun->observer(step, state, rerun->ctx) : 0;
}

/* The caller destroys them in either case. */
static int32_t make_options(const struct hk_estimate *e, const struct hk_rerun *rerun, hooke_options **out) {
  int32_t status = hk_pick_options(e->options, rerun->method, rerun->value, out);
  if (status == HOOKE_OK) status = hooke_options_set_number(*out, "duration", rerun->duration);
  if (status == HOOKE_OK) status = hooke_options_set_number(*out, "every", rerun->every);
  return status == HOOKE_OK ? hooke_options_unset(*out, "max_steps") : status;
}

int32_t hk_estimate_rerun(struct hk_estimate *e, const struct hk_rerun *rerun, struct hk_frames *frames) {
  struct run run = {e, rerun};
  const struct hk_listener listener = {
      .on_progress = tell, .on_frame = show, .on_start = start_from, .ctx = &run};
  hooke_options *options = NULL;
  int32_t status = make_options(e, rerun, &options);
  if (status == HOOKE_OK) status = hk_frames_run(frames, options, &listener, NULL);
  hooke_options_destroy(options);
  return status == HOOKE_NO_MEMORY || status == HOOKE_STOPPED ? status : HOOKE_OK;
}

int32_t hk_estimate_compare(struct hk_estimate *e, const struct hk_rerun *rerun, int64_t frames,
                            struct hk_distance *distance) {
  struct run run = {e, rerun};
  const struct hk_listener listener = {
      .on_progress = tell, .on_start = start_from, .most_work = e->left, .ctx = &run};
  struct hk_trial trial = {.status = NULL};
  hooke_options *options = NULL;
  *distance = no_distance();
  int32_t status = make_options(e, rerun, &options);
  if (status == HOOKE_OK) status = hk_trial_run(&trial, &e->kept, frames, options, &listener);
  if (status == HOOKE_OK && !isnan(trial.error_max)) {
    *distance = (struct hk_distance){.rms = trial.error};
    for (int64_t f = 0; f < frames; f++)
      hk_wants_spread(&e->wants, &e->kept.watched, f, &trial.watched, f, trial.error_max_at[f], distance->of);
  }
  e->left -= trial.work;
  hk_trial_release(&trial);
  hooke_options_destroy(options);
  return status == HOOKE_NO_MEMORY || status == HOOKE_STOPPED ? status : HOOKE_OK;
}

double hk_estimate_fit_step(const struct hk_estimate *e, double least) {
  double unit;
  if (hk_step_unit(e->duration, e->apart, &unit) != HOOKE_OK) return NAN;
  const double parts = floor(unit / least * (1.0 + 1e-12));
  return parts >= 1.0 ? unit / parts : NAN;
}

/* ---- the index ---- */

/* A run of the same method at `factor` times the step or tolerance, and its distance; `factor` NaN: none. */
struct level {
  double factor;
  struct hk_distance from;
};

static const char *name_of(int32_t adaptive, double factor) {
  if (adaptive) return factor < 1.0 ? "error, a tenth of the tolerance" : "error, a looser tolerance";
  return factor < 1.0 ? "error, half the step" : "error, a larger step";
}

/* `done` and `fraction` of all other runs. */
static int32_t run_level(struct hk_estimate *e, double factor, double done, double fraction,
                         struct level *level) {
  const int32_t adaptive = method_of(e)->adaptive;
  const double value = hk_estimate_value(e->options);
  double other = factor * value;
  if (!adaptive && factor > 1.0) other = hk_estimate_fit_step(e, other);
  if (adaptive && other > LOOSEST * (1.0 + 1e-9)) other = NAN;
  *level = (struct level){other / value, no_distance()};
  if (isnan(other)) return HOOKE_OK;
  const struct hk_rerun rerun = {.method = method_of(e)->name,
                                 .value = other,
                                 .duration = e->duration,
                                 .every = e->apart,
                                 .what = name_of(adaptive, factor),
                                 .done = done,
                                 .fraction = fraction};
  return hk_estimate_compare(e, &rerun, e->kept.count, &level->from);
}

/* The order q of which errors in proportion to h^q put two runs at a and b times the step at distances of
 * this ratio from the run: |a^q - 1| / |b^q - 1|, which grows with q. */
static double order_seen(double a, double b, double ratio) {
  double low = -20.0, high = 21.0; /* whose middles are not 0 */
  for (int k = 0; k < 60; k++) {
    const double q = 0.5 * (low + high);
    if (fabs(expm1(q * log(a)) / expm1(q * log(b))) < ratio)
      low = q;
    else
      high = q;
  }
  return 0.5 * (low + high);
}

/* Distance of two runs that rounding alone may make [m]: that of velocities turns the phase of oscillations,
 * in proportion to the power 3/2 of the number of steps. Orders are not seen below. */
static double noise(const struct hk_estimate *e) {
  double hold = 0.0;
  for (int64_t f = 0; f < e->kept.recorded; f++)
    hold = fmax(hold, hk_frames_resolution(&e->kept, e->kept.position + f * e->kept.size));
  return hold * (128.0 + 0.1 * e->steps * sqrt(e->steps));
}

void hk_estimate_know(struct hk_estimate *e, int32_t n, double error) {
  e->error[n] = error + (n > 0 ? hk_want_doubt(&e->wants, n - 1, &e->kept.watched) : 0.0);
}

static void know(struct hk_estimate *e, int32_t n, const struct hk_distance *from, double order,
                 double factor) {
  e->order[n] = order;
  hk_estimate_know(e, n, factor * from->of[n]);
  if (n > 0) return;
  e->rms = factor * from->rms;
  e->known_until = e->begin + e->duration;
  e->compared = e->kept.recorded;
  e->by = method_of(e)->adaptive ? "tolerance" : "half-step";
}

/* Of particles; what else is not known has no reason of its own. */
static void say(struct hk_estimate *e, int32_t n, const char *reason) {
  if (n > 0) return;
  hk_print(e->reason, sizeof e->reason, "%s", reason);
}

static double expected_order(const struct hk_estimate *e) {
  return method_of(e)->adaptive ? POWER : (double)method_of(e)->order;
}

static int is_expected(const struct hk_estimate *e, double seen) {
  if (method_of(e)->adaptive) return seen >= LEAST_POWER && seen <= MOST_POWER;
  return fabs(seen - expected_order(e)) <= ORDERS_APART;
}

/* 1 if another step, `near`, gives another motion, as far as its size tells, where no order is seen. */
static int is_lost(const struct hk_estimate *e, const struct level *near, const struct level *far) {
  if (isnan(far->factor) || !isnan(far->from.of[0])) return 0;
  /* the motion is at least as large as its first frame, which mostly tells without a pass over all */
  return near->from.of[0] > LOST * hk_frames_extent(&e->kept, 1) &&
         near->from.of[0] > LOST * hk_frames_extent(&e->kept, e->kept.recorded);
}

/* From the run `near`, at half the step, and `far`, at twice the step or unknown. */
static void judge_by_finer(struct hk_estimate *e, int32_t n, const struct level *near,
                           const struct level *far) {
  const int32_t adaptive = method_of(e)->adaptive, is_length = n == 0 || e->wants.want[n - 1].width == 0;
  const double one = near->from.of[n], other = far->from.of[n];
  double order = expected_order(e), safety = UNSURE;
  if (!adaptive && is_lost(e, near, far)) {
    say(e, n, "half the step gives another motion, and twice the step none");
    return;
  }
  if (!is_length && one <= SMALL * e->bound[n - 1]) {
    order = fmin(order, 1.0);
  } else if (other > 0.0 && one > (is_length ? noise(e) : 0.0)) {
    const double seen = order_seen(far->factor, near->factor, other / one);
    if (is_expected(e, seen)) safety = adaptive ? SURE_TOLERANCE : SURE;
    if (!adaptive && seen < LEAST_ORDER) {
      say(e, n, "half the step gives another motion");
      return;
    }
    if (!adaptive && seen > order + ORDERS_ABOVE) {
      say(e, n, "twice the step loses the motion, and so may this step");
      return;
    }
    if (!adaptive) order = fmin(order, seen);
  }
  know(e, n, &near->from, adaptive ? POWER : order, safety / fabs(expm1(order * log(near->factor))));
}

/* From runs at twice the step and at four times, if the order is seen. */
static void judge_by_coarser(struct hk_estimate *e, int32_t n, const struct level *near,
                             const struct level *far) {
  const double order = expected_order(e), one = near->from.of[n], other = far->from.of[n];
  if (!(one > 0.0 && other > 0.0 && is_expected(e, order_seen(far->factor, near->factor, other / one)))) {
    say(e, n, TOO_LONG);
    return;
  }
  know(e, n, &near->from, order, UNSURE / expm1(order * log(near->factor)));
}

int32_t hk_estimate_by_runs(struct hk_estimate *e) {
  const double ratio = method_of(e)->adaptive ? FACTOR : 2.0;
  const int32_t tightest = method_of(e)->adaptive && hk_estimate_value(e->options) < TIGHTEST * FACTOR;
  const int32_t finer = (e->work <= LONG || e->wants.count > 0) && !tightest;
  struct level near, far;
  e->left = MOST_WORK * fmax(e->work, MOMENT);
  int32_t status = run_level(e, finer ? 1.0 / ratio : ratio, 0.0, 0.6, &near);
  if (status == HOOKE_OK && !isnan(near.from.of[0]))
    status = run_level(e, finer ? ratio : ratio * ratio, 0.6, 0.1, &far);
  if (status != HOOKE_OK) return status;
  if (isnan(near.from.of[0])) say(e, 0, finer ? "a finer run did not come to its end" : TOO_LONG);
  for (int32_t n = 0; n <= e->wants.count && !isnan(near.from.of[0]) && (n == 0 || !isnan(e->error[0])); n++)
    (finer ? judge_by_finer : judge_by_coarser)(e, n, &near, &far);
  return HOOKE_OK;
}

int32_t hk_estimate_last_slice(struct hk_estimate *e) {
  const double from = hooke_state_time(e->late), duration = e->begin + e->duration - from;
  const double value = hk_estimate_value(e->options);
  const double finer = method_of(e)->adaptive ? fmax(TIGHTEST, value / FACTOR) : 0.5 * value;
  struct hk_frames frames;
  if (!isnan(e->late_after) || finer >= value) return HOOKE_OK;
  int32_t status = hk_frames_create(e->system, 2, &frames);
  const struct hk_rerun rerun = {.method = method_of(e)->name,
                                 .value = finer,
                                 .duration = duration,
                                 .every = duration,
                                 .what = "error, the last piece",
                                 .fraction = 1.0,
                                 .from = e->late};
  if (status == HOOKE_OK) status = hk_estimate_rerun(e, &rerun, &frames);
  if (status == HOOKE_OK && frames.recorded == 2) {
    const double order = expected_order(e);
    const double *end = e->kept.position + (e->kept.count - 1) * e->kept.size;
    (void)hk_frames_distance(&frames, 1, end, &e->last_error);
    e->last_error *= SURE / fabs(expm1(order * log(finer / value)));
    e->last_from = from;
  }
  hk_frames_release(&frames);
  return status;
}
