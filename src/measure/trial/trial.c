#include "measure/trial/trial.h"

#include "core/memory.h"
#include "core/random.h"
#include "core/status.h"
#include "integrate/loop/run_loop.h"
#include "measure/counted_work/work.h"
#include "model/coordinates/coordinates.h"
#include "model/generalized.h"
#include "model/system.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* ---- frames ---- */

int32_t hk_frames_create(const hooke_system *system, int64_t count, struct hk_frames *frames) {
  const int64_t size = 3 * hooke_system_particle_count(system);
  const int32_t width = system->generalized ? 1 : 3;
  *frames = (struct hk_frames){.system = system, .count = count, .size = size, .width = width};
  double *block = hk_new(count, (size_t)(size + 3) * sizeof(double));
  frames->time = block;
  frames->free_place = hk_new(hooke_system_count(system, "free") * (3 / width), sizeof(int64_t));
  if (block == NULL || frames->free_place == NULL) {
    hk_frames_release(frames);
    return HOOKE_NO_MEMORY;
  }
  frames->time = hk_part(&block, count);
  frames->energy = hk_part(&block, count);
  frames->rounding = hk_part(&block, count);
  frames->position = block;
  for (int64_t p = 0; p < hk_system_numbers(system) / width; p++)
    if (system->generalized || system->inverse_mass[p] > 0.0) frames->free_place[frames->free_count++] = p;
  return HOOKE_OK;
}

int32_t hk_frames_watch(struct hk_frames *frames, const struct hk_watched_list *list,
                        const struct hk_wants *wants) {
  const int32_t status = hk_watched_series_create(list, frames->count, &frames->watched);
  frames->watched.time = frames->time;
  frames->wants = wants;
  return status;
}

void hk_frames_release(struct hk_frames *frames) {
  hk_free(frames->time);
  hk_free(frames->free_place);
  hooke_state_destroy(frames->within);
  hk_watched_series_release(&frames->watched);
  memset(frames, 0, sizeof *frames);
}

static double energy_of(const hooke_system *system, const hooke_state *state) {
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  return system->generalized ? NAN : hooke_system_energy_at(system, "total", hooke_state_time(state), q, v);
}

void hk_frames_record(struct hk_frames *frames, const hooke_state *state) {
  if (frames->recorded >= frames->count) return;
  const int64_t f = frames->recorded++;
  const double *q = hooke_state_position(state);
  frames->time[f] = hooke_state_time(state);
  frames->energy[f] = energy_of(frames->system, state);
  hk_watched_series_keep(&frames->watched, f, frames->time[f], q, hooke_state_velocity(state));
  if (frames->within && f == hk_frames_within(frames)) (void)hooke_state_copy(state, frames->within);
  if (frames->size > 0) memcpy(frames->position + f * frames->size, q, (size_t)frames->size * sizeof(double));
}

double hk_frames_distance(const struct hk_frames *frames, int64_t f, const double *q, double *largest) {
  return hk_frames_apart(frames, frames->position + f * frames->size, q, largest);
}

double hk_frames_apart(const struct hk_frames *frames, const double *p, const double *q, double *largest) {
  const int32_t wide = frames->width == 3;
  double sum = 0.0, most = 0.0;
  for (int64_t k = 0; k < frames->free_count; k++) {
    const int64_t i = frames->width * frames->free_place[k];
    const double dx = q[i] - p[i], dy = wide ? q[i + 1] - p[i + 1] : 0.0,
                 dz = wide ? q[i + 2] - p[i + 2] : 0.0;
    const double square = (dx * dx + dy * dy) + dz * dz;
    sum += square;
    most = fmax(most, square);
  }
  if (largest) *largest = sqrt(most);
  return frames->free_count > 0 ? sqrt(sum / (double)frames->free_count) : 0.0;
}

double hk_frames_extent(const struct hk_frames *frames, int64_t count) {
  const int64_t size = frames->size, all = count * size;
  double most = 0.0;
  if (frames->width == 3) return hk_diagonal(all / 3, frames->position);
  for (int64_t i = 0; i < size && count > 0; i++) {
    double low = frames->position[i], high = low;
    for (int64_t k = i; k < all; k += size) {
      low = fmin(low, frames->position[k]);
      high = fmax(high, frames->position[k]);
    }
    most = fmax(most, high - low);
  }
  return most;
}

