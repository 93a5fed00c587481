/* The rows of a study: each a run for its error, repeated for its time; the ladders, level by level; the rows
 * of a level run side by side. */
#include "measure/study/study.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/status.h"
#include "measure/trial/side_by_side.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* With a wanted error, the search gets this fraction of a budget, but at most this of the remaining time. */
static const double SEARCH_SHARE = 0.2, MOST_SEARCH = 0.5;

/* A short run is repeated until its time is steady or this much has been spent on it, and this share of a
 * budget. */
static const double REPEAT_SECONDS = 0.01, REPEAT_SHARE = 0.005;
static const double STEADY = 1.03;
enum { MOST_REPEATS = 9 };

/* A ladder ends where its next row has so many times the counted work of the cheapest run that meets the
 * want. Until one does, rows are run together that are so much alike in work. */
static const double WINS_NO_MORE = 5.0, ALIKE = 2.0;
static const double TENTH_COSTS = 1.6; /* of the work, where a tolerance falls to a tenth */

/* Fraction of the remaining time for a first row, whose time is unknown: others must have their turn. */
static const double UNKNOWN_SHARE = 0.1;

/* ---- a row ---- */

int32_t hk_study_row_options(const struct hk_study *study, int32_t method, double value,
                             hooke_options **out) {
  int32_t status = hooke_options_copy(study->m->run, out);
  if (status == HOOKE_OK && study->once && value == hk_study_ladder(study, method, 0))
    status = hooke_options_set_text(*out, "method", study->method[method]);
  else if (status == HOOKE_OK)
    status = hk_trial_set_value(*out, study->method[method], value);
  /* rows in parallel, each on its own thread */
  return status == HOOKE_OK && !study->once ? hooke_options_set_number(*out, "threads", 1) : status;
}

int32_t hk_study_run_options(const struct hk_study *study, int64_t row, hooke_options **out) {
  struct hk_reference r = study->reference;
  if (row >= 0) return hk_study_row_options(study, study->row[row].method, study->row[row].value, out);
  r.extent = r.run_extent;
  return hk_reference_options(study->m->run, r.method, r.rtol, &r, out);
}

