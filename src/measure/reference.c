#include "measure/reference.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/status.h"
#include "measure/node_blocks.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Tolerance of the check, level by level; the first is for studies with a budget, so that there is something to keep. The
 * run that is kept is ten times tighter, so that their distance is mostly the error of the check, and a bound on that of
 * the reference; below 1e-11 CVODE takes many more steps for no gain. */
static const double tolerances[] = {1e-7, 1e-9, 1e-10, 1e-11};
enum { LEVEL_COUNT = sizeof tolerances / sizeof tolerances[0], FIRST_LEVEL = 1, EXPECTED_LEVELS = 2 };
static const double TIGHTEST = 1e-11;
static const double NEXT_LEVEL = 1.5, AFTER_QUICK_LEVEL = 2.5; /* times the seconds of the level before */

static const double CLOSE = 1e-9;        /* agreement, as a share of the extent, at which tightening ends */
static const double DIGITS = 1e-6;       /* trusted digits where nothing else is wanted */
static const double DISPLACEMENT = 1e-6; /* of the start, as a share of the extent, to see how errors grow */
static const double SAFETY =
    2.0; /* the two may be off in the same direction, and then by more than they part */
static const double MOST_COST = 5.0;         /* of the explicit check against the first method */
static const double MOST_EVALUATIONS = 10.0; /* of rk8pd for one of the first method, in equal time */
static const double TIMEABLE = 2e-3;         /* [s] */
static const double TRIAL_SHARE = 0.05;      /* of the duration, to predict that cost */
static const double CHECK_COST = 2.0;        /* of the check against the first method, before it is known */
/* Of the budget: where the first run ends, so that there is time to check it, and where the last check does. */
static const double FIRST_RUN_SHARE = 0.3, LEVELS_SHARE = 0.8;

int32_t hooke_reference_method(const hooke_system *system, const double *q, const char **method) {
  struct hooke_node_blocks blocks;
  const int32_t status = hooke_node_blocks_create(system, q, &blocks);
  *method = "cvode-adams";
  if (status != HOOKE_OK) return status;
  if (hooke_node_blocks_damping_rate(&blocks) > 2.0 * hooke_node_blocks_frequency(&blocks))
    *method = "cvode-bdf";
  hooke_node_blocks_release(&blocks);
  return HOOKE_OK;
}

void hooke_reference_release(struct hooke_reference *reference) {
  hooke_frames_release(&reference->frames);
  memset(reference, 0, sizeof *reference);
}

/* Options of a run by `method` at a tolerance; the absolute one follows the size of the scene. */
static int32_t tight_options(const struct hooke_reference_request *request, const char *method, double rtol,
                             double extent, hooke_options **out) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_copy(request->run, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", method);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "rtol", rtol);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "atol", 0.01 * rtol * extent);
  if (status == HOOKE_OK) status = hooke_options_unset(options, "atol_velocity");
  if (status == HOOKE_OK) status = hooke_options_unset(options, "max_order");
  if (status == HOOKE_OK) status = hooke_options_unset(options, "max_steps");
  if (status == HOOKE_OK)
    *out = options;
  else
    hooke_options_destroy(options);
  return status;
}

int32_t hooke_reference_options(const hooke_options *run, const char *method, double rtol, double extent,
                                hooke_options **options) {
  const struct hooke_reference_request request = {.run = run};
  return tight_options(&request, method, rtol, extent, options);
}

/* ---- the size of things ---- */

static double diagonal(int64_t rows, const double *position) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (int64_t k = 0; k < 3 * rows; k++) {
    low[k % 3] = fmin(low[k % 3], position[k]);
    high[k % 3] = fmax(high[k % 3], position[k]);
  }
  double square = 0.0;
  for (int a = 0; a < 3 && rows > 0; a++)
    square += (high[a] - low[a]) * (high[a] - low[a]);
  return sqrt(square);
}

/* Before any run: the start alone, and 1 m for a scene without size. */
static int32_t find_extent(const hooke_system *system, double *extent) {
  hooke_state *state = NULL;
  const int32_t status = hooke_state_create(system, &state);
  if (status != HOOKE_OK) return status;
  *extent = diagonal(hooke_state_size(state) / 3, hooke_state_position(state));
  if (!(*extent > 0.0)) *extent = 1.0;
  hooke_state_destroy(state);
  return HOOKE_OK;
}

/* ---- one run of either ---- */

