#include "measure/trial/reference_run.h"

#include "core/clock.h"
#include "core/status.h"
#include "measure/spectrum/node_blocks.h"
#include "model/system.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Tolerances of the check, level by level. The recorded run is ten times tighter, so that their distance is
 * mostly the error of the check, and a bound on that of the reference; at the tightest level, where rounding
 * dominates, both have the same tolerance. Without a budget the first level is tight. */
static const double TIGHTER = 0.1, LOOSEST = 1e-4, QUICK = 1e-7, TIGHT = 1e-9, TIGHTEST = 1e-14;
static const double FIRST_SHARE = 0.1; /* the first tolerance, in digits as a fraction of the extent */
static const double LEAST_FACTOR = 1e-2, MOST_FACTOR = 0.1; /* factor from one level to the next */
static const double AIM = 0.3, LIKE = 0.1; /* of the wanted distance; by a reference of another motion */
static const double COST_POWER = 1.0 / 6.0, COST_SPARE = 1.1; /* of a level, in the factor */
/* Of rk4: half the step is this factor of a tolerance, and costs twice as much. */
static const double HALVED = 1.0 / 16.0, HALVED_COST_POWER = 1.0 / 4.0;
enum { EXPECTED_LEVELS = 2 };

static const double CLOSE = 1e-9;     /* agreement, as a fraction of the extent, at which tightening ends */
static const double CLOSER = 0.5;     /* of the distance at the level before, from which tightening helps */
static const double DIGITS = 1e-6;    /* trusted digits if none are wanted or those are out of reach */
static const double SAFETY = 2.0;     /* the two may err in the same direction, by more than their distance */
static const double CHECK_COST = 2.0; /* cost of the check relative to the first method, before it is known */
/* Fractions of the budget: end of the first run, so that there is time to check it; end of the last check;
 * and limit for another level once all frames are trusted. */
static const double FIRST_RUN_SHARE = 0.3, FIRST_OF_FEW = 0.45, LEVELS_SHARE = 0.8, FLOOR_SHARE = 0.4;

/* The cheapest method at positions q: Adams, or BDF if damping is faster than the fastest oscillation, so
 * that fast motion dies out and an implicit method can take long steps. */
static int32_t choose_method(const hooke_system *system, const double *q, const char **method) {
  struct hk_node_blocks blocks;
  *method = hooke_method_is_built("cvode-adams") ? "cvode-adams" : hk_rk4.name;
  if (system->mover_count > 0 || !hooke_method_is_adaptive(*method)) return HOOKE_OK;
  const int32_t status = hk_node_blocks_create(system, q, NULL, &blocks);
  if (status != HOOKE_OK) return status;
  /* in the time that the fastest oscillation takes for a radian, and that the fastest damping takes */
  const double swing = hk_node_blocks_reach(&blocks, (struct hk_node_limit){.kk = 1.0}, INFINITY, NULL),
               decay = hk_node_blocks_reach(&blocks, (struct hk_node_limit){.c = 1.0}, INFINITY, NULL);
  if (system->overdamped || swing > 2.0 * decay) *method = "cvode-bdf";
  hk_node_blocks_release(&blocks);
  return HOOKE_OK;
}

int32_t hk_reference_is_halved(const struct hk_reference *r) {
  return !hooke_method_is_adaptive(r->method);
}

double hk_reference_time(const struct hk_reference *r, int64_t count, double duration) {
  if (count <= 0) return NAN;
  return count == r->frames.count ? r->frames.time[0] + duration : r->frames.time[count - 1];
}

void hk_reference_release(struct hk_reference *reference) {
  hk_frames_release(&reference->frames);
  memset(reference, 0, sizeof *reference);
}

/* Before any run: the start alone, of a problem its largest coordinate; 1 m for a scene without size. */
static void find_extent(struct hk_reference *r, const hooke_state *state) {
  const double *q = hooke_state_position(state);
  const hooke_system *system = r->frames.system;
  double most = 0.0;
  for (int64_t k = 0; k < hooke_state_size(state); k++)
    most = fmax(most, fabs(q[k]));
  r->extent = system->generalized ? most : hk_diagonal(hooke_state_size(state) / 3, q);
  if (!(r->extent > 0.0)) r->extent = 1.0;
  r->farthest = fmax(most, r->extent);
}

/* ---- agreement ---- */

