/* A measurement in one HDF5 file:
 *
 *   /hooke, /h5md               as in every file (h5md_h5.h): versions, units, options of the run, scene,
 * status
 *   /<kind>                     attributes: the record of that name
 *   /<kind>/options             an attribute for each option that is set
 *   /<kind>/<column>            [rows] of the table "rows"; NaN where a number does not apply
 *   /<kind>/series/<column>     [rows][frames], without the ending _at; of a record [frames]; NaN past the
 *                               end of a run
 *   /<kind>/<table>             attributes of a record; arrays of other tables, [rows], or of a matrix
 *                               [outer][inner]
 *   /particles, /observables    motions of a study that ran each method once: the reference in the group
 * "all", each method in one of its name (frames_h5.h)
 *
 * Texts are padded with zeros. A table without rows is left out. An older file is replaced when the new one
 * is complete. */
#include "core/memory.h"
#include "core/status.h"
#include "io/measurement/measurement_file.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/object_h5.h"
#include "io/scene/scene.h"
#include "io/trajectory/h5md_h5.h"
#include "measure/study/study.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LEAST_LENGTH = 32, NAME_SIZE = 64 };

/* ---- one column ---- */

/* Rows of a table in a column: every `stride`-th of the first `count` strides. */
struct extent {
  int64_t count, stride;
  hsize_t size[2];
  int rank;
};

static struct extent extent_of(const struct hk_table *table, const struct hk_column *column,
                               const void *object) {
  const int64_t rows = hk_table_count(table, object), inner = table->inner ? table->inner(object) : 1;
  const struct extent outer = {rows / inner, inner, {(hsize_t)(rows / inner)}, 1};
  if (column->axis == HOOKE_AXIS_OUTER) return outer;
  if (column->axis == HOOKE_AXIS_INNER) return (struct extent){inner, 1, {(hsize_t)inner}, 1};
  if (table->inner == NULL) return (struct extent){rows, 1, {(hsize_t)rows}, 1};
  return (struct extent){rows, 1, {(hsize_t)(rows / inner), (hsize_t)inner}, 2};
}

static herr_t write_numbers(hid_t group, const hooke_measurement *m, const struct hk_table *table,
                            const struct hk_column *column, struct extent extent) {
  double *value = hk_new(extent.count, sizeof *value);
  if (value == NULL) return -1;
  for (int64_t k = 0; k < extent.count; k++)
    value[k] = hk_measured_value(m, table, column, k * extent.stride).number;
  const herr_t result =
      hk_h5_array_of(group, column->name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, extent.rank, extent.size, value);
  hk_free(value);
  return result;
}

static int64_t longest_text(const hooke_measurement *m, const struct hk_table *table,
                            const struct hk_column *column) {
  size_t length = LEAST_LENGTH;
  for (int64_t row = 0; row < hk_measured_rows(m, table); row++) {
    const char *text = hk_measured_value(m, table, column, row).text;
    const size_t own = text ? strlen(text) + 1 : 0;
    length = own > length ? own : length;
  }
  return (int64_t)length;
}

static herr_t write_texts(hid_t group, const hooke_measurement *m, const struct hk_table *table,
                          const struct hk_column *column, struct extent extent) {
  hid_t data = hk_h5_texts(group, column->name, extent.count, longest_text(m, table, column));
  herr_t result = data < 0 ? -1 : 0;
  for (int64_t k = 0; result >= 0 && k < extent.count; k++) {
    const char *text = hk_measured_value(m, table, column, k * extent.stride).text;
    result = hk_h5_write_text(data, k, text ? text : "");
  }
  hk_h5_drop(data);
  return result;
}

/* ---- series ---- */

/* One row at a time, so that no second copy of all series is held. */
static herr_t write_series_row(hid_t data, int64_t row, const struct hk_series *series) {
  const hsize_t line = (hsize_t)series->count, begin[2] = {(hsize_t)row, 0}, size[2] = {1, line};
  hid_t there = H5Dget_space(data), here = H5Screate_simple(1, &line, NULL);
  herr_t result = there < 0 || here < 0 ? -1 : 0;
  if (result >= 0) result = H5Sselect_hyperslab(there, H5S_SELECT_SET, begin, NULL, size, NULL);
  if (result >= 0) result = H5Dwrite(data, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, series->value);
  hk_h5_drop(here);
  hk_h5_drop(there);
  return result;
}

