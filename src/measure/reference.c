#include "measure/reference.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/status.h"
#include "measure/node_blocks.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Tolerance of the check, level by level. The run that is kept is ten times tighter, so that their distance is mostly the
 * error of the check, and a bound on that of the reference; below 1e-11 CVODE takes many more steps for no gain. */
static const double tolerances[] = {1e-9, 1e-10, 1e-11};
enum { TOLERANCE_COUNT = sizeof tolerances / sizeof tolerances[0] };
static const double TIGHTEST = 1e-11;

static const double CLOSE = 1e-9;        /* agreement, as a share of the extent, at which tightening ends */
static const double DIGITS = 1e-6;       /* trusted digits where nothing else is wanted */
static const double DISPLACEMENT = 1e-6; /* of the start, as a share of the extent, to see how errors grow */
static const double SAFETY =
    2.0; /* the two may be off in the same direction, and then by more than they part */
static const double MOST_COST = 5.0;         /* of the explicit check against the first method */
static const double MOST_EVALUATIONS = 10.0; /* of rk8pd for one of the first method, in equal time */
static const double TIMEABLE = 2e-3;         /* [s] */
static const double TRIAL_SHARE = 0.05;      /* of the duration, to predict that cost */

int32_t hooke_reference_method(const hooke_system *system, const double *q, const char **method) {
  struct hooke_node_blocks blocks;
  const int32_t status = hooke_node_blocks_create(system, q, &blocks);
  *method = "cvode-adams";
  if (status == HOOKE_NOT_BUILT) return HOOKE_OK;
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

/* What a run took. */
struct cost {
  double evaluations, seconds;
};

static int32_t make_frames(const struct hooke_reference_request *request, struct hooke_reference *r,
                           struct cost *cost) {
  hooke_options *options = NULL;
  int32_t status = tight_options(request, r->method, r->rtol, r->extent, &options);
  if (status == HOOKE_OK)
    status = hooke_frames_run(&r->frames, options, request->listener, &cost->seconds, &cost->evaluations);
  hooke_options_destroy(options);
  if (status != HOOKE_OK) return status;
  const double size = diagonal(r->frames.recorded * r->frames.size / 3, r->frames.position);
  if (size > 0.0) r->extent = size;
  return HOOKE_OK;
}

static int32_t judge_by(const struct hooke_reference_request *request, const struct hooke_reference *r,
                        const char *method, double rtol, const struct hooke_listener *listener,
                        struct hooke_trial *trial) {
  hooke_options *options = NULL;
  int32_t status = tight_options(request, method, rtol, r->extent, &options);
  if (status == HOOKE_OK) status = hooke_trial_run(trial, &r->frames, r->frames.count, options, listener);
  hooke_options_destroy(options);
  if (status != HOOKE_OK || strcmp(trial->status, "finished") == 0) return status;
  return hooke_fail(HOOKE_SOLVER_FAILED, NULL, "no reference: %s %s at rtol %g", method, trial->status, rtol);
}

/* ---- the second integrator ---- */

/* What rk8pd needs for a short trial, over what the first method needs for the same share of its run: in time, since one
 * spends it on forces and the other on vectors and solves; trials too short to time count by evaluations. */
static int32_t explicit_cost(const struct hooke_reference_request *request, const struct hooke_reference *r,
                             struct cost first, double *ratio) {
  struct hooke_frames frames;
  hooke_options *options = NULL;
  struct cost trial = {INFINITY, INFINITY};
  *ratio = INFINITY;
  if (!hooke_method_is_built("rk8pd")) return HOOKE_OK;
  int32_t status = hooke_frames_create(r->frames.system, 2, &frames);
  if (status != HOOKE_OK) return status;
  const double duration = TRIAL_SHARE * hooke_options_number(request->run, "duration");
  status = tight_options(request, "rk8pd", tolerances[0], r->extent, &options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "duration", duration);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "every", duration);
  /* a scene too stiff for it must not hold the study up: forces cost it no more than they cost the other */
  const double most = MOST_COST * TRIAL_SHARE * first.evaluations * MOST_EVALUATIONS;
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "max_steps", fmax(10.0, ceil(most)));
  if (status == HOOKE_OK)
    status = hooke_frames_run(&frames, options, NULL, &trial.seconds, &trial.evaluations);
  hooke_options_destroy(options);
  hooke_frames_release(&frames);
  if (status == HOOKE_STEP_LIMIT || status == HOOKE_SOLVER_FAILED || status == HOOKE_DIVERGED)
    return HOOKE_OK;
  const double by_time = trial.seconds / (TRIAL_SHARE * first.seconds);
  const double by_evaluations = trial.evaluations / (TRIAL_SHARE * first.evaluations);
  *ratio = trial.seconds > TIMEABLE ? by_time : by_evaluations;
  return status;
}

static int32_t choose_check(const struct hooke_reference_request *request, struct hooke_reference *r,
                            struct cost first) {
  double ratio;
  const int32_t status = explicit_cost(request, r, first, &ratio);
  r->check = ratio < MOST_COST ? "rk8pd" : "arkode-esdirk";
  return status;
}

