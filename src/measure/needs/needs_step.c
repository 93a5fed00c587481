/* Finds the step with which a variant has an error of at most a tenth of the wanted one. */
#include "measure/needs/needs.h"

#include "core/status.h"
#include "integrate/integrator.h"
#include "measure/limit/limit_predict.h"
#include "measure/limit/explicit_step.h"
#include "model/force/spring.h"

#include <math.h>

static const double BELOW_LIMIT = 0.9; /* start of the search */
static const double DIFFERENCE_FACTOR =
    2.0; /* error of a step over its change when halved, at order 1 or more */
static const double FINE_FACTOR =
    1.25; /* error of the finer of two runs over their change: 1 at order 1, with a margin for higher terms */
static const double FINEST = 16384.0; /* smallest step that is tried, below the first stable one */
static const double COARSEST_RTOL = 1e-3, FINEST_RTOL = 1e-13;
static const double LEAST_GAIN = 1.12; /* factor on the predictable time that makes a finer step worthwhile */
static const double WELL_BEGUN = 0.25; /* of the duration: beyond it one step without gain is enough */
static const double LEAST_SHARE = 0.1, COARSE = 256.0; /* of the duration; below the first stable step */
static const double FINE = 16.0;    /* below the first stable step: what has no value then has none */
static const double CERTAIN = 0.25; /* of a change, by the step: leaves no doubt of it */
static const double LONGER = 16.0, LONGEST = 64.0; /* than the step of the full system, tried before that */
static const double MARGIN = 4.0; /* of the step's error, if only a part of the run can be judged */
enum { REPEATS = 20, HALVINGS = 3 };

struct attempt {
  struct hk_needs_path path;
  struct hk_needs_cost cost;
  int32_t finished;
};

/* Steps are unit / value, tolerances 10^-value. */
struct search {
  struct hk_needs_recorder recorder;
  hooke_options *options;
  int32_t adaptive;
  double value; /* of the coarser of two runs */
  double first_stable;
  int32_t has_limit; /* 0: no stable step is known, such as in a build without LAPACK */
  double error;      /* of the last pair; number of agreeing frames; successive pairs without improvement */
  int64_t frames;
  int32_t stalls;
  struct attempt run[2];
};

static double finer(const struct search *search, double value) {
  return search->adaptive ? value + 1.0 : 2.0 * value;
}

/* Variants are run as far as they are judged; the time of a whole run is measured at the end. */
static int32_t is_shortened(const struct search *search) {
  const struct hk_needs *needs = search->recorder.needs;
  return search->recorder.trial->map != NULL && needs->judged < needs->frame_count;
}

static int32_t run_at(struct search *search, double value, int32_t which) {
  struct attempt *run = &search->run[which];
  run->cost.step = search->adaptive ? NAN : search->recorder.needs->unit / value;
  run->cost.rtol = search->adaptive ? 1.0 / pow(10.0, value) : NAN;
  search->recorder.path = &run->path;
  const int32_t status = hk_needs_set_step(&run->cost, search->options);
  if (status != HOOKE_OK) return status;
  return hk_needs_run_once(&search->recorder, search->options, &run->finished, &run->cost);
}

static int32_t is_exhausted(const struct search *search) {
  if (search->adaptive) return 1.0 / pow(10.0, search->value + 1.0) < FINEST_RTOL;
  return search->value > FINEST * search->first_stable;
}

/* Number of frames up to which the two runs stay within `bound` of each other. */
static int64_t agreed(const struct search *search, double bound) {
  return hk_needs_agreed(search->recorder.needs, &search->run[0].path, &search->run[1].path,
                         bound / DIFFERENCE_FACTOR);
}

/* 1 if the step is not yet as small as that of the full system. */
static int32_t is_coarser_than_full(const struct search *search) {
  const struct hk_needs_cost *full = &search->recorder.needs->full, *own = &search->run[0].cost;
  if (search->recorder.trial->map == NULL) return 0;
  return search->adaptive ? own->rtol > full->rtol : own->step > full->step;
}

