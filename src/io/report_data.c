/* What the page of a study shows, as JSON. */
#include "io/report.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

/* A curve over time has this many points at most; each is the largest of the frames that it stands for. */
enum { MOST_POINTS = 240 };

static const char *const row_numbers[] = {"step",         "rtol",
                                          "atol",         "error",
                                          "error_max",    "error_final",
                                          "energy_drift", "force_evaluations",
                                          "steps",        "linear_iterations",
                                          "wall_seconds", "wall_median",
                                          "repeats",      "near_floor",
                                          "timed_alone"};
static const char *const reference_numbers[] = {"agreement", "trusted_until", "growth",
                                                "duration",  "frames",        "budget_spent"};
static const char *const order_numbers[] = {"order", "low", "high", "theory"};
static const char *const recommendation_numbers[] = {"met",  "want",  "step",         "rtol",
                                                     "atol", "error", "wall_seconds", "force_evaluations"};
#define COUNT_OF(list) ((int)(sizeof(list) / sizeof((list)[0])))

/* ---- curves over time ---- */

static int64_t point_count(const hooke_study *study) {
  const int64_t frames = hooke_study_frame_count(study);
  return frames < MOST_POINTS ? frames : MOST_POINTS;
}

/* The first frame of a point; those of the last point end with the last frame. */
static int64_t first_frame(const hooke_study *study, int64_t point) {
  return point * hooke_study_frame_count(study) / point_count(study);
}

static void add_times(struct hooke_text *text, const hooke_study *study) {
  const double *time = hooke_study_series(study, 0, "time");
  hooke_text_open(text, "time", '[');
  for (int64_t k = 0; time && k < point_count(study); k++)
    hooke_text_number(text, NULL, time[first_frame(study, k + 1) - 1]);
  hooke_text_close(text, ']');
}

static void add_curve(struct hooke_text *text, const hooke_study *study, int64_t row, const char *what) {
  const double *value = hooke_study_series(study, row, what);
  char key[32];
  snprintf(key, sizeof key, "%s_at", what);
  hooke_text_open(text, key, '[');
  for (int64_t k = 0; value && k < point_count(study); k++) {
    double largest = NAN;
    for (int64_t f = first_frame(study, k); f < first_frame(study, k + 1); f++)
      largest = fmax(largest, fabs(value[f]));
    hooke_text_number(text, NULL, largest);
  }
  hooke_text_close(text, ']');
}

/* ---- the study ---- */

static void add_reference(struct hooke_text *text, const hooke_study *study) {
  hooke_text_open(text, "reference", '{');
  hooke_text_word(text, "method", hooke_study_reference(study, "method"));
  hooke_text_word(text, "check", hooke_study_reference(study, "check"));
  for (int k = 0; k < COUNT_OF(reference_numbers); k++)
    hooke_text_number(text, reference_numbers[k], hooke_study_figure(study, reference_numbers[k]));
  hooke_text_close(text, '}');
}

static void add_rows(struct hooke_text *text, const hooke_study *study) {
  hooke_text_open(text, "rows", '[');
  for (int64_t row = 0; row < hooke_study_row_count(study); row++) {
    hooke_text_open(text, NULL, '{');
    hooke_text_word(text, "method", hooke_study_text(study, row, "method"));
    hooke_text_word(text, "status", hooke_study_text(study, row, "status"));
    for (int k = 0; k < COUNT_OF(row_numbers); k++)
      hooke_text_number(text, row_numbers[k], hooke_study_number(study, row, row_numbers[k]));
    add_curve(text, study, row, "error");
    add_curve(text, study, row, "energy_drift");
    hooke_text_close(text, '}');
  }
  hooke_text_close(text, ']');
}

