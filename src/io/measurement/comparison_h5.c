/* A comparison in one H5MD file: the reference under /particles/all, each method under /particles/<method>,
 * the options that all have in common under /hooke/options, and
 *
 *   /comparison/reference              the method of the reference
 *   /comparison/<column>               [rows] of the table "rows": texts, and numbers (NaN: none)
 *   /comparison/series/time            [frames]
 *   /comparison/series/error           [rows][frames], likewise energy_drift; NaN past the end of a run
 *
 * Texts are padded with zeros. Everything is created in advance and written in place, like the frames. */
#include "core/handle.h"
#include "core/memory.h"
#include "core/status.h"
#include "hooke/measurement.h"
#include "measure/trial/comparison.h"

#if HOOKE_HAVE_HDF5

#include "io/file/bytes.h"
#include "io/file/inputs.h"
#include "io/file/atomic_file.h"
#include "io/hdf5/file_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/scene/scene.h"
#include "io/trajectory/h5md_h5.h"
#include "io/trajectory/trajectory_writer_h5.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_LENGTH = 32, MOST_COLUMNS = 24, NAME_SIZE = 64 };

/* Offsets of the arrays of the table in the file. */
struct table {
  int64_t reference, time, column[MOST_COLUMNS];
};

struct hooke_comparison_file {
  struct hk_h5_file file;
  struct table at;
  struct hk_h5md_places place;
  hooke_measurement *measurement;
  const struct hk_comparison *comparison; /* its object */
  const struct hk_table *rows;
  struct hk_trajectory_writer *writer; /* the reference, then one a row */
  char failure[512];                   /* message of the write that made the file bad; "" while it is good */
};

/* ---- creating ---- */

/* Offset of a dataset, which this closes. */
static herr_t find(hid_t data, int64_t *at) {
  const haddr_t first = data < 0 ? HADDR_UNDEF : H5Dget_offset(data);
  hk_h5_drop(data);
  *at = (int64_t)first;
  return first == HADDR_UNDEF ? -1 : 0;
}

/* Numbers have the machine's byte order, since they are written as bytes. */
static hid_t new_numbers(hid_t where, const char *name, int rank, const hsize_t *size) {
  const double none = NAN;
  return hk_h5_array(where, name, H5T_NATIVE_DOUBLE, rank, size, &none);
}

/* "error_at" is called "error" among the series. */
static void name_of(const struct hk_column *column, char name[NAME_SIZE]) {
  snprintf(name, NAME_SIZE, "%s", column->name);
  if (column->type == HOOKE_COLUMN_SERIES) name[strlen(name) - strlen("_at")] = '\0';
}

static hid_t make_column(const hooke_comparison_file *file, hid_t table, hid_t series,
                         const struct hk_column *column) {
  const struct hk_comparison *c = file->comparison;
  const hsize_t size[2] = {(hsize_t)c->row_count, (hsize_t)c->frame_count};
  char name[NAME_SIZE];
  name_of(column, name);
  if (column->type == HOOKE_COLUMN_TEXT) return hk_h5_texts(table, name, c->row_count, TEXT_LENGTH);
  if (column->type == HOOKE_COLUMN_SERIES) return new_numbers(series, name, 2, size);
  return new_numbers(table, name, 1, size);
}

