/* One row of a study: a run for its error, repeated for its time. */
#include "measure/study/study.h"

#include "core/status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A short run is repeated until its time is steady or this much has been spent on it, and this share of a
 * budget. */
static const double REPEAT_SECONDS = 0.1, REPEAT_SHARE = 0.005;
static const double STEADY = 1.03;
enum { MOST_REPEATS = 9 };

int32_t hk_study_row_options(const struct hk_study *study, int32_t method, double value,
                             hooke_options **out) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_copy(study->run, &options);
  if (status == HOOKE_OK && study->once && value == hk_study_ladder(study, method, 0))
    status = hooke_options_set_text(options, "method", study->method[method]);
  else if (status == HOOKE_OK)
    status = hk_trial_set_value(options, study->method[method], value);
  /* rows in parallel, each on its own thread */
  if (status == HOOKE_OK && !study->once) status = hooke_options_set_number(options, "threads", 1);
  if (status == HOOKE_OK)
    *out = options;
  else
    hooke_options_destroy(options);
  return status;
}

int32_t hk_study_run_options(const struct hk_study *study, int64_t row, hooke_options **out) {
  struct hk_reference r = study->reference;
  if (row >= 0) return hk_study_row_options(study, study->row[row].method, study->row[row].value, out);
  r.extent = r.run_extent;
  return hk_reference_options(study->run, r.method, r.rtol, &r, out);
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

int32_t hk_study_run_row(const struct hk_study *study, int32_t method, double value,
                         const struct hk_listener *listener, struct hk_study_row *row) {
  const struct hk_reference *r = &study->reference;
  hooke_options *options = NULL;
  *row = (struct hk_study_row){.method = method, .value = value, .repeats = 1, .timed_alone = 1};
  int32_t status = hk_study_row_options(study, method, value, &options);
  if (status == HOOKE_OK) status = hk_trial_create(&r->frames, &row->trial);
  if (status == HOOKE_OK) status = hk_trial_run(&row->trial, &r->frames, r->trusted, options, listener);
  row->wall_median = row->trial.wall_seconds;
  hooke_options_destroy(options);
  return status;
}

int32_t hk_study_time_row(struct hk_study *study, struct hk_study_row *row) {
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
  const int32_t status = hk_study_run_row(study, method, value, &listener, row);
  if (status == HOOKE_STOPPED && study->late) {
    hk_trial_release(&row->trial);
    study->budget_spent = 1;
    return HOOKE_OK;
  }
  return status == HOOKE_OK ? hk_study_time_row(study, row) : status;
}