/* Rows of a method follow each other. */
static void add_orders(struct hooke_text *text, const hooke_study *study) {
  hooke_text_open(text, "orders", '{');
  for (int64_t row = 0; row < hooke_study_row_count(study); row++) {
    const char *method = hooke_study_text(study, row, "method");
    if (row > 0 && strcmp(method, hooke_study_text(study, row - 1, "method")) == 0) continue;
    if (hooke_method_is_adaptive(method) != 0) continue;
    hooke_text_open(text, method, '{');
    for (int k = 0; k < COUNT_OF(order_numbers); k++)
      hooke_text_number(text, order_numbers[k], hooke_study_order(study, method, order_numbers[k]));
    hooke_text_word(text, "note", hooke_study_order_note(study, method));
    hooke_text_close(text, '}');
  }
  hooke_text_close(text, '}');
}

static void add_recommendation(struct hooke_text *text, const hooke_study *study, const char *command) {
  const int made = !isnan(hooke_study_recommendation_number(study, "want"));
  if (!made) {
    hooke_text_word(text, "recommendation", NULL);
    return;
  }
  hooke_text_open(text, "recommendation", '{');
  hooke_text_word(text, "method", hooke_study_recommendation_text(study, "method"));
  hooke_text_word(text, "note", hooke_study_recommendation_text(study, "note"));
  for (int k = 0; k < COUNT_OF(recommendation_numbers); k++) {
    const char *what = recommendation_numbers[k];
    hooke_text_number(text, what, hooke_study_recommendation_number(study, what));
  }
  hooke_text_word(text, "command", command);
  hooke_text_close(text, '}');
}

/* ---- where and with what ---- */

/* The processor's name as Linux tells it; "" elsewhere. */
static void find_processor(char *name, size_t size) {
  char line[256];
  name[0] = '\0';
  FILE *file = fopen("/proc/cpuinfo", "r");
  if (file == NULL) return;
  while (name[0] == '\0' && fgets(line, sizeof line, file)) {
    const char *colon = strchr(line, ':');
    if (strncmp(line, "model name", 10) != 0 || colon == NULL) continue;
    colon += 1 + strspn(colon + 1, " ");
    snprintf(name, size, "%.*s", (int)strcspn(colon, "\n"), colon);
  }
  fclose(file);
}

static void add_machine(struct hooke_text *text) {
  char processor[256], kernel[160] = "";
  struct utsname name;
  find_processor(processor, sizeof processor);
  if (uname(&name) == 0) snprintf(kernel, sizeof kernel, "%.64s, %.64s", name.sysname, name.machine);
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  hooke_text_open(text, "machine", '{');
  hooke_text_word(text, "processor", processor[0] ? processor : NULL);
  hooke_text_number(text, "cores", cores > 0 ? (double)cores : NAN);
  hooke_text_word(text, "system", kernel);
  hooke_text_close(text, '}');
}

static void add_versions(struct hooke_text *text) {
  static const char *const facts[] = {"sundials", "gsl",          "hdf5",   "jansson",
                                      "chartjs",  "instructions", "licence"};
  hooke_text_open(text, "versions", '{');
  hooke_text_word(text, "hooke", hooke_version());
  for (int k = 0; k < COUNT_OF(facts); k++)
    hooke_text_word(text, facts[k], hooke_build_fact(facts[k]));
  hooke_text_close(text, '}');
}

static void add_date(struct hooke_text *text) {
  char date[32] = "";
  const time_t now = time(NULL);
  struct tm parts;
  if (gmtime_r(&now, &parts)) strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", &parts);
  hooke_text_word(text, "date", date);
}

void hooke_report_add_data(struct hooke_text *text, const hooke_study *study, const char *scene,
                           const char *command) {
  struct hooke_text data = {.bytes = NULL};
  hooke_text_open(&data, NULL, '{');
  hooke_text_word(&data, "scene", scene);
  add_date(&data);
  add_reference(&data, study);
  add_times(&data, study);
  add_rows(&data, study);
  add_orders(&data, study);
  add_recommendation(&data, study, command);
  add_machine(&data);
  add_versions(&data);
  hooke_text_close(&data, '}');
  if (data.status == HOOKE_OK)
    hooke_text_add(text, data.bytes, data.length);
  else
    text->status = data.status;
  hooke_text_release(&data);
}
