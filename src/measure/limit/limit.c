/* Creating a limit, and its computation at one state and along a run. */
#include "measure/limit/limit.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/table/option.h"
#include "core/status.h"
#include "integrate/loop/run_loop.h"
#include "measure/limit/limit_measure.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Progress: predictions are quick compared with measurements. */
static const double PREDICTING = 0.05;

static const struct hk_option_row limit_rows[] = {
    HOOKE_OPTION("methods", .type = HOOKE_OPTION_TEXT, NULL,
                 "methods, separated by commas; every fixed-step one if not given"),
    HOOKE_OPTION("predict", .type = HOOKE_OPTION_FLAG, "false", "leave out the measuring"),
    HOOKE_OPTION(
        "nonlinear", .type = HOOKE_OPTION_FLAG, "false",
        "measure on the scene itself over the duration of the run, instead of on the linearised scene"),
    HOOKE_OPTION("along", .type = HOOKE_OPTION_FLAG, "false",
                 "at every frame of the run: the smallest limit met and when, predicted alone"),
    HOOKE_OPTION("accuracy", HOOKE_OPTION_BETWEEN(1e-9, 0.1), "1e-3",
                 "relative accuracy of predictions and measurements"),
    HOOKE_OPTION("budget", HOOKE_OPTION_POSITIVE("s"), "60", "time that the measuring may take"),
};

static const struct hk_option_table limit_table = {"limit", HOOKE_OPTION_ROWS(limit_rows)};

/* ---- creating ---- */

static int32_t has_fixed_step(const char *method) {
  return !hooke_method_is_adaptive(method);
}

/* Reports the fraction done of the current part; HOOKE_STOPPED if it is to end. */
static int32_t tell(double done, const char *what, void *ctx) {
  struct hk_limit *limit = ctx;
  const double share = fmin(1.0, limit->share + limit->width * fmax(0.0, fmin(1.0, done)));
  return hk_measurement_tell(limit->measurement, share, limit->under_way ? limit->under_way : what);
}

static void forget(struct hk_limit *limit) {
  limit->endless = hk_budget_of(INFINITY, tell, limit);
  limit->found = 0;
  limit->frequency = limit->decay = limit->time = NAN;
  limit->mode_count = limit->products = limit->clamped = limit->tipping = limit->limiting.count = 0;
  hk_free(limit->mode);
  limit->mode = NULL;
  hk_participation_release(&limit->participation);
  memset(&limit->participation, 0, sizeof limit->participation);
  limit->suggestion = hk_no_suggestion;
  for (int32_t k = 0; k < limit->row_count; k++) {
    struct hk_limit_row *row = &limit->row[k];
    row->bound = row->predicted = row->measured = row->steps_run = NAN;
    row->exact = row->never_stable = row->spins = row->has_mode = 0;
    row->note[0] = '\0';
  }
}

static void forget_smallest(struct hk_limit *limit) {
  for (int32_t k = 0; k < limit->row_count; k++)
    limit->row[k].smallest = limit->row[k].smallest_time = NAN, limit->row[k].unknown = 0;
}