static int32_t has_finished(const struct search *search) {
  return search->run[0].finished && search->run[1].finished;
}

/* 1 while steps may be so coarse that the whole motion is wrong and halving them shows no difference. */
static int32_t may_be_too_coarse(const struct search *search, int64_t frames) {
  if (search->has_limit && (double)frames >= LEAST_SHARE * (double)search->recorder.needs->frame_count)
    return 0;
  return search->adaptive ? search->value < 8.0 : search->value < COARSE * search->first_stable;
}

/* 1 if smaller steps no longer help: differences grow too fast for any step to be small enough. */
static int32_t has_stalled(struct search *search, double error, int64_t frames) {
  const double all = (double)search->recorder.needs->frame_count;
  const int32_t idle = (double)frames < LEAST_GAIN * (double)search->frames &&
                       !is_coarser_than_full(search) && !may_be_too_coarse(search, frames);
  search->stalls = idle ? search->stalls + 1 : 0;
  search->error = error;
  search->frames = frames;
  return search->stalls >= ((double)frames < WELL_BEGUN * all ? 2 : 1);
}

static void swap_runs(struct search *search) {
  const struct attempt first = search->run[0];
  search->run[0] = search->run[1];
  search->run[1] = first;
}

/* 1 if the error of a variant exceeds the wanted one for any step, and is known to a quarter or with a step
 * as small as that of the full system. */
static int32_t is_needed_for_certain(const struct search *search, double error) {
  const struct hk_needs *needs = search->recorder.needs;
  if (search->recorder.trial->map == NULL) return 0;
  const double distance = hk_needs_distance(needs, &needs->path, &search->run[1].path);
  if (!(distance - error > needs->want)) return 0;
  return error <= CERTAIN * distance || !is_coarser_than_full(search);
}

/* Leaves the run that is good enough, or the best one, at index 0 and the finer one at index 1. */
static int32_t find_step(struct search *search) {
  const struct hk_needs *needs = search->recorder.needs;
  const double bound = HOOKE_NEEDS_STEP_SHARE * needs->want;
  int32_t status = run_at(search, search->value, 0);
  for (search->error = INFINITY; status == HOOKE_OK;) {
    status = run_at(search, finer(search, search->value), 1);
    if (status != HOOKE_OK) break;
    if (has_finished(search)) {
      const double error =
          DIFFERENCE_FACTOR * hk_needs_distance(needs, &search->run[0].path, &search->run[1].path);
      if (has_stalled(search, error, agreed(search, bound)) || error <= bound) break;
      if (is_needed_for_certain(search, error)) break;
      if (!isfinite(error) && search->value >= FINE * search->first_stable) break;
    } else {
      search->first_stable = finer(search, search->value);
    }
    if (is_exhausted(search)) break;
    search->value = finer(search, search->value);
    swap_runs(search);
    search->recorder.share_begun += (1.0 - search->recorder.share_begun) / 3.0;
  }
  return status;
}

/* A callback that stops here stops the run after it, too. */
double hk_needs_step_limit(struct hk_needs *needs, const hooke_system *system) {
  const char *method = hooke_options_text(needs->m->run, "method");
  hooke_state *state = NULL;
  double limit = NAN;
  if (hooke_state_create(system, &state) != HOOKE_OK) return NAN;
  const double *q = hooke_state_position(state);
  if (hk_limit_predict(system, q, NULL, method, 1e-3, hk_needs_tell_pick, needs, &limit) != HOOKE_OK &&
      hooke_step_bound(system, method, q, &limit) != HOOKE_OK) {
    limit = NAN;
  }
  hooke_state_destroy(state);
  return limit;
}

