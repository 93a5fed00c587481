#include "measure/trial/reference_run.h"

#include "core/clock.h"
#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double ABSOLUTE = 0.01;            /* of rtol times the extent: the absolute tolerance */
static const double LEAST_RELATIVE = 1e-15;     /* that CVODE takes */
static const double LEAST_WORK = 1e-300;        /* [s]: none, where 0 is without limit */
static const double MOST_COST = 5.0;            /* of the explicit check against the first method */
static const double MOST_EVALUATIONS = 10.0;    /* of rk8pd against the first method, in equal time */
static const double MOST_ESDIRK = 20.0;         /* of arkode-esdirk against the first method */
static const double COARSEST = 1e-4;            /* tolerance that `longest` stands for */
static const double TRIAL_SHARE = 0.05;         /* of the duration, to predict costs */
static const double FIRST_TRIAL_SHARE = 0.0225; /* of the budget: a run that takes more comes to no end */

int32_t hk_reference_find_longest(const struct hk_reference_watch *watch, struct hk_reference *r,
                                  const char *method) {
  const hooke_options *run = watch->request->run;
  hooke_state *state = NULL;
  double bound = NAN, unit;
  int32_t status =
      hk_step_unit(hooke_options_number(run, "duration"), hooke_options_number(run, "every"), &unit);
  if (status == HOOKE_OK) status = hooke_state_create(r->frames.system, &state);
  if (status == HOOKE_OK)
    status = hooke_step_bound(r->frames.system, method, hooke_state_position(state), &bound);
  hooke_state_destroy(state);
  r->longest = unit / fmax(1.0, bound > 0.0 ? ceil(unit / bound * (1.0 - 1e-9)) : 1.0);
  return status;
}

double hk_reference_setting(const struct hk_reference *r, const char *method, double rtol) {
  if (hooke_method_is_adaptive(method)) return rtol;
  const double parts = pow(COARSEST / rtol, 1.0 / hk_method_find(method)->order);
  return r->longest / fmax(1.0, ceil(parts * (1.0 - 1e-9)));
}

int32_t hk_reference_options(const hooke_options *run, const char *method, double rtol,
                             const struct hk_reference *r, hooke_options **out) {
  const double relative = fmax(rtol * fmin(1.0, r->extent / r->farthest), LEAST_RELATIVE);
  int32_t status = hooke_options_copy(run, out);
  if (status == HOOKE_OK) status = hooke_options_set_text(*out, "method", method);
  if (status == HOOKE_OK && !hooke_method_is_adaptive(method))
    status = hooke_options_set_number(*out, "step", hk_reference_setting(r, method, rtol));
  if (status == HOOKE_OK) status = hooke_options_set_number(*out, "rtol", relative);
  if (status == HOOKE_OK) status = hooke_options_set_number(*out, "atol", ABSOLUTE * rtol * r->extent);
  if (status == HOOKE_OK) status = hooke_options_unset(*out, "atol_velocity");
  if (status == HOOKE_OK) status = hk_run_fill_tolerances(NULL, *out);
  if (status == HOOKE_OK) status = hooke_options_unset(*out, "max_order");
  return status == HOOKE_OK ? hooke_options_unset(*out, "max_steps") : status;
}

static double share_of_all(const struct hk_reference_watch *watch, double fraction, double now) {
  const double spent = now - watch->begun, of_run = now - watch->run_begun;
  if (!(fraction > 0.0) || !(spent > 0.0)) return 0.0;
  const double run = of_run / fraction, unit = watch->unit > 0.0 ? watch->unit : run;
  return spent / (spent + run - of_run + watch->ahead * unit);
}

static int32_t watch_progress(double fraction, void *ctx) {
  struct hk_reference_watch *watch = ctx;
  const struct hk_listener *listener = watch->request->listener;
  const double now = hk_clock_seconds();
  if (listener && listener->on_progress) {
    const int32_t value = listener->on_progress(share_of_all(watch, fraction, now), listener->ctx);
    if (value != 0) return value;
  }
  if (watch->request->counted || now < watch->deadline) return 0;
  watch->expired = 1;
  return 1;
}

