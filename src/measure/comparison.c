/* Comparison: one scene by several methods, against CVODE at tight tolerance, frame by frame. */
#include "measure/comparison.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

enum { PROGRESS_STEPS = 200 };

static double root_mean_square(const hooke_comparison *c, const double *q, const double *reference,
                               double *largest) {
  double sum = 0.0;
  *largest = 0.0;
  for (int64_t k = 0; k < c->free_count; k++) {
    const int64_t i = 3 * c->free[k];
    double square = 0.0;
    for (int a = 0; a < 3; a++)
      square += (q[i + a] - reference[i + a]) * (q[i + a] - reference[i + a]);
    sum += square;
    *largest = fmax(*largest, sqrt(square));
  }
  return c->free_count > 0 ? sqrt(sum / (double)c->free_count) : 0.0;
}

static void measure_frame(hooke_comparison *c, int64_t f, const hooke_state *state, double energy) {
  struct hooke_comparison_row *row = &c->row[c->current];
  double largest;
  row->error_at[f] =
      root_mean_square(c, hooke_state_position(state), c->position + f * hooke_state_size(state), &largest);
  row->drift_at[f] = energy - c->energy[f];
  row->error = fmax(row->error, row->error_at[f]);
  row->error_max = fmax(row->error_max, largest);
  row->error_final = row->error_at[f];
  row->energy_drift = fmax(row->energy_drift, fabs(row->drift_at[f]));
}

static const char *name_of_run(const hooke_comparison *c) {
  return c->current < 0 ? "reference" : c->row[c->current].method;
}

static int32_t tell_progress(hooke_comparison *c, double t) {
  if (c->progress == NULL) return 0;
  const double share = fmin(1.0, (t - c->t0) / c->duration);
  return c->progress(((double)c->runs_done + share) / (double)(c->row_count + 1), name_of_run(c),
                     c->progress_ctx);
}

static int32_t see_step(int64_t step, const hooke_state *state, void *ctx) {
  (void)step;
  return tell_progress(ctx, hooke_state_time(state));
}

static int32_t see_frame(int64_t step, const hooke_state *state, void *ctx) {
  hooke_comparison *c = ctx;
  const int64_t f = c->frame++;
  if (f >= c->frame_count) return 0;
  const double energy =
      hooke_system_energy(c->system, hooke_state_position(state), hooke_state_velocity(state));
  if (c->current < 0) {
    c->time[f] = hooke_state_time(state);
    c->energy[f] = energy;
    memcpy(c->position + f * hooke_state_size(state), hooke_state_position(state),
           (size_t)hooke_state_size(state) * sizeof(double));
  } else {
    measure_frame(c, f, state, energy);
  }
  const int32_t value = c->on_frame ? c->on_frame(name_of_run(c), f, step, state, c->on_frame_ctx) : 0;
  return value ? value : tell_progress(c, hooke_state_time(state));
}

/* One run on a fresh state; returns its outcome, with the integrator for its counts. */
static int32_t run_once(hooke_comparison *c, const hooke_options *options, hooke_integrator **integrator) {
  hooke_state *state = NULL;
  int32_t status = hooke_integrator_create(c->system, options, integrator);
  if (status == HOOKE_OK) status = hooke_state_create(c->system, &state);
  if (status == HOOKE_OK) {
    c->frame = 0;
    c->t0 = hooke_state_time(state);
    hooke_integrator_on_frame(*integrator, see_frame, c);
    if (c->progress) hooke_integrator_on_step(*integrator, PROGRESS_STEPS, see_step, c);
    status = hooke_integrator_run(*integrator, state);
  }
  hooke_state_destroy(state);
  c->runs_done++;
  return status;
}

static int32_t run_reference(hooke_comparison *c) {
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  c->current = -1;
  int32_t status = hooke_options_copy(c->options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", c->reference);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "rtol", 1e-10);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "atol", 1e-12);
  if (status == HOOKE_OK) status = hooke_options_unset(options, "atol_velocity");
  if (status == HOOKE_OK) status = run_once(c, options, &integrator);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
  return status;
}

static void keep_counts(struct hooke_comparison_row *row, const hooke_integrator *integrator) {
  const hooke_options *options = hooke_integrator_options(integrator);
  const int adaptive = hooke_method_is_adaptive(row->method);
  row->step = adaptive ? NAN : hooke_options_number(options, "step");
  row->rtol = adaptive ? hooke_options_number(options, "rtol") : NAN;
  row->atol = adaptive ? hooke_options_number(options, "atol") : NAN;
  row->force_evaluations = (double)hooke_integrator_count(integrator, "force_evaluations");
  row->steps = (double)hooke_integrator_count(integrator, "steps");
  row->wall_seconds = hooke_integrator_wall_seconds(integrator);
}

static int32_t run_row(hooke_comparison *c, int64_t k) {
  struct hooke_comparison_row *row = &c->row[k];
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  c->current = k;
  row->error = row->error_max = row->error_final = row->energy_drift = 0.0;
  for (int64_t f = 0; f < c->frame_count; f++)
    row->error_at[f] = row->drift_at[f] = NAN;
  int32_t status = hooke_options_copy(c->options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", row->method);
  if (status == HOOKE_OK) status = run_once(c, options, &integrator);
  hooke_options_destroy(options);
  if (integrator == NULL) return status;
  keep_counts(row, integrator);
  hooke_integrator_destroy(integrator);
  row->status = status == HOOKE_OK         ? "finished"
                : status == HOOKE_DIVERGED ? "diverged"
                : status == HOOKE_STOPPED  ? "stopped"
                                           : "failed";
  if (status != HOOKE_OK) row->error = row->error_max = row->error_final = row->energy_drift = NAN;
  const int is_result =
      status == HOOKE_DIVERGED || status == HOOKE_SOLVER_FAILED || status == HOOKE_STEP_LIMIT;
  return is_result ? HOOKE_OK : status;
}

int32_t hooke_comparison_run(hooke_comparison *c) {
  if (c->runs_done > 0)
    return hooke_fail(HOOKE_BAD_CALL, NULL, "the comparison has been run; make a new one");
  int32_t status = hooke_comparison_prepare(c);
  if (status == HOOKE_OK) status = run_reference(c);
  for (int64_t k = 0; k < c->row_count && status == HOOKE_OK; k++)
    status = run_row(c, k);
  return status;
}