/* Of one unit of what is wanted [m]. */
static double length_of(const struct hk_reference *r) {
  return r->frames.wants ? r->frames.wants->length : 1.0;
}

/* Number of initial frames whose distance, with the safety factor, is at most `digits`. */
static void trust(struct hk_reference *r, const struct hk_trial *check, double digits) {
  const double scale = SAFETY * length_of(r);
  r->digits = digits;
  r->agreement = r->wanted_agreement = r->energy_agreement = 0.0;
  for (r->trusted = 0; r->trusted < r->checked; r->trusted++) {
    if (!(scale * check->wanted_at[r->trusted] <= digits)) break;
    r->agreement = fmax(r->agreement, SAFETY * check->error_max_at[r->trusted]);
    r->wanted_agreement = fmax(r->wanted_agreement, SAFETY * check->wanted_at[r->trusted]);
    r->energy_agreement = fmax(r->energy_agreement, SAFETY * fabs(check->drift_at[r->trusted]));
  }
  if (r->trusted < 2) r->agreement = r->wanted_agreement = NAN;
  if (r->trusted < 2 || r->frames.system->generalized) r->energy_agreement = NAN;
}

/* Which of a list of wants the two do not agree on at the next frame. */
static void find_parted(struct hk_reference *r, const struct hk_trial *check) {
  const struct hk_wants *wants = r->frames.wants;
  const int64_t f = r->trusted;
  double bound[HOOKE_WANTS], apart[1 + HOOKE_WANTS] = {0.0}, most = -1.0;
  if (!hk_wants_is_list(wants) || f >= r->checked) return;
  hk_wants_bounds(wants, &r->frames.watched, r->frames.recorded, bound);
  hk_wants_spread(wants, &check->watched, f, &r->frames.watched, f, check->error_max_at[f], apart);
  for (int32_t k = 0; k < wants->count; k++) {
    if (apart[1 + k] / bound[k] <= most) continue;
    most = apart[1 + k] / bound[k];
    r->parted = k;
    r->parted_by = SAFETY * apart[1 + k];
  }
}

/* If the wanted digits are out of reach from the first frame on, as many as possible. */
static void find_trust(struct hk_reference_watch *watch, struct hk_reference *r,
                       const struct hk_trial *check) {
  const double fallback = DIGITS * r->extent, wanted = watch->request->digits;
  r->checked = 0;
  watch->apart = 0.0;
  while (r->checked < r->frames.recorded && !isnan(check->error_max_at[r->checked]))
    watch->apart = fmax(watch->apart, SAFETY * length_of(r) * check->wanted_at[r->checked++]);
  trust(r, check, isnan(wanted) ? fallback : wanted);
  r->coarse = r->trusted < 2 && r->digits < fallback;
  find_parted(r, check);
  if (r->coarse) trust(r, check, fallback);
  hk_watched_series_compare(&r->frames.watched, &check->watched, r->trusted, r->frames.time, SAFETY);
}

/* ---- levels ---- */

/* The tolerance of a level: steps are halved, once or more often, from the loosest one on. */
static double of_level(const struct hk_reference *r, double tolerance) {
  const double halvings = ceil(log(tolerance / LOOSEST) / log(HALVED) - 1e-9);
  return hk_reference_is_halved(r) ? LOOSEST * pow(HALVED, halvings) : tolerance;
}

static int measures_growth(const struct hk_reference_request *request) {
  return !request->enough && !request->brief;
}

/* Work to come beside this level, for progress: the usual levels, and the runs for the growth. */
static double ahead_of_level(const struct hk_reference_watch *watch) {
  const double growth = measures_growth(watch->request) ? 1.0 : 0.0;
  return growth + fmax(0.0, EXPECTED_LEVELS - watch->levels) * (1.0 + CHECK_COST);
}

