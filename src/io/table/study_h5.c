/* A study in one HDF5 file:
 *
 *   /hooke, /h5md                     as in every file (h5md_h5.h): versions, units, the options of the run, the scene,
 *                                     the status of the study
 *   /study                            attributes duration, budget_spent
 *   /study/options                    an attribute for each option of the study that is set
 *   /study/reference                  attributes methods (two), ended, agreement, energy_agreement, trusted_until,
 *                                     growth, growth_probability, growth_seen, displacements
 *   /study/method, status             [rows], texts
 *   /study/<column>                   [rows], one array for each number of hooke_study_number(), NaN where there is none
 *   /study/series/time                [frames], those that are judged
 *   /study/series/error               [rows][frames], likewise energy_drift; NaN past the end of a run
 *   /study/orders/method, note        [methods that have rows], texts
 *   /study/orders/<figure>            [methods]: order, low, high, theory; NaN for an error-controlled method
 *   /study/recommendation             attributes method, note, met, want, step, rtol, atol, error, wall_seconds,
 *                                     force_evaluations, error_low, error_high, limit_share, holds_stiffness,
 *                                     error_stiffness, holds_start, error_start; the group is there only if
 *                                     something was recommended
 *
 *   /study/watched/quantity, unit     [quantities], texts, where something is watched; agreement [quantities]
 *   /study/watched/error              [rows][quantities]
 *   /study/statistics                 attributes members, from, until, noise; only if there was an ensemble
 *   /study/statistics/quantity, unit  [quantities], texts
 *   /study/statistics/method          [methods], texts, "reference" first
 *   /study/statistics/<figure>        [methods][quantities]: step, rtol, members, failed, mean, spread, bias
 *
 * Texts are padded with zeros. The file takes its place when it is complete. */
#include "core/memory.h"
#include "core/status.h"
#include "hooke/io.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/file_h5.h"
#include "io/trajectory/h5md_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/scene/scene.h"
#include "io/table/study_watched_h5.h"
#include "measure/study/study.h"

#include <math.h>
#include <string.h>

enum { TEXT_LENGTH = 32, NOTE_LENGTH = 256 };

static const char *const series[] = {"error", "energy_drift"};
static const char *const figures[] = {"order", "low", "high", "theory"};
enum { FIGURE_COUNT = sizeof figures / sizeof figures[0] };

