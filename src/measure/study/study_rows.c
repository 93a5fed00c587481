/* The rows of a study: each a run for its error, repeated for its time; the ladders, level by level; on
 * several threads the rows of a level run in parallel. */
#include "measure/study/study.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* With a wanted error, the search gets this fraction of a budget, or so many times the run of the reference,
 * but at most this fraction of the remaining time. */
static const double SEARCH_SHARE = 0.2, SEARCH_RUNS = 2.0, MOST_SEARCH = 0.5;
static const double REPEATS = 4.0; /* of a short row, for its time */

/* A short run is repeated until its time is steady or this much has been spent on it, and this share of a
 * budget. */
static const double REPEAT_SECONDS = 0.04, REPEAT_SHARE = 0.005;
static const double STEADY = 1.03;
enum { MOST_REPEATS = 9 };

/* A ladder ends where its next row has so many times the counted work of the cheapest one that meets the
 * want. */
static const double WINS_NO_MORE = 5.0;

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

/* The first run warms up; it counts only if it is the only one. */
static int32_t repeat_for_time(struct hk_study *study, const hooke_options *options,
                               const struct hk_listener *listener, struct hk_study_row *row) {
  double seconds[MOST_REPEATS], spent = row->trial.wall_seconds;
  int32_t count = 0, status = HOOKE_OK;
  const struct hk_reference *r = &study->reference;
  const double most = fmin(REPEAT_SECONDS, REPEAT_SHARE * study->budget);
  while (status == HOOKE_OK && count < MOST_REPEATS && spent < most) {
    status = hk_trial_run(&row->trial, &r->frames, r->trusted, options, listener);
    seconds[count++] = row->trial.wall_seconds;
    spent += row->trial.wall_seconds;
    qsort(seconds, (size_t)count, sizeof seconds[0], compare_seconds);
    if (count >= 3 && seconds[1] <= STEADY * seconds[0]) break;
  }
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

/* One value of a method, for its error; several threads may do so at a time. */
static int32_t run_row(const struct hk_study *study, int32_t method, double value,
                       const struct hk_listener *listener, struct hk_study_row *row) {
  const struct hk_reference *r = &study->reference;
  hooke_options *options = NULL;
  *row = (struct hk_study_row){.method = method, .value = value, .repeats = 1, .timed_alone = 1};
  int32_t status = hk_study_row_options(study, method, value, &options);
  if (status == HOOKE_OK) status = hk_trial_run(&row->trial, &r->frames, r->trusted, options, listener);
  if (status == HOOKE_OK) status = measure_step(study, row);
  row->wall_median = row->trial.wall_seconds;
  hooke_options_destroy(options);
  return status;
}

/* Then, if that was short, repeated for its time. */
static int32_t time_row(struct hk_study *study, struct hk_study_row *row) {
  const struct hk_listener listener = {.on_progress = hk_study_tell, .ctx = study};
  hooke_options *options = NULL;
  if (study->once || strcmp(row->trial.status, "finished") != 0) return HOOKE_OK;
  study->under_way = study->method[row->method];
  int32_t status = hk_study_row_options(study, row->method, row->value, &options);
  if (status == HOOKE_OK) status = repeat_for_time(study, options, &listener, row);
  hooke_options_destroy(options);
  return status;
}

int32_t hk_study_measure(struct hk_study *study, int32_t method, double value, struct hk_study_row *row) {
  const struct hk_listener listener = {.on_progress = hk_study_tell_row, .ctx = study};
  study->under_way = study->method[method];
  study->late = 0;
  const int32_t status = run_row(study, method, value, &listener, row);
  if (status == HOOKE_STOPPED && study->late) {
    hk_trial_release(&row->trial);
    study->budget_spent = 1;
    return HOOKE_OK;
  }
  return status == HOOKE_OK ? time_row(study, row) : status;
}

/* ---- times of rows ---- */

/* Time and counted work of the next row of a method [s]: those of its last finished row, scaled by the steps;
 * NaN before the first. */
struct cost {
  double seconds, work;
};

static struct cost predict(const struct hk_study *study, int32_t method, double value) {
  for (int64_t k = study->row_count - 1; k >= 0; k--) {
    const struct hk_study_row *row = &study->row[k];
    if (row->method != method || strcmp(row->trial.status, "finished") != 0) continue;
    const double growth = hk_study_is_adaptive(study, method) ? 1.6 : row->value / value;
    return (struct cost){row->trial.wall_seconds * growth, row->trial.work * growth};
  }
  return (struct cost){NAN, NAN};
}

/* The least counted work of a row that meets the want [s]; infinity without one, or where the caller has
 * chosen the rows. */
static double least_work(const struct hk_study *study) {
  double least = INFINITY;
  if (hk_study_chosen_ladder(study)) return INFINITY;
  for (int64_t k = 0; k < study->row_count; k++) {
    const struct hk_trial *trial = &study->row[k].trial;
    if (trial->wanted <= study->wants.most && strcmp(trial->status, "finished") == 0)
      least = fmin(least, trial->work);
  }
  return least;
}

static double expect_seconds(const struct hk_study *study, int32_t method, double value) {
  const double predicted = predict(study, method, value).seconds;
  return isnan(predicted) ? hk_study_guess(study, method, value) : predicted;
}

static double seconds_ahead(const struct hk_study *study, int32_t level) {
  double sum = 0.0;
  for (int32_t m = 0; m < study->method_count; m++) {
    for (int32_t k = level; !study->cut[m] && !isnan(hk_study_ladder(study, m, k)); k++) {
      const double once = expect_seconds(study, m, hk_study_ladder(study, m, k));
      sum += once + fmin(REPEATS * once, REPEAT_SECONDS);
    }
  }
  return sum;
}

/* ---- the rows of a level ---- */

struct job {
  int32_t method;
  double value, expected; /* step or rtol; time [s] */
  double fraction;        /* maximum fraction of the remaining time when it begins */
  double deadline;
  struct level *level;
  struct hk_study_row row;
  int32_t status;
  char message[512]; /* messages belong to the thread that failed */
};

struct level {
  struct hk_study *study;
  int32_t count;
  struct job job[HOOKE_STUDY_METHODS];
  atomic_int next, stop, running;
};

static int32_t asked_to_stop(double fraction, void *ctx) {
  const struct job *job = ctx;
  (void)fraction;
  return atomic_load(&job->level->stop) || hk_clock_seconds() >= job->deadline;
}

static double deadline_of(const struct job *job, const struct hk_study *study) {
  const double now = hk_clock_seconds();
  return now + job->fraction * (study->deadline - now);
}

static void *work(void *ctx) {
  struct level *level = ctx;
  for (int32_t k; (k = atomic_fetch_add(&level->next, 1)) < level->count && !atomic_load(&level->stop);) {
    struct job *job = &level->job[k];
    const struct hk_listener listener = {.on_progress = asked_to_stop, .ctx = job};
    job->deadline = deadline_of(job, level->study);
    job->status = run_row(level->study, job->method, job->value, &listener, &job->row);
    job->row.timed_alone = 0;
    if (job->status != HOOKE_OK) snprintf(job->message, sizeof job->message, "%s", hooke_last_error());
  }
  atomic_fetch_sub(&level->running, 1);
  return NULL;
}

/* Runs rows in parallel first, for the errors; then short rows again, alone, for their times. The caller's
 * thread works too, or reports progress, which no other thread does. */
static int32_t run_side_by_side(struct level *level, int32_t threads) {
  pthread_t thread[HOOKE_STUDY_METHODS];
  int32_t started = 0;
  atomic_store(&level->running, 0);
  for (int32_t k = 0; k < threads && k < level->count; k++) {
    atomic_fetch_add(&level->running, 1);
    if (pthread_create(&thread[k], NULL, work, level) != 0) {
      atomic_fetch_sub(&level->running, 1);
      break;
    }
    started++;
  }
  if (started == 0) {
    atomic_fetch_add(&level->running, 1);
    work(level);
  }
  level->study->under_way = "rows side by side";
  level->study->late = 0;
  level->study->row_deadline = level->study->deadline;
  while (atomic_load(&level->running) > 0) {
    const struct timespec moment = {0, 20000000};
    nanosleep(&moment, NULL);
    if (hk_study_tell_row(0.0, level->study) != 0) atomic_store(&level->stop, 1);
  }
  for (int32_t k = 0; k < started; k++)
    pthread_join(thread[k], NULL);
  int32_t status = HOOKE_OK;
  for (int32_t k = 0; k < level->count && status == HOOKE_OK; k++) {
    struct job *job = &level->job[k];
    if (job->status == HOOKE_STOPPED && hk_clock_seconds() >= job->deadline) {
      hk_trial_release(&job->row.trial);
      level->study->budget_spent = level->study->given_up[job->method] = 1;
    } else if (job->status != HOOKE_OK)
      status = hk_fail(job->status, NULL, "%s", job->message);
    else if (job->row.trial.status)
      status = time_row(level->study, &job->row);
  }
  return status;
}

static int32_t run_one_by_one(struct level *level) {
  int32_t status = HOOKE_OK;
  for (int32_t k = 0; k < level->count && status == HOOKE_OK; k++) {
    struct job *job = &level->job[k];
    const double begun = hk_clock_seconds();
    level->study->row_deadline = deadline_of(job, level->study);
    status = hk_study_measure(level->study, job->method, job->value, &job->row);
    level->study->given_up[job->method] = level->study->late;
    level->study->work_ahead = fmax(0.0, level->study->work_ahead - (hk_clock_seconds() - begun));
  }
  return status;
}

/* Rows that ran, even a stopped one, are kept. */
static int32_t keep_rows(struct level *level) {
  struct hk_study *study = level->study;
  int32_t status = HOOKE_OK;
  if (study->row_count + level->count > study->row_capacity) {
    const int64_t capacity = 2 * study->row_capacity + 64;
    status = hk_grow((void **)&study->row, study->row_count, capacity, sizeof *study->row);
    if (status == HOOKE_OK) study->row_capacity = capacity;
  }
  for (int32_t k = 0; k < level->count; k++) {
    struct job *job = &level->job[k];
    if (status == HOOKE_OK && job->row.trial.status)
      study->row[study->row_count++] = job->row;
    else
      hk_trial_release(&job->row.trial);
  }
  return status;
}

static int compare_jobs(const void *a, const void *b) {
  const struct job *x = a, *y = b;
  return (x->expected > y->expected) - (x->expected < y->expected);
}

/* Runs the rows of a level that the budget still allows, the quickest first, so that a slow row does not keep
 * the others from running. */
static void plan_level(struct hk_study *study, int32_t number, struct level *level) {
  const double most = WINS_NO_MORE * least_work(study);
  double ahead = 0.0;
  for (int32_t m = 0; m < study->method_count; m++) {
    const double value = hk_study_ladder(study, m, number);
    if (isnan(value) || study->given_up[m]) continue;
    const struct cost cost = predict(study, m, value);
    study->cut[m] |= cost.work >= most;
    if (study->cut[m]) continue;
    /* the time of a first row is unknown: it is begun, and ends when its share of time is over */
    const double predicted = cost.seconds, next = fmax(0.0, predicted);
    if (hk_clock_seconds() + ahead + next > study->deadline) {
      study->budget_spent = 1;
      continue;
    }
    ahead += next;
    level->job[level->count++] = (struct job){.method = m,
                                              .value = value,
                                              .expected = expect_seconds(study, m, value),
                                              .fraction = isnan(predicted) ? UNKNOWN_SHARE : 1.0,
                                              .level = level};
  }
  qsort(level->job, (size_t)level->count, sizeof level->job[0], compare_jobs);
}

/* A search needs time for a run as fine as the reference. */
static double end_of_rows(const struct hk_study *study) {
  const double end = study->begun + study->budget, left = end - hk_clock_seconds();
  if (isnan(study->wants.most) || isinf(end)) return end;
  const double search = fmax(SEARCH_SHARE * study->budget, SEARCH_RUNS * study->reference.run_work);
  return end - fmin(search, MOST_SEARCH * left);
}

int32_t hk_study_run_ladders(struct hk_study *study) {
  const int32_t threads = study->once ? 1 : (int32_t)hooke_options_number(study->m->run, "threads");
  int32_t status = HOOKE_OK;
  struct level *level = hk_new(1, sizeof *level);
  if (level == NULL) return HOOKE_NO_MEMORY;
  study->deadline = end_of_rows(study);
  for (int32_t number = 0; status == HOOKE_OK; number++) {
    *level = (struct level){.study = study};
    study->work_ahead = seconds_ahead(study, number);
    plan_level(study, number, level);
    if (level->count == 0) break;
    status = threads > 1 ? run_side_by_side(level, threads) : run_one_by_one(level);
    const int32_t kept = keep_rows(level);
    if (status == HOOKE_OK) status = kept;
  }
  hk_free(level);
  return status;
}
