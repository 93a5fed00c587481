/* Estimates of a run's error from other runs of its method: Richardson's, if the observed order is that of
 * the method. */
#include "measure/estimate/estimate.h"

#include "integrate/method.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { LEAST_STEPS = 16 };
static const double COARSER_TOLERANCE = 10.0, FINER_TOLERANCE = 0.01, LOOSEST = 0.1, TIGHTEST = 1e-14;
/* Accepted orders: of a step, this much above the method's; of a tolerance. */
static const double ORDERS_APART = 0.4, LEAST_POWER = 0.5, MOST_POWER = 1.3;
static const double CAUTIOUS_POWER = 0.7; /* errors do not scale evenly with tolerances */
static const double ROUNDING = 1e-13;     /* of the largest coordinate: smaller differences are rounding */

double hk_estimate_value(const hooke_options *options) {
  const int32_t adaptive = hooke_method_is_adaptive(hooke_options_text(options, "method"));
  return hooke_options_number(options, adaptive ? "rtol" : "step");
}

static const struct hk_method *method_of(const struct hk_estimate *e) {
  return hk_method_find(hooke_options_text(e->options, "method"));
}

/* ---- reruns ---- */

struct run {
  struct hk_estimate *estimate;
  const struct hk_rerun *rerun;
};

static void start_from(hooke_state *state, void *ctx) {
  const struct hk_rerun *rerun = ((const struct run *)ctx)->rerun;
  if (rerun->from) hooke_state_copy(rerun->from, state);
}

static int32_t tell(double share, void *ctx) {
  const struct hk_estimate *e = ((const struct run *)ctx)->estimate;
  return hk_measurement_tell(e->measurement, share, "error");
}

static int32_t show(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  const struct hk_rerun *rerun = ((const struct run *)ctx)->rerun;
  (void)frame;
  return rerun->observer ? rerun->observer(step, state, rerun->ctx) : 0;
}

int32_t hk_estimate_rerun(struct hk_estimate *e, const struct hk_rerun *rerun, struct hk_frames *frames) {
  struct run run = {e, rerun};
  const struct hk_listener listener = {tell, show, start_from, &run};
  const char *method = hooke_options_text(e->options, "method");
  hooke_options *options = NULL;
  int32_t status = hk_pick_options(e->options, method, rerun->value, &options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "duration", rerun->duration);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "every", rerun->every);
  if (status == HOOKE_OK) status = hooke_options_unset(options, "max_steps");
  if (status == HOOKE_OK) status = hk_frames_run(frames, options, &listener, NULL, NULL);
  hooke_options_destroy(options);
  return status == HOOKE_NO_MEMORY || status == HOOKE_STOPPED ? status : HOOKE_OK;
}

/* Distance of the ends of two reruns; NaN if one did not finish. */
static double end_apart(const struct hk_frames *a, const struct hk_frames *b) {
  if (a->recorded < a->count || b->recorded < b->count) return NAN;
  return hk_frames_distance(a, a->count - 1, b->position + (b->count - 1) * b->size, NULL);
}

static double floor_of(const struct hk_frames *frames) {
  double largest = 0.0;
  for (int64_t k = 0; k < frames->recorded * frames->size; k++)
    largest = fmax(largest, fabs(frames->position[k]));
  return ROUNDING * largest;
}

static void know(struct hk_estimate *e, double error, double from, double until, const char *by) {
  if (!(error >= 0.0)) return;
  e->error = error;
  e->known_from = from;
  e->known_until = until;
  e->by = by;
}

/* ---- coarser reruns ---- */

/* Step or tolerance of a run `level` times coarser; NaN if there is none. */
static double coarser(const struct hk_estimate *e, int32_t adaptive, double value, int32_t level) {
  if (adaptive) {
    const double looser = value * pow(COARSER_TOLERANCE, level);
    return looser <= LOOSEST * (1.0 + 1e-9) ? looser : NAN;
  }
  const double steps = round(e->duration / value);
  return steps >= LEAST_STEPS ? e->duration / ceil(steps / exp2(level) * (1.0 - 1e-12)) : NAN;
}

