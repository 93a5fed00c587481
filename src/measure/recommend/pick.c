#include "measure/recommend/pick.h"

#include "core/print.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "measure/counted_work/work.h"
#include "measure/limit/explicit_step.h"
#include "measure/limit/limit_predict.h"
#include "measure/recommend/soundness.h"
#include "measure/spectrum/step_bound.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* All in counted work: at least so much [s], and so many times the picked run, the run itself once more among
 * them. */
static const double LEAST_WORK = 1.8, RUNS = 9.0;
static const double REFERENCE_RUNS = 5.0, REFERENCE_SHARE = 0.75; /* of it, at most for the reference */
static const double QUICK = 0.5,
                    SLOWER = 4.0; /* of LEAST_WORK / RUNS: first cap of quick runs; to the next */
static const double QUICK_TOLERANCE = 1e-2;
static const double DIGITS = 0.02;          /* of the wanted error: accuracy of the reference */
static const double FRAMES_BYTES = 1 << 24; /* beyond MANY_FRAMES */
static const double BEGINNING = 0.1;        /* duration studied if the reference reached no frame */
static const double LONGER = 4.0;           /* from one budget to the next while it came to nothing */
static const double LIMITS_SHARE = 0.1;     /* of LEAST_WORK, for the limit of bodies at the start */
static const double REVERSED = 2.0;         /* ratio of times that is worth telling */
enum { FEWEST_FRAMES = 25, MOST_FRAMES = 1000, MANY_FRAMES = 100, MOST_BUDGETS = 2 };

/* Counted work that all of it may take, as far as that is known [s]. */
static double most_work_of(const struct hk_pick *pick) {
  return fmax(LEAST_WORK, RUNS * (pick->met ? pick->best.work : pick->quickest));
}

static int32_t allows(const struct hk_pick *pick, const char *method) {
  int32_t allowed = pick->method_count == 0;
  for (int32_t k = 0; k < pick->method_count; k++)
    allowed |= strcmp(method, pick->methods[k]) == 0;
  return allowed && hooke_method_is_built(method) && hk_method_suits(method, pick->system);
}

/* ---- the studied duration ---- */

/* A number of frames between FEWEST_FRAMES and MOST_FRAMES, such that the steps that fit the run fit them,
 * too. The last frame comes sooner where no such number divides the run. */
static int32_t choose_frames(struct hk_pick *pick) {
  double every, unit;
  int32_t status = hk_step_times(pick->run, &pick->duration, &every);
  if (status == HOOKE_OK) status = hk_step_unit(pick->duration, every, &unit);
  if (status != HOOKE_OK) return status;
  const double units = round(pick->duration / unit);
  const double bytes = 3.0 * (double)pick->system->particle_count * sizeof(double);
  const double most =
      pick->wants->whole ? MOST_FRAMES : fmax(MANY_FRAMES, fmin(MOST_FRAMES, FRAMES_BYTES / bytes));
  const double least = ceil(units / most);
  double apart = least;
  while (fmod(units, apart) != 0.0 && units / apart >= FEWEST_FRAMES)
    apart++;
  if (units / apart < FEWEST_FRAMES) apart = least;
  const double parts = ceil(FEWEST_FRAMES * apart / units);
  every = parts > 1.0 ? apart * unit / parts : apart * unit;
  pick->unit = fmin(unit, every);
  return hooke_options_set_number(pick->run, "every", every);
}

/* ---- the quickest run ---- */

/* The largest step of a method that is to be tried [s], of which `bound` is certain to be stable at the
 * start: infinity if nothing limits it. */
static int32_t largest_step(struct hk_pick *pick, const char *method, const double *q, double *bound,
                            double *largest) {
  *bound = INFINITY;
  int32_t status = hooke_step_bound(pick->system, method, q, bound);
  if (status == HOOKE_OK && isnan(*bound) && !pick->system->generalized && hk_step_is_bounded(method)) {
    struct hk_budget budget = hk_budget_of_work(LIMITS_SHARE * LEAST_WORK, NULL, NULL);
    double limit = 0.0;
    status = hk_limit_sure(pick->system, q, NULL, method, &budget, &limit);
    pick->work += budget.work;
    if (limit > 0.0) *bound = limit;
  }
  if (isnan(*bound)) *bound = INFINITY;
  *largest = fmin(pick->unit, hk_soundness_limit_share * *bound);
  return status;
}