/* One level: a run, and another to check it. */
static int32_t agree(struct hk_reference_watch *watch, struct hk_reference *r, double tolerance,
                     struct hk_trial *check) {
  const double budget = watch->request->budget;
  const int first = r->check == NULL;
  const double fraction = watch->request->enough ? FIRST_OF_FEW : FIRST_RUN_SHARE;
  const double deadline = watch->start + LEVELS_SHARE * budget;
  struct hk_run_cost cost;
  r->rtol = hk_reference_is_halved(r) ? HALVED * tolerance : fmax(TIGHTEST, TIGHTER * tolerance);
  watch->levels++;
  watch->ahead = ahead_of_level(watch) + CHECK_COST;
  int32_t status =
      hk_reference_make_frames(watch, r, first ? watch->start + fraction * budget : deadline, &cost);
  const int64_t frames = r->frames.recorded;
  if (status == HOOKE_OK && r->frames.wants && tolerance <= QUICK && frames == r->frames.count)
    status = hk_wants_require_values(r->frames.wants, &r->frames.watched, frames, frames);
  if (status != HOOKE_OK || frames < 2) return status;
  if (first) status = hk_reference_choose_check(watch, r, tolerance, cost);
  watch->ahead = ahead_of_level(watch);
  const struct hk_listener listener = hk_reference_listen(watch, deadline);
  if (status == HOOKE_OK) status = hk_reference_judge(watch, r, r->check, tolerance, &listener, check);
  if (status == HOOKE_OK) find_trust(watch, r, check);
  return status;
}

/* Keeps the longer agreement, of equals the later; the wanted digits come before any others. */
static void keep_further(struct hk_reference *r, struct hk_reference *next) {
  const int better = next->coarse != r->coarse ? r->coarse : next->trusted >= r->trusted;
  struct hk_reference *worse = better ? r : next;
  hk_frames_release(&worse->frames);
  if (worse == r) *r = *next;
}

static double first_tolerance(const struct hk_reference_request *request, const struct hk_reference *r) {
  const struct hk_reference *like = request->alike;
  if (hk_reference_is_halved(r))
    return LOOSEST; /* halving costs little more than beginning with short steps */
  if (!request->enough && isinf(request->budget)) return TIGHT;
  if (isnan(request->digits)) return request->enough ? FIRST_SHARE * DIGITS : QUICK;
  double tolerance = fmin(LOOSEST, FIRST_SHARE * request->digits / r->extent);
  if (like && like->wanted_agreement > 0.0)
    tolerance = fmin(tolerance, like->rtol / TIGHTER * LIKE * request->digits /
                                    (length_of(like) * like->wanted_agreement));
  return fmax(TIGHT, tolerance);
}

static int is_all(const struct hk_reference *r) {
  return r->trusted == r->frames.count && !r->coarse;
}

/* The distance at which tightening ends [m]. */
static double aim_of(const struct hk_reference *r) {
  return is_all(r) ? CLOSE * r->extent : r->digits;
}

/* The tolerance at which the two should agree: errors scale with the tolerance, unless motion is chaotic. */
static double next_tolerance(const struct hk_reference_watch *watch, const struct hk_reference *r,
                             double tolerance) {
  const double aim = AIM * aim_of(r) / watch->apart;
  const double least = tolerance > TIGHT ? LEAST_FACTOR : MOST_FACTOR;
  return fmax(TIGHTEST, tolerance * fmax(least, fmin(MOST_FACTOR, aim)));
}

/* 1 if the reference is as good as requested. */
static int is_enough(const struct hk_reference_request *request, const struct hk_reference *r) {
  return is_all(r) && (request->enough || r->agreement <= CLOSE * r->extent);
}

/* 1 if rounding alone is above the distance that tightening aims at, where more steps would only add to it.
 */
static int is_drowned(const struct hk_reference *r) {
  const int64_t frame = r->trusted < r->frames.recorded ? r->trusted : r->frames.recorded - 1;
  return SAFETY * r->frames.rounding[frame] > aim_of(r);
}

/* 1 if the two part for good, which tighter tolerances put off a little; the first steps of rk4 are long. */
static int is_lost(const struct hk_reference_watch *watch, const struct hk_reference *r, double tolerance) {
  return watch->request->brief && !is_all(r) && (!hk_reference_is_halved(r) || tolerance <= TIGHT);
}

/* Beside positions. */
static int32_t keep_more(const struct hk_reference_request *request, struct hk_frames *frames) {
  const int32_t status = hk_frames_watch(frames, request->watched, request->wants);
  return status == HOOKE_OK && request->keeps_state ? hooke_state_create(frames->system, &frames->within)
                                                    : status;
}

/* Runs a level, which may replace the best one so far. */
static int32_t run_level(struct hk_reference_watch *watch, struct hk_reference *r, double tolerance,
                         struct hk_trial *check) {
  struct hk_reference next = *r;
  next.trusted = next.checked = 0;
  int32_t status = hk_frames_create(r->frames.system, r->frames.count, &next.frames);
  if (status == HOOKE_OK) status = keep_more(watch->request, &next.frames);
  if (status == HOOKE_OK) status = agree(watch, &next, tolerance, check);
  if (status != HOOKE_OK) {
    hk_frames_release(&next.frames);
    return status;
  }
  watch->cut = next.checked < next.frames.count;
  keep_further(r, &next);
  return HOOKE_OK;
}