/* The runs of a reference under way: told of as a share of them all, stopped when their time is over. */
struct watch {
  const struct hooke_reference_request *request;
  double begun, run_begun, deadline;       /* on the clock [s] */
  double unit;                             /* of the first run [s]; 0 until it is over */
  double ahead;                            /* the runs to come, in units */
  int32_t levels;                          /* begun */
  int32_t expired;                         /* the deadline ended a run */
  const struct hooke_reference *displaced; /* the run that starts displaced is against this one */
};

static double share_of_all(const struct watch *watch, double share, double now) {
  const double spent = now - watch->begun, of_run = now - watch->run_begun;
  if (!(share > 0.0) || !(spent > 0.0)) return 0.0;
  const double run = of_run / share, unit = watch->unit > 0.0 ? watch->unit : run;
  return spent / (spent + run - of_run + watch->ahead * unit);
}

static int32_t watch_progress(double share, void *ctx) {
  struct watch *watch = ctx;
  const struct hooke_listener *listener = watch->request->listener;
  const double now = hooke_clock_seconds();
  if (listener && listener->on_progress) {
    const int32_t value = listener->on_progress(share_of_all(watch, share, now), listener->ctx);
    if (value != 0) return value;
  }
  if (now < watch->deadline) return 0;
  watch->expired = 1;
  return 1;
}

static struct hooke_listener listen(struct watch *watch, double deadline) {
  watch->run_begun = hooke_clock_seconds();
  watch->deadline = deadline;
  watch->expired = 0;
  return (struct hooke_listener){.on_progress = watch_progress, .ctx = watch};
}

/* What is still to come beside this level, for progress: the levels that are usual, and the run for the growth. */
static double ahead_of_level(const struct watch *watch) {
  return 1.0 + fmax(0.0, EXPECTED_LEVELS - watch->levels) * (1.0 + CHECK_COST);
}

/* What a run took. */
struct cost {
  double evaluations, seconds;
};

static int32_t make_frames(struct watch *watch, struct hooke_reference *r, double deadline,
                           struct cost *cost) {
  const struct hooke_listener listener = listen(watch, deadline);
  hooke_options *options = NULL;
  int32_t status = tight_options(watch->request, r->method, r->rtol, r->extent, &options);
  if (status == HOOKE_OK)
    status = hooke_frames_run(&r->frames, options, &listener, &cost->seconds, &cost->evaluations);
  hooke_options_destroy(options);
  if (status == HOOKE_STOPPED && watch->expired) status = HOOKE_OK;
  if (status != HOOKE_OK) return status;
  if (watch->unit == 0.0) watch->unit = hooke_clock_seconds() - watch->run_begun;
  const double size = diagonal(r->frames.recorded * r->frames.size / 3, r->frames.position);
  if (size > 0.0) r->extent = size;
  return HOOKE_OK;
}

/* A run as far as there are frames, or until the deadline; error_at is NaN past its end. */
static int32_t judge_by(struct watch *watch, const struct hooke_reference *r, const char *method, double rtol,
                        const struct hooke_listener *listener, struct hooke_trial *trial) {
  const struct hooke_frames *frames = &r->frames;
  hooke_options *options = NULL;
  int32_t status = tight_options(watch->request, method, rtol, r->extent, &options);
  if (status == HOOKE_OK && frames->recorded < frames->count) {
    const double reached = frames->time[frames->recorded - 1] - frames->time[0];
    status = hooke_options_set_number(options, "duration", reached);
  }
  if (status == HOOKE_OK) status = hooke_trial_run(trial, frames, frames->recorded, options, listener);
  hooke_options_destroy(options);
  if (status == HOOKE_STOPPED && watch->expired) return HOOKE_OK;
  if (status != HOOKE_OK || strcmp(trial->status, "finished") == 0) return status;
  return hooke_fail(HOOKE_SOLVER_FAILED, NULL, "no reference: %s %s at rtol %g", method, trial->status, rtol);
}

/* ---- the second integrator ---- */

/* What rk8pd needs for a short trial, over what the first method needs for the same share of its run: in time, since one
 * spends it on forces and the other on vectors and solves; trials too short to time count by evaluations. */