static int32_t tell_quickest(double fraction, void *ctx) {
  const struct hk_pick *pick = ctx;
  (void)fraction;
  return pick->progress ? pick->progress(0.0, "quick runs", pick->ctx) : 0;
}

/* Lowers the work of the quickest run to that of a method, if it comes to the end with at most `most`. */
static int32_t try_quick(struct hk_pick *pick, const char *method, double most) {
  const int adaptive = hooke_method_is_adaptive(method);
  const struct hk_listener listener = {.on_progress = tell_quickest, .most_work = most, .ctx = pick};
  struct hk_run_cost cost = {.work = 0.0};
  struct hk_frames none = {.system = pick->system};
  hooke_options *options = NULL;
  if (!allows(pick, method)) return HOOKE_OK;
  int32_t status = hk_pick_options(pick->run, method, adaptive ? QUICK_TOLERANCE : pick->unit, &options);
  if (status == HOOKE_OK) status = hk_frames_run(&none, options, &listener, &cost);
  hooke_options_destroy(options);
  pick->work += cost.work;
  if (status == HOOKE_OK) pick->quickest = fmin(pick->quickest, cost.work);
  return cost.too_long || hk_trial_gave_up(status) ? HOOKE_OK : status;
}

/* Explicit Euler at its largest step; in stiff and overdamped scenes methods that solve for a step may need
 * far less, which is found by letting them work for longer and longer. */
static int32_t find_quickest(struct hk_pick *pick) {
  static const char *const solving[] = {"cvode-bdf", "tr-bdf2"};
  const char *euler = hk_method_of_euler(pick->system);
  hooke_state *state = NULL;
  double bound, step = 0.0;
  int32_t status = hooke_state_create(pick->system, &state);
  if (status == HOOKE_OK) status = largest_step(pick, euler, hooke_state_position(state), &bound, &step);
  hooke_state_destroy(state);
  if (status != HOOKE_OK) return status;
  if (!(step > 0.0)) step = pick->unit;
  const double steps = ceil(pick->duration / step);
  pick->quickest = fmax(1.0, steps) * hk_work_of_evaluation(pick->system);
  for (double most = QUICK * LEAST_WORK / RUNS; most * SLOWER < pick->quickest && status == HOOKE_OK;
       most *= SLOWER)
    for (size_t k = 0; k < sizeof solving / sizeof solving[0] && status == HOOKE_OK; k++)
      status = try_quick(pick, solving[k], most);
  return status;
}

/* ---- the reference ---- */

static int32_t tell_reference(double fraction, void *ctx) {
  const struct hk_pick *pick = ctx;
  return pick->progress ? pick->progress(REFERENCE_SHARE * fraction, "reference", pick->ctx) : 0;
}

static int32_t make_reference(struct hk_pick *pick, double budget) {
  const struct hk_listener listener = {.on_progress = tell_reference, .ctx = pick};
  const double duration = hooke_options_number(pick->run, "duration");
  const double every = hooke_options_number(pick->run, "every");
  const struct hk_reference_request request = {.run = pick->run,
                                               .frame_count = hk_schedule_frames(duration, every),
                                               .digits = DIGITS * pick->want * pick->wants->length,
                                               .wants = pick->wants,
                                               .watched = pick->wants->list,
                                               .enough = 1,
                                               .counted = 1,
                                               .budget = budget,
                                               .listener = &listener};
  const int32_t status = hk_reference_create(pick->system, &request, &pick->reference);
  pick->work += status == HOOKE_OK ? pick->reference.work : budget;
  return status;
}