/* 1 if a level with a tolerance smaller by this factor than that of a level of so many seconds should end
 * within the budget for levels. */
static int has_time(const struct hk_reference_watch *watch, const struct hk_reference *r, double times,
                    double seconds) {
  const double fraction = is_all(r) ? FLOOR_SHARE : LEVELS_SHARE;
  const double expected =
      COST_SPARE * pow(times, hk_reference_is_halved(r) ? HALVED_COST_POWER : COST_POWER) * seconds;
  return hk_reference_now(watch) + expected <= watch->start + fraction * watch->request->budget;
}

/* Tightens until the two agree, or tolerances or time are exhausted. */
static int32_t tighten(struct hk_reference_watch *watch, struct hk_reference *r, struct hk_trial *check) {
  double tolerance = first_tolerance(watch->request, r);
  int32_t status = hk_reference_choose_first(watch, r, TIGHTER * tolerance);
  if (status != HOOKE_OK) return status;
  for (double before = INFINITY;; before = watch->apart) {
    const double begun = hk_reference_now(watch);
    status = run_level(watch, r, tolerance, check);
    const int failed = hk_trial_gave_up(status); /* another tolerance may do */
    if (failed && r->checked > 0) status = HOOKE_OK;
    if (status != HOOKE_OK && (!failed || tolerance <= TIGHTEST)) return status;
    const int last = tolerance <= TIGHTEST || is_lost(watch, r, tolerance) || is_drowned(r) ||
                     (!isnan(watch->request->digits) && is_all(r) && watch->apart > CLOSER * before);
    if (r->checked > 0 && (failed || last || is_enough(watch->request, r))) break;
    const double seconds = hk_reference_now(watch) - begun;
    double finer = of_level(r, failed ? tolerance * LEAST_FACTOR : next_tolerance(watch, r, tolerance));
    if (!has_time(watch, r, tolerance / finer, seconds))
      finer = fmax(finer, of_level(r, MOST_FACTOR * tolerance));
    r->hurried = watch->cut || !has_time(watch, r, tolerance / finer, seconds);
    if (r->hurried) break;
    tolerance = finer;
  }
  if (status == HOOKE_OK && r->checked < 2) {
    status = hk_fail(HOOKE_BAD_VALUE, "budget",
                     "is too small: of its share of %.3g s the reference came to no frame after the start; "
                     "give a larger budget, a shorter duration or a smaller every",
                     watch->request->budget);
  }
  return status;
}

int32_t hk_reference_create(const hooke_system *system, const struct hk_reference_request *request,
                            struct hk_reference *r) {
  struct hk_reference_watch watch = {.request = request, .begun = hk_clock_seconds()};
  watch.start = hk_reference_now(&watch);
  struct hk_trial trial = {.status = NULL};
  hooke_state *state = NULL;
  *r = (struct hk_reference){.growth = NAN,
                             .growth_probability = NAN,
                             .growth_seen = NAN,
                             .agreement = NAN,
                             .wanted_agreement = NAN,
                             .energy_agreement = NAN,
                             .coarse = 1};
  int32_t status = hooke_state_create(system, &state);
  if (status == HOOKE_OK) status = choose_method(system, hooke_state_position(state), &r->method);
  if (status == HOOKE_OK) status = hk_frames_create(system, request->frame_count, &r->frames);
  if (status == HOOKE_OK) find_extent(r, state);
  hooke_state_destroy(state);
  if (status == HOOKE_OK) status = keep_more(request, &r->frames);
  if (status == HOOKE_OK && hk_reference_is_halved(r))
    status = hk_reference_find_longest(&watch, r, r->method);
  if (status == HOOKE_OK) status = tighten(&watch, r, &trial);
  if (status == HOOKE_OK && measures_growth(request)) status = hk_reference_measure_growth(&watch, r, &trial);
  hk_trial_release(&trial);
  r->wall_seconds = hk_clock_seconds() - watch.begun;
  r->work = watch.work;
  if (status != HOOKE_OK) hk_reference_release(r);
  return status;
}