static int compare_seconds(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Repeats a short run for its time. The first one warms up; it counts only if it is the only one. */
static int32_t time_row(struct hk_study *study, struct hk_study_row *row) {
  const struct hk_listener listener = {.on_progress = hk_stage_tell, .ctx = &study->stage};
  const struct hk_reference *r = &study->reference;
  double seconds[MOST_REPEATS], spent = row->trial.wall_seconds;
  const double most = fmin(REPEAT_SECONDS, REPEAT_SHARE * study->budget);
  int32_t count = 0;
  hooke_options *options = NULL;
  if (study->once || strcmp(row->trial.status, "finished") != 0 || spent >= most) return HOOKE_OK;
  study->stage.what = study->method[row->method];
  int32_t status = hk_study_row_options(study, row->method, row->value, &options);
  while (status == HOOKE_OK && count < MOST_REPEATS && spent < most) {
    status = hk_trial_run(&row->trial, &r->frames, r->trusted, options, &listener);
    seconds[count++] = row->trial.wall_seconds;
    spent += row->trial.wall_seconds;
    qsort(seconds, (size_t)count, sizeof seconds[0], compare_seconds);
    if (count >= 3 && seconds[1] <= STEADY * seconds[0]) break;
  }
  hooke_options_destroy(options);
  if (count == 0) return status;
  row->repeats = count;
  row->timed_alone = 1;
  row->wall_median = seconds[count / 2];
  row->trial.wall_seconds = seconds[0];
  return status;
}

/* ---- the error of one step ---- */

enum { PARTS = 16 };              /* steps of rk4 for one step of the method */
static const double KNOWN = 1e-2; /* fraction of the error by which those and half as many may differ */
static const double CLEAR = 1e2;  /* of what positions can hold: below that, rounding hides the error */

/* The state one step of a row after a state within the reference, by the row's method or, in `parts`, by rk4;
 * NULL where that gives up. */
static int32_t step_on(const struct hk_study *study, const struct hk_study_row *row, int64_t parts,
                       hooke_state **state) {
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  int32_t status = hk_study_row_options(study, row->method, row->value, &options);
  if (status == HOOKE_OK && parts > 1)
    status = hk_trial_set_value(options, hk_rk4.name, row->value / (double)parts);
  if (status == HOOKE_OK) status = hooke_options_unset(options, "duration");
  if (status == HOOKE_OK) status = hooke_options_unset(options, "every");
  if (status == HOOKE_OK) status = hooke_integrator_create(study->m->system, options, &integrator);
  if (status == HOOKE_OK) status = hooke_state_create(study->m->system, state);
  if (status == HOOKE_OK) status = hooke_state_copy(study->reference.frames.within, *state);
  if (status == HOOKE_OK) status = hooke_integrator_step(integrator, *state, parts);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
  if (!hk_trial_gave_up(status)) return status;
  hooke_state_destroy(*state);
  *state = NULL;
  return HOOKE_OK;
}

static int32_t measure_step(const struct hk_study *study, struct hk_study_row *row) {
  const struct hk_reference *r = &study->reference;
  const int64_t parts[3] = {1, PARTS, PARTS / 2};
  hooke_state *by[3] = {NULL, NULL, NULL};
  int32_t status = HOOKE_OK;
  row->error_step = NAN;
  if (study->once || hk_study_is_adaptive(study, row->method) || r->trusted <= hk_frames_within(&r->frames))
    return HOOKE_OK;
  for (int32_t k = 0; k < 3 && status == HOOKE_OK; k++)
    status = step_on(study, row, parts[k], &by[k]);
  if (status == HOOKE_OK && by[0] && by[1] && by[2]) {
    const double *q = hooke_state_position(by[1]);
    const double error = hk_frames_apart(&r->frames, q, hooke_state_position(by[0]), NULL),
                 doubt = hk_frames_apart(&r->frames, q, hooke_state_position(by[2]), NULL);
    const int known = doubt <= KNOWN * error && error > CLEAR * hk_frames_resolution(&r->frames, q);
    row->error_step = known ? error : NAN;
  }
  for (int32_t k = 0; k < 3; k++)
    hooke_state_destroy(by[k]);
  return status;
}

/* ---- the rows to come ---- */

/* Time and counted work of the next row of a method [s], by its last finished ones, and the least error of
 * all to come that take less than so much work: by the order that three rows show, or that of the method if
 * it is lower. NaN before the first and the third. */
struct outlook {
  double seconds, work, error;
};

static struct outlook predict(const struct hk_study *study, int32_t method, double value, double most) {
  const int32_t adaptive = hk_study_is_adaptive(study, method);
  const struct hk_study_row *last[3];
  int32_t count = 0;
  for (int64_t k = study->row_count - 1; k >= 0 && count < 3; k--)
    if (study->row[k].method == method && strcmp(study->row[k].trial.status, "finished") == 0)
      last[count++] = &study->row[k];
  if (count == 0) return (struct outlook){NAN, NAN, NAN};
  const struct hk_trial *fine = &last[0]->trial;
  const double growth = adaptive ? TENTH_COSTS : last[0]->value / value,
               rows = log(most / fine->work) / log(adaptive ? TENTH_COSTS : 2.0);
  double error = NAN;
  if (count == 3) {
    const double own = adaptive ? 10.0 : exp2((double)hk_method_find(study->method[method])->order),
                 fall = fmin(own, fmax(1.0, sqrt(last[2]->trial.wanted / fine->wanted)));
    error = fine->wanted * pow(fall, -rows);
  }
  return (struct outlook){fine->wall_seconds * growth, fine->work * growth, error};
}

/* The least counted work of a run that meets the want [s], a row or, among all methods, the reference;
 * infinity without one, or where the caller has chosen the rows. */
static double least_work(const struct hk_study *study) {
  const struct hk_reference *r = &study->reference;
  const int all = r->trusted == r->frames.count && !r->coarse;
  double least = INFINITY;
  if (isnan(study->wants.most) || hk_study_chosen_ladder(study)) return INFINITY;
  if (all && !hooke_options_is_set(study->m->options, "methods")) least = r->run_work;
  for (int64_t k = 0; k < study->row_count; k++) {
    const struct hk_trial *trial = &study->row[k].trial;
    if (trial->wanted <= study->wants.most && strcmp(trial->status, "finished") == 0)
      least = fmin(least, trial->work);
  }
  return least;
}

/* ---- the rows of a level ---- */

struct job {
  double fraction; /* maximum fraction of the remaining time when it begins */
  double deadline;
  int32_t late; /* 1: that ended it */
  struct hk_turn *turn;
  struct hk_study_row row;
};

struct level {
  struct hk_study *study;
  int32_t count;
  struct job job[HOOKE_STUDY_METHODS];
};

static int32_t tell_job(double fraction, void *ctx) {
  const struct job *job = ctx;
  return hk_turn_tell(fraction, job->turn) || hk_clock_seconds() >= job->deadline;
}

/* One value of a method, for its error. */
static int32_t run_job(struct hk_turn *turn, void *ctx) {
  struct level *level = ctx;
  struct hk_study *study = level->study;
  const struct hk_reference *r = &study->reference;
  struct job *job = &level->job[turn->number];
  struct hk_study_row *row = &job->row;
  const struct hk_listener listener = {.on_progress = tell_job, .ctx = job};
  const double now = hk_clock_seconds();
  hooke_options *options = NULL;
  if (turn->worker == 0) study->stage.what = study->method[row->method];
  job->turn = turn;
  job->deadline = now + job->fraction * (study->deadline - now);
  int32_t status = hk_study_row_options(study, row->method, row->value, &options);
  if (status == HOOKE_OK) status = hk_trial_run(&row->trial, &r->frames, r->trusted, options, &listener);
  if (status == HOOKE_OK) status = measure_step(study, row);
  hooke_options_destroy(options);
  row->wall_median = row->trial.wall_seconds;
  row->repeats = 1;
  row->timed_alone = !turn->serial;
  job->late = status == HOOKE_STOPPED && hk_clock_seconds() >= job->deadline;
  return job->late ? HOOKE_OK : status;
}

/* Runs rows side by side first, for the errors; then short rows again, alone, for their times. */
static int32_t run_level(struct level *level) {
  struct hk_study *study = level->study;
  int32_t status =
      hk_run_side_by_side(study->m, study->once, level->count, run_job, level, hk_stage_tell, &study->stage);
  for (int32_t k = 0; k < level->count && status == HOOKE_OK; k++) {
    struct job *job = &level->job[k];
    if (job->late) {
      hk_trial_release(&job->row.trial);
      study->late = study->budget_spent = study->given_up[job->row.method] = 1;
    } else {
      status = time_row(study, &job->row);
    }
  }
  return status;
}

int32_t hk_study_measure(struct hk_study *study, int32_t method, double value, struct hk_study_row *row) {
  struct level level = {
      .study = study, .count = 1, .job = {{.fraction = 1.0, .row = {.method = method, .value = value}}}};
  const int32_t status = run_level(&level);
  *row = level.job[0].row;
  return status;
}

/* Rows that ran, even a stopped one, are kept. */
static int32_t keep_rows(struct level *level) {
  struct hk_study *study = level->study;
  const int64_t most = study->row_count + level->count;
  const int32_t status = hk_grow((void **)&study->row, study->row_count, most, sizeof *study->row);
  for (int32_t k = 0; k < level->count; k++) {
    struct job *job = &level->job[k];
    if (status == HOOKE_OK && job->row.trial.status)
      study->row[study->row_count++] = job->row;
    else
      hk_trial_release(&job->row.trial);
  }
  return status;
}

/* The next row of each ladder that the budget still allows or, where ladders are cut, of those whose rows are
 * the cheapest: one that meets the want spares the others theirs. */
static void plan_level(struct hk_study *study, int32_t next[HOOKE_STUDY_METHODS], struct level *level) {
  const double most = WINS_NO_MORE * least_work(study);
  struct outlook row[HOOKE_STUDY_METHODS];
  double value[HOOKE_STUDY_METHODS], cheapest = INFINITY, ahead = 0.0;
  for (int32_t m = 0; m < study->method_count; m++) {
    value[m] = study->given_up[m] ? NAN : hk_study_ladder(study, m, next[m]);
    row[m] = predict(study, m, value[m], most);
    if (isfinite(most) && !isnan(value[m]))
      study->cut[m] |= row[m].work >= most || row[m].error > study->wants.most;
    if (study->cut[m]) value[m] = NAN;
    if (!isnan(value[m])) cheapest = fmin(cheapest, row[m].work);
  }
  for (int32_t m = 0; m < study->method_count; m++) {
    if (isnan(value[m]) || (isfinite(most) && row[m].work > ALIKE * cheapest)) continue;
    /* the time of a first row is unknown: it is begun, and ends when its share of time is over */
    const double seconds = fmax(0.0, row[m].seconds);
    if (hk_clock_seconds() + ahead + seconds > study->deadline) {
      study->budget_spent = study->given_up[m] = 1;
      continue;
    }
    next[m]++;
    ahead += seconds;
    level->job[level->count++] = (struct job){.fraction = isnan(row[m].seconds) ? UNKNOWN_SHARE : 1.0,
                                              .row = {.method = m, .value = value[m]}};
  }
}

static double end_of_rows(const struct hk_study *study) {
  const double end = study->begun + study->budget, left = end - hk_clock_seconds();
  if (isnan(study->wants.most) || isinf(end)) return end;
  return end - fmin(SEARCH_SHARE * study->budget, MOST_SEARCH * left);
}

int32_t hk_study_run_ladders(struct hk_study *study) {
  const double levels = hooke_options_number(study->m->options, "points");
  int32_t status = HOOKE_OK, next[HOOKE_STUDY_METHODS] = {0};
  struct level *level = hk_new(1, sizeof *level);
  if (level == NULL) return HOOKE_NO_MEMORY;
  study->deadline = end_of_rows(study);
  while (status == HOOKE_OK) {
    *level = (struct level){.study = study};
    plan_level(study, next, level);
    if (level->count == 0) break;
    const double done = (double)(study->row_count + level->count) / study->method_count;
    hk_stage_begin(&study->stage, "rows",
                   HOOKE_STUDY_REFERENCE +
                       (HOOKE_STUDY_ROWS - HOOKE_STUDY_REFERENCE) * fmin(1.0, exp2(done - levels)));
    status = run_level(level);
    const int32_t kept = keep_rows(level);
    if (status == HOOKE_OK) status = kept;
  }
  hk_free(level);
  return status;
}