/* Shorter runs have the tolerances of the whole one. */
static int32_t set_duration(struct hk_pick *pick, double duration) {
  const int32_t status = hk_run_fill_tolerances(pick->system, pick->run);
  pick->fraction = duration / pick->duration;
  return status == HOOKE_OK ? hooke_options_set_number(pick->run, "duration", duration) : status;
}

/* Limits the studied duration to the frames of the reference, if its budget was short. */
static int32_t shorten(struct hk_pick *pick) {
  const struct hk_reference *r = &pick->reference;
  if (!r->hurried || r->trusted >= r->frames.count || r->trusted < 2) return HOOKE_OK;
  return set_duration(pick, r->frames.time[r->trusted - 1] - r->frames.time[0]);
}

/* A reference, by a larger budget if one is too small for a single frame. */
static int32_t insist(struct hk_pick *pick, double budget) {
  int32_t status = make_reference(pick, budget);
  for (int k = 1; k < MOST_BUDGETS && status == HOOKE_BAD_VALUE; k++) {
    hk_reference_release(&pick->reference);
    status = make_reference(pick, budget *= LONGER);
  }
  return status;
}

/* Covers the whole run; if not even its second frame is reached, a beginning with closer frames. */
static int32_t find_reference(struct hk_pick *pick) {
  const double budget = fmax(REFERENCE_SHARE * LEAST_WORK, REFERENCE_RUNS * pick->quickest);
  int32_t status = make_reference(pick, budget);
  if (status == HOOKE_OK && (pick->reference.trusted > 1 || !pick->reference.hurried)) return shorten(pick);
  if (status != HOOKE_OK && status != HOOKE_BAD_VALUE) return status;
  hk_reference_release(&pick->reference);
  const double units = ceil(BEGINNING * round(pick->duration / pick->unit));
  status = hooke_options_set_number(pick->run, "every", pick->unit);
  if (status == HOOKE_OK) status = set_duration(pick, units * pick->unit);
  if (status == HOOKE_OK) status = insist(pick, budget);
  return status == HOOKE_OK ? shorten(pick) : status;
}

/* ---- what others take of it ---- */

int32_t hk_pick_options(const hooke_options *run, const char *method, double value, hooke_options **out) {
  const int32_t status = hooke_options_copy(run, out);
  return status == HOOKE_OK ? hk_trial_set_value(*out, method, value) : status;
}

double hk_pick_trusted(const struct hk_pick *pick) {
  const struct hk_reference *r = &pick->reference;
  if (r->trusted == r->frames.count) return pick->fraction * pick->duration;
  return r->trusted > 0 ? r->frames.time[r->trusted - 1] - r->frames.time[0] : 0.0;
}

void hk_pick_say_reversal(const struct hk_pick *pick, char *text, int32_t size) {
  const struct hk_pick_row *best = &pick->best, *second = &pick->second;
  text[0] = '\0';
  if (!pick->met || second->method == NULL || !(best->wall_seconds > REVERSED * second->wall_seconds)) return;
  hk_print(text, (size_t)size,
           "by counted work; on this machine, as measured once, %s took %.3g s and %s %.3g s", best->method,
           best->wall_seconds, second->method, second->wall_seconds);
}

/* ---- the search ---- */

/* It finds the cheapest row of each method within the wanted error, by as few runs as its order allows, and
 * confirms the cheapest of all from a displaced start. */
enum { MOST_RUNS = 12, MOST_METHODS = 32, MOST_DOUBTS = 6 };
static const double LOOSEST = 0.1, TIGHTEST = 1e-14;
static const double AIM = 0.85, GOOD = 0.75; /* of the allowed error: target; good enough */
static const double CLOSE = 1.1;             /* a narrower bracket is not searched further */
static const double LEAST_FACTOR = 1.0 / 64.0, MOST_FACTOR = 8.0; /* factors from one value to the next */
static const double LOOSER = 10.0;                                /* after a tolerance that took too long */
static const double COST_POWER = 1.0 / 2.0; /* cost of a run in its tolerance, at most */
static const double ALIKE = 1.2;            /* costs within that are alike */
static const double SPARE = 1.3;            /* of a run that might be cheaper, over the best one's work */
static const double MOST_STEPS = 1e8;
static const double SHARE_OF_LIMITS = 0.25; /* of the work that is left, at most for the limits of one row */
static const double SHARE_OF_REFERENCE =
    0.2;                                 /* approximate work of a run, as a fraction of the reference's */
