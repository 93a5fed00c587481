#include "entrant.h"

#include "baseline.h"
#include "clock.h"

#include <math.h>
#include <stdlib.h>

/* Steps of a turn: enough that loading and storing a state does not show, unless they take longer than a few
 * turns. */
enum { LEAST_STEPS = 5, ENOUGH_STEPS = 50, FEW = 10 };

struct entrant {
  hooke_integrator *integrator;
  hooke_state *state;
  struct baseline *plain; /* or the two above */
  double step;
  int64_t steps;   /* of a turn */
  int32_t threads; /* 0: one, of the plain loop */
  int turns;
  double turn[MOST_TURNS]; /* time of a step [s] */
};

int32_t entrant_create(const hooke_system *system, const hooke_state *start, const char *method,
                       int32_t threads, double step, struct entrant **entrant) {
  struct entrant *e = *entrant = calloc(1, sizeof *e);
  hooke_options *options = NULL;
  int32_t status = e ? hooke_state_create(system, &e->state) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hooke_state_copy(start, e->state);
  if (status == HOOKE_OK) status = hooke_options_create("run", &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", method);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "step", step);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "threads", threads);
  if (status == HOOKE_OK) e->threads = threads;
  if (status == HOOKE_OK) status = hooke_integrator_create(system, options, &e->integrator);
  hooke_options_destroy(options);
  return status;
}

int32_t entrant_create_plain(const hooke_system *system, const hooke_state *start, const char *method,
                             double step, struct entrant **entrant) {
  struct entrant *e = *entrant = calloc(1, sizeof *e);
  if (e == NULL) return HOOKE_NO_MEMORY;
  e->step = step;
  e->plain = baseline_create(system, start, method);
  return e->plain ? HOOKE_OK : HOOKE_NO_MEMORY;
}

void entrant_destroy(struct entrant *e) {
  if (e == NULL) return;
  hooke_integrator_destroy(e->integrator);
  hooke_state_destroy(e->state);
  baseline_destroy(e->plain);
  free(e);
}

int32_t entrant_step(struct entrant *e, int64_t steps) {
  if (e->plain == NULL) return hooke_integrator_step(e->integrator, e->state, steps);
  baseline_step(e->plain, e->step, steps);
  return HOOKE_OK;
}

int32_t entrant_turn(struct entrant *e) {
  const double begun = bench_work_seconds(e->threads);
  const int32_t status = entrant_step(e, e->steps);
  e->turn[e->turns++] = (bench_work_seconds(e->threads) - begun) / (double)e->steps;
  return status;
}

int32_t entrant_warm_up(struct entrant *e, double seconds) {
  int32_t status = HOOKE_OK;
  e->steps = LEAST_STEPS;
  for (int turn = 0; turn < 2 && status == HOOKE_OK;
       turn++) { /* the first one measures the approximate time of a step */
    status = entrant_turn(e);
    double steps = seconds / e->turn[turn];
    if (e->plain == NULL) steps = fmax(steps, fmin(ENOUGH_STEPS, FEW * steps));
    e->steps = (int64_t)fmin(fmax(steps, LEAST_STEPS), 1e9);
  }
  e->turns = 0;
  return status;
}

int32_t entrant_turns(const struct entrant *e) {
  return e->turns;
}

double entrant_least(const struct entrant *e) {
  double least = INFINITY;
  for (int k = 0; k < e->turns; k++)
    least = fmin(least, e->turn[k]);
  return least;
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

double entrant_median(const struct entrant *e) {
  double sorted[MOST_TURNS];
  for (int k = 0; k < e->turns; k++)
    sorted[k] = e->turn[k];
  qsort(sorted, (size_t)e->turns, sizeof(double), by_size);
  return 0.5 * (sorted[(e->turns - 1) / 2] + sorted[e->turns / 2]);
}

const double *entrant_position(const struct entrant *e) {
  return e->plain ? baseline_position(e->plain) : hooke_state_position(e->state);
}

double entrant_evaluations(const struct entrant *e) {
  if (e->plain) return NAN;
  return (double)hooke_integrator_count(e->integrator, "force_evaluations") /
         (double)hooke_integrator_count(e->integrator, "steps");
}
