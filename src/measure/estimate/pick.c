#include "measure/estimate/pick.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "measure/trial/step_unit.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double LEAST_SECONDS = 1.9; /* minimum time of a pick */
static const double RUNS = 5.0;          /* or this multiple of the time of the picked run */
static const double REFERENCE_RUNS = 3.0, REFERENCE_SHARE = 0.6; /* of it, at most for the reference */
static const double DIGITS = 0.1;    /* of the wanted error: accuracy of the reference */
static const double BEGINNING = 0.1; /* duration studied if the reference reached no frame */
static const double LONGER = 4.0;    /* from one budget to the next while it came to nothing */
enum { FEWEST_FRAMES = 25, MOST_FRAMES = 100, EVALUATIONS = 3, MOST_BUDGETS = 4 };

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

/* Time of one force evaluation [s]. */
static int32_t time_evaluation(const hooke_system *system, const hooke_state *state, double *seconds) {
  double *force = hk_new(3 * hooke_system_particle_count(system), sizeof(double));
  int32_t status = force ? HOOKE_OK : HOOKE_NO_MEMORY;
  *seconds = INFINITY;
  for (int k = 0; k < EVALUATIONS && status == HOOKE_OK; k++) {
    const double begun = hk_clock_seconds();
    status = hooke_system_force(system, hooke_state_time(state), hooke_state_position(state),
                                hooke_state_velocity(state), force);
    *seconds = fmin(*seconds, hk_clock_seconds() - begun);
  }
  hk_free(force);
  return status;
}

/* Approximate time of the quickest run [s]: explicit Euler at its largest step. */
static int32_t quickest_run(struct hk_pick *pick, double *seconds) {
  hooke_state *state = NULL;
  double bound = 0.0;
  int32_t status = hooke_state_create(pick->system, &state);
  if (status == HOOKE_OK) status = time_evaluation(pick->system, state, &pick->evaluation);
  if (status == HOOKE_OK)
    status =
        hooke_step_bound(pick->system, hk_method_of_euler(pick->system), hooke_state_position(state), &bound);
  hooke_state_destroy(state);
  *seconds =
      pick->evaluation * fmax(1.0, pick->duration / (bound > 0.0 ? fmin(bound, pick->unit) : pick->unit));
  return status;
}

/* ---- the reference ---- */

static int32_t tell_reference(double share, void *ctx) {
  const struct hk_pick *pick = ctx;
  return pick->progress ? pick->progress(REFERENCE_SHARE * share, "reference", pick->ctx) : 0;
}

static int32_t make_reference(struct hk_pick *pick, double budget) {
  const struct hk_listener listener = {.on_progress = tell_reference, .ctx = pick};
  const double duration = hooke_options_number(pick->run, "duration");
  const double every = hooke_options_number(pick->run, "every");
  const struct hk_reference_request request = {.run = pick->run,
                                               .frame_count = hk_schedule_frames(duration, every),
                                               .digits = DIGITS * pick->want,
                                               .enough = 1,
                                               .budget = budget,
                                               .listener = &listener};
  return hk_reference_create(pick->system, &request, &pick->reference);
}

/* Limits the studied duration to the frames of the reference, if time was short. */
static int32_t shorten(struct hk_pick *pick) {
  const struct hk_reference *r = &pick->reference;
  if (!r->hurried || r->trusted >= r->frames.count || r->trusted < 2) return HOOKE_OK;
  const double reached = r->frames.time[r->trusted - 1] - r->frames.time[0];
  pick->share = reached / pick->duration;
  return hooke_options_set_number(pick->run, "duration", reached);
}

/* A reference, by larger and larger budgets while they are too small for a single frame. */
static int32_t insist(struct hk_pick *pick, double budget) {
  int32_t status = make_reference(pick, budget);
  for (int k = 1; k < MOST_BUDGETS && status == HOOKE_BAD_VALUE; k++) {
    hk_reference_release(&pick->reference);
    status = make_reference(pick, budget *= LONGER);
  }
  return status;
}

/* Covers the whole run; if not even its second frame is reached, a beginning with closer frames. */
static int32_t find_reference(struct hk_pick *pick, double budget) {
  int32_t status = make_reference(pick, budget);
  if (status == HOOKE_OK && (pick->reference.trusted > 1 || !pick->reference.hurried)) return shorten(pick);
  if (status != HOOKE_OK && status != HOOKE_BAD_VALUE) return status;
  hk_reference_release(&pick->reference);
  const double units = ceil(BEGINNING * round(pick->duration / pick->unit));
  pick->share = units * pick->unit / pick->duration;
  status = hooke_options_set_number(pick->run, "every", pick->unit);
  if (status == HOOKE_OK) status = hooke_options_set_number(pick->run, "duration", units * pick->unit);
  if (status == HOOKE_OK) status = insist(pick, budget);
  return status == HOOKE_OK ? shorten(pick) : status;
}

/* ---- picking ---- */

int32_t hk_pick_options(const hooke_options *run, const char *method, double value, hooke_options **out) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_copy(run, &options);
  if (status == HOOKE_OK) status = hk_trial_set_value(options, method, value);
  if (status == HOOKE_OK)
    *out = options;
  else
    hooke_options_destroy(options);
  return status;
}

double hk_pick_trusted(const struct hk_pick *pick) {
  const struct hk_reference *r = &pick->reference;
  if (r->trusted == r->frames.count) return pick->share * pick->duration;
  return r->trusted > 0 ? r->frames.time[r->trusted - 1] - r->frames.time[0] : 0.0;
}

int32_t hk_pick_run(struct hk_pick *pick, const hooke_system *system, const hooke_options *run, double want,
                    const char *method, hooke_progress *progress, void *ctx) {
  double quickest = 0.0;
  *pick = (struct hk_pick){.system = system,
                           .want = want,
                           .method = method,
                           .share = 1.0,
                           .begun = hk_clock_seconds(),
                           .progress = progress,
                           .ctx = ctx};
  int32_t status = hooke_options_copy(run, &pick->run);
  if (status == HOOKE_OK) status = choose_frames(pick);
  if (status == HOOKE_OK) status = quickest_run(pick, &quickest);
  if (status == HOOKE_OK)
    status = find_reference(pick, fmax(REFERENCE_SHARE * LEAST_SECONDS, REFERENCE_RUNS * quickest));
  pick->deadline = fmax(pick->begun + LEAST_SECONDS, hk_clock_seconds() + RUNS * quickest);
  return status == HOOKE_OK ? hk_pick_search(pick) : status;
}

void hk_pick_release(struct hk_pick *pick) {
  hk_reference_release(&pick->reference);
  hooke_options_destroy(pick->run);
  memset(pick, 0, sizeof *pick);
}