static int32_t explicit_cost(struct watch *watch, const struct hooke_reference *r, double rtol,
                             struct cost first, double *ratio) {
  struct hooke_frames frames;
  hooke_options *options = NULL;
  struct cost trial = {INFINITY, INFINITY};
  *ratio = INFINITY;
  if (!hooke_method_is_built("rk8pd")) return HOOKE_OK;
  int32_t status = hooke_frames_create(r->frames.system, 2, &frames);
  if (status != HOOKE_OK) return status;
  const double reached = r->frames.time[r->frames.recorded - 1] - r->frames.time[0];
  const double duration = TRIAL_SHARE * reached;
  status = tight_options(watch->request, "rk8pd", rtol, r->extent, &options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "duration", duration);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "every", duration);
  /* a scene too stiff for it must not hold the study up: forces cost it no more than they cost the other */
  const double most = MOST_COST * TRIAL_SHARE * first.evaluations * MOST_EVALUATIONS;
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "max_steps", fmax(10.0, ceil(most)));
  const double longest = fmax(TIMEABLE, 2.0 * MOST_COST * TRIAL_SHARE * first.seconds);
  const struct hooke_listener listener = listen(watch, hooke_clock_seconds() + longest);
  if (status == HOOKE_OK)
    status = hooke_frames_run(&frames, options, &listener, &trial.seconds, &trial.evaluations);
  hooke_options_destroy(options);
  hooke_frames_release(&frames);
  if (status == HOOKE_STEP_LIMIT || status == HOOKE_SOLVER_FAILED || status == HOOKE_DIVERGED)
    return HOOKE_OK;
  if (status == HOOKE_STOPPED && watch->expired) return HOOKE_OK;
  const double by_time = trial.seconds / (TRIAL_SHARE * first.seconds);
  const double by_evaluations = trial.evaluations / (TRIAL_SHARE * first.evaluations);
  *ratio = trial.seconds > TIMEABLE ? by_time : by_evaluations;
  return status;
}

static int32_t choose_check(struct watch *watch, struct hooke_reference *r, double rtol, struct cost first) {
  double ratio;
  const int32_t status = explicit_cost(watch, r, rtol, first, &ratio);
  r->check = ratio < MOST_COST ? "rk8pd" : "arkode-esdirk";
  return status;
}

/* ---- agreement ---- */

static void find_trust(const struct hooke_reference_request *request, struct hooke_reference *r,
                       const struct hooke_trial *check) {
  /* fmax leaves a NaN out: nothing in particular is wanted */
  const double digits = fmax(DIGITS * r->extent, request->digits);
  r->agreement = 0.0;
  r->checked = r->trusted = 0;
  while (r->checked < r->frames.recorded && !isnan(check->error_at[r->checked]))
    r->checked++;
  for (; r->trusted < r->checked; r->trusted++) {
    const double apart = check->error_at[r->trusted];
    if (!(apart <= digits)) break;
    r->agreement = fmax(r->agreement, SAFETY * apart);
  }
  hooke_watched_series_compare(&r->frames.watched, &check->watched, r->trusted, r->frames.time, SAFETY);
}

/* One level: a run, and another to check it. */
static int32_t agree(struct watch *watch, struct hooke_reference *r, double tolerance,
                     struct hooke_trial *check) {
  const double budget = watch->request->budget;
  const int first = r->check == NULL;
  const double deadline = watch->begun + LEVELS_SHARE * budget;
  struct cost cost;
  r->rtol = fmax(TIGHTEST, 0.1 * tolerance);
  watch->levels++;
  watch->ahead = ahead_of_level(watch) + CHECK_COST;
  int32_t status = make_frames(watch, r, first ? watch->begun + FIRST_RUN_SHARE * budget : deadline, &cost);
  if (status != HOOKE_OK || r->frames.recorded < 2) return status;
  if (first) status = choose_check(watch, r, tolerance, cost);
  watch->ahead = ahead_of_level(watch);
  const struct hooke_listener listener = listen(watch, deadline);
  if (status == HOOKE_OK) status = judge_by(watch, r, r->check, tolerance, &listener, check);
  if (status == HOOKE_OK) find_trust(watch->request, r, check);
  return status;
}

/* The further agreement is kept, of equals the later. */
static void keep_further(struct hooke_reference *r, struct hooke_reference *next) {
  struct hooke_reference *worse = next->trusted >= r->trusted ? r : next;
  hooke_frames_release(&worse->frames);
  if (worse == r) *r = *next;
}