static int32_t make_space(struct hk_limit *limit) {
  const int64_t size = 3 * limit->system->particle_count;
  double *block = hk_new(size, (size_t)(4 + limit->row_count) * sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  limit->q = hk_part(&block, size);
  limit->v = hk_part(&block, size);
  limit->shape = hk_part(&block, size);
  limit->stiffest = hk_part(&block, size);
  for (int32_t k = 0; k < limit->row_count; k++)
    limit->row[k].mode = hk_part(&block, size);
  return HOOKE_OK;
}

static int32_t create(hooke_measurement *m) {
  if (!HOOKE_HAVE_LAPACK)
    return hk_fail(HOOKE_NOT_BUILT, NULL, "limits need LAPACK, which this build is without");
  struct hk_limit *limit = m->object = hk_new(1, sizeof *limit);
  if (limit == NULL) return HOOKE_NO_MEMORY;
  limit->measurement = m;
  limit->at = hk_system_at(m->system, 0.0);
  limit->system = &limit->at;
  limit->run = m->run;
  limit->options = m->options;
  limit->budget = &limit->endless;
  const char *method[HOOKE_LISTED_METHODS];
  int32_t status = hk_method_list_read(limit->system, hooke_options_text(limit->options, "methods"),
                                       has_fixed_step, method, &limit->row_count);
  for (int32_t k = 0; k < limit->row_count; k++)
    limit->row[k].method = method[k];
  if (status == HOOKE_OK) status = make_space(limit);
  forget(limit);
  forget_smallest(limit);
  return status;
}

static void destroy(void *object) {
  struct hk_limit *limit = object;
  if (limit == NULL) return;
  forget(limit);
  hk_free(limit->q);
  hk_free(limit);
}

static int32_t begin_part(struct hk_limit *limit, double share, double width, const char *under_way) {
  limit->share = share;
  limit->width = width;
  limit->under_way = under_way;
  return tell(0.0, under_way, limit);
}

/* ---- one state ---- */

const struct hk_limit_row *hk_limit_limiting_row(const struct hk_limit *limit) {
  const char *method =
      limit->run ? hooke_options_text(limit->run, "method") : hk_method_of_euler(limit->system);
  const struct hk_limit_row *first = NULL;
  for (int32_t k = 0; k < limit->row_count; k++) {
    const struct hk_limit_row *row = &limit->row[k];
    if (!row->has_mode) continue;
    if (strcmp(row->method, method) == 0) return row;
    if (first == NULL || (first->predicted == 0.0 && row->predicted > 0.0)) first = row;
  }
  return first;
}

static void remember(struct hk_limit *limit, const double *q, const double *v, double t) {
  const size_t bytes = 3 * (size_t)limit->system->particle_count * sizeof(double);
  memcpy(limit->q, q, bytes);
  if (v) memcpy(limit->v, v, bytes);
  limit->time = t;
}

/* The mode, the springs and particles that limit the step in it, and a suggestion. */
static int32_t find_participation(struct hk_limit *limit) {
  const struct hk_limit_row *row = hk_limit_limiting_row(limit);
  if (row == NULL) return HOOKE_OK;
  const int64_t n = limit->system->particle_count;
  double longest = 0.0;
  for (int64_t p = 0; p < n; p++) {
    const double *u = row->mode + 3 * p;
    longest = fmax(longest, sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]));
  }
  for (int64_t k = 0; k < 3 * n; k++)
    limit->shape[k] = longest > 0.0 ? row->mode[k] / longest : 0.0;
  /* if no step is stable, only stiffness is considered */
  const int stiffness_alone =
      hk_method_stability_in(row->method, limit->system)->damps_implicitly || !(row->predicted > 0.0);
  const double h = stiffness_alone ? 0.0 : row->predicted;
  int32_t status = hk_participation_find(limit->system, limit->q, limit->v, limit->shape,
                                         stiffness_alone ? 1.0 : h * h, h, &limit->participation);
  if (status == HOOKE_OK) hk_limiting_take(&limit->participation, &limit->limiting);
  limit->participation.undamped = 2.0 / limit->frequency;
  limit->participation.budget = limit->budget;
  limit->participation.memory = limit->memory;
  if (status == HOOKE_OK && row->predicted > 0.0)
    status = hk_suggestion_find(limit->system, limit->q, row->method, row->predicted, &limit->participation,
                                &limit->suggestion);
  return status;
}

static void add_note(struct hk_limit_row *row, const char *note) {
  if (note && note[0]) hk_append(row->note, sizeof row->note, "%s%s", row->note[0] ? "; " : "", note);
}

static int32_t measure_row(struct hk_limit *limit, struct hk_limit_row *row, const hooke_state *state,
                           struct hk_budget *budget) {
  const double accuracy = hooke_options_number(limit->options, "accuracy");
  const double *q = hooke_state_position((hooke_state *)state);
  const double start = isnan(row->predicted) ? row->bound : row->predicted;
  struct hk_measured_limit m = {.step = NAN, .note = ""};
  const int nonlinear = hooke_options_number(limit->options, "nonlinear") != 0.0;
  if (row->spins && !nonlinear) return HOOKE_OK; /* what runs is at rest */
  const int32_t status = nonlinear ? hk_limit_measure_nonlinear(limit->measurement->system, state, limit->run,
                                                                row->method, start, accuracy, budget, &m)
                                   : hk_limit_measure(limit, row, q, state->v, start, accuracy, budget, &m);
  if (status != HOOKE_OK) return status;
  row->measured = m.step;
  row->steps_run = (double)m.steps_run;
  row->never_stable |= m.never_stable && !nonlinear;
  add_note(row, m.note);
  return HOOKE_OK;
}

/* The unused budget of a row goes to later ones. */
static int32_t measure(struct hk_limit *limit, const hooke_state *state) {
  const double seconds = hooke_options_number(limit->options, "budget");
  const double width = (1.0 - PREDICTING) / limit->row_count;
  struct hk_budget budget = hk_budget_of(seconds, tell, limit);
  for (int32_t k = 0; k < limit->row_count; k++) {
    struct hk_limit_row *row = &limit->row[k];
    if (hooke_method_is_adaptive(row->method)) continue;
    int32_t status = begin_part(limit, PREDICTING + k * width, width, row->method);
    hk_budget_lend(&budget, 1.0 / (limit->row_count - k));
    if (status == HOOKE_OK) status = measure_row(limit, row, state, &budget);
    if (status != HOOKE_OK) return status;
    hk_budget_take_back(&budget);
  }
  return begin_part(limit, 1.0, 0.0, "done");
}

