#include "measure/estimate/soundness.h"

#include "core/clock.h"
#include "core/memory.h"
#include "measure/limit/limit_predict.h"
#include "measure/spectrum/step_bound.h"
#include "model/state.h"

#include <math.h>
#include <string.h>

const double hk_soundness_most_rise = 0.01, hk_soundness_limit_share = 0.9;

enum { LEAST_STATES = 8 };
static const double SIGNIFICANT = 3.0; /* standard errors */

static int is_driven(const hooke_system *system) {
  return system->force != NULL || system->drive_count > 0;
}

int32_t hk_soundness_begin(struct hk_soundness *s, const hooke_system *system, const char *method,
                           double step, double patience, const hooke_state *state, int64_t capacity) {
  const double *q = hooke_state_position(state);
  *s = (struct hk_soundness){.system = system,
                             .method = method,
                             .step = step,
                             .least_limit = INFINITY,
                             .patience = patience,
                             .capacity = capacity};
  s->time = hk_new(2 * capacity, sizeof(double));
  if (s->time == NULL) return HOOKE_NO_MEMORY;
  s->energy = s->time + capacity;
  const struct hk_energies at = hk_state_energies(state, system);
  s->gravity0 = at.gravity;
  s->scale = at.kinetic + at.elastic;
  if (!hk_step_is_bounded(method) || !(step > 0.0)) return HOOKE_OK;
  s->by_limit = system->bodies.moving > 0;
  return s->by_limit ? HOOKE_OK : hk_node_blocks_create(system, q, &s->blocks);
}

/* Takes its time from the patience. */
static void find_limit(struct hk_soundness *s, const double *q, const double *v, double *limit) {
  const double begun = hk_clock_seconds();
  struct hk_patience patience = hk_patience_of(s->patience, NULL, NULL);
  (void)hk_limit_sure(s->system, q, v, s->method, &patience, limit);
  s->patience -= hk_clock_seconds() - begun;
}

/* With bodies there is no bound to begin with. */
static void see_limit(struct hk_soundness *s, const double *q, const double *v) {
  double limit = 0.0;
  if (s->patience > 0.0) find_limit(s, q, v, &limit);
  if (limit == 0.0) s->unknown_limit = 1;
  if (limit > 0.0 && s->step > hk_soundness_limit_share * limit) s->least_limit = fmin(s->least_limit, limit);
}

/* The limit itself is computed only where the step is not clear of the bound, until the step is not clear of
 * a limit; after that the limit is assumed to scale with the bound, which determines the next step to try. */
static void see_step(struct hk_soundness *s, const double *q, const double *v) {
  int64_t particle;
  hk_node_blocks_fill(&s->blocks, q);
  if (hk_step_is_safe(&s->blocks, s->method, s->step / hk_soundness_limit_share, &particle)) return;
  const double bound = hk_step_bound_of(&s->blocks, s->method);
  double limit = s->limit_over_bound * bound;
  if (s->patience > 0.0 && isinf(s->least_limit)) {
    limit = bound;
    find_limit(s, q, v, &limit);
    s->limit_over_bound = limit > 0.0 && s->patience > 0.0 ? limit / bound : 1.0;
  }
  if (s->step > hk_soundness_limit_share * limit) s->least_limit = fmin(s->least_limit, limit);
}

void hk_soundness_see(struct hk_soundness *s, const hooke_state *state) {
  if (s->count == s->capacity) return;
  const struct hk_energies at = hk_state_energies(state, s->system);
  s->swing = fmax(s->swing, fabs(at.gravity - s->gravity0));
  s->time[s->count] = hooke_state_time(state);
  s->energy[s->count++] = at.kinetic + at.elastic + (at.gravity - s->gravity0);
  if (s->blocks.system) see_step(s, hooke_state_position(state), hooke_state_velocity(state));
  if (s->by_limit && !s->unknown_limit)
    see_limit(s, hooke_state_position(state), hooke_state_velocity(state));
}

void hk_soundness_release(struct hk_soundness *s) {
  hk_free(s->time);
  hk_node_blocks_release(&s->blocks);
  memset(s, 0, sizeof *s);
}

/* Slope of the least-squares line through `count` points, and its standard error. */
static double fit_slope(int64_t count, const double *x, const double *y, double *error) {
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, rest = 0.0;
  for (int64_t k = 0; k < count; k++) {
    mean_x += x[k] / (double)count;
    mean_y += y[k] / (double)count;
  }
  for (int64_t k = 0; k < count; k++) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  const double slope = xy / xx;
  for (int64_t k = 0; k < count; k++)
    rest += pow(y[k] - mean_y - slope * (x[k] - mean_x), 2.0);
  *error = sqrt(rest / (double)(count - 2) / xx);
  return slope;
}

double hk_soundness_rise(const struct hk_soundness *s) {
  if (is_driven(s->system) || s->count < LEAST_STATES) return NAN;
  const int64_t from = s->count / 2, count = s->count - from;
  const double span = s->time[s->count - 1] - s->time[from], scale = s->scale + s->swing;
  double error;
  const double slope = fit_slope(count, s->time + from, s->energy + from, &error);
  return slope > SIGNIFICANT * error && scale > 0.0 ? slope * span / scale : 0.0;
}