static int32_t begin_search(struct search *search, double limit) {
  search->frames = search->stalls = 0;
  search->has_limit = search->adaptive || !isnan(limit);
  const struct hk_needs *needs = search->recorder.needs;
  const double unit = needs->unit;
  search->recorder.fraction = 0.25;
  if (search->adaptive) {
    search->value = -log10(COARSEST_RTOL);
    return HOOKE_OK;
  }
  double start = BELOW_LIMIT * limit;
  /* a smaller step that solves nothing is cheaper */
  const char *method = hooke_options_text(needs->m->run, "method");
  int32_t status = HOOKE_OK;
  if (limit > 0.0) status = hk_step_cheapest(search->recorder.trial->system, method, &start);
  if (limit == 0.0) start = unit / 64.0; /* no step is stable: a run is short enough or not */
  search->value = start < unit ? ceil(unit / start) : 1.0;
  search->first_stable = search->value;
  return status;
}

/* The counts of a whole run, where it was judged in part alone. `finished` is 0 if it does not finish. */
static int32_t run_whole(struct search *search, struct hk_needs_cost *cost, int32_t *finished) {
  struct hk_needs *needs = search->recorder.needs;
  if (!is_shortened(search) || !*finished) return HOOKE_OK;
  search->recorder.path = NULL;
  int32_t status = hooke_options_set_number(search->options, "duration", needs->duration);
  if (status == HOOKE_OK) status = hk_needs_set_step(cost, search->options);
  return status == HOOKE_OK ? hk_needs_run_once(&search->recorder, search->options, finished, cost) : status;
}

int32_t hk_needs_find_times(struct hk_needs *needs, int32_t count, const struct hk_needs_trial *trial,
                            struct hk_needs_cost *const *cost, double most) {
  hooke_options *options = NULL;
  double spent = 0.0, slowest[2] = {0.0, 0.0};
  int32_t finished, status = hooke_options_copy(needs->m->run, &options);
  for (int32_t k = 0; k < count * REPEATS && spent < most && status == HOOKE_OK; k++) {
    struct hk_needs_recorder recorder = {.needs = needs, .trial = &trial[k % count]};
    struct hk_needs_cost *own = cost[k % count], again = *own;
    status = hk_needs_set_step(own, options);
    if (status == HOOKE_OK) status = hk_needs_run_once(&recorder, options, &finished, &again);
    if (status != HOOKE_OK) break;
    own->wall_seconds = k < count ? again.wall_seconds : fmin(own->wall_seconds, again.wall_seconds);
    slowest[k % count] = fmax(slowest[k % count], again.wall_seconds);
    spent += again.wall_seconds;
  }
  for (int32_t k = 0; k < count; k++)
    if (slowest[k] > 0.0) needs->spread = fmax(needs->spread, slowest[k] / cost[k]->wall_seconds);
  hooke_options_destroy(options);
  return status;
}

static void hand_over(struct hk_needs_path *from, struct hk_needs_path *to) {
  hk_needs_path_release(to);
  *to = *from;
  *from = (struct hk_needs_path){0};
}

/* The full system, and all variants against it, are judged up to where the best step can be trusted, with a
 * margin: differences of variants grow about as fast. Up to there a larger step may suffice. */
static int32_t judge_full(struct search *search, double limit, struct hk_needs_path *fine) {
  struct hk_needs *needs = search->recorder.needs;
  const double bound = HOOKE_NEEDS_STEP_SHARE * needs->want;
  if (search->recorder.trial->map || search->error <= bound) return HOOKE_OK;
  needs->judged = agreed(search, bound / MARGIN);
  needs->own_error = FINE_FACTOR * hk_needs_distance(needs, &search->run[0].path, &search->run[1].path);
  hand_over(&search->run[1].path, fine);
  int32_t status = hk_needs_path_create(needs, &search->run[1].path);
  if (status == HOOKE_OK) status = begin_search(search, limit);
  return status == HOOKE_OK ? find_step(search) : status;
}

static int32_t start(struct search *search, double limit) {
  const struct hk_needs *needs = search->recorder.needs;
  int32_t status = begin_search(search, limit);
  if (status == HOOKE_OK) status = hooke_options_copy(needs->m->run, &search->options);
  if (status == HOOKE_OK && is_shortened(search))
    status = hk_run_fill_tolerances(search->recorder.trial->system, search->options);
  if (status == HOOKE_OK && is_shortened(search))
    status =
        hooke_options_set_number(search->options, "duration", (double)(needs->judged - 1) * needs->every);
  for (int k = 0; k < 2 && status == HOOKE_OK; k++)
    status = hk_needs_path_create(needs, &search->run[k].path);
  return status;
}

