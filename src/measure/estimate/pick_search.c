/* Finds the cheapest row of each method within the wanted error, by as few runs as its order allows. */
#include "measure/limit/limit_predict.h"
#include "measure/estimate/pick.h"
#include "measure/estimate/soundness.h"
#include "measure/spectrum/step_bound.h"

#include "core/clock.h"
#include "core/status.h"
#include "integrate/method.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { MOST_RUNS = 12, REPEATS = 3, MOST_METHODS = 32 };
static const double LOOSEST = 0.1, TIGHTEST = 1e-14;
static const double AIM = 0.7, GOOD = 0.5; /* of the allowed error: target; good enough */
static const double CLOSE = 1.2;           /* a narrower bracket is not searched further */
static const double LEAST_FACTOR = 1.0 / 64.0, MOST_FACTOR = 8.0; /* factors from one value to the next */
static const double LOOSER = 10.0;                                /* after a tolerance that took too long */
static const double COST_POWER = 1.0 / 2.0; /* cost of a run in its tolerance, at most */
static const double PATIENCE = 1.3; /* times the best row's time: maximum for a run that might be cheaper */
static const double SHORT = 5e-3;   /* [s] a shorter run is repeated for its time */
static const double MOMENT = 0.05;  /* [s] minimum allowance of a run: a short one may hit a busy machine */
static const double MOST_STEPS = 1e8;
static const double SHARE_OF_LIMITS = 0.5; /* of the remaining time, at most for the limits of one row */
static const double SHARE_OF_REFERENCE =
    0.2; /* approximate time of a run, as a fraction of the reference's */

/* A run in the search. */
struct result {
  double value, error, rms, seconds; /* the errors NaN: it did not finish */
  double allowed; /* a value clear of the stability limit at all frames; infinity: this one is */
  int32_t gains;  /* spontaneous rise of energy */
};

struct search {
  struct hk_pick *pick;
  const char *method;
  int32_t adaptive;
  double order;        /* of the error, in the value */
  double most;         /* allowed error [m] */
  double bound;        /* limit of the step at the start [s]; infinity if none */
  double largest;      /* largest allowed value */
  double first;        /* first value */
  int32_t raised;      /* that is no longer to be raised from the bound to the limit at the start */
  double meets, fails; /* coarsest value that meets the want, finest coarser one that does not */
  double error_meets, error_fails;
  double rate;  /* minimum time of an evaluation of forces or of their derivative, over all runs [s] */
  double until; /* deadline of a run that costs too much, wall-clock time [s] */
  int32_t late, runs, over;
  struct result last;
};

struct looker {
  struct search *search;
  struct hk_soundness soundness;
  double step;
  int32_t status;
};

static int32_t on_progress(double share, void *ctx) {
  struct search *s = ((struct looker *)ctx)->search;
  const struct hk_pick *pick = s->pick;
  const double now = hk_clock_seconds();
  (void)share;
  const double done = (now - pick->begun) / (pick->deadline - pick->begun);
  const int32_t value = pick->progress ? pick->progress(fmin(done, 0.99), s->method, pick->ctx) : 0;
  if (value != 0) return value;
  s->late = now > s->until;
  return s->late;
}

/* Time for the limits of one row [s]. */
static double time_for_limits(const struct hk_pick *pick) {
  return SHARE_OF_LIMITS * (pick->deadline - hk_clock_seconds());
}

static int32_t on_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  struct looker *looker = ctx;
  struct search *s = looker->search;
  const struct hk_frames *frames = &s->pick->reference.frames;
  (void)step;
  if (frame == 0)
    looker->status = hk_soundness_begin(&looker->soundness, frames->system, s->method, looker->step,
                                        time_for_limits(s->pick), state, frames->count);
  if (looker->status != HOOKE_OK) return 1;
  const double patience = looker->soundness.patience;
  hk_soundness_see(&looker->soundness, state);
  s->until += patience - looker->soundness.patience; /* computing limits does not count as part of the run */
  return 0;
}