/* ---- agreement ---- */

static void find_trust(const struct hooke_reference_request *request, struct hooke_reference *r,
                       const struct hooke_trial *check) {
  /* fmax leaves a NaN out: nothing in particular is wanted */
  const double digits = fmax(DIGITS * r->extent, request->digits);
  r->agreement = 0.0;
  for (r->trusted = 0; r->trusted < r->frames.count; r->trusted++) {
    const double apart = check->error_at[r->trusted];
    if (!(apart <= digits)) break;
    r->agreement = fmax(r->agreement, SAFETY * apart);
  }
  r->trusted_until = r->trusted > 0 ? r->frames.time[r->trusted - 1] : NAN;
}

/* Tightens until the two agree, tolerances end, or time does. */
static int32_t tighten(const struct hooke_reference_request *request, struct hooke_reference *r,
                       struct hooke_trial *check) {
  const double begun = hooke_clock_seconds();
  int32_t status = HOOKE_OK;
  for (int k = 0; k < TOLERANCE_COUNT && status == HOOKE_OK; k++) {
    const double level_begun = hooke_clock_seconds();
    struct cost cost;
    r->rtol = fmax(TIGHTEST, 0.1 * tolerances[k]);
    status = make_frames(request, r, &cost);
    if (status == HOOKE_OK && k == 0) status = choose_check(request, r, cost);
    if (status == HOOKE_OK) status = judge_by(request, r, r->check, tolerances[k], request->listener, check);
    if (status != HOOKE_OK) break;
    find_trust(request, r, check);
    if (r->trusted == r->frames.count && r->agreement <= CLOSE * r->extent) break;
    /* the next level takes about one and a half times as long */
    const double now = hooke_clock_seconds();
    if (now - begun + 1.5 * (now - level_begun) > request->budget) break;
  }
  return status;
}

/* ---- growth ---- */

struct displaced {
  const struct hooke_reference *reference;
  const struct hooke_listener *listener;
};

/* Every free particle by the same length, in directions that follow no line of the scene. */
static void displace(hooke_state *state, void *ctx) {
  const struct displaced *displaced = ctx;
  const struct hooke_frames *frames = &displaced->reference->frames;
  double *q = hooke_state_position(state);
  for (int64_t k = 0; k < frames->free_count; k++) {
    const double angle = 2.399963229728653 * (double)(k + 1), z = cos(1.7 * (double)(k + 1));
    const double length = DISPLACEMENT * displaced->reference->extent, across = sqrt(1.0 - z * z);
    q[3 * frames->free_particle[k]] += length * across * cos(angle);
    q[3 * frames->free_particle[k] + 1] += length * across * sin(angle);
    q[3 * frames->free_particle[k] + 2] += length * z;
  }
}

static int32_t displaced_progress(double share, void *ctx) {
  const struct displaced *displaced = ctx;
  const struct hooke_listener *listener = displaced->listener;
  return listener && listener->on_progress ? listener->on_progress(share, listener->ctx) : 0;
}

static int32_t measure_growth(const struct hooke_reference_request *request, struct hooke_reference *r,
                              struct hooke_trial *trial) {
  struct displaced displaced = {r, request->listener};
  const struct hooke_listener listener = {
      .on_progress = displaced_progress, .on_start = displace, .ctx = &displaced};
  const int32_t status = judge_by(request, r, r->method, r->rtol, &listener, trial);
  if (status == HOOKE_OK) r->growth = trial->error / (DISPLACEMENT * r->extent);
  return status;
}

int32_t hooke_reference_create(const hooke_system *system, const struct hooke_reference_request *request,
                               struct hooke_reference *r) {
  const double begun = hooke_clock_seconds();
  struct hooke_trial trial = {.status = NULL};
  hooke_state *state = NULL;
  *r = (struct hooke_reference){.growth = NAN, .agreement = NAN, .trusted_until = NAN};
  if (!hooke_method_is_built("cvode-adams")) {
    return hooke_fail(HOOKE_NOT_BUILT, NULL, "a reference needs SUNDIALS, which this build is without");
  }
  int32_t status = hooke_state_create(system, &state);
  if (status == HOOKE_OK) status = hooke_reference_method(system, hooke_state_position(state), &r->method);
  hooke_state_destroy(state);
  if (status == HOOKE_OK) status = find_extent(system, &r->extent);
  if (status == HOOKE_OK) status = hooke_frames_create(system, request->frame_count, &r->frames);
  if (status == HOOKE_OK) status = hooke_trial_create(&r->frames, &trial);
  if (status == HOOKE_OK) status = tighten(request, r, &trial);
  if (status == HOOKE_OK) status = measure_growth(request, r, &trial);
  hooke_trial_release(&trial);
  r->wall_seconds = hooke_clock_seconds() - begun;
  if (status != HOOKE_OK) hooke_reference_release(r);
  return status;
}