double hk_frames_resolution(const struct hk_frames *frames, const double *q) {
  double most = 0.0;
  for (int64_t k = 0; k < frames->free_count; k++)
    for (const double *x = q + frames->width * frames->free_place[k], *end = x + frames->width; x < end; x++)
      most = fmax(most, fabs(*x));
  return 0.5 * (nextafter(most, INFINITY) - most);
}

/* ---- a trial ---- */

/* A trial that was not run: numbers are NaN. */
static const struct hk_trial none = {.step = NAN,
                                     .rtol = NAN,
                                     .atol = NAN,
                                     .atol_velocity = NAN,
                                     .error = NAN,
                                     .error_max = NAN,
                                     .error_final = NAN,
                                     .wanted = NAN,
                                     .energy_drift = NAN,
                                     .force_evaluations = NAN,
                                     .steps = NAN,
                                     .linear_iterations = NAN,
                                     .wall_seconds = NAN};

static int32_t make_space(const struct hk_frames *reference, struct hk_trial *trial) {
  *trial = none;
  double *block = hk_new(reference->count, 4 * sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  trial->error_at = hk_part(&block, reference->count);
  trial->error_max_at = hk_part(&block, reference->count);
  trial->drift_at = hk_part(&block, reference->count);
  trial->wanted_at = hk_part(&block, reference->count);
  const int32_t status = hk_watched_series_create(reference->watched.list, reference->count, &trial->watched);
  if (status != HOOKE_OK) hk_trial_release(trial);
  return status;
}

void hk_trial_release(struct hk_trial *trial) {
  hk_free(trial->error_at);
  hk_watched_series_release(&trial->watched);
  *trial = none;
}

/* ---- running ---- */

static const double LEAST_MOVE = 1e3; /* of a step, in what positions can hold */

struct run {
  struct hk_frames *record;          /* or */
  const struct hk_frames *reference; /* with */
  struct hk_trial *trial;
  int64_t frames, next;
  double begin, duration;
  int64_t last_step;           /* of the last frame */
  double hold, move, rounding; /* see round_off() */
  const struct hk_listener *listener;
  const hooke_integrator *integrator;
  int32_t too_long; /* 1: it worked more than its listener allows, whenever that was noticed */
};

/* A step that is given up takes its counts with it. */
static int32_t works_too_long(struct run *run) {
  const double most = run->listener->most_work;
  run->too_long |= most > 0.0 && run->integrator && hk_work_of(run->integrator) > most;
  return run->too_long;
}

/* A run that was stopped counts as what it was allowed: where it was noticed depends on a clock. */
static double work_of(struct run *run) {
  return works_too_long(run) ? run->listener->most_work : hk_work_of(run->integrator);
}

static int32_t tell(double fraction, const char *method, void *ctx) {
  struct run *run = ctx;
  (void)method;
  if (works_too_long(run)) return 1;
  return run->listener->on_progress ? run->listener->on_progress(fmin(1.0, fraction), run->listener->ctx) : 0;
}

static void judge(const struct run *run, int64_t f, const hooke_state *state) {
  struct hk_trial *trial = run->trial;
  const double *q = hooke_state_position(state);
  const double rounding = fmax(run->rounding, run->reference->rounding[f]);
  double largest;
  trial->rounding = rounding;
  trial->error_at[f] = fmax(rounding, hk_frames_distance(run->reference, f, q, &largest));
  trial->error_max_at[f] = fmax(rounding, largest);
  trial->drift_at[f] = energy_of(run->reference->system, state) - run->reference->energy[f];
  hk_watched_series_keep(&trial->watched, f, hooke_state_time(state), q, hooke_state_velocity(state));
  trial->error = fmax(trial->error, trial->error_at[f]);
  trial->error_max = fmax(trial->error_max, trial->error_max_at[f]);
  trial->error_final = trial->error_at[f];
  trial->energy_drift = fmax(trial->energy_drift, fabs(trial->drift_at[f]));
}

/* Of every frame that it came to. */
static void judge_wants(struct hk_trial *trial, const struct hk_frames *reference, int64_t frames) {
  const struct hk_wants *wants = hk_wants_is_list(reference->wants) ? reference->wants : NULL;
  double bound[HOOKE_WANTS];
  if (wants) hk_wants_bounds(wants, &reference->watched, reference->recorded, bound);
  for (int64_t f = 0; f < frames && !isnan(trial->error_max_at[f]); f++) {
    double error = trial->error_max_at[f];
    if (wants) error = hk_wants_error(wants, bound, &trial->watched, &reference->watched, f, error);
    trial->wanted_at[f] = error;
    if (!(error <= trial->wanted) && !isnan(trial->wanted)) trial->wanted = error;
  }
  if (wants && wants->whole && frames < reference->count) trial->wanted = NAN;
}

/* What rounding may have displaced a particle by so far [m]: by chance in every step, but always in the same
 * direction where steps move particles by little more than positions can hold. */
static void round_off(struct run *run, int64_t f, int64_t step, const double *q) {
  const struct hk_frames *frames = run->record ? run->record : run->reference;
  const double steps = (double)step;
  double move = 0.0;
  if (f > 0 && f <= frames->count) (void)hk_frames_distance(frames, f - 1, q, &move);
  if (step > run->last_step) run->move = fmax(run->move, move / (steps - (double)run->last_step));
  run->last_step = step;
  run->hold = fmax(run->hold, hk_frames_resolution(frames, q));
  run->rounding = fmax(run->rounding, run->hold * (run->move < LEAST_MOVE * run->hold ? steps : sqrt(steps)));
  if (run->record && f < frames->count) frames->rounding[f] = run->rounding;
}

static int32_t see_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct run *run = ctx;
  const int64_t f = run->next++;
  round_off(run, f, step, hooke_state_position(state));
  if (run->record)
    hk_frames_record(run->record, state);
  else if (f < run->frames)
    judge(run, f, state);
  int32_t value = 0;
  if (run->listener->on_frame) value = run->listener->on_frame(f, step, state, run->listener->ctx);
  return value ? value : tell((hooke_state_time(state) - run->begin) / run->duration, NULL, run);
}

