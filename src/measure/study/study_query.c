/* Reading a study. */
#include "measure/study/study.h"

#include "core/figure.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

const char *const hk_study_row_number[HOOKE_STUDY_ROW_NUMBERS] = {"step",
                                                                  "rtol",
                                                                  "atol",
                                                                  "error",
                                                                  "error_max",
                                                                  "error_final",
                                                                  "energy_drift",
                                                                  "force_evaluations",
                                                                  "steps",
                                                                  "linear_iterations",
                                                                  "wall_seconds",
                                                                  "wall_median",
                                                                  "repeats",
                                                                  "near_floor",
                                                                  "near_energy_floor",
                                                                  "timed_alone"};

static const struct hk_study_row *row_at(const hooke_study *study, int64_t row) {
  return row >= 0 && row < study->row_count ? &study->row[row] : NULL;
}

static const char *how_it_ended(const struct hk_reference *r) {
  if (r->trusted == r->frames.count && !r->coarse) return "agreed";
  return r->hurried ? "time" : "rounding";
}

const char *hooke_study_reference(const hooke_study *study, const char *what) {
  if (study->reference.method == NULL) return "";
  if (strcmp(what, "method") == 0) return study->reference.method;
  if (strcmp(what, "check") == 0) return study->reference.check;
  if (strcmp(what, "ended") == 0) return how_it_ended(&study->reference);
  return hk_study_watched_text(study, what);
}

/* The time of frame `count` - 1, or the end of the run if that is all of them: the last may come before
 * it. */
static double time_until(const hooke_study *study, int64_t count) {
  const struct hk_frames *frames = &study->reference.frames;
  if (count <= 0) return NAN;
  return count == frames->count ? frames->time[0] + study->duration : frames->time[count - 1];
}

double hooke_study_figure(const hooke_study *study, const char *what) {
  const struct hk_reference *r = &study->reference;
  const int made = r->frames.count > 0;
  const struct hk_figure figures[] = {
      {"agreement", made ? r->agreement : NAN},
      {"trusted_until", made ? time_until(study, r->trusted) : NAN},
      {"checked_until", made ? time_until(study, r->checked) : NAN},
      {"energy_agreement", made ? r->energy_agreement : NAN},
      {"growth", made ? r->growth : NAN},
      {"growth_probability", made ? r->growth_probability : NAN},
      {"growth_seen", made ? r->growth_seen : NAN},
      {"displacements", made ? (double)r->displacements : NAN},
      {"duration", study->duration},
      {"frames", made ? (double)r->trusted : NAN},
      {"budget_spent", (double)study->budget_spent},
  };
  const double figure = HOOKE_FIGURE(figures, what);
  return isnan(figure) ? hk_study_watched_figure(study, what) : figure;
}

int64_t hooke_study_row_count(const hooke_study *study) {
  return study->row_count;
}

const char *hooke_study_text(const hooke_study *study, int64_t row, const char *what) {
  const struct hk_study_row *r = row_at(study, row);
  if (r == NULL) return NULL;
  if (strcmp(what, "method") == 0) return study->method[r->method];
  return strcmp(what, "status") == 0 ? r->trial.status : NULL;
}

static double is_near(double value, double floor) {
  return value <= 10.0 * floor ? 1.0 : 0.0;
}

double hooke_study_number(const hooke_study *study, int64_t row, const char *what) {
  const struct hk_study_row *r = row_at(study, row);
  if (r == NULL) return NAN;
  if (strcmp(what, "wall_median") == 0) return r->wall_median;
  if (strcmp(what, "repeats") == 0) return (double)r->repeats;
  if (strcmp(what, "timed_alone") == 0) return (double)r->timed_alone;
  if (strcmp(what, "near_floor") == 0) return is_near(r->trial.error, study->reference.agreement);
  if (strcmp(what, "near_energy_floor") == 0)
    return is_near(r->trial.energy_drift, study->reference.energy_agreement);
  if (strncmp(what, "watched:", 8) == 0) return hk_watched_series_figure(&r->trial.watched, what + 8);
  return hk_trial_number(&r->trial, what);
}

int64_t hooke_study_frame_count(const hooke_study *study) {
  return study->reference.trusted;
}

const double *hooke_study_series(const hooke_study *study, int64_t row, const char *what) {
  const struct hk_study_row *r = row_at(study, row);
  if (strcmp(what, "time") == 0) return study->reference.frames.time;
  if ((r || row == -1) && strncmp(what, "watched:", 8) == 0)
    return hk_watched_series_find(r ? &r->trial.watched : &study->reference.frames.watched, what + 8);
  if (r == NULL) return NULL;
  if (strcmp(what, "error") == 0) return r->trial.error_at;
  return strcmp(what, "energy_drift") == 0 ? r->trial.drift_at : NULL;
}

static int32_t method_index(const hooke_study *study, const char *method) {
  for (int32_t m = 0; m < study->method_count; m++) {
    if (strcmp(study->method[m], method) == 0) return m;
  }
  return -1;
}

double hooke_study_order(const hooke_study *study, const char *method, const char *what) {
  const int32_t m = method_index(study, method);
  if (m < 0 || study->reference.frames.count == 0) return NAN;
  const struct hooke_study_order *order = &study->order[m];
  if (strcmp(what, "order") == 0) return order->order;
  if (strcmp(what, "low") == 0) return order->low;
  if (strcmp(what, "high") == 0) return order->high;
  return strcmp(what, "theory") == 0 ? order->theory : NAN;
}

const char *hooke_study_order_note(const hooke_study *study, const char *method) {
  const int32_t m = method_index(study, method);
  return m < 0 ? "" : study->order[m].note;
}

const char *hooke_study_recommendation_text(const hooke_study *study, const char *what) {
  const struct hk_study_recommendation *r = &study->recommendation;
  if (!r->made) return NULL;
  if (strcmp(what, "method") == 0) return r->method >= 0 ? study->method[r->method] : NULL;
  return strcmp(what, "note") == 0 ? r->note : NULL;
}

double hooke_study_recommendation_number(const hooke_study *study, const char *what) {
  const struct hk_study_recommendation *r = &study->recommendation;
  if (!r->made) return NAN;
  const int adaptive = r->method >= 0 && hk_study_is_adaptive(study, r->method);
  const struct hk_figure numbers[] = {
      {"met", (double)r->met},
      {"want", r->want},
      {"step", adaptive ? NAN : r->value},
      {"rtol", adaptive ? r->value : NAN},
      {"atol", adaptive ? r->atol : NAN},
      {"error", r->error},
      {"wall_seconds", r->wall_seconds},
      {"force_evaluations", r->force_evaluations},
      {"error_low", isnan(r->error) ? NAN : fmax(0.0, r->error - study->reference.agreement)},
      {"error_high", r->error + study->reference.agreement},
      {"limit_share", r->margin.limit_share},
      {"holds_stiffness", r->margin.holds[HOOKE_STUDY_STIFFNESS]},
      {"error_stiffness", r->margin.error[HOOKE_STUDY_STIFFNESS]},
      {"holds_start", r->margin.holds[HOOKE_STUDY_START]},
      {"error_start", r->margin.error[HOOKE_STUDY_START]},
  };
  return HOOKE_FIGURE(numbers, what);
}
