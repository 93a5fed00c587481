#include "measure/recommend/soundness.h"

#include "core/memory.h"
#include "measure/counted_work/work.h"
#include "measure/limit/limit_predict.h"
#include "measure/spectrum/step_bound.h"
#include "model/force/force.h"

#include <math.h>
#include <string.h>

const double hk_soundness_most_rise = 0.01, hk_soundness_limit_share = 0.9;

enum { LEAST_STATES = 8 };
static const double SIGNIFICANT = 3.0; /* standard errors */

static int is_driven(const hooke_system *system) {
  return system->force != NULL || hk_system_takes_work(system);
}

static int32_t make_states(struct hk_soundness *s) {
  const int64_t size = 3 * s->system->particle_count;
  double *block = hk_new(2 * HOOKE_SOUNDNESS_STATES * size, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  for (int k = 0; k < HOOKE_SOUNDNESS_STATES; k++)
    s->at[k] = (struct hk_soundness_state){INFINITY, hk_part(&block, size), hk_part(&block, size), NAN};
  return HOOKE_OK;
}

int32_t hk_soundness_begin(struct hk_soundness *s, const hooke_system *system, const char *method,
                           double step, const hooke_state *state, int64_t capacity) {
  *s = (struct hk_soundness){
      .system = system, .method = method, .step = step, .least_limit = INFINITY, .capacity = capacity};
  s->time = hk_new(2 * capacity, sizeof(double));
  if (s->time == NULL) return HOOKE_NO_MEMORY;
  s->energy = s->time + capacity;
  const struct hk_energies at = hk_state_energies(state, system);
  s->gravity0 = at.gravity;
  s->scale = at.kinetic + at.elastic;
  if (!hk_step_is_bounded(method)) s->step = NAN;
  if (isnan(s->step)) return HOOKE_OK;
  const int32_t status = make_states(s);
  if (status != HOOKE_OK || system->mover_count > 0) return status;
  return hk_node_blocks_create(system, hooke_state_position(state), hooke_state_velocity(state), &s->blocks);
}

/* The bound where the step is not clear of it. */
static double see_bound(struct hk_soundness *s, const hooke_state *state) {
  const double clear = s->step / hk_soundness_limit_share;
  if (s->blocks.system == NULL) return 0.0;
  hk_node_blocks_fill(&s->blocks, *state->t, state->q, state->v);
  const double bound = hk_step_bound_of(&s->blocks, s->method, clear, NULL);
  return bound < clear ? bound : INFINITY;
}

static void see_step(struct hk_soundness *s, const hooke_state *state) {
  const double bound = see_bound(s, state);
  struct hk_soundness_state *at = &s->at[s->count > 0];
  if (isinf(bound) || (s->count > 0 && bound > at->bound)) return;
  const size_t bytes = 3 * (size_t)s->system->particle_count * sizeof(double);
  at->bound = bound;
  at->t = hooke_state_time(state);
  memcpy(at->q, hooke_state_position(state), bytes);
  memcpy(at->v, hooke_state_velocity(state), bytes);
}

void hk_soundness_see(struct hk_soundness *s, const hooke_state *state) {
  if (s->count == s->capacity) return;
  if (!isnan(s->step)) see_step(s, state);
  const struct hk_energies at = hk_state_energies(state, s->system);
  s->swing = fmax(s->swing, fabs(at.gravity - s->gravity0));
  s->time[s->count] = hooke_state_time(state);
  s->energy[s->count++] = at.kinetic + at.elastic + (at.gravity - s->gravity0);
}

int32_t hk_soundness_find_limits(struct hk_soundness *s, struct hk_budget *budget) {
  int32_t status = HOOKE_OK;
  for (int k = 0; k < HOOKE_SOUNDNESS_STATES && !isnan(s->step) && status == HOOKE_OK; k++) {
    double limit = s->at[k].bound;
    if (isinf(limit)) continue;
    const hooke_system at = hk_system_at(s->system, s->at[k].t);
    status = hk_limit_sure(&at, s->at[k].q, s->at[k].v, s->method, budget, &limit);
    s->unknown_limit |= !(limit > 0.0) && s->system->mover_count > 0;
    if (!(limit > 0.0) && s->system->mover_count > 0) continue;
    if (s->step > hk_soundness_limit_share * limit) s->least_limit = fmin(s->least_limit, limit);
  }
  return status;
}

double hk_soundness_work(const struct hk_soundness *s) {
  return s->blocks.system ? (double)s->count * hk_work_of_pass(s->system) : 0.0;
}

void hk_soundness_release(struct hk_soundness *s) {
  hk_free(s->time);
  hk_free(s->at[0].q);
  hk_node_blocks_release(&s->blocks);
  memset(s, 0, sizeof *s);
}

double hk_fit_slope(int64_t count, const double *x, const double *y, double *error) {
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
  const double slope = hk_fit_slope(count, s->time + from, s->energy + from, &error);
  return slope > SIGNIFICANT * error && scale > 0.0 ? slope * span / scale : 0.0;
}

int32_t hk_soundness_holds(const struct hk_soundness *s) {
  return isinf(s->least_limit) && !(hk_soundness_rise(s) > hk_soundness_most_rise);
}