static herr_t write_series(hid_t group, const hooke_measurement *m, const struct hk_table *table,
                           const struct hk_column *column) {
  const int64_t rows = hk_measured_rows(m, table);
  struct hk_series series = hk_measured_value(m, table, column, 0).series;
  const hsize_t size[2] = {(hsize_t)rows, (hsize_t)series.count};
  const double none = NAN;
  char name[NAME_SIZE];
  snprintf(name, sizeof name, "%s", column->name);
  const size_t length = strlen(name);
  if (length > 3 && strcmp(name + length - 3, "_at") == 0) name[length - 3] = '\0';
  if (table->record)
    return hk_h5_array_of(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, size + 1,
                          series.value ? series.value : &none);
  hid_t data = hk_h5_array(group, name, H5T_IEEE_F64LE, 2, size, &none);
  herr_t result = data < 0 ? -1 : 0;
  for (int64_t row = 0; result >= 0 && row < rows; row++) {
    series = hk_measured_value(m, table, column, row).series;
    if (series.value && series.count > 0) result = write_series_row(data, row, &series);
  }
  hk_h5_drop(data);
  return result;
}

/* ---- tables ---- */

static herr_t write_attribute(hid_t group, const hooke_measurement *m, const struct hk_table *table,
                              const struct hk_column *column) {
  const struct hk_value value = hk_measured_value(m, table, column, 0);
  return column->type == HOOKE_COLUMN_TEXT
             ? hk_h5_text_attribute(group, column->name, value.text ? value.text : "")
             : hk_h5_attribute(group, column->name, H5T_NATIVE_DOUBLE, 1, &value.number);
}

/* Series go into a group of their own. */
static herr_t write_column(hid_t kind, hid_t group, const hooke_measurement *m, const struct hk_table *table,
                           const struct hk_column *column) {
  const struct extent extent = extent_of(table, column, hk_measured(m, table));
  if (column->type == HOOKE_COLUMN_SERIES) {
    if (!table->record && strcmp(table->name, "rows") != 0) return 0;
    hid_t series = hk_h5_group(kind, "series");
    const herr_t result = series < 0 ? -1 : write_series(series, m, table, column);
    hk_h5_drop(series);
    return result;
  }
  if (table->record) return write_attribute(group, m, table, column);
  /* tables that share a group share the names of their indices */
  if (H5Lexists(group, column->name, H5P_DEFAULT) > 0) return 0;
  return column->type == HOOKE_COLUMN_TEXT ? write_texts(group, m, table, column, extent)
                                           : write_numbers(group, m, table, column, extent);
}

static herr_t write_table(hid_t kind, const hooke_measurement *m, const struct hk_table *table) {
  const char *name = table->group ? table->group : table->name;
  const int is_own = strcmp(table->name, m->kind->name) == 0, is_rows = strcmp(table->name, "rows") == 0;
  if (hk_measured_rows(m, table) == 0 && !is_rows) return 0;
  hid_t group = is_own || is_rows ? kind : hk_h5_group(kind, name);
  herr_t result = group < 0 ? -1 : 0;
  for (int32_t k = 0; result >= 0 && k < table->column_count; k++)
    result = write_column(kind, group, m, table, &table->columns[k]);
  if (group != kind) hk_h5_drop(group);
  return result;
}

/* ---- motions ---- */

/* Only the numbers of frames are kept from the study, so every run is made again. */
struct motions {
  const hooke_measurement *m;
  int64_t count; /* 0 for other measurements, and for a study that was stopped */
  struct hk_frame_file *writer;
};

static int32_t create_motions(const hooke_measurement *m, struct motions *motions) {
  const struct hk_study *study = m->kind == &hk_study_kind && m->outcome == HOOKE_OK ? m->object : NULL;
  const int64_t count = study && study->once ? study->row_count + 1 : 0;
  *motions = (struct motions){m, count, hk_new(count, sizeof *motions->writer)};
  return motions->writer ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static herr_t make_motions(struct motions *motions, hid_t file) {
  const hooke_system *system = motions->m->system;
  herr_t result = 0;
  for (int64_t k = 0; result >= 0 && k < motions->count; k++) {
    const struct hk_study *study = motions->m->object;
    const char *group = k == 0 ? "all" : study->method[study->row[k - 1].method];
    const int64_t frames = k == 0 ? study->reference.frames.recorded : study->row[k - 1].trial.frames;
    hk_frame_arrays_plan(system, group, frames, &motions->writer[k]);
    result = hk_frame_arrays_create(file, &motions->writer[k]);
  }
  return result >= 0 && motions->count > 0 ? hk_h5md_connect(file, system, "all") : result;
}

struct run {
  const struct motions *motions;
  int64_t number;
  int error; /* errno of a write */
  int32_t stopped;
};

static int32_t write_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  struct run *run = ctx;
  struct hk_frame_file *writer = &run->motions->writer[run->number];
  if (frame >= writer->frame_count) return 1;
  run->error = hk_frame_write(writer, writer->written, step, state);
  writer->written += run->error == 0;
  return run->error != 0;
}