/* One run on a fresh state; returns the integrator for its counts. */
static int32_t run_once(struct run *run, const hooke_system *system, const hooke_options *options,
                        hooke_integrator **integrator) {
  hooke_state *state = NULL;
  hooke_options *own = NULL;
  int32_t status = hooke_options_copy(options, &own);
  if (status == HOOKE_OK) status = hooke_step_settle(system, own);
  if (status == HOOKE_OK && run->listener->serial) status = hooke_options_set_number(own, "threads", 1.0);
  if (status == HOOKE_OK) status = hooke_integrator_create(system, own, integrator);
  hooke_options_destroy(own);
  run->integrator = *integrator;
  if (status == HOOKE_OK) status = hooke_state_create(system, &state);
  if (status == HOOKE_OK) {
    if (run->listener->on_start) run->listener->on_start(state, run->listener->ctx);
    run->begin = hooke_state_time(state);
    run->duration = hooke_options_number(options, "duration");
    hooke_integrator_on_frame(*integrator, see_frame, run);
    hooke_integrator_on_progress(*integrator, 0.0, tell, run);
    status = hk_run_whole(*integrator, state);
  }
  hooke_state_destroy(state);
  return status;
}

static void keep_counts(struct run *run) {
  struct hk_trial *trial = run->trial;
  const hooke_integrator *integrator = run->integrator;
  const hooke_options *options = hooke_integrator_options(integrator);
  const int adaptive = hooke_method_is_adaptive(hooke_options_text(options, "method"));
  trial->step = adaptive ? NAN : hooke_options_number(options, "step");
  trial->rtol = adaptive ? hooke_options_number(options, "rtol") : NAN;
  trial->atol = adaptive ? hooke_options_number(options, "atol") : NAN;
  trial->atol_velocity = adaptive ? hooke_options_number(options, "atol_velocity") : NAN;
  trial->force_evaluations = (double)hooke_integrator_count(integrator, "force_evaluations");
  trial->steps = (double)hooke_integrator_count(integrator, "steps");
  trial->linear_iterations = (double)hooke_integrator_count(integrator, "linear_iterations");
  trial->wall_seconds = hooke_integrator_number(integrator, "wall_seconds");
  trial->work = work_of(run);
  trial->frames = run->next;
}

int32_t hk_trial_gave_up(int32_t status) {
  return status == HOOKE_DIVERGED || status == HOOKE_SOLVER_FAILED || status == HOOKE_STEP_LIMIT;
}