static const double DISPLACEMENT = 10.0; /* of the start, in halves of a unit in the last place */
static const uint64_t SEED = 1;          /* of that */

/* A run in the search. */
struct result {
  struct hk_pick_row row; /* the errors NaN: it did not finish */
  double allowed;         /* a value clear of the stability limit at all frames; infinity: this one is */
  int32_t gains;          /* spontaneous rise of energy */
  int32_t unknown; /* 1: that limit is not known at some state, so that nobody knows whether it is sound */
  int32_t late;    /* its work was too much */
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
  int32_t runs, over;
  struct hk_pick_row best; /* the cheapest that meets the want, or else the closest to it */
  int32_t met;
  struct result last;
};

static double work_left(const struct hk_pick *pick) {
  const double confirming = pick->met ? pick->best.work : pick->quickest;
  return most_work_of(pick) - pick->work - confirming;
}

/* ---- one run ---- */

struct looker {
  const struct search *search;
  struct hk_soundness soundness;
  const char *limited_as;
  double step, displacement;
  int32_t status;
};

static int32_t on_progress(double fraction, void *ctx) {
  const struct search *s = ((struct looker *)ctx)->search;
  const struct hk_pick *pick = s->pick;
  (void)fraction;
  const double done = pick->work / most_work_of(pick);
  return pick->progress ? pick->progress(fmin(done, 0.99), s->method, pick->ctx) : 0;
}

static void on_start(hooke_state *state, void *ctx) {
  const struct looker *looker = ctx;
  uint64_t random = SEED;
  if (looker->displacement > 0.0)
    hk_displace(state, looker->search->pick->system, looker->displacement, &random);
}

static int32_t on_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  struct looker *looker = ctx;
  const struct hk_frames *frames = &looker->search->pick->reference.frames;
  (void)step;
  if (frame == 0)
    looker->status = hk_soundness_begin(&looker->soundness, frames->system, looker->limited_as, looker->step,
                                        state, frames->count);
  if (looker->status != HOOKE_OK) return 1;
  hk_soundness_see(&looker->soundness, state);
  return 0;
}

/* Judges the step and the energy of a run. */
static int32_t judge(struct search *s, struct hk_soundness *soundness, struct result *result) {
  struct hk_budget budget = hk_budget_of_work(SHARE_OF_LIMITS * fmax(0.0, work_left(s->pick)), NULL, NULL);
  if (isnan(result->row.error)) soundness->at[1].bound = INFINITY; /* nothing is sure of where it went */
  const int32_t status = hk_soundness_find_limits(soundness, &budget);
  s->pick->work += hk_soundness_work(soundness) + budget.work;
  result->allowed = hk_soundness_limit_share * soundness->least_limit;
  result->unknown = soundness->unknown_limit;
  result->gains = hk_soundness_rise(soundness) > hk_soundness_most_rise;
  return status;
}

/* Runs from the start, or from one displaced by `displacement` [m]. */
static int32_t run_row(struct search *s, double value, double displacement, double most_work,
                       struct result *result) {
  const struct hk_reference *r = &s->pick->reference;
  struct looker looker = {.search = s, .step = s->adaptive ? NAN : value, .displacement = displacement};
  const struct hk_listener listener = {.on_progress = on_progress,
                                       .on_frame = on_frame,
                                       .on_start = on_start,
                                       .most_work = most_work,
                                       .ctx = &looker};
  struct hk_trial trial = {.status = NULL};
  hooke_options *options = NULL;
  int32_t status = hk_pick_options(s->pick->run, s->method, value, &options);
  if (status == HOOKE_OK) status = hooke_step_settle(s->pick->system, options);
  if (status == HOOKE_OK) looker.limited_as = hk_step_limited_as(s->pick->system, options);
  if (status == HOOKE_OK) status = hk_trial_run(&trial, &r->frames, r->trusted, options, &listener);
  if (looker.status != HOOKE_OK) status = looker.status;
  s->pick->work += trial.work;
  *result =
      (struct result){.row = {s->method, value, trial.wanted, trial.error, trial.work, trial.wall_seconds},
                      .late = trial.status && strcmp(trial.status, "stopped") == 0};
  if (status == HOOKE_OK && looker.soundness.time) status = judge(s, &looker.soundness, result);
  hk_soundness_release(&looker.soundness);
  hk_trial_release(&trial);
  hooke_options_destroy(options);
  return status;
}