static void end(struct search *search) {
  for (int k = 0; k < 2; k++)
    hk_needs_path_release(&search->run[k].path);
  hooke_options_destroy(search->options);
}

static struct search new_search(struct hk_needs *needs, const struct hk_needs_trial *trial) {
  const char *method = hooke_options_text(needs->m->run, "method");
  return (struct search){.recorder = {.needs = needs, .trial = trial},
                         .adaptive = hk_method_find(method)->adaptive};
}

static void fill_cost(const struct search *search, double limit, struct hk_needs_cost *cost) {
  const hooke_system *system = search->recorder.trial->system;
  *cost = search->run[0].cost;
  cost->step_error = NAN;
  cost->step_limit = limit;
  cost->unlimited = isinf(limit);
  cost->springs = (double)hooke_system_count(system, "springs");
  cost->indexed = system->springs->stored.indexed;
  cost->particles = (double)hooke_system_particle_count(system);
}

int32_t hk_needs_measure(struct hk_needs *needs, const struct hk_needs_trial *trial,
                         struct hk_needs_cost *cost, struct hk_needs_path *fine) {
  const double limit = hk_needs_step_limit(needs, trial->system);
  struct search search = new_search(needs, trial);
  int32_t status = start(&search, limit);
  if (status == HOOKE_OK) status = find_step(&search);
  if (status == HOOKE_OK && has_finished(&search) && trial->map == NULL)
    needs->own_error = FINE_FACTOR * search.error / DIFFERENCE_FACTOR;
  if (status == HOOKE_OK && has_finished(&search)) status = judge_full(&search, limit, fine);
  int32_t finished = has_finished(&search);
  fill_cost(&search, limit, cost);
  if (finished) cost->step_error = search.error;
  if (status == HOOKE_OK && finished) status = run_whole(&search, cost, &finished);
  if (status == HOOKE_OK && finished && fine->position == NULL) hand_over(&search.run[1].path, fine);
  if (status == HOOKE_OK && finished && trial->map == NULL) { /* what hk_needs_prepare() would run again */
    hand_over(&search.run[0].path, &needs->by_step[0]);
    needs->trial_work += cost->work;
  }
  end(&search);
  return status;
}

/* ---- by a given step ---- */

/* A run with the step of `cost`, and its path. */
static int32_t run_by_step(struct hk_needs *needs, const struct hk_needs_trial *trial,
                           const struct hk_needs_cost *cost, int32_t displaced, struct hk_needs_path *path,
                           int32_t *finished) {
  struct search search = new_search(needs, trial);
  struct hk_needs_cost taken = *cost;
  int32_t status = start(&search, NAN);
  search.recorder.path = &search.run[0].path;
  search.recorder.displaced = displaced;
  if (status == HOOKE_OK) status = hk_needs_set_step(cost, search.options);
  if (status == HOOKE_OK) status = hk_needs_run_once(&search.recorder, search.options, finished, &taken);
  if (status == HOOKE_OK) hand_over(&search.run[0].path, path);
  if (status == HOOKE_OK && !isnan(taken.work)) needs->trial_work += taken.work;
  end(&search);
  return status;
}

int32_t hk_needs_prepare(struct hk_needs *needs, int32_t displaced) {
  const struct hk_needs_trial full = {needs->m->system, NULL};
  struct hk_needs_path *path = &needs->by_step[displaced];
  int32_t finished;
  return path->position ? HOOKE_OK : run_by_step(needs, &full, &needs->full, displaced, path, &finished);
}

/* 1 if runs by far longer steps, below the limit of stability, leave no doubt that a variant is beyond the
 * want, by `error`. */