int32_t hk_limit_look(struct hk_limit *limit, const double *q, const double *v, double t) {
  forget(limit);
  forget_smallest(limit);
  remember(limit, q, v, t);
  limit->at.moment = t;
  int32_t status = begin_part(limit, 0.0, PREDICTING, "eigenvalues");
  if (status == HOOKE_OK) status = hk_limit_predict_rows(limit, limit->q, v);
  return status == HOOKE_OK ? find_participation(limit) : status;
}

int32_t hk_limit_price(struct hk_limit *limit) {
  const struct hk_limit_row *row = hk_limit_limiting_row(limit);
  if (row == NULL) return HOOKE_OK;
  limit->width = 0.0;
  limit->under_way = NULL;
  return hk_suggestion_price(limit->measurement->system, limit->run, row->method, row->predicted,
                             &limit->participation, limit->budget, &limit->suggestion);
}

static int32_t find(struct hk_limit *limit, const hooke_state *state) {
  int32_t status = hk_limit_look(limit, state->q, state->v, *state->t);
  if (status == HOOKE_OK) status = hk_limit_price(limit);
  const int predict = hooke_options_number(limit->options, "predict") != 0.0;
  return status == HOOKE_OK && !predict ? measure(limit, state) : status;
}

/* ---- along a run ---- */

struct walk {
  struct hk_limit *limit;
  int64_t frame, frame_count;
  int32_t status;
};

static int32_t see_frame(int64_t step, const hooke_state *state, void *ctx) {
  (void)step;
  struct walk *walk = ctx;
  struct hk_limit *limit = walk->limit;
  forget(limit);
  limit->at.moment = hooke_state_time(state);
  walk->status =
      begin_part(limit, (double)walk->frame++ / (double)walk->frame_count, 0.0, "limits along the run");
  if (walk->status == HOOKE_OK) walk->status = hk_limit_predict_rows(limit, state->q, state->v);
  for (int32_t k = 0; k < limit->row_count && walk->status == HOOKE_OK; k++) {
    struct hk_limit_row *row = &limit->row[k];
    row->unknown += isnan(row->predicted);
    if (row->predicted >= row->smallest || isnan(row->predicted)) continue;
    row->smallest = row->predicted;
    if (isfinite(row->predicted)) row->smallest_time = hooke_state_time(state);
  }
  return walk->status != HOOKE_OK;
}

static int32_t see_steps(double done, const char *method, void *ctx) {
  struct walk *walk = ctx;
  (void)method;
  walk->status = begin_part(walk->limit, done, 0.0, "limits along the run");
  return walk->status != HOOKE_OK;
}

/* The smallest prediction is that of the other frames. */
static void note_unknown(struct hk_limit *limit, int64_t frames) {
  char note[96];
  for (int32_t k = 0; k < limit->row_count; k++) {
    struct hk_limit_row *row = &limit->row[k];
    if (row->unknown == 0) continue;
    snprintf(note, sizeof note, "along the run not known at %lld of %lld frames", (long long)row->unknown,
             (long long)frames);
    add_note(row, note);
  }
}

static int32_t go_along(struct hk_limit *limit, hooke_state *state) {
  hooke_integrator *integrator = NULL;
  if (limit->run == NULL) {
    return hk_fail(HOOKE_BAD_VALUE, "run",
                   "limits along a run need the options of the run; they were not given");
  }
  int32_t status = hooke_integrator_create(limit->measurement->system, limit->run, &integrator);
  if (status != HOOKE_OK) return status;
  forget(limit);
  forget_smallest(limit);
  struct walk walk = {limit, 0, hooke_integrator_count(integrator, "frames"), HOOKE_OK};
  status = hooke_integrator_on_frame(integrator, see_frame, &walk);
  if (status == HOOKE_OK) status = hooke_integrator_on_progress(integrator, 0.0, see_steps, &walk);
  if (status == HOOKE_OK) status = hk_run_whole(integrator, state);
  hooke_integrator_destroy(integrator);
  remember(limit, hooke_state_position(state), hooke_state_velocity(state), hooke_state_time(state));
  if (walk.status != HOOKE_OK) return walk.status;
  note_unknown(limit, walk.frame);
  if (status < 0 || !limit->found) return status;
  int32_t found = find_participation(limit);
  if (found == HOOKE_OK) found = hk_limit_price(limit);
  return found != HOOKE_OK ? found : status;
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  const int along = hooke_options_number(m->options, "along") != 0.0;
  return along ? go_along(m->object, state) : find(m->object, state);
}

const struct hk_measurement_kind hk_limit_kind = {
    .name = "limit",
    .options = &limit_table,
    .takes_state = 1,
    .tables = hk_limit_tables,
    .claim = hk_limit_claim,
    .create = create,
    .run = run,
    .destroy = destroy,
};