static int32_t run_row(struct search *s, double value, struct result *result) {
  const struct hk_reference *r = &s->pick->reference;
  struct looker looker = {.search = s, .step = s->adaptive ? NAN : value};
  const struct hk_listener listener = {.on_progress = on_progress, .on_frame = on_frame, .ctx = &looker};
  struct hk_trial trial = {.status = NULL};
  hooke_options *options = NULL;
  s->late = 0;
  int32_t status = hk_pick_options(s->pick->run, s->method, value, &options);
  if (status == HOOKE_OK) status = hk_trial_create(&r->frames, &trial);
  if (status == HOOKE_OK) status = hk_trial_run(&trial, &r->frames, r->trusted, options, &listener);
  *result = (struct result){
      .value = value, .error = trial.error_max, .rms = trial.error, .seconds = trial.wall_seconds};
  const double work = trial.force_evaluations + fmax(0.0, trial.linear_iterations);
  for (int k = 1; k < REPEATS && status == HOOKE_OK && result->seconds < SHORT && !isnan(trial.error); k++) {
    looker.soundness.count = looker.soundness.capacity; /* already recorded */
    const struct hk_listener quiet = {.on_progress = on_progress, .ctx = &looker};
    status = hk_trial_run(&trial, &r->frames, r->trusted, options, &quiet);
    result->seconds = fmin(result->seconds, trial.wall_seconds);
  }
  /* the run itself may have hit a busy machine */
  s->rate = fmin(s->rate, result->seconds / work);
  result->seconds = work * s->rate;
  s->pick->evaluation = fmin(s->pick->evaluation, s->rate);
  if (looker.soundness.time) {
    result->allowed = hk_soundness_limit_share * looker.soundness.least_limit;
    result->gains = hk_soundness_rise(&looker.soundness) > hk_soundness_most_rise;
  }
  hk_soundness_release(&looker.soundness);
  hk_trial_release(&trial);
  hooke_options_destroy(options);
  return looker.status != HOOKE_OK ? looker.status : status;
}

/* ---- from one run to the next ---- */

static double fit(const struct search *s, double value) {
  if (s->adaptive) return fmin(LOOSEST, fmax(TIGHTEST, value));
  return s->pick->unit / fmax(1.0, ceil(s->pick->unit / value * (1.0 - 1e-12)));
}

/* 1 if the row is the best so far: the cheapest within the want, or while there is none the closest to it. */
static int beats(const struct search *s, const struct result *result, int32_t meets) {
  const struct hk_pick *pick = s->pick;
  if (pick->best.method == NULL || meets != pick->met) return meets || !pick->met;
  return meets ? result->seconds < pick->best.seconds : result->error < pick->best.error;
}

static void learn(struct search *s, const struct result *result) {
  const int32_t sound = !isnan(result->error) && isinf(result->allowed) && !result->gains;
  const int32_t meets = sound && s->pick->reference.trusted > 1 && result->error <= s->most;
  if (sound && beats(s, result, meets)) {
    s->pick->best =
        (struct hk_pick_row){s->method, result->value, result->error, result->rms, result->seconds};
    s->pick->met = meets;
  }
  if (meets && !(result->value <= s->meets)) {
    s->meets = result->value;
    s->error_meets = result->error;
  } else if (!meets && !(result->value >= s->fails)) {
    s->fails = result->value;
    s->error_fails = sound ? result->error : NAN;
  }
  if (s->fails <= s->meets) s->fails = NAN; /* a coarser row that meets the want wins over a finer one */
  if (result->allowed < s->largest) s->largest = result->allowed;
  if (!sound && result->gains) s->largest = fmin(s->largest, 0.5 * result->value);
}