/* ---- from one run to the next ---- */

static double fit(const struct search *s, double value) {
  if (s->adaptive) return fmin(LOOSEST, fmax(TIGHTEST, value));
  return s->pick->unit / fmax(1.0, ceil(s->pick->unit / value * (1.0 - 1e-12)));
}

/* 1 if the row is the best of its method: the cheapest within the want, or while there is none the closest to
 * it. */
static int beats(const struct search *s, const struct result *result, int32_t meets) {
  if (s->best.method == NULL || meets != s->met) return meets || !s->met;
  return meets ? result->row.work < s->best.work : result->row.error < s->best.error;
}

static int32_t is_sound(const struct result *result) {
  return !isnan(result->row.error) && isinf(result->allowed) && !result->gains;
}

static void learn(struct search *s, const struct result *result) {
  const int32_t sound = is_sound(result);
  const int32_t meets =
      sound && !result->unknown && s->pick->reference.trusted > 1 && result->row.error <= s->most;
  if (sound && beats(s, result, meets)) {
    s->best = result->row;
    s->met = meets;
  }
  if (meets && !(result->row.value <= s->meets)) {
    s->meets = result->row.value;
    s->error_meets = result->row.error;
  } else if (!meets && !(result->row.value >= s->fails)) {
    s->fails = result->row.value;
    s->error_fails = sound ? result->row.error : NAN;
  }
  if (s->fails <= s->meets) s->fails = NAN; /* a coarser row that meets the want wins over a finer one */
  if (result->allowed < s->largest) s->largest = result->allowed;
  if (!sound && result->gains) s->largest = fmin(s->largest, 0.5 * result->row.value);
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

/* The next coarser step that fits, if by the order of the method it meets the want; else NaN. */
static double coarser_step(const struct search *s) {
  const double parts = round(s->pick->unit / s->meets) - 1.0, value = s->pick->unit / fmax(1.0, parts);
  if (s->adaptive || parts < 1.0 || value > s->largest) return NAN;
  return s->error_meets * pow(value / s->meets, s->order) <= s->most ? value : NAN;
}

/* Next value to run; NaN at the end of the search. */
static double next_value(const struct search *s) {
  if (isnan(s->meets) && isnan(s->fails)) return fit(s, s->first);
  if (!isnan(s->meets) && (s->error_meets >= GOOD * s->most || s->fails / s->meets <= CLOSE)) return NAN;
  double value = aim(s);
  if (!isnan(s->meets) && !isnan(s->fails)) /* within the bracket, and clear of its ends */
    value = fmin(s->fails / CLOSE, fmax(s->meets * CLOSE, value));
  value = fit(s, fmin(value, s->largest));
  if (value <= s->meets * (1.0 + 1e-9)) value = coarser_step(s);
  if (isnan(value) || value <= s->meets * (1.0 + 1e-9) || value >= s->fails * (1.0 - 1e-9)) return NAN;
  return value;
}

/* Work of the first run where it is known, approximate work of the others [s]. */
static double cost_of(const struct search *s, double value) {
  const struct hk_pick *pick = s->pick;
  if (s->last.row.work > 0.0)
    return s->last.row.work * pow(s->last.row.value / value, s->adaptive ? COST_POWER : 1.0);
  const double steps = ceil(pick->fraction * pick->duration / value);
  const double work = s->adaptive ? NAN : hk_work_of_steps(pick->system, s->method, (int64_t)steps);
  return isnan(work) ? 0.0 : work;
}

/* If the bound makes the step finer than the error requires, uses the limit at the start instead. */
static int32_t raise_largest(struct search *s) {
  const double *q = s->pick->reference.frames.position;
  double limit = s->bound;
  if (s->adaptive || s->raised || s->largest < hk_soundness_limit_share * s->bound) return HOOKE_OK;
  s->raised = 1;
  struct hk_budget budget = hk_budget_of_work(SHARE_OF_LIMITS * fmax(0.0, work_left(s->pick)), NULL, NULL);
  const int32_t status = hk_limit_sure(s->pick->system, q, NULL, s->method, &budget, &limit);
  s->pick->work += budget.work;
  if (status == HOOKE_OK) s->largest = fmin(s->pick->unit, hk_soundness_limit_share * limit);
  return status;
}

/* The largest allowed value, which is below the bound where steps that solve nothing are cheaper, as verlet's
 * with bodies always are. */
static int32_t find_largest(struct search *s) {
  const double *q = s->pick->reference.frames.position;
  s->bound = INFINITY;
  s->largest = LOOSEST;
  if (s->adaptive) return HOOKE_OK;
  int32_t status = largest_step(s->pick, s->method, q, &s->bound, &s->largest);
  const double before = s->largest;
  if (status == HOOKE_OK && s->pick->system->mover_count == 0)
    status = hk_step_cheapest(s->pick->system, s->method, &s->largest);
  s->raised = s->largest < before;
  return status;
}

static int32_t begin(struct hk_pick *pick, const char *method, struct search *s) {
  *s = (struct search){.pick = pick,
                       .method = method,
                       .adaptive = hooke_method_is_adaptive(method),
                       .most = pick->want * pick->fraction - pick->reference.wanted_agreement,
                       .meets = NAN,
                       .fails = NAN,
                       .error_meets = NAN,
                       .error_fails = NAN};
  s->order = s->adaptive ? 1.0 : (double)hk_method_find(method)->order;
  const int32_t status = find_largest(s);
  s->first = s->adaptive ? s->most * pick->wants->length / pick->reference.extent : s->largest;
  return status;
}

/* ---- all methods ---- */

/* The best row of all: the cheapest that meets the want, of those alike the first method's; else the closest.
 * `second`, if it is not NULL: the cheapest by another method. */
static struct search *choose(int32_t count, struct search *all, struct search **second) {
  struct search *best = NULL, *next = NULL;
  double least = INFINITY;
  for (int32_t k = 0; k < count; k++)
    if (all[k].met) least = fmin(least, all[k].best.work);
  for (int32_t k = 0; k < count; k++) {
    struct search *s = &all[k];
    if (s->best.method == NULL || (isfinite(least) && !s->met)) continue;
    if (isfinite(least) ? best == NULL && s->best.work <= ALIKE * least
                        : best == NULL || s->best.error < best->best.error)
      best = s;
  }
  for (int32_t k = 0; k < count; k++) {
    struct search *s = &all[k];
    if (s->met && s != best && (next == NULL || s->best.work < next->best.work)) next = s;
  }
  if (second) *second = next;
  return best;
}

static void keep_best(struct hk_pick *pick, int32_t count, struct search *all) {
  struct search *second;
  const struct search *best = choose(count, all, &second);
  if (best == NULL) return;
  pick->best = best->best;
  pick->met = best->met;
  pick->second = second ? second->best : (struct hk_pick_row){.method = NULL};
}

/* Approximate work of the next run [s]; infinity at the end of the search of this method. */
static double promise(const struct search *s, double *value) {
  const struct hk_pick *pick = s->pick;
  *value = s->over || s->runs == MOST_RUNS ? NAN : next_value(s);
  if (isnan(*value) || (!s->adaptive && pick->duration / *value > MOST_STEPS)) return INFINITY;
  const double cost = cost_of(s, *value);
  if (s->runs > 0) return cost;
  return cost > 0.0 ? s->order * s->order * cost : SHARE_OF_REFERENCE * pick->reference.run_work;
}

/* 1 if a looser tolerance may be quick enough where the first one was not. */
static int32_t loosen(struct search *s, double value) {
  if (!s->adaptive || !isnan(s->meets) || !isnan(s->fails) || value >= LOOSEST) return 0;
  s->first = LOOSER * value;
  return 1;
}

/* Runs one row, with at most so much work. */
static int32_t try_value(struct search *s, double value, double most_work) {
  int32_t status = run_row(s, value, 0.0, most_work, &s->last);
  s->runs++;
  if (status != HOOKE_OK) return status;
  if (s->last.late) {
    s->over = !loosen(s, value);
    return HOOKE_OK;
  }
  learn(s, &s->last);
  s->over |= s->last.unknown && s->last.row.error <= s->most; /* no finer one is known any better */
  if (s->error_meets < GOOD * s->most && isnan(s->fails)) status = raise_largest(s);
  return status;
}

/* Does the next run of a method, unless it cannot become the cheapest, or too little work is left. */
static int32_t advance(struct search *s, double value) {
  const struct hk_pick *pick = s->pick;
  const double cost = cost_of(s, value), left = work_left(pick);
  const double useful = pick->fraction * pick->most;
  s->over =
      (pick->met && cost > ALIKE * pick->best.work) || (pick->best.method && cost > left) || cost > useful;
  if (s->over) return HOOKE_OK;
  /* a first row is found in any case */
  double most = pick->best.method ? fmin(useful, fmax(left, SPARE * pick->best.work)) : useful;
  if (pick->met) most = fmin(most, SPARE * ALIKE * pick->best.work);
  return try_value(s, value, most);
}

/* Chooses the method whose next run promises to be the cheapest. */
static int32_t search_all(struct hk_pick *pick, int32_t count, struct search *all) {
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK) {
    double least = INFINITY, value = NAN, next;
    struct search *best = NULL;
    for (int32_t k = 0; k < count; k++) {
      const double work = promise(&all[k], &next);
      if (!(work < least)) continue;
      least = work;
      value = next;
      best = &all[k];
    }
    if (best == NULL) break;
    status = advance(best, value);
    keep_best(pick, count, all);
  }
  return status;
}

