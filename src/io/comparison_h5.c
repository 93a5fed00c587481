/* A comparison in one H5MD file: the reference under /particles/all, each method under /particles/<method>, the options
 * that all have in common under /hooke/options, and
 *
 *   /comparison/reference              the method of the reference
 *   /comparison/method, status         [rows], texts
 *   /comparison/<column>               [rows], one array for each number of hooke_comparison_number(), NaN where
 *                                      there is none
 *   /comparison/series/time            [frames]
 *   /comparison/series/error           [rows][frames], likewise energy_drift; NaN past the end of a run
 *
 * Texts are padded with zeros. All of it is made in advance and written in place, like the frames. */
#include "core/handle.h"
#include "core/memory.h"
#include "core/status.h"
#include "hooke/io.h"

#if HOOKE_HAVE_HDF5

#include "io/file_h5.h"
#include "io/h5md_h5.h"
#include "io/object_h5.h"
#include "io/place.h"
#include "io/recording_h5.h"
#include "measure/comparison.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_LENGTH = 32 };

static const char *const columns[] = {"step",      "rtol",        "atol",         "error",
                                      "error_max", "error_final", "energy_drift", "force_evaluations",
                                      "steps",     "wall_seconds"};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };
static const char *const series[] = {"error", "energy_drift"};

struct hooke_comparison_file {
  struct hooke_h5_file file;
  hooke_comparison *comparison;
  int64_t row_count, frame_count;
  struct hooke_recording *recording; /* the reference, then a row each */
  char failure[512];                 /* of the write that made the file bad; "" while it is good */
};

/* ---- making ---- */

static const char *method_of(const hooke_comparison_file *file, int64_t row) {
  const char *method = hooke_comparison_text(file->comparison, row, "method");
  return method ? method : "";
}

static herr_t write_text(hid_t table, const char *name, int64_t row, const char *text) {
  hid_t data = H5Dopen2(table, name, H5P_DEFAULT);
  herr_t result = data < 0 ? -1 : hooke_h5_write_text(data, row, text ? text : "");
  hooke_h5_drop(data);
  return result;
}

