#include "measure/recommend/pick.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "measure/counted_work/work.h"
#include "measure/limit/limit_predict.h"
#include "measure/recommend/soundness.h"
#include "measure/spectrum/step_bound.h"
#include "measure/trial/step_unit.h"

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
static const double DIGITS = 0.02;      /* of the wanted error: accuracy of the reference */
static const double BEGINNING = 0.1;    /* duration studied if the reference reached no frame */
static const double LONGER = 4.0;       /* from one budget to the next while it came to nothing */
static const double LIMITS_SHARE = 0.1; /* of LEAST_WORK, for the limit of bodies at the start */
static const double REVERSED = 2.0;     /* ratio of times that is worth telling */
enum { FEWEST_FRAMES = 25, MOST_FRAMES = 100, MOST_BUDGETS = 2 };

double hk_pick_most_work(const struct hk_pick *pick) {
  return fmax(LEAST_WORK, RUNS * (pick->met ? pick->best.work : pick->quickest));
}

int32_t hk_pick_allows(const struct hk_pick *pick, const char *method) {
  int32_t allowed = pick->method_count == 0;
  for (int32_t k = 0; k < pick->method_count; k++)
    allowed |= strcmp(method, pick->methods[k]) == 0;
  return allowed && hooke_method_is_built(method) && hk_method_suits(method, pick->system);
}

/* ---- the studied duration ---- */

/* A number of frames between FEWEST_FRAMES and MOST_FRAMES, such that the steps that fit the run fit them,
 * too. */
static int32_t choose_frames(struct hk_pick *pick) {
  double every, unit;
  int32_t status = hk_step_times(pick->run, &pick->duration, &every);
  if (status == HOOKE_OK) status = hk_step_unit(pick->duration, every, &unit);
  if (status != HOOKE_OK) return status;
  const double units = round(pick->duration / unit);
  double apart = 1.0;
  while (units / apart > MOST_FRAMES || fmod(units, apart) != 0.0)
    if (++apart > units) apart = units;
  const double parts = ceil(FEWEST_FRAMES * apart / units);
  every = parts > 1.0 ? apart * unit / parts : apart * unit;
  pick->unit = fmin(unit, every);
  return hooke_options_set_number(pick->run, "every", every);
}

/* ---- the quickest run ---- */

int32_t hk_pick_largest_step(struct hk_pick *pick, const char *method, const double *q, double *bound,
                             double *largest) {
  *bound = INFINITY;
  int32_t status = hooke_step_bound(pick->system, method, q, bound);
  if (status == HOOKE_OK && isnan(*bound) && hk_step_is_bounded(method)) {
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
  if (!hk_pick_allows(pick, method)) return HOOKE_OK;
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
  if (status == HOOKE_OK)
    status = hk_pick_largest_step(pick, euler, hooke_state_position(state), &bound, &step);
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
                                               .digits = DIGITS * pick->want,
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

/* ---- picking ---- */

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

int32_t hk_pick_prepare(struct hk_pick *pick, const hooke_options *run) {
  int32_t status = hooke_options_copy(run, &pick->run);
  if (status == HOOKE_OK) status = choose_frames(pick);
  if (status == HOOKE_OK) status = find_quickest(pick);
  if (status == HOOKE_OK) status = find_reference(pick);
  return status;
}

void hk_pick_release(struct hk_pick *pick) {
  hk_reference_release(&pick->reference);
  hooke_options_destroy(pick->run);
  memset(pick, 0, sizeof *pick);
}