/* Value at which the error should be right, by the order, or by the slope between two runs. */
static double aim(const struct search *s) {
  const double from = isnan(s->meets) ? s->fails : s->meets;
  const double error = isnan(s->meets) ? s->error_fails : s->error_meets;
  double slope = s->order;
  if (isnan(error)) return s->largest < from ? s->largest : 0.5 * from;
  if (!isnan(s->meets) && s->error_fails > s->error_meets && s->error_meets > 0.0)
    slope = log(s->error_fails / s->error_meets) / log(s->fails / s->meets);
  const double factor = pow(AIM * s->most / error, 1.0 / fmax(slope, 0.3));
  return from * fmin(MOST_FACTOR, fmax(LEAST_FACTOR, factor));
}

/* Next value to run; NaN at the end of the search. */
static double next_value(const struct search *s) {
  if (isnan(s->meets) && isnan(s->fails)) return fit(s, s->first);
  if (!isnan(s->meets) && (s->error_meets >= GOOD * s->most || s->fails / s->meets <= CLOSE)) return NAN;
  double value = aim(s);
  if (!isnan(s->meets) && !isnan(s->fails)) /* within the bracket, and clear of its ends */
    value = fmin(s->fails / CLOSE, fmax(s->meets * CLOSE, value));
  value = fit(s, fmin(value, s->largest));
  if (value <= s->meets * (1.0 + 1e-9) || value >= s->fails * (1.0 - 1e-9)) return NAN;
  return value;
}

/* Minimum time of the first run, approximate time of the others [s]. */
static double cost_of(const struct search *s, const struct result *last, double value) {
  if (last->seconds > 0.0) return last->seconds * pow(last->value / value, s->adaptive ? COST_POWER : 1.0);
  return s->adaptive ? 0.0 : s->pick->evaluation * s->pick->share * s->pick->duration / value;
}

/* If the bound makes the step finer than the error requires, uses the limit at the start instead. */
static void raise_largest(struct search *s) {
  const double *q = s->pick->reference.frames.position;
  const double seconds = time_for_limits(s->pick);
  double limit = s->bound;
  if (s->adaptive || s->raised || !(seconds > 0.0) || s->largest < hk_soundness_limit_share * s->bound)
    return;
  s->raised = 1;
  struct hk_patience patience = hk_patience_of(seconds, NULL, NULL);
  if (hk_limit_sure(s->pick->system, q, NULL, s->method, &patience, &limit) == HOOKE_OK)
    s->largest = fmin(s->pick->unit, hk_soundness_limit_share * limit);
}

/* The bound on the step at the start, and the largest allowed value; that is below the bound where steps that
 * solve nothing are cheaper, as verlet's with bodies always are. */
static int32_t find_largest(struct search *s) {
  const double *q = s->pick->reference.frames.position;
  s->bound = INFINITY;
  if (!s->adaptive) (void)hooke_step_bound(s->pick->system, s->method, q, &s->bound);
  if (isnan(s->bound)) s->bound = INFINITY;
  s->largest = s->adaptive ? LOOSEST : fmin(s->pick->unit, hk_soundness_limit_share * s->bound);
  const double before = s->largest;
  const int32_t solves = !s->adaptive && s->pick->system->bodies.moving == 0;
  const int32_t status = solves ? hk_step_cheapest(s->pick->system, s->method, &s->largest) : HOOKE_OK;
  s->raised = s->largest < before;
  return status;
}

static int32_t begin(struct hk_pick *pick, const char *method, struct search *s) {
  *s = (struct search){.pick = pick,
                       .method = method,
                       .adaptive = hooke_method_is_adaptive(method),
                       .most = pick->want * pick->share - pick->reference.agreement,
                       .meets = NAN,
                       .fails = NAN,
                       .error_meets = NAN,
                       .error_fails = NAN,
                       .rate = INFINITY,
                       .until = INFINITY};
  s->order = s->adaptive ? 1.0 : (double)hk_method_find(method)->order;
  const int32_t status = find_largest(s);
  s->first = s->adaptive ? s->most / pick->reference.extent : s->largest;
  return status;
}