static herr_t make_table(const hooke_comparison_file *file) {
  const double none = NAN;
  const hsize_t rows = (hsize_t)file->row_count, frames = (hsize_t)file->frame_count,
                both[2] = {rows, frames};
  hid_t table = H5Gcreate2(file->file.id, "comparison", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  hid_t group = table < 0 ? -1 : H5Gcreate2(table, "series", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  hid_t made[COLUMN_COUNT + 6];
  int count = 0;
  if (group >= 0) {
    made[count++] = hooke_h5_texts(table, "reference", -1, TEXT_LENGTH);
    made[count++] = hooke_h5_texts(table, "method", file->row_count, TEXT_LENGTH);
    made[count++] = hooke_h5_texts(table, "status", file->row_count, TEXT_LENGTH);
    for (int k = 0; k < COLUMN_COUNT; k++) {
      made[count++] = hooke_h5_array(table, columns[k], H5T_IEEE_F64LE, 1, &rows, &none);
    }
    made[count++] = hooke_h5_array(group, "time", H5T_IEEE_F64LE, 1, &frames, &none);
    for (int k = 0; k < 2; k++)
      made[count++] = hooke_h5_array(group, series[k], H5T_IEEE_F64LE, 2, both, &none);
  }
  herr_t result = count == 0 ? -1 : 0;
  for (int k = 0; k < count; k++) {
    if (made[k] < 0) result = -1;
    hooke_h5_drop(made[k]);
  }
  for (int64_t k = 0; result >= 0 && k < file->row_count; k++)
    result = write_text(table, "method", k, method_of(file, k));
  hooke_h5_drop(group);
  hooke_h5_drop(table);
  return result;
}

static herr_t make_recordings(hooke_comparison_file *file, const hooke_system *system) {
  herr_t result = 0;
  for (int64_t k = 0; result >= 0 && k <= file->row_count; k++) {
    const char *group = k == 0 ? "all" : method_of(file, k - 1);
    result = hooke_recording_create(file->file.id, system, group, file->frame_count, &file->recording[k]);
  }
  return result;
}

static int32_t fill(struct hooke_h5_guard *guard, const char *path, const hooke_system *system,
                    const char *scene_text, hooke_comparison_file *file) {
  const double runs = (double)(file->row_count + 1), text = scene_text ? (double)strlen(scene_text) : 0.0;
  const double table = runs * (256.0 + 16.0 * (double)file->frame_count);
  const double bytes = text + table + runs * hooke_recording_bytes(system, file->frame_count);
  int32_t status = hooke_h5_file_create(guard, path, bytes, &file->file);
  if (status != HOOKE_OK) return status;
  herr_t result = hooke_h5md_describe(file->file.id, NULL, file->comparison->options, scene_text);
  if (result >= 0) result = make_recordings(file, system);
  if (result >= 0) result = hooke_h5md_connect(file->file.id, system, "all");
  if (result >= 0) result = make_table(file);
  if (result < 0) return hooke_h5_fail(guard, path, "make room for all frames");
  return hooke_h5_file_publish(guard, &file->file);
}

static void release(hooke_comparison_file *file) {
  for (int64_t k = 0; file->recording && k <= file->row_count; k++)
    hooke_recording_release(&file->recording[k]);
  hooke_h5_file_release(&file->file);
  hooke_free(file->recording);
  hooke_handle_free(file);
}

/* ---- frames ---- */

static struct hooke_recording *find(hooke_comparison_file *file, const char *run) {
  if (strcmp(run, "reference") == 0) return &file->recording[0];
  for (int64_t k = 1; k <= file->row_count; k++) {
    if (strcmp(file->recording[k].group, run) == 0) return &file->recording[k];
  }
  return NULL;
}

/* Observer of the comparison: anything but 0 stops it. */
static int32_t write_frame(const char *run, int64_t frame, int64_t step, const hooke_state *state,
                           void *ctx) {
  hooke_comparison_file *file = ctx;
  struct hooke_recording *recording = find(file, run);
  if (file->failure[0] || recording == NULL || recording->written == recording->frame_count) {
    if (file->failure[0] == '\0') {
      snprintf(file->failure, sizeof file->failure, "%s: no room for frame %lld of %s", file->file.path,
               (long long)frame, run);
    }
    return 1;
  }
  const int error = hooke_recording_write(recording, step, state);
  if (error == 0) return 0;
  char what[96];
  snprintf(what, sizeof what, "write frame %lld of %.40s", (long long)frame, run);
  hooke_place_fail(file->file.path, what, error);
  snprintf(file->failure, sizeof file->failure, "%s", hooke_last_error());
  return 1;
}

int32_t hooke_comparison_file_create(const char *path, const hooke_system *system,
                                     hooke_comparison *comparison, const char *scene_text,
                                     hooke_comparison_file **file) {
  *file = NULL;
  int32_t status = hooke_comparison_prepare(comparison);
  if (status != HOOKE_OK) return status;
  hooke_comparison_file *made = hooke_handle_new("hooke_comparison_file", sizeof *made);
  if (made == NULL) return HOOKE_NO_MEMORY;
  made->file.id = -1;
  made->comparison = comparison;
  made->row_count = hooke_comparison_row_count(comparison);
  made->frame_count = hooke_comparison_frame_count(comparison);
  made->recording = hooke_new(made->row_count + 1, sizeof *made->recording);
  for (int64_t k = 0; made->recording && k <= made->row_count; k++)
    hooke_recording_clear(&made->recording[k]);

  struct hooke_h5_guard guard;
  hooke_h5_guard_begin(&guard);
  status = made->recording ? fill(&guard, path, system, scene_text, made) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    hooke_comparison_on_frame(comparison, write_frame, made);
    *file = made;
  } else {
    release(made);
  }
  hooke_h5_guard_end(&guard);
  return status;
}

/* ---- the table ---- */

/* Writes `count` numbers of an array of the table: from `first` on (rank 1), or in row `first` (rank 2). */
static herr_t write_numbers(hid_t table, const char *name, int rank, int64_t first, int64_t count,
                            const double *value) {
  const hsize_t line = (hsize_t)count;
  const hsize_t begin[2] = {(hsize_t)first, 0}, size[2] = {rank == 1 ? line : 1, line};
  hid_t data = H5Dopen2(table, name, H5P_DEFAULT);
  hid_t there = data < 0 ? -1 : H5Dget_space(data), here = H5Screate_simple(1, &line, NULL);
  herr_t result = there < 0 || here < 0 ? -1 : 0;
  if (result >= 0) result = H5Sselect_hyperslab(there, H5S_SELECT_SET, begin, NULL, size, NULL);
  if (result >= 0) result = H5Dwrite(data, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, value);
  hooke_h5_drop(here);
  hooke_h5_drop(there);
  hooke_h5_drop(data);
  return result;
}

static herr_t write_table_row(const hooke_comparison_file *file, hid_t table, int64_t row) {
  const hooke_comparison *comparison = file->comparison;
  herr_t result = write_text(table, "method", row, method_of(file, row));
  if (result >= 0)
    result = write_text(table, "status", row, hooke_comparison_text(comparison, row, "status"));
  for (int k = 0; result >= 0 && k < COLUMN_COUNT; k++) {
    const double number = hooke_comparison_number(comparison, row, columns[k]);
    result = write_numbers(table, columns[k], 1, row, 1, &number);
  }
  if (file->recording[row + 1].written == 0) return result; /* it has not run: no series */
  for (int k = 0; result >= 0 && k < 2; k++) {
    const double *value = hooke_comparison_series(comparison, row, series[k]);
    char name[32];
    snprintf(name, sizeof name, "series/%s", series[k]);
    if (value) result = write_numbers(table, name, 2, row, file->frame_count, value);
  }
  return result;
}

static herr_t write_table(const hooke_comparison_file *file) {
  hid_t table = H5Gopen2(file->file.id, "comparison", H5P_DEFAULT);
  herr_t result = table < 0 ? -1 : 0;
  if (result >= 0) result = write_text(table, "reference", 0, hooke_comparison_reference(file->comparison));
  const double *time = hooke_comparison_series(file->comparison, 0, "time");
  const int64_t frames = file->recording[0].written;
  if (result >= 0 && frames > 0) result = write_numbers(table, "series/time", 1, 0, frames, time);
  for (int64_t k = 0; result >= 0 && k < file->row_count; k++)
    result = write_table_row(file, table, k);
  hooke_h5_drop(table);
  return result;
}

/* ---- closing ---- */

static int32_t is_short(const hooke_comparison_file *file) {
  for (int64_t k = 0; k <= file->row_count; k++) {
    if (file->recording[k].written < file->recording[k].frame_count) return 1;
  }
  return 0;
}

/* A run that was never begun, or was interrupted, makes the comparison a stopped one. */
static int32_t outcome_of(const hooke_comparison_file *file) {
  for (int64_t k = 0; k <= file->row_count; k++) {
    const char *status = k == 0 ? "finished" : hooke_comparison_text(file->comparison, k - 1, "status");
    if (file->recording[k].written == 0 || status == NULL || strcmp(status, "stopped") == 0)
      return HOOKE_STOPPED;
  }
  return HOOKE_OK;
}

/* A new file in which every run has exactly its frames takes the place of ours. */
static int32_t rewrite(struct hooke_h5_guard *guard, const hooke_comparison_file *file) {
  struct hooke_h5_file shorter;
  double bytes = hooke_h5_file_bytes(&file->file);
  for (int64_t k = 0; k <= file->row_count; k++)
    bytes -= hooke_recording_unused_bytes(&file->recording[k]);
  int32_t status = hooke_h5_file_create(guard, file->file.path, bytes, &shorter);
  herr_t result = 0;
  for (int64_t k = 0; status == HOOKE_OK && result >= 0 && k <= file->row_count; k++) {
    struct hooke_recording recording;
    result = hooke_recording_copy(&file->recording[k], shorter.id, &recording);
    hooke_recording_release(&recording);
  }
  if (status == HOOKE_OK) {
    if (result >= 0) result = hooke_h5md_copy(file->file.id, shorter.id, "all");
    if (result >= 0) {
      result = H5Ocopy(file->file.id, "comparison", shorter.id, "comparison", H5P_DEFAULT, H5P_DEFAULT);
    }
    if (result < 0) status = hooke_h5_fail(guard, file->file.path, "shorten the file to the frames it has");
  }
  if (status == HOOKE_OK) status = hooke_h5_file_finish(guard, &shorter);
  hooke_h5_file_release(&shorter);
  return status;
}

static int32_t finish(struct hooke_h5_guard *guard, hooke_comparison_file *file) {
  if (file->failure[0]) return hooke_fail(HOOKE_IO_FAILED, NULL, "%s", file->failure);
  if (write_table(file) < 0 || hooke_h5md_write_status(file->file.id, outcome_of(file)) < 0) {
    return hooke_h5_fail(guard, file->file.path, "write the table of the comparison");
  }
  if (is_short(file)) return rewrite(guard, file);
  for (int64_t k = 0; k <= file->row_count; k++)
    hooke_recording_release(&file->recording[k]);
  return hooke_h5_file_finish(guard, &file->file);
}

int32_t hooke_comparison_file_close(hooke_comparison_file *file) {
  if (file == NULL) return HOOKE_OK;
  struct hooke_h5_guard guard;
  hooke_h5_guard_begin(&guard);
  hooke_comparison_on_frame(file->comparison, NULL, NULL);
  int32_t status = finish(&guard, file);
  release(file);
  hooke_h5_guard_end(&guard);
  return status;
}

#else

static int32_t not_built(void) {
  return hooke_fail(HOOKE_NOT_BUILT, NULL,
                    "files of comparisons need HDF5, and this build of the library is without it");
}

int32_t hooke_comparison_file_create(const char *path, const hooke_system *system,
                                     hooke_comparison *comparison, const char *scene_text,
                                     hooke_comparison_file **file) {
  (void)path, (void)system, (void)comparison, (void)scene_text;
  *file = NULL;
  return not_built();
}

int32_t hooke_comparison_file_close(hooke_comparison_file *file) {
  return file ? not_built() : HOOKE_OK;
}

#endif
