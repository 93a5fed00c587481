/* The page of a study: what it shows, as JSON. */
#include "hooke/io.h"
#include "io/page/report.h"
#include "io/table/study_watched.h"
#include "measure/study/study.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A curve over time has this many points at most; each is the largest of the frames that it stands for. */
enum { MOST_POINTS = 240 };

static const char *const reference_numbers[] = {
    "agreement",   "energy_agreement", "trusted_until", "growth", "growth_probability",
    "growth_seen", "displacements",    "duration",      "frames", "budget_spent"};
static const char *const order_numbers[] = {"order", "low", "high", "theory"};
static const char *const recommendation_numbers[] = {"met",
                                                     "want",
                                                     "step",
                                                     "rtol",
                                                     "atol",
                                                     "error",
                                                     "wall_seconds",
                                                     "force_evaluations",
                                                     "error_low",
                                                     "error_high",
                                                     "limit_share",
                                                     "holds_stiffness",
                                                     "error_stiffness",
                                                     "holds_start",
                                                     "error_start"};
#define COUNT_OF(list) ((int)(sizeof(list) / sizeof((list)[0])))

struct request {
  const hooke_study *study;
  const char *command;
};

/* ---- curves over time ---- */

static int64_t point_count(const hooke_study *study) {
  const int64_t frames = hooke_study_frame_count(study);
  return frames < MOST_POINTS ? frames : MOST_POINTS;
}

/* The first frame of a point; those of the last point end with the last frame. */
static int64_t first_frame(const hooke_study *study, int64_t point) {
  return point * hooke_study_frame_count(study) / point_count(study);
}

static void add_times(struct hk_text *text, const hooke_study *study) {
  const double *time = hooke_study_series(study, 0, "time");
  hk_text_open(text, "time", '[');
  for (int64_t k = 0; time && k < point_count(study); k++)
    hk_text_number(text, NULL, time[first_frame(study, k + 1) - 1]);
  hk_text_close(text, ']');
}

static void add_curve(struct hk_text *text, const hooke_study *study, int64_t row, const char *what) {
  const double *value = hooke_study_series(study, row, what);
  char key[32];
  snprintf(key, sizeof key, "%s_at", what);
  hk_text_open(text, key, '[');
  for (int64_t k = 0; value && k < point_count(study); k++) {
    double largest = NAN;
    for (int64_t f = first_frame(study, k); f < first_frame(study, k + 1); f++)
      largest = fmax(largest, fabs(value[f]));
    hk_text_number(text, NULL, largest);
  }
  hk_text_close(text, ']');
}

/* ---- the study ---- */

static void add_reference(struct hk_text *text, const hooke_study *study) {
  hk_text_open(text, "reference", '{');
  hk_text_word(text, "method", hooke_study_reference(study, "method"));
  hk_text_word(text, "check", hooke_study_reference(study, "check"));
  hk_text_word(text, "ended", hooke_study_reference(study, "ended"));
  for (int k = 0; k < COUNT_OF(reference_numbers); k++)
    hk_text_number(text, reference_numbers[k], hooke_study_figure(study, reference_numbers[k]));
  hk_text_close(text, '}');
}

static void add_rows(struct hk_text *text, const hooke_study *study) {
  hk_text_open(text, "rows", '[');
  for (int64_t row = 0; row < hooke_study_row_count(study); row++) {
    hk_text_open(text, NULL, '{');
    hk_text_word(text, "method", hooke_study_text(study, row, "method"));
    hk_text_word(text, "status", hooke_study_text(study, row, "status"));
    for (int k = 0; k < HOOKE_STUDY_ROW_NUMBERS; k++)
      hk_text_number(text, hk_study_row_number[k], hooke_study_number(study, row, hk_study_row_number[k]));
    hk_study_watched_add(text, study, row);
    add_curve(text, study, row, "error");
    add_curve(text, study, row, "energy_drift");
    hk_text_close(text, '}');
  }
  hk_text_close(text, ']');
}

/* Rows of a method follow each other. */
static void add_orders(struct hk_text *text, const hooke_study *study) {
  hk_text_open(text, "orders", '{');
  for (int64_t row = 0; row < hooke_study_row_count(study); row++) {
    const char *method = hooke_study_text(study, row, "method");
    if (row > 0 && strcmp(method, hooke_study_text(study, row - 1, "method")) == 0) continue;
    if (hooke_method_is_adaptive(method) != 0) continue;
    hk_text_open(text, method, '{');
    for (int k = 0; k < COUNT_OF(order_numbers); k++)
      hk_text_number(text, order_numbers[k], hooke_study_order(study, method, order_numbers[k]));
    hk_text_word(text, "note", hooke_study_order_note(study, method));
    hk_text_close(text, '}');
  }
  hk_text_close(text, '}');
}

static void add_recommendation(struct hk_text *text, const hooke_study *study, const char *command) {
  const int made = !isnan(hooke_study_recommendation_number(study, "want"));
  if (!made) {
    hk_text_word(text, "recommendation", NULL);
    return;
  }
  hk_text_open(text, "recommendation", '{');
  hk_text_word(text, "method", hooke_study_recommendation_text(study, "method"));
  hk_text_word(text, "note", hooke_study_recommendation_text(study, "note"));
  for (int k = 0; k < COUNT_OF(recommendation_numbers); k++) {
    const char *what = recommendation_numbers[k];
    hk_text_number(text, what, hooke_study_recommendation_number(study, what));
  }
  hk_text_word(text, "command", command);
  hk_text_close(text, '}');
}

/* ---- the page ---- */

static void add_data(struct hk_text *data, const void *ctx) {
  const struct request *request = ctx;
  add_reference(data, request->study);
  add_times(data, request->study);
  add_rows(data, request->study);
  add_orders(data, request->study);
  add_recommendation(data, request->study, request->command);
  hk_study_watched_add(data, request->study, -1);
  hk_study_statistics_add(data, request->study);
}

int32_t hooke_study_write_report(const hooke_study *study, const char *path, const char *scene,
                                 const char *command) {
  const struct request request = {study, command};
  const struct hk_report report = {"study", scene, add_data, &request};
  return hk_report_write(&report, path);
}