static int32_t is_beyond(struct hk_needs *needs, const struct hk_needs_trial *trial,
                         const struct hk_needs_cost *cost, int32_t *beyond, double *error) {
  struct search search = new_search(needs, trial);
  const double value = needs->unit / cost->step;
  if (!(LONGEST * cost->step <= cost->step_limit) || needs->path.position == NULL) return HOOKE_OK;
  int32_t status = start(&search, NAN);
  search.value = ceil(value / LONGEST);
  search.first_stable = value / (LONGER * FINEST); /* it ends beyond */
  if (status == HOOKE_OK) status = find_step(&search);
  *error = hk_needs_distance(needs, &needs->path, &search.run[1].path);
  *beyond = status == HOOKE_OK && has_finished(&search) && is_needed_for_certain(&search, search.error);
  if (!isnan(search.run[1].cost.work)) needs->trial_work += 2.0 * search.run[1].cost.work;
  end(&search);
  return status;
}

int32_t hk_needs_compare(struct hk_needs *needs, const struct hk_needs_trial *trial,
                         const struct hk_needs_cost *cost, int32_t displaced, double *error) {
  struct hk_needs_path own = {0};
  int32_t finished = 0, beyond = 0;
  int32_t status = displaced ? HOOKE_OK : is_beyond(needs, trial, cost, &beyond, error);
  if (status != HOOKE_OK || beyond) return status;
  status = hk_needs_prepare(needs, displaced);
  if (status == HOOKE_OK) status = run_by_step(needs, trial, cost, displaced, &own, &finished);
  *error = finished ? hk_needs_distance(needs, &needs->by_step[displaced], &own) : INFINITY;
  hk_needs_path_release(&own);
  return status;
}

/* ---- within the wanted error, all errors together ---- */

/* NaN for a run that did not finish, or whose step or energy is not sound. */
static double error_of(const struct search *search, int32_t which) {
  const struct hk_needs *needs = search->recorder.needs;
  if (!search->run[which].finished || !search->recorder.sound) return NAN;
  return hk_needs_distance(needs, &needs->path, &search->run[which].path) + needs->own_error;
}

/* Bisects towards `failed`, which is too coarse, and keeps the coarsest sufficient run at index 0. */
static int32_t coarsen(struct search *search, double failed, double *error) {
  int32_t status = HOOKE_OK;
  for (int k = 0; k < HALVINGS && status == HOOKE_OK; k++) {
    const double middle = 0.5 * (failed + search->value), between = search->adaptive ? middle : floor(middle);
    if (between == failed) break;
    status = run_at(search, between, 1);
    if (status != HOOKE_OK) break;
    const double found = error_of(search, 1);
    if (!(found <= search->recorder.needs->want)) {
      failed = between;
      continue;
    }
    search->value = between;
    *error = found;
    swap_runs(search);
  }
  return status;
}

/* Leaves it at index 0; `error` is NaN, or above the want, if there is none. */
static int32_t find_coarsest(struct search *search, double *error) {
  const double want = search->recorder.needs->want;
  double failed = NAN;
  for (;;) {
    const int32_t status = run_at(search, search->value, 0);
    if (status != HOOKE_OK) return status;
    *error = error_of(search, 0);
    if (*error <= want || !is_coarser_than_full(search)) break;
    failed = search->value;
    search->value = finer(search, search->value);
  }
  return *error <= want && !isnan(failed) ? coarsen(search, failed, error) : HOOKE_OK;
}

int32_t hk_needs_fit(struct hk_needs *needs, const struct hk_needs_trial *trial, struct hk_needs_cost *cost,
                     struct hk_needs_path *path, double *error) {
  const double limit = hk_needs_step_limit(needs, trial->system);
  struct search search = new_search(needs, trial);
  int32_t status = start(&search, limit);
  *error = NAN;
  search.recorder.judges = 1;
  if (status == HOOKE_OK) status = find_coarsest(&search, error);
  search.recorder.judges = 0;
  fill_cost(&search, limit, cost);
  int32_t finished = *error <= needs->want;
  if (status == HOOKE_OK && finished) status = run_whole(&search, cost, &finished);
  if (status == HOOKE_OK && finished)
    hand_over(&search.run[0].path, path);
  else
    *error = NAN;
  end(&search);
  return status;
}