/* Tightens until the two agree, tolerances end, or time does. */
static int32_t tighten(struct watch *watch, struct hooke_reference *r, struct hooke_trial *check) {
  const double end = watch->begun + LEVELS_SHARE * watch->request->budget;
  int32_t status = HOOKE_OK;
  for (int k = isinf(end) ? FIRST_LEVEL : 0; k < LEVEL_COUNT && status == HOOKE_OK; k++) {
    const double level_begun = hooke_clock_seconds();
    struct hooke_reference next = *r;
    next.trusted = next.checked = 0;
    status = hooke_frames_create(r->frames.system, r->frames.count, &next.frames);
    if (status == HOOKE_OK)
      status = hooke_watched_series_create(watch->request->watched, r->frames.count, &next.frames.watched);
    if (status == HOOKE_OK) status = agree(watch, &next, tolerances[k], check);
    if (status != HOOKE_OK) {
      hooke_frames_release(&next.frames);
      break;
    }
    const int over = next.checked < next.frames.count;
    keep_further(r, &next);
    if (r->trusted == r->frames.count && r->agreement <= CLOSE * r->extent) break;
    const double now = hooke_clock_seconds(), growth = k < FIRST_LEVEL ? AFTER_QUICK_LEVEL : NEXT_LEVEL;
    if (over || now + growth * (now - level_begun) > end) {
      r->hurried = over || k + 1 < LEVEL_COUNT;
      break;
    }
  }
  if (status == HOOKE_OK && r->checked < 2) {
    status =
        hooke_fail(HOOKE_BAD_VALUE, "budget",
                   "is too small: of its share of %.3g s the reference came to no frame after the start; "
                   "give a larger budget, a shorter duration or a smaller every",
                   watch->request->budget);
  }
  return status;
}

/* ---- growth ---- */

/* Every free particle by the same length, in directions that follow no line of the scene. */
static void displace(hooke_state *state, void *ctx) {
  const struct hooke_reference *reference = ((const struct watch *)ctx)->displaced;
  const struct hooke_frames *frames = &reference->frames;
  double *q = hooke_state_position(state);
  for (int64_t k = 0; k < frames->free_count; k++) {
    const double angle = 2.399963229728653 * (double)(k + 1), z = cos(1.7 * (double)(k + 1));
    const double length = DISPLACEMENT * reference->extent, across = sqrt(1.0 - z * z);
    q[3 * frames->free_particle[k]] += length * across * cos(angle);
    q[3 * frames->free_particle[k] + 1] += length * across * sin(angle);
    q[3 * frames->free_particle[k] + 2] += length * z;
  }
}

static int32_t measure_growth(struct watch *watch, struct hooke_reference *r, struct hooke_trial *trial) {
  struct hooke_listener listener = listen(watch, watch->begun + watch->request->budget);
  listener.on_start = displace;
  watch->displaced = r;
  watch->ahead = 0.0;
  const int32_t status = judge_by(watch, r, r->method, r->rtol, &listener, trial);
  for (int64_t f = 0; f < r->frames.count && status == HOOKE_OK; f++) /* fmax leaves out those without one */
    r->growth = fmax(r->growth, trial->error_at[f] / (DISPLACEMENT * r->extent));
  return status;
}

int32_t hooke_reference_create(const hooke_system *system, const struct hooke_reference_request *request,
                               struct hooke_reference *r) {
  struct watch watch = {.request = request, .begun = hooke_clock_seconds()};
  struct hooke_trial trial = {.status = NULL};
  hooke_state *state = NULL;
  *r = (struct hooke_reference){.growth = NAN, .agreement = NAN};
  if (!hooke_method_is_built("cvode-adams")) {
    return hooke_fail(HOOKE_NOT_BUILT, NULL, "a reference needs SUNDIALS, which this build is without");
  }
  int32_t status = hooke_state_create(system, &state);
  if (status == HOOKE_OK) status = hooke_reference_method(system, hooke_state_position(state), &r->method);
  hooke_state_destroy(state);
  if (status == HOOKE_OK) status = find_extent(system, &r->extent);
  if (status == HOOKE_OK) status = hooke_frames_create(system, request->frame_count, &r->frames);
  if (status == HOOKE_OK)
    status = hooke_watched_series_create(request->watched, request->frame_count, &r->frames.watched);
  if (status == HOOKE_OK) status = hooke_trial_create(&r->frames, &trial);
  if (status == HOOKE_OK) status = tighten(&watch, r, &trial);
  if (status == HOOKE_OK) status = measure_growth(&watch, r, &trial);
  hooke_trial_release(&trial);
  r->wall_seconds = hooke_clock_seconds() - watch.begun;
  if (status != HOOKE_OK) hooke_reference_release(r);
  return status;
}