double hk_reference_now(const struct hk_reference_watch *watch) {
  return watch->request->counted ? watch->work : hk_clock_seconds();
}

static struct hk_listener limited(struct hk_reference_watch *watch, double most_work) {
  const struct hk_listener *own = watch->request->listener;
  return (struct hk_listener){.on_progress = watch_progress,
                              .most_work = fmax(LEAST_WORK, most_work),
                              .serial = own && own->serial,
                              .ctx = watch};
}

struct hk_listener hk_reference_listen(struct hk_reference_watch *watch, double deadline) {
  watch->run_begun = hk_clock_seconds();
  watch->deadline = deadline;
  watch->expired = 0;
  return limited(watch, watch->request->counted ? deadline - watch->work : INFINITY);
}

int32_t hk_reference_make_frames(struct hk_reference_watch *watch, struct hk_reference *r, double deadline,
                                 struct hk_run_cost *cost) {
  const struct hk_listener listener = hk_reference_listen(watch, deadline);
  hooke_options *options = NULL;
  *cost = (struct hk_run_cost){.work = 0.0};
  int32_t status = hk_reference_options(watch->request->run, r->method, r->rtol, r, &options);
  if (status == HOOKE_OK) status = hk_frames_run(&r->frames, options, &listener, cost);
  hooke_options_destroy(options);
  watch->work += cost->work;
  watch->expired |= cost->too_long;
  if (status == HOOKE_STOPPED && watch->expired) status = HOOKE_OK;
  if (status != HOOKE_OK) return status;
  r->run_extent = r->extent;
  r->run_work = cost->work;
  if (watch->unit == 0.0) watch->unit = hk_clock_seconds() - watch->run_begun;
  const double size = hk_frames_extent(&r->frames, r->frames.recorded);
  if (size > 0.0) r->extent = size;
  return HOOKE_OK;
}

int32_t hk_reference_judge(struct hk_reference_watch *watch, const struct hk_reference *r, const char *method,
                           double rtol, const struct hk_listener *listener, struct hk_trial *trial) {
  const struct hk_frames *frames = &r->frames;
  hooke_options *options = NULL;
  int32_t status = hk_reference_options(watch->request->run, method, rtol, r, &options);
  if (status == HOOKE_OK && frames->recorded < frames->count) {
    const double reached = frames->time[frames->recorded - 1] - frames->time[0];
    status = hooke_options_set_number(options, "duration", reached);
  }
  if (status == HOOKE_OK) status = hk_trial_run(trial, frames, frames->recorded, options, listener);
  hooke_options_destroy(options);
  if (status == HOOKE_OK) watch->work += trial->work;
  if (status == HOOKE_OK && strcmp(trial->status, "stopped") == 0) watch->expired = 1;
  if ((status == HOOKE_OK || status == HOOKE_STOPPED) && watch->expired) return HOOKE_OK;
  if (status != HOOKE_OK || strcmp(trial->status, "finished") == 0) return status;
  return hk_fail(HOOKE_SOLVER_FAILED, NULL, "no reference: %s %s at rtol %g", method, trial->status, rtol);
}

/* ---- choice of integrators ---- */

/* A trial over a fraction of the duration, with a limit on counted work [s] and steps; infinite if it does
 * not finish. */