/* ---- from a displaced start ---- */

/* As rounding does: so little that the scene's own motion may let it grow a millionfold and more [m]; what a
 * step above the limit amplifies shows in it all the same. */
static double displacement_of(const struct hk_reference *r) {
  return DISPLACEMENT * hk_frames_resolution(&r->frames, r->frames.position);
}

/* Runs the best row once more; if the want is not met there, the search goes on. */
static int32_t confirm(struct search *s, int32_t *holds) {
  struct result again;
  const int32_t status = run_row(s, s->best.value, displacement_of(&s->pick->reference), 0.0, &again);
  *holds = status == HOOKE_OK && is_sound(&again) && !again.unknown && again.row.error <= s->most;
  s->best.error = fmax(s->best.error, again.row.error);
  s->best.rms = fmax(s->best.rms, again.row.rms);
  if (*holds || status != HOOKE_OK) return status;
  if (!is_sound(&again)) s->best.method = NULL;
  s->met = 0;
  s->meets = s->error_meets = NAN;
  s->fails = again.row.value;
  s->error_fails = is_sound(&again) ? again.row.error : NAN;
  s->largest = fmin(s->largest, fmin(again.allowed, is_sound(&again) ? INFINITY : 0.5 * again.row.value));
  s->over = 0;
  return HOOKE_OK;
}