int32_t hk_trial_run(struct hk_trial *trial, const struct hk_frames *reference, int64_t frames,
                     const hooke_options *options, const struct hk_listener *listener) {
  struct run run = {.reference = reference, .trial = trial, .frames = frames, .listener = listener};
  hooke_integrator *integrator = NULL;
  int32_t status = trial->error_at ? HOOKE_OK : make_space(reference, trial);
  if (status != HOOKE_OK) return status;
  trial->error = trial->error_max = trial->error_final = trial->energy_drift = trial->wanted = 0.0;
  for (int64_t f = 0; f < reference->count; f++)
    trial->error_at[f] = trial->error_max_at[f] = trial->drift_at[f] = trial->wanted_at[f] = NAN;
  hk_watched_series_clear(&trial->watched);
  trial->watched.time = reference->time; /* not that of the last run */
  status = run_once(&run, reference->system, options, &integrator);
  judge_wants(trial, reference, frames);
  const int32_t too_long = (status == HOOKE_OK || status == HOOKE_STOPPED) && works_too_long(&run);
  if (too_long) status = HOOKE_STOPPED;
  if (status != HOOKE_OK || frames < 2)
    trial->error = trial->error_max = trial->error_final = trial->energy_drift = trial->wanted = NAN;
  if (integrator == NULL) return status;
  keep_counts(&run);
  hooke_integrator_destroy(integrator);
  trial->status = status == HOOKE_OK         ? "finished"
                  : status == HOOKE_DIVERGED ? "diverged"
                  : status == HOOKE_STOPPED  ? "stopped"
                                             : "failed";
  if (reference->system->generalized) trial->energy_drift = NAN;
  if (status == HOOKE_OK)
    hk_watched_series_compare(&trial->watched, &reference->watched, frames, reference->time, 1.0);
  return too_long || hk_trial_gave_up(status) ? HOOKE_OK : status;
}

int32_t hk_frames_run(struct hk_frames *frames, const hooke_options *options,
                      const struct hk_listener *listener, struct hk_run_cost *cost) {
  struct run run = {.record = frames, .listener = listener};
  hooke_integrator *integrator = NULL;
  frames->recorded = 0;
  const int32_t status = run_once(&run, frames->system, options, &integrator);
  if (integrator && cost)
    *cost = (struct hk_run_cost){hooke_integrator_number(integrator, "wall_seconds"),
                                 (double)hooke_integrator_count(integrator, "force_evaluations"),
                                 work_of(&run), works_too_long(&run),
                                 hooke_options_number(hooke_integrator_options(integrator), "atol")};
  if (integrator)
    snprintf(frames->zero_passages, sizeof frames->zero_passages, "%s",
             hooke_integrator_text(integrator, "zero_passages"));
  hooke_integrator_destroy(integrator);
  return status;
}

int32_t hk_trial_set_value(hooke_options *run, const char *method, double value) {
  static const char *const absolute[] = {"atol", "atol_velocity"};
  const double rtol = hooke_options_number(run, "rtol");
  const int32_t fixed = !hooke_method_is_adaptive(method); /* whose text may be that of the options */
  int32_t status = hooke_options_set_text(run, "method", method);
  if (status == HOOKE_OK && fixed) return hooke_options_set_number(run, "step", value);
  if (status == HOOKE_OK) status = hooke_options_set_number(run, "rtol", value);
  for (int k = 0; k < 2 && status == HOOKE_OK; k++) {
    const double fraction = hooke_options_number(run, absolute[k]) / rtol;
    if (!isnan(fraction)) status = hooke_options_set_number(run, absolute[k], value * fraction);
  }
  return status;
}

void hk_displace(hooke_state *state, const hooke_system *system, double length, uint64_t *random) {
  double *q = hooke_state_position(state);
  for (int64_t p = 0; p < system->particle_count; p++) {
    for (int64_t k = 3 * p; k < 3 * p + 3 && system->inverse_mass[p] > 0.0; k++)
      q[k] += length * hk_random_normal(random);
  }
  hk_movers_renew(system, q, hooke_state_velocity(state));
}

/* ---- the steps that fit a run ---- */

int32_t hk_step_is_whole(double quotient) {
  return fabs(quotient - round(quotient)) <= 1e-9 * quotient && round(quotient) >= 1.0;
}

int32_t hk_step_unit(double duration, double every, double *unit) {
  for (int32_t parts = 1; parts <= 10000; parts++) {
    *unit = every / (double)parts;
    if (hk_step_is_whole(duration / *unit)) return HOOKE_OK;
  }
  return hk_fail(HOOKE_BAD_VALUE, "every",
                 "%.6g s and duration %.6g s have no step in common; take a part of the duration", every,
                 duration);
}

int32_t hk_step_times(hooke_options *run, double *duration, double *every) {
  *duration = hooke_options_number(run, "duration");
  *every = hooke_options_number(run, "every");
  if (isnan(*duration)) {
    return hk_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
  }
  if (isnan(*every)) *every = *duration / 100.0;
  return hooke_options_set_number(run, "every", *every);
}