static int32_t try_beginning(struct hk_reference_watch *watch, const struct hk_reference *r,
                             const char *method, double rtol, double most_work, double most_steps,
                             double duration, struct hk_run_cost *cost) {
  struct hk_frames frames;
  hooke_options *options = NULL;
  *cost = (struct hk_run_cost){.work = 0.0};
  int32_t status = hk_frames_create(r->frames.system, 2, &frames);
  if (status != HOOKE_OK) return status;
  status = hk_reference_options(watch->request->run, method, rtol, r, &options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "duration", duration);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "every", duration);
  if (status == HOOKE_OK && !isinf(most_steps))
    status = hooke_options_set_number(options, "max_steps", most_steps);
  const double end = watch->start + watch->request->budget;
  (void)hk_reference_listen(watch, end);
  const struct hk_listener listener = limited(watch, most_work);
  if (status == HOOKE_OK) status = hk_frames_run(&frames, options, &listener, cost);
  hooke_options_destroy(options);
  hk_frames_release(&frames);
  watch->work += cost->work;
  watch->expired |= cost->too_long;
  if (!hk_trial_gave_up(status) && !(status == HOOKE_STOPPED && watch->expired)) return status;
  cost->work = INFINITY;
  return HOOKE_OK;
}

int32_t hk_reference_choose_first(struct hk_reference_watch *watch, struct hk_reference *r, double rtol) {
  if (strcmp(r->method, "cvode-bdf") != 0) return HOOKE_OK;
  const double duration = TRIAL_SHARE * hooke_options_number(watch->request->run, "duration");
  const double most = FIRST_TRIAL_SHARE * watch->request->budget;
  struct hk_run_cost bdf, adams;
  int32_t status = try_beginning(watch, r, "cvode-bdf", rtol, most, INFINITY, duration, &bdf);
  if (status == HOOKE_OK)
    status = try_beginning(watch, r, "cvode-adams", rtol, fmin(most, bdf.work), INFINITY, duration, &adams);
  if (status == HOOKE_OK && adams.work < bdf.work) r->method = "cvode-adams";
  return status;
}

/* Counted work of a check in a short trial, with so much and so many steps at most, relative to that of the
 * first method for the same part of its run. */
static int32_t relative_cost(struct hk_reference_watch *watch, const struct hk_reference *r,
                             const char *method, double rtol, double first_work, double most,
                             double most_steps, double *ratio) {
  struct hk_run_cost trial;
  const double reached = r->frames.time[r->frames.recorded - 1] - r->frames.time[0];
  *ratio = INFINITY;
  if (!hooke_method_is_built(method)) return HOOKE_OK;
  const int32_t status = try_beginning(watch, r, method, rtol, most * TRIAL_SHARE * first_work, most_steps,
                                       TRIAL_SHARE * reached, &trial);
  if (status == HOOKE_OK) *ratio = trial.work / (TRIAL_SHARE * first_work);
  return status;
}

int32_t hk_reference_choose_check(struct hk_reference_watch *watch, struct hk_reference *r, double rtol,
                                  struct hk_run_cost first) {
  double by_explicit, by_implicit = MOST_COST;
  if (hk_reference_is_halved(r)) {
    r->check = r->method;
    return HOOKE_OK;
  }
  /* a scene too stiff for it must not delay the study: forces cost it no more than the other */
  const double steps = MOST_COST * TRIAL_SHARE * first.force_evaluations * MOST_EVALUATIONS;
  int32_t status = relative_cost(watch, r, "rk8pd", rtol, first.work, 2.0 * MOST_COST,
                                 fmax(10.0, ceil(steps)), &by_explicit);
  /* it may come to no end where springs are very stiff */
  if (status == HOOKE_OK && by_explicit >= MOST_COST)
    status = relative_cost(watch, r, "arkode-esdirk", rtol, first.work, MOST_ESDIRK, INFINITY, &by_implicit);
  r->check = by_explicit <= by_implicit ? "rk8pd" : "arkode-esdirk";
  /* of order 2 alone, but it comes to an end */
  if (status != HOOKE_OK || !isinf(by_explicit) || !isinf(by_implicit)) return status;
  if (!hk_method_suits("tr-bdf2", r->frames.system)) return HOOKE_OK;
  r->check = "tr-bdf2";
  return hk_reference_find_longest(watch, r, r->check);
}