static hid_t new_group(hid_t where, const char *name) {
  return H5Gcreate2(where, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

/* ---- rows ---- */

static herr_t write_row_texts(hid_t table, const hooke_study *study, const char *what) {
  const int64_t count = hooke_study_row_count(study);
  hid_t data = hk_h5_texts(table, what, count, TEXT_LENGTH);
  herr_t result = data < 0 ? -1 : 0;
  for (int64_t row = 0; result >= 0 && row < count; row++)
    result = hk_h5_write_text(data, row, hooke_study_text(study, row, what));
  hk_h5_drop(data);
  return result;
}

static herr_t write_column(hid_t table, const hooke_study *study, const char *what, double *line) {
  const hsize_t count = (hsize_t)hooke_study_row_count(study);
  for (hsize_t row = 0; row < count; row++)
    line[row] = hooke_study_number(study, (int64_t)row, what);
  return hk_h5_array_of(table, what, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &count, line);
}

/* A row at a time, so that no second copy of all series is held. */
static herr_t write_series_row(hid_t data, int64_t row, int64_t frames, const double *value) {
  const hsize_t line = (hsize_t)frames, begin[2] = {(hsize_t)row, 0}, size[2] = {1, line};
  hid_t there = H5Dget_space(data), here = H5Screate_simple(1, &line, NULL);
  herr_t result = there < 0 || here < 0 ? -1 : 0;
  if (result >= 0) result = H5Sselect_hyperslab(there, H5S_SELECT_SET, begin, NULL, size, NULL);
  if (result >= 0) result = H5Dwrite(data, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, value);
  hk_h5_drop(here);
  hk_h5_drop(there);
  return result;
}

static herr_t write_series(hid_t group, const hooke_study *study, const char *what) {
  const double none = NAN;
  const int64_t rows = hooke_study_row_count(study), frames = hooke_study_frame_count(study);
  const hsize_t size[2] = {(hsize_t)rows, (hsize_t)frames};
  hid_t data = hk_h5_array(group, what, H5T_IEEE_F64LE, 2, size, &none);
  herr_t result = data < 0 ? -1 : 0;
  for (int64_t row = 0; result >= 0 && frames > 0 && row < rows; row++) {
    const double *value = hooke_study_series(study, row, what);
    if (value) result = write_series_row(data, row, frames, value);
  }
  hk_h5_drop(data);
  return result;
}

static herr_t write_rows(hid_t table, const hooke_study *study) {
  const hsize_t frames = (hsize_t)hooke_study_frame_count(study);
  double *line = hk_new(hooke_study_row_count(study), sizeof *line);
  hid_t group = line ? new_group(table, "series") : -1;
  herr_t result = group < 0 ? -1 : 0;
  if (result >= 0) result = write_row_texts(table, study, "method");
  if (result >= 0) result = write_row_texts(table, study, "status");
  for (int k = 0; result >= 0 && k < HOOKE_STUDY_ROW_NUMBERS; k++)
    result = write_column(table, study, hk_study_row_number[k], line);
  if (result >= 0) {
    const double none = NAN, *time = frames > 0 ? hooke_study_series(study, 0, "time") : &none;
    result = hk_h5_array_of(group, "time", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &frames, time);
  }
  for (int k = 0; result >= 0 && k < 2; k++)
    result = write_series(group, study, series[k]);
  hk_h5_drop(group);
  hk_free(line);
  return result;
}

/* ---- orders ---- */

/* The methods that have rows; those of one method follow each other. */
static int64_t find_methods(const hooke_study *study, const char **method) {
  int64_t count = 0;
  for (int64_t row = 0; row < hooke_study_row_count(study); row++) {
    const char *name = hooke_study_text(study, row, "method");
    if (count == 0 || strcmp(method[count - 1], name) != 0) method[count++] = name;
  }
  return count;
}

static herr_t write_order_texts(hid_t group, const hooke_study *study, int64_t count,
                                const char *const *method) {
  hid_t name = hk_h5_texts(group, "method", count, TEXT_LENGTH);
  hid_t note = hk_h5_texts(group, "note", count, NOTE_LENGTH);
  herr_t result = name < 0 || note < 0 ? -1 : 0;
  for (int64_t k = 0; result >= 0 && k < count; k++) {
    result = hk_h5_write_text(name, k, method[k]);
    if (result >= 0) result = hk_h5_write_text(note, k, hooke_study_order_note(study, method[k]));
  }
  hk_h5_drop(note);
  hk_h5_drop(name);
  return result;
}

static herr_t write_orders(hid_t study_group, const hooke_study *study) {
  const char *method[HOOKE_STUDY_METHODS];
  const int64_t count = find_methods(study, method);
  const hsize_t size = (hsize_t)count;
  hid_t group = new_group(study_group, "orders");
  herr_t result = group < 0 ? -1 : write_order_texts(group, study, count, method);
  for (int k = 0; result >= 0 && k < FIGURE_COUNT; k++) {
    double line[HOOKE_STUDY_METHODS] = {0.0};
    for (int64_t m = 0; m < count; m++)
      line[m] = hooke_study_order(study, method[m], figures[k]);
    result = hk_h5_array_of(group, figures[k], H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &size, line);
  }
  hk_h5_drop(group);
  return result;
}

/* ---- attributes ---- */

static herr_t write_number(hid_t group, const char *name, double number) {
  return hk_h5_number_attribute(group, name, 1, &number);
}

static herr_t write_reference(hid_t study_group, const hooke_study *study) {
  static const char *const names[] = {"agreement",          "energy_agreement", "trusted_until", "growth",
                                      "growth_probability", "growth_seen",      "displacements"};
  const char *const methods[2] = {hooke_study_reference(study, "method"),
                                  hooke_study_reference(study, "check")};
  hid_t group = new_group(study_group, "reference");
  herr_t result = group < 0 ? -1 : hk_h5_text_attributes(group, "methods", 2, methods);
  if (result >= 0) result = hk_h5_text_attribute(group, "ended", hooke_study_reference(study, "ended"));
  for (size_t k = 0; result >= 0 && k < sizeof names / sizeof names[0]; k++)
    result = write_number(group, names[k], hooke_study_figure(study, names[k]));
  hk_h5_drop(group);
  return result;
}

static herr_t write_recommendation(hid_t study_group, const hooke_study *study) {
  static const char *const names[] = {"met",
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
  const char *note = hooke_study_recommendation_text(study, "note");
  const char *method = hooke_study_recommendation_text(study, "method");
  if (note == NULL) return 0;
  hid_t group = new_group(study_group, "recommendation");
  herr_t result = group < 0 ? -1 : hk_h5_text_attribute(group, "method", method ? method : "");
  if (result >= 0) result = hk_h5_text_attribute(group, "note", note);
  for (size_t k = 0; result >= 0 && k < sizeof names / sizeof names[0]; k++)
    result = write_number(group, names[k], hooke_study_recommendation_number(study, names[k]));
  hk_h5_drop(group);
  return result;
}

/* ---- the file ---- */

static herr_t write_study(hid_t file, const hooke_study *study) {
  hid_t group = new_group(file, "study");
  herr_t result = group < 0 ? -1 : write_number(group, "duration", hooke_study_figure(study, "duration"));
  if (result >= 0) {
    const int32_t spent = hooke_study_figure(study, "budget_spent") == 1.0;
    result = hk_h5_integer_attribute(group, "budget_spent", 1, &spent);
  }
  if (result >= 0) result = hk_h5md_write_options(group, study->options);
  if (result >= 0) result = write_reference(group, study);
  if (result >= 0) result = write_rows(group, study);
  if (result >= 0) result = write_orders(group, study);
  if (result >= 0) result = write_recommendation(group, study);
  if (result >= 0) result = hk_h5_write_watched(group, study);
  if (result >= 0) result = hk_h5_write_statistics(group, study);
  hk_h5_drop(group);
  return result;
}

static double bytes_of(const hooke_study *study, const char *scene_text) {
  const double rows = (double)hooke_study_row_count(study), frames = (double)hooke_study_frame_count(study);
  const double text = scene_text ? (double)strlen(scene_text) : 0.0;
  return hk_h5_watched_bytes(study) + text + 65536.0 + rows * (512.0 + 16.0 * frames) + 8.0 * frames;
}

static int32_t write_file(const hooke_study *study, const char *path, const char *scene_text,
                          int32_t outcome) {
  struct hk_h5_guard guard;
  struct hk_h5_file file;
  hk_h5_guard_begin(&guard);
  int32_t status = hk_h5_file_create(&guard, path, bytes_of(study, scene_text), &file);
  if (status == HOOKE_OK) {
    herr_t result = hk_h5md_describe(file.id, NULL, study->run, scene_text);
    if (result >= 0) result = write_study(file.id, study);
    if (result >= 0) result = hk_h5md_set_status(file.id, outcome);
    status = result < 0 ? hk_h5_fail(&guard, path, "write the study") : hk_h5_file_finish(&guard, &file);
  }
  hk_h5_file_release(&file);
  hk_h5_guard_end(&guard);
  return status;
}

int32_t hooke_study_write_h5(const hooke_study *study, const char *path, const char *scene_text,
                             int32_t outcome) {
  char *whole = NULL;
  int32_t status = hk_scene_make_whole(scene_text, study->system, study->run, &whole);
  if (status == HOOKE_OK) status = write_file(study, path, whole ? whole : scene_text, outcome);
  hk_free(whole);
  return status;
}

#else

int32_t hooke_study_write_h5(const hooke_study *study, const char *path, const char *scene_text,
                             int32_t outcome) {
  (void)study, (void)scene_text, (void)outcome;
  return hk_fail(HOOKE_NOT_BUILT, NULL, "%s: a study in HDF5 needs HDF5, which this build is without", path);
}

#endif