/* Runs one row. */
static int32_t try_value(struct search *s, double value) {
  const int32_t status = run_row(s, value, &s->last);
  if (status == HOOKE_OK) learn(s, &s->last);
  if (s->error_meets < GOOD * s->most && isnan(s->fails)) raise_largest(s);
  s->runs++;
  return status;
}

/* Approximate time of the next run [s]; infinity at the end of the search of this method. */
static double promise(const struct search *s, double *value) {
  const struct hk_pick *pick = s->pick;
  *value = s->over || s->runs == MOST_RUNS ? NAN : next_value(s);
  if (isnan(*value) || (!s->adaptive && pick->duration / *value > MOST_STEPS)) return INFINITY;
  if (s->runs > 0) return cost_of(s, &s->last, *value);
  if (s->adaptive || isinf(s->bound)) return SHARE_OF_REFERENCE * pick->reference.wall_seconds;
  return s->order * s->order * cost_of(s, &s->last, *value);
}

/* 1 if a looser tolerance may be quick enough where the first one was not. */
static int32_t loosen(struct search *s, double value) {
  if (!s->adaptive || !isnan(s->meets) || !isnan(s->fails) || value >= LOOSEST) return 0;
  s->first = LOOSER * value;
  return 1;
}

/* Does the next run of a method, unless it cannot become the cheapest, or there is no time. */
static int32_t advance(struct search *s, double value) {
  const struct hk_pick *pick = s->pick;
  const double now = hk_clock_seconds(), cost = cost_of(s, &s->last, value);
  s->over = (pick->met && cost > pick->best.seconds) || (pick->best.method && now + cost > pick->deadline);
  if (s->over) return HOOKE_OK;
  /* a first row is found in any case */
  s->until = pick->best.method ? fmax(pick->deadline, now + PATIENCE * pick->best.seconds) : INFINITY;
  if (pick->met) s->until = fmin(s->until, now + MOMENT + PATIENCE * pick->best.seconds);
  const int32_t status = try_value(s, value);
  if (status != HOOKE_STOPPED || !s->late) return status;
  s->over = !loosen(s, value);
  return HOOKE_OK;
}

/* Chooses the method whose next run promises to be the quickest. */
static int32_t search_all(int32_t count, struct search *all) {
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK) {
    double least = INFINITY, value = NAN, next;
    struct search *best = NULL;
    for (int32_t k = 0; k < count; k++) {
      const double seconds = promise(&all[k], &next);
      if (!(seconds < least)) continue;
      least = seconds;
      value = next;
      best = &all[k];
    }
    if (best == NULL) break;
    status = advance(best, value);
  }
  return status;
}

int32_t hk_pick_search(struct hk_pick *pick) {
  struct search all[MOST_METHODS];
  int32_t count = 0, status = HOOKE_OK;
  for (int64_t m = 0; m < hooke_method_count() && count < MOST_METHODS && status == HOOKE_OK; m++) {
    const char *method = hooke_method_name(m);
    if (pick->method ? strcmp(method, pick->method) != 0 : !hooke_method_is_built(method)) continue;
    if (!hk_method_suits(method, pick->system)) continue;
    status = begin(pick, method, &all[count]);
    count += all[count].largest > 0.0;
  }
  if (status == HOOKE_OK) status = search_all(count, all);
  if (status != HOOKE_OK || pick->met || pick->method) return status;
  /* the reference itself meets any want that it can judge */
  struct search last;
  status = begin(pick, pick->reference.method, &last);
  if (status == HOOKE_OK) status = try_value(&last, pick->reference.rtol);
  if (pick->best.method == NULL) /* nothing after the start can be judged */
    pick->best =
        (struct hk_pick_row){pick->reference.method, pick->reference.rtol, NAN, NAN, last.last.seconds};
  return status;
}