static int32_t tell(double fraction, void *ctx) {
  struct run *run = ctx;
  const double done = ((double)run->number + fraction) / (double)run->motions->count;
  run->stopped = hk_measurement_tell(run->motions->m, done, run->motions->writer[run->number].group);
  return run->stopped;
}

static int32_t run_again(struct run *run, const char *path) {
  const struct hk_study *study = run->motions->m->object;
  const struct hk_frame_file *writer = &run->motions->writer[run->number];
  const struct hk_listener listener = {.on_progress = tell, .on_frame = write_frame, .ctx = run};
  struct hk_frames frames = {.system = study->m->system}; /* none: they go into the file */
  hooke_options *options = NULL;
  int32_t status = hk_study_run_options(study, run->number - 1, &options);
  if (status == HOOKE_OK) status = hk_frames_run(&frames, options, &listener, NULL);
  hooke_options_destroy(options);
  if (run->error) return hk_file_fail(path, "write a frame", run->error);
  if (run->stopped || status == HOOKE_NO_MEMORY) return status;
  if (writer->written == writer->frame_count) return HOOKE_OK;
  return hk_fail(HOOKE_IO_FAILED, NULL, "%s: the run of %s came to %lld frames and now to %lld", path,
                 writer->group, (long long)writer->frame_count, (long long)writer->written);
}

/* By the descriptor, once HDF5 has closed the file. The progress of the measurement is called. HOOKE_STOPPED;
 * HOOKE_IO_FAILED, also if a run takes another course than before. */
static int32_t write_motions(struct motions *motions, const struct hk_atomic_file *file) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; status == HOOKE_OK && k < motions->count; k++) {
    struct run run = {.motions = motions, .number = k};
    motions->writer[k].descriptor = file->descriptor;
    status = run_again(&run, file->path);
  }
  return status;
}

/* ---- the file ---- */

static herr_t write_all(hid_t file, const hooke_measurement *m) {
  hid_t kind = hk_h5_group(file, m->kind->name);
  herr_t result = kind < 0 ? -1 : hk_h5md_write_options(kind, m->options);
  const struct hk_table *table;
  for (int64_t k = 0; result >= 0 && (table = hk_measurement_table_at(m->kind, k)) != NULL; k++)
    result = write_table(kind, m, table);
  hk_h5_drop(kind);
  return result;
}

static int32_t write_results(const hooke_measurement *m, const char *scene_text,
                             const struct hk_atomic_file *atomic, struct motions *motions) {
  struct hk_h5_file file;
  int32_t status = hk_h5_file_create(0.0, atomic, &file);
  if (status == HOOKE_OK) {
    const hid_t id = file.guard.file;
    herr_t result = hk_h5md_describe(id, m->system, NULL, m->run, scene_text);
    if (result >= 0) result = write_all(id, m);
    if (result >= 0) result = make_motions(motions, id);
    if (result >= 0) result = hk_h5md_set_status(id, m->outcome);
    if (result < 0) status = hk_h5_fail(&file.guard, "write the results");
  }
  return hk_h5_file_settle(&file, status);
}

/* Motions need no HDF5, which waits for nobody while they are made. */
static int32_t write_file(const hooke_measurement *m, const char *path, const char *scene_text) {
  struct hk_atomic_file file = HOOKE_NO_ATOMIC_FILE;
  struct motions motions;
  int32_t status = create_motions(m, &motions);
  if (status != HOOKE_OK) return status;
  status = hk_atomic_file_make(path, &file);
  if (status == HOOKE_OK) status = write_results(m, scene_text, &file, &motions);
  if (status == HOOKE_OK) status = write_motions(&motions, &file);
  if (status == HOOKE_OK) status = hk_atomic_file_commit(&file, NULL);
  hk_atomic_file_release(&file);
  hk_free(motions.writer);
  return status;
}

int32_t hk_measurement_write_h5(const hooke_measurement *m, const char *path) {
  char *whole = NULL;
  const char *scene = m->label[HOOKE_LABEL_SCENE];
  int32_t status = hk_scene_make_whole(scene, m->system, m->run, &whole);
  if (status == HOOKE_OK) status = write_file(m, path, whole ? whole : scene);
  hk_free(whole);
  return status;
}

#else

int32_t hk_measurement_write_h5(const hooke_measurement *m, const char *path) {
  (void)m;
  return hk_fail(HOOKE_NOT_BUILT, NULL, "%s: results in HDF5 need HDF5, which this build is without", path);
}

#endif