/* `near` is the distance of the run from the coarser one, `far` that of this from the next. */
static double extrapolate(struct hk_estimate *e, int32_t adaptive, double near, double far) {
  const double factor = adaptive ? COARSER_TOLERANCE : 2.0, order = (double)method_of(e)->order;
  const double seen = log(far / near) / log(factor);
  const int believed =
      adaptive ? seen >= LEAST_POWER && seen <= MOST_POWER : fabs(seen - order) <= ORDERS_APART / order;
  if (!believed) return NAN;
  e->order = adaptive ? fmin(seen, CAUTIOUS_POWER) : order;
  return near / (pow(factor, e->order) - 1.0);
}

int32_t hk_estimate_by_coarser(struct hk_estimate *e) {
  const int32_t adaptive = method_of(e)->adaptive;
  const double value = hk_estimate_value(e->options);
  struct hk_frames frames[2] = {{.count = 0}, {.count = 0}};
  int32_t status = HOOKE_OK;
  for (int32_t k = 0; k < 2 && status == HOOKE_OK; k++) {
    const double next = coarser(e, adaptive, value, k + 1);
    if (isnan(next)) break;
    status = hk_frames_create(e->system, 2, &frames[k]);
    const struct hk_rerun rerun = {.value = next, .duration = e->duration, .every = e->duration};
    if (status == HOOKE_OK) status = hk_estimate_rerun(e, &rerun, &frames[k]);
    if (frames[k].recorded < 2) break;
  }
  if (status == HOOKE_OK && frames[1].recorded == 2) {
    const double *end = e->kept.position + (e->kept.count - 1) * e->kept.size;
    const double near = hk_frames_distance(&frames[0], 1, end, NULL), far = end_apart(&frames[0], &frames[1]);
    if (near > floor_of(&frames[0]))
      know(e, extrapolate(e, adaptive, near, far), e->begin, e->begin + e->duration,
           adaptive ? "tolerance" : "half-step");
  }
  hk_frames_release(&frames[0]);
  hk_frames_release(&frames[1]);
  return status;
}

/* ---- finer reruns ---- */

/* Largest distance of the last `count` kept frames from those of a finer run, as an error of the run. */
static double error_to(struct hk_estimate *e, const struct hk_frames *finer) {
  const struct hk_frames *kept = &e->kept;
  const struct hk_method *method = method_of(e);
  double apart = 0.0;
  if (finer->recorded < finer->count) return NAN;
  for (int64_t f = 1; f < finer->count; f++) {
    const double *q = kept->position + (kept->count - finer->count + f) * kept->size;
    apart = fmax(apart, hk_frames_distance(finer, f, q, NULL));
  }
  e->order = method->adaptive ? 1.0 : (double)method->order;
  const double gain = method->adaptive ? FINER_TOLERANCE : exp2(-e->order);
  return apart / (1.0 - gain);
}

static double finer_value(const struct hk_estimate *e) {
  const double value = hk_estimate_value(e->options);
  return method_of(e)->adaptive ? fmax(TIGHTEST, FINER_TOLERANCE * value) : 0.5 * value;
}

int32_t hk_estimate_by_slice(struct hk_estimate *e) {
  struct hk_frames frames;
  if (e->late == NULL || !isnan(e->late_after)) return HOOKE_OK;
  const double from = hooke_state_time(e->late), duration = e->begin + e->duration - from;
  if (!(duration > 0.0)) return HOOKE_OK;
  int32_t status = hk_frames_create(e->system, 2, &frames);
  if (status != HOOKE_OK) return status;
  const struct hk_rerun rerun = {
      .value = finer_value(e), .duration = duration, .every = duration, .from = e->late};
  status = hk_estimate_rerun(e, &rerun, &frames);
  if (status == HOOKE_OK) know(e, error_to(e, &frames), from, e->begin + e->duration, "slice");
  hk_frames_release(&frames);
  return status;
}

int32_t hk_estimate_by_finer(struct hk_estimate *e) {
  struct hk_frames frames;
  int32_t status = hk_frames_create(e->system, e->kept.count, &frames);
  if (status != HOOKE_OK) return status;
  const struct hk_rerun rerun = {.value = finer_value(e), .duration = e->duration, .every = e->apart};
  status = hk_estimate_rerun(e, &rerun, &frames);
  if (status == HOOKE_OK)
    know(e, error_to(e, &frames), e->begin, e->begin + e->duration,
         method_of(e)->adaptive ? "tolerance" : "half-step");
  hk_frames_release(&frames);
  return status;
}