static double reference_setting(const struct hk_pick *pick) {
  return hk_reference_setting(&pick->reference, pick->reference.method, pick->reference.rtol);
}

/* The reference itself meets any want that it can judge. */
static int32_t fall_back(struct hk_pick *pick, int32_t count, struct search *all) {
  for (int32_t k = 0; k < count; k++) {
    if (strcmp(all[k].method, pick->reference.method) != 0) continue;
    const int32_t status = try_value(&all[k], reference_setting(pick), 0.0);
    keep_best(pick, count, all);
    return status;
  }
  return HOOKE_OK;
}

/* Searches until a row is met from the displaced start, too, or nothing meets the want. */
static int32_t search_and_confirm(struct hk_pick *pick, int32_t count, struct search *all) {
  int32_t status = HOOKE_OK, holds = 0;
  for (int doubts = 0; status == HOOKE_OK && !holds && doubts < MOST_DOUBTS; doubts++) {
    status = search_all(pick, count, all);
    if (status == HOOKE_OK && !pick->met && isinf(pick->most)) status = fall_back(pick, count, all);
    struct search *best = choose(count, all, NULL);
    if (status != HOOKE_OK || best == NULL || !best->met) break;
    status = confirm(best, &holds);
    pick->met = 0;
    pick->best.method = NULL;
    keep_best(pick, count, all);
  }
  pick->met &= holds;
  return status;
}