static herr_t make_table(hooke_comparison_file *file) {
  const hsize_t frames = (hsize_t)file->comparison->frame_count;
  struct table *at = &file->at;
  hid_t table = H5Gcreate2(file->file.id, "comparison", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (table < 0) return -1;
  hid_t series = H5Gcreate2(table, "series", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  herr_t result = series < 0 ? -1 : find(hk_h5_texts(table, "reference", -1, TEXT_LENGTH), &at->reference);
  if (result >= 0) result = find(new_numbers(series, "time", 1, &frames), &at->time);
  for (int32_t k = 0; result >= 0 && k < file->rows->column_count; k++)
    result = find(make_column(file, table, series, &file->rows->columns[k]), &at->column[k]);
  hk_h5_drop(series);
  hk_h5_drop(table);
  return result;
}

static herr_t make_recordings(hooke_comparison_file *file) {
  const struct hk_comparison *c = file->comparison;
  herr_t result = 0;
  for (int64_t k = 0; result >= 0 && k <= c->row_count; k++) {
    const char *group = k == 0 ? "all" : c->row[k - 1].method;
    result = hk_trajectory_writer_create(file->file.id, c->system, group, c->frame_count, &file->writer[k]);
  }
  return result;
}

/* Text number `k` of an array of texts. */
static int write_text(const hooke_comparison_file *file, int64_t at, int64_t k, const char *text) {
  char padded[TEXT_LENGTH] = {0};
  if (text) memcpy(padded, text, strnlen(text, TEXT_LENGTH));
  return hk_bytes_write(file->file.atomic.descriptor, at + k * TEXT_LENGTH, TEXT_LENGTH, padded);
}

/* Numbers of an array of the table, from number `first` on. */
static int write_numbers(const hooke_comparison_file *file, int64_t at, int64_t first, int64_t count,
                         const double *value) {
  const int64_t size = (int64_t)sizeof *value;
  return hk_bytes_write(file->file.atomic.descriptor, at + size * first, size * count, value);
}

static int write_methods(const hooke_comparison_file *file) {
  const struct hk_comparison *c = file->comparison;
  const int64_t at = file->at.column[hk_table_find(file->rows, "method") - file->rows->columns];
  int error = 0;
  for (int64_t k = 0; error == 0 && k < c->row_count; k++)
    error = write_text(file, at, k, c->row[k].method);
  return error;
}

static int32_t fill(struct hk_h5_guard *guard, const char *path, const char *scene_text,
                    hooke_comparison_file *file) {
  const struct hk_comparison *c = file->comparison;
  const double runs = (double)(c->row_count + 1), text = scene_text ? (double)strlen(scene_text) : 0.0;
  const double table = runs * (256.0 + 16.0 * (double)c->frame_count);
  const double bytes = text + table + runs * hk_trajectory_writer_bytes(c->system, c->frame_count);
  int32_t status = hk_h5_file_create_locked(guard, path, bytes, 0, &file->file);
  if (status != HOOKE_OK) return status;
  herr_t result = hk_h5md_describe(file->file.id, c->system, NULL, c->run, scene_text);
  if (result >= 0) result = make_recordings(file);
  if (result >= 0) result = hk_h5md_connect(file->file.id, c->system, "all");
  if (result >= 0) result = make_table(file);
  if (result >= 0) hk_h5md_find(file->file.id, &file->place);
  if (result < 0 || file->place.status < 0) return hk_h5_fail(guard, path, "make room for all frames");
  status = hk_h5_file_settle(guard, &file->file);
  for (int64_t k = 0; k <= c->row_count; k++)
    file->writer[k].file.descriptor = file->file.atomic.descriptor;
  const int error = status == HOOKE_OK ? write_methods(file) : 0;
  if (error) return hk_file_fail(path, "write the names of the methods", error);
  return status == HOOKE_OK ? hk_h5_file_publish(&file->file) : status;
}

static void release(hooke_comparison_file *file) {
  hk_h5_file_release(&file->file);
  hk_free(file->writer);
  hk_handle_free(file);
}

/* ---- frames ---- */

static struct hk_trajectory_writer *find_run(hooke_comparison_file *file, const char *run) {
  if (strcmp(run, "reference") == 0) return &file->writer[0];
  for (int64_t k = 1; k <= file->comparison->row_count; k++) {
    if (strcmp(file->writer[k].group, run) == 0) return &file->writer[k];
  }
  return NULL;
}

/* Observer of the comparison; a non-zero value stops it. */
static int32_t write_frame(const char *run, int64_t frame, int64_t step, const hooke_state *state,
                           void *ctx) {
  hooke_comparison_file *file = ctx;
  struct hk_trajectory_writer *writer = find_run(file, run);
  if (hk_atomic_file_require_own(&file->file.atomic) != HOOKE_OK) return 1;
  if (file->failure[0] || writer == NULL || writer->written == writer->frame_count) {
    if (file->failure[0] == '\0') {
      snprintf(file->failure, sizeof file->failure, "%s: no room for frame %lld of %s",
               file->file.atomic.path, (long long)frame, run);
    }
    return 1;
  }
  const int error = hk_trajectory_writer_write(writer, step, state);
  if (error == 0) return 0;
  char what[96];
  snprintf(what, sizeof what, "write frame %lld of %.40s", (long long)frame, run);
  hk_file_fail(file->file.atomic.path, what, error);
  snprintf(file->failure, sizeof file->failure, "%s", hooke_last_error());
  return 1;
}

static int32_t create(const char *path, hooke_measurement *m, const char *scene_text,
                      hooke_comparison_file **file) {
  hooke_comparison_file *made = hk_handle_new("hooke_comparison_file", sizeof *made);
  if (made == NULL) return HOOKE_NO_MEMORY;
  made->file = HOOKE_NO_H5_FILE;
  made->measurement = m;
  made->comparison = m->object;
  made->rows = hk_measurement_table(m->kind, "rows");
  made->writer = hk_new(made->comparison->row_count + 1, sizeof *made->writer);
  struct hk_h5_guard guard;
  hk_h5_guard_begin(&guard);
  int32_t status = made->writer ? fill(&guard, path, scene_text, made) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hooke_comparison_on_frame(m, write_frame, made);
  if (status == HOOKE_OK)
    *file = made;
  else
    release(made);
  hk_h5_guard_end(&guard);
  return status;
}

int32_t hooke_comparison_file_create(const char *path, hooke_measurement *m, hooke_comparison_file **file) {
  *file = NULL;
  int32_t status = hk_measurement_require(m, &hk_comparison_kind, "hooke_comparison_file_create");
  if (status == HOOKE_OK) status = hk_inputs_refuse(m->system, path);
  if (status == HOOKE_OK) status = hk_comparison_prepare(m->object);
  const char *scene = m->label[HOOKE_LABEL_SCENE];
  char *whole = NULL;
  if (status == HOOKE_OK) status = hk_scene_make_whole(scene, m->system, m->run, &whole);
  if (status == HOOKE_OK) status = create(path, m, whole ? whole : scene, file);
  hk_free(whole);
  return status;
}

/* ---- the table ---- */

static int write_column(const hooke_comparison_file *file, int64_t row, int32_t k) {
  const struct hk_column *column = &file->rows->columns[k];
  const int64_t at = file->at.column[k];
  const void *object = file->comparison;
  if (column->type == HOOKE_COLUMN_TEXT)
    return write_text(file, at, row, hk_table_text(file->rows, column, object, row));
  const double number = hk_table_number(file->rows, column, object, row);
  if (column->type != HOOKE_COLUMN_SERIES) return write_numbers(file, at, row, 1, &number);
  const struct hk_series series = hk_table_series(file->rows, column, object, row);
  if (series.value == NULL || file->writer[row + 1].written == 0) return 0; /* it has not run */
  return write_numbers(file, at, row * series.count, series.count, series.value);
}

static int write_table(const hooke_comparison_file *file) {
  const struct hk_comparison *c = file->comparison;
  const int64_t frames = file->writer[0].written;
  int error = write_text(file, file->at.reference, 0, c->reference.method);
  if (error == 0 && frames > 0)
    error = write_numbers(file, file->at.time, 0, frames, c->reference.frames.time);
  for (int64_t row = 0; row < c->row_count; row++) {
    for (int32_t k = 0; error == 0 && k < file->rows->column_count; k++)
      error = write_column(file, row, k);
  }
  return error;
}

/* ---- closing ---- */

static int32_t is_short(const hooke_comparison_file *file) {
  for (int64_t k = 0; k <= file->comparison->row_count; k++) {
    if (file->writer[k].written < file->writer[k].frame_count) return 1;
  }
  return 0;
}

/* An unfinished run makes the comparison a stopped one. */
static int32_t outcome_of(const hooke_comparison_file *file) {
  for (int64_t k = 0; k <= file->comparison->row_count; k++) {
    const char *status = k == 0 ? "finished" : file->comparison->row[k - 1].trial.status;
    if (file->writer[k].written == 0 || status == NULL || strcmp(status, "stopped") == 0)
      return HOOKE_STOPPED;
  }
  return HOOKE_OK;
}

/* The same file with space for exactly the written frames, and all constant data. */
static herr_t make_shorter(const hooke_comparison_file *file, hid_t old, hid_t shorter,
                           struct hk_trajectory_writer *writer, struct hk_h5_copy *copy) {
  herr_t result = hk_h5md_copy(old, shorter, copy);
  for (int64_t k = 0; result >= 0 && k <= file->comparison->row_count; k++)
    result =
        hk_trajectory_writer_copy(&file->writer[k], old, shorter, file->writer[k].written, &writer[k], copy);
  if (result >= 0) result = hk_h5md_refer(shorter, "all");
  return result < 0 ? result : hk_h5_copy(old, shorter, "comparison", NULL, copy);
}

static int copy_all(const hooke_comparison_file *file, const struct hk_h5_copy *copy, int descriptor,
                    struct hk_trajectory_writer *writer) {
  int error = hk_h5_copy_bytes(copy, file->file.atomic.descriptor, descriptor);
  for (int64_t k = 0; error == 0 && k <= file->comparison->row_count; k++) {
    writer[k].file.descriptor = descriptor;
    error = hk_frame_copy(&file->writer[k].file, &writer[k].file, file->writer[k].written);
  }
  return error;
}

/* Replaces the file by one in which every run has exactly its frames. */
static int32_t rewrite(struct hk_h5_guard *guard, const hooke_comparison_file *file,
                       struct hk_trajectory_writer *writer) {
  const char *what = "shorten the file to the frames it has";
  struct hk_h5_copy copy = {.guard = guard};
  struct hk_h5_file shorter;
  hid_t old;
  double bytes = hk_h5_file_bytes(&file->file);
  for (int64_t k = 0; k <= file->comparison->row_count; k++)
    bytes -= hk_trajectory_writer_bytes_after(&file->writer[k], file->writer[k].written);
  int32_t status = hk_h5_file_open(guard, &file->file, &old);
  if (status != HOOKE_OK) return status;
  status = hk_h5_file_create_locked(guard, file->file.atomic.path, bytes, 1, &shorter);
  if (status == HOOKE_OK && make_shorter(file, old, shorter.id, writer, &copy) < 0)
    status = hk_h5_fail(guard, file->file.atomic.path, what);
  H5Fclose(old);
  if (status == HOOKE_OK) status = hk_h5_file_settle(guard, &shorter);
  const int error = status == HOOKE_OK ? copy_all(file, &copy, shorter.atomic.descriptor, writer) : 0;
  hk_h5_copy_release(&copy);
  if (error) status = hk_file_fail(file->file.atomic.path, what, error);
  if (status == HOOKE_OK) status = hk_h5_file_publish(&shorter);
  if (status == HOOKE_OK) status = hk_h5_file_close(&shorter);
  hk_h5_file_release(&shorter);
  return status;
}

static int32_t shorten(const hooke_comparison_file *file) {
  struct hk_trajectory_writer *writer = hk_new(file->comparison->row_count + 1, sizeof *writer);
  if (writer == NULL) return HOOKE_NO_MEMORY;
  struct hk_h5_guard guard;
  hk_h5_guard_begin(&guard);
  const int32_t status = rewrite(&guard, file, writer);
  hk_h5_guard_end(&guard);
  hk_free(writer);
  return status;
}

static int32_t finish(hooke_comparison_file *file) {
  const int32_t own = hk_atomic_file_require_own(&file->file.atomic);
  if (own != HOOKE_OK) return own;
  if (file->failure[0]) {
    hk_h5md_write_status(file->file.atomic.descriptor, file->place.status, HOOKE_IO_FAILED);
    return hk_fail(HOOKE_IO_FAILED, NULL, "%s", file->failure);
  }
  int error = write_table(file);
  if (error == 0)
    error = hk_h5md_write_status(file->file.atomic.descriptor, file->place.status, outcome_of(file));
  if (error) return hk_file_fail(file->file.atomic.path, "write the table of the comparison", error);
  return is_short(file) ? shorten(file) : hk_h5_file_close(&file->file);
}

int32_t hooke_comparison_file_close(hooke_comparison_file *file) {
  if (file == NULL) return HOOKE_OK;
  int32_t status = hooke_comparison_on_frame(file->measurement, NULL, NULL);
  if (status == HOOKE_OK) status = finish(file);
  release(file);
  return status;
}

#else

static int32_t not_built(void) {
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "files of comparisons need HDF5, and this build of the library is without it");
}

int32_t hooke_comparison_file_create(const char *path, hooke_measurement *m, hooke_comparison_file **file) {
  (void)path;
  *file = NULL;
  const int32_t status = hk_measurement_require(m, &hk_comparison_kind, "hooke_comparison_file_create");
  return status == HOOKE_OK ? not_built() : status;
}

int32_t hooke_comparison_file_close(hooke_comparison_file *file) {
  return file ? not_built() : HOOKE_OK;
}

#endif