/* Refuses a list of which no trial can tell whether it is met: the two references do not agree on it at any
 * frame after the start, or only while a quantity is far below the largest value that a want is a part of,
 * as an energy of 0 whose largest value is an error itself. */
static int32_t require_judge(const struct hk_pick *pick) {
  const struct hk_reference *r = &pick->reference;
  const struct hk_wants *wants = pick->wants;
  double bound[HOOKE_WANTS];
  if (!hk_wants_is_list(wants)) return HOOKE_OK;
  hk_wants_bounds(wants, &r->frames.watched, r->frames.recorded, bound);
  if (!(pick->want * pick->fraction > r->wanted_agreement))
    return hk_fail(
        HOOKE_BAD_VALUE, "want",
        "%s: no run tells whether it is within %.3g %s: two references, by %s and %s, have to agree to a "
        "fiftieth of that, and differ by %.2g at the first frame that could tell",
        wants->want[r->parted].name, bound[r->parted], hk_want_unit(wants, r->parted), r->method, r->check,
        r->parted_by);
  return hk_wants_require_values(wants, &r->frames.watched, r->frames.recorded, r->trusted);
}

static int32_t search_methods(struct hk_pick *pick) {
  struct search all[MOST_METHODS];
  int32_t count = 0, status = HOOKE_OK;
  for (int64_t m = 0; m < hooke_method_count() && count < MOST_METHODS && status == HOOKE_OK; m++) {
    const char *method = hooke_method_name(m);
    if (!allows(pick, method)) continue;
    status = begin(pick, method, &all[count]);
    count += all[count].largest > 0.0;
  }
  if (status == HOOKE_OK) status = search_and_confirm(pick, count, all);
  if (status != HOOKE_OK || pick->best.method || pick->method_count > 0) return status;
  /* nothing after the start can be judged */
  pick->best = (struct hk_pick_row){
      pick->reference.method, reference_setting(pick), NAN, NAN, pick->reference.run_work, NAN};
  return status;
}

int32_t hk_pick_run(struct hk_pick *pick, const hooke_system *system, const hooke_options *run,
                    const struct hk_wants *wants, double want, double most, int32_t count,
                    const char *const *methods, hooke_progress *progress, void *ctx) {
  *pick = (struct hk_pick){.system = system,
                           .wants = wants,
                           .want = want,
                           .most = most,
                           .method_count = count,
                           .methods = methods,
                           .fraction = 1.0,
                           .progress = progress,
                           .ctx = ctx};
  int32_t status = hooke_options_copy(run, &pick->run);
  if (status == HOOKE_OK) status = choose_frames(pick);
  if (status == HOOKE_OK) status = find_quickest(pick);
  if (status == HOOKE_OK) status = find_reference(pick);
  if (status == HOOKE_OK) status = require_judge(pick);
  return status == HOOKE_OK ? search_methods(pick) : status;
}

void hk_pick_release(struct hk_pick *pick) {
  hk_reference_release(&pick->reference);
  hooke_options_destroy(pick->run);
  memset(pick, 0, sizeof *pick);
}
