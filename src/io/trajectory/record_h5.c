/* Reading trajectory files: scene, options, outcome and frames. */
#include "hooke/trajectory.h"

#include "core/handle.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/status.h"
#include "io/trajectory/record.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/array_open_h5.h"
#include "io/hdf5/dataset_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/trajectory/error_h5.h"
#include "io/trajectory/file_check_h5.h"
#include "io/trajectory/frame_check_h5.h"
#include "io/trajectory/h5md_h5.h"
#include "io/trajectory/record_h5.h"
#include "integrate/integrator.h"
#include "model/state.h"

#include <math.h>
#include <string.h>

/* ---- texts and options ---- */

/* Leaving it out would describe another run. */
static int32_t refuse_option(const char *name) {
  return hk_fail(HOOKE_BAD_VALUE, name, "is neither a single number nor a text in /hooke/options");
}

static int32_t unreadable(const char *name) {
  return hk_fail(HOOKE_IO_FAILED, NULL, "the option %s of the run could not be read", name);
}

static int32_t read_word(hid_t attribute, hooke_options *options, const char *name) {
  char *word = hk_h5_attribute_text(attribute);
  const int32_t status = word ? hooke_options_set_text(options, name, word) : unreadable(name);
  if (word) H5free_memory(word);
  return status;
}

static int has_attribute(hid_t group, const char *name) {
  return group >= 0 && H5Aexists(group, name) > 0;
}

/* "" if there is none. NULL without memory. */
static char *read_attribute(hid_t group, const char *name) {
  hid_t attribute = has_attribute(group, name) ? H5Aopen(group, name, H5P_DEFAULT) : -1;
  char *word = attribute >= 0 ? hk_h5_attribute_text(attribute) : NULL;
  char *text = hk_copy_text(word ? word : "");
  if (word) H5free_memory(word);
  hk_h5_drop(attribute);
  return text;
}

static int32_t read_option(hid_t attribute, hooke_options *options, const char *name) {
  hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
  const int single = space >= 0 && H5Sget_simple_extent_npoints(space) == 1;
  const H5T_class_t class = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  const int is_number = class == H5T_FLOAT || class == H5T_INTEGER;
  double number = NAN;
  int32_t status;
  if (single && is_number)
    status = H5Aread(attribute, H5T_NATIVE_DOUBLE, &number) >= 0
                 ? hooke_options_set_number(options, name, number)
                 : unreadable(name);
  else if (single && class == H5T_STRING && H5Tis_variable_str(type) > 0)
    status = read_word(attribute, options, name);
  else
    status = refuse_option(name);
  hk_h5_drop(space);
  hk_h5_drop(type);
  return status;
}

static int32_t read_options(hid_t group, hooke_options *options) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; group >= 0 && k < hooke_options_row_count(options) && status == HOOKE_OK; k++) {
    const char *name = hooke_options_row(options, k, "name");
    if (H5Aexists(group, name) <= 0) continue;
    hid_t attribute = H5Aopen(group, name, H5P_DEFAULT);
    status = attribute >= 0 ? read_option(attribute, options, name) : refuse_option(name);
    hk_h5_drop(attribute);
  }
  return status;
}

/* ---- a record ---- */

static const char *const facts[HOOKE_RECORD_FACTS] = {"version",      "sundials", "cholmod",
                                                      "instructions", "machine",  "callbacks"};

/* The contents of the group of hooke. */
static int32_t read_own(struct hooke_record *record, hid_t file) {
  hid_t group = hk_h5_open_own(file, "hooke"), options = hk_h5_open_own(group, "options");
  int32_t status = hk_h5_read_text(group, "scene", &record->scene);
  if (status == HOOKE_OK) status = hk_h5_read_text(group, "status", &record->status);
  if (status == HOOKE_OK) status = hk_h5_read_text(group, "error_by", &record->error_by);
  if (status == HOOKE_OK) status = hk_h5_read_text(group, "error_reason", &record->error_reason);
  record->run = read_attribute(group, "run");
  if (status == HOOKE_OK && record->run == NULL) status = HOOKE_NO_MEMORY;
  for (int k = 0; status == HOOKE_OK && k < HOOKE_RECORD_FACTS; k++) {
    record->fact[k] = read_attribute(group, facts[k]);
    if (record->fact[k] == NULL) status = HOOKE_NO_MEMORY;
  }
  record->is_run = has_attribute(group, "method");
  hk_h5md_find(file, &record->at);
  if (status == HOOKE_OK) status = read_options(options, record->options);
  hk_h5_drop(options);
  hk_h5_drop(group);
  return status;
}

/* A run that came to an end left a file of just its frames, so that one without a time is damaged. */
static int32_t read_times(struct hooke_record *record, struct hk_h5_guard *guard, hid_t file) {
  static const char times[] = "/particles/all/position/time";
  int64_t rows = 0, columns = 0;
  const int32_t status =
      hk_array_read_open(guard, file, record->path, times, 0, 0, 0, &record->time, &rows, &columns);
  if (status == HOOKE_OK && columns != 1) return hk_dataset_refuse(record->path, times, "is no column");
  const int is_over = hk_h5md_is_end(record->status);
  while (status == HOOKE_OK && record->frame_count < rows &&
         (is_over || !isnan(record->time[record->frame_count])))
    record->frame_count++;
  return status;
}

/* Older files do not tell, and have none. */
static int64_t read_beyond(struct hooke_record *record, hid_t file) {
  int64_t first = -1;
  hid_t data = record->at.beyond < 0 ? -1 : H5Dopen2(file, "hooke/beyond", H5P_DEFAULT);
  hid_t space = data < 0 ? -1 : H5Dget_space(data);
  if (space >= 0 && H5Sget_simple_extent_npoints(space) == 1 &&
      H5Dread(data, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &first) < 0)
    first = -1;
  record->good_count = first > 0 && first < record->frame_count ? first : record->frame_count;
  hk_h5_drop(space);
  hk_h5_drop(data);
  return first;
}

/* ---- whole or not ---- */

static int32_t damaged(const struct hooke_record *record, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "%s is damaged: %s are not those that were written, by their check value", record->path,
                 what);
}

static int32_t check_error(struct hooke_record *record, struct hk_h5_guard *guard, hid_t file,
                           uint32_t stored) {
  double *number = NULL;
  int64_t rows = 0, columns = 0;
  int32_t status =
      hk_array_read_open(guard, file, record->path, "/hooke/error", 0, 0, 0, &number, &rows, &columns);
  if (status == HOOKE_OK &&
      (rows * columns != HOOKE_ERROR_COUNT || !record->error_by || !record->error_reason ||
       hk_file_check_error(record->outcome, number, record->error_by, record->error_reason) != stored))
    status = damaged(record, "the outcome of its run, its number of frames or its error");
  hk_free(number);
  return status;
}

/* An error is of the run as it ended. */
static int32_t check_parts(struct hooke_record *record, struct hk_h5_guard *guard, hid_t file,
                           int64_t beyond) {
  uint32_t stored = 0;
  int32_t status = hk_file_check_read(guard, file, record->path, &stored, &record->is_covered);
  if (status != HOOKE_OK || !record->is_covered || !record->status) return status;
  status = hk_file_check_description(guard, file, record->path, record->scene, &record->description);
  if (status == HOOKE_OK && !hk_file_check_run(record->description, record->run))
    status = damaged(record, "the name of its run, its scene, options, masses or springs");
  if (status != HOOKE_OK) return status;
  record->outcome = hk_file_check_outcome(record->description, record->status, beyond, record->frame_count);
  if (hk_h5md_is_end(record->status) && record->outcome != stored)
    return check_error(record, guard, file, stored);
  if (record->error_by) record->error_by[0] = '\0';
  if (record->error_reason) record->error_reason[0] = '\0';
  return HOOKE_OK;
}

int32_t hk_record_check_count(const hooke_record *record) {
  const struct hk_method *method = hk_method_find(hooke_options_text(record->options, "method"));
  struct hk_schedule planned;
  if (!record->is_run || !method || !record->status || strcmp(record->status, "finished") != 0)
    return HOOKE_OK;
  const int32_t status = hk_schedule_read(method, record->options, &planned);
  if (status != HOOKE_OK || planned.frames == record->frame_count) return status;
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s is damaged: it has %lld frames, and its finished run has %lld",
                 record->path, (long long)record->frame_count, (long long)planned.frames);
}

/* close_file() has to follow in any case. */
static int32_t open_file(const struct hooke_record *record, struct hk_h5_guard *guard, hid_t *file) {
  hk_h5_guard_begin(guard);
  return hk_dataset_file(guard, record->path, file);
}

static void close_file(const struct hk_h5_guard *guard, hid_t file) {
  if (file >= 0) H5Fclose(file);
  hk_h5_guard_end(guard);
}

static int32_t read_file(struct hooke_record *record) {
  struct hk_h5_guard guard;
  hid_t file;
  int32_t status = open_file(record, &guard, &file);
  if (status == HOOKE_OK) status = read_own(record, file);
  if (status == HOOKE_BAD_VALUE) status = hk_fail_before(status, "%s: ", record->path);
  /* an unreadable object is not a missing one */
  if (status == HOOKE_OK && guard.reason[0]) status = hk_h5_fail(&guard, record->path, "read the file");
  if (status == HOOKE_OK) status = read_times(record, &guard, file);
  if (status == HOOKE_OK) status = check_parts(record, &guard, file, read_beyond(record, file));
  if (status == HOOKE_OK) hk_record_find_places(record, file);
  close_file(&guard, file);
  return status;
}

int32_t hooke_record_open(const char *path, hooke_record **out) {
  HOOKE_KEEP_ERRNO;
  *out = NULL;
  struct hooke_record *record = hk_handle_new("hooke_record", sizeof *record);
  if (record == NULL) return HOOKE_NO_MEMORY;
  record->path = hk_copy_text(path);
  int32_t status = record->path ? hooke_options_create("run", &record->options) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = read_file(record);
  if (status == HOOKE_OK && record->status == NULL)
    status = hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is no trajectory of hooke: it has no /hooke/status", path);
  if (status == HOOKE_OK)
    *out = record;
  else
    hooke_record_close(record);
  return status;
}

void hooke_record_close(hooke_record *record) {
  if (record == NULL) return;
  hooke_options_destroy(record->options);
  hk_free(record->path);
  hk_free(record->scene);
  hk_free(record->status);
  hk_free(record->run);
  hk_free(record->error_by);
  hk_free(record->error_reason);
  for (int k = 0; k < HOOKE_RECORD_FACTS; k++)
    hk_free(record->fact[k]);
  hk_free(record->time);
  hk_free(record->kept.value);
  hk_handle_free(record);
}

const char *hooke_record_text(const hooke_record *record, const char *what) {
  if (strcmp(what, "scene") == 0) return record->scene ? record->scene : "";
  if (strcmp(what, "run") == 0) return record->run;
  if (strcmp(what, "error_by") == 0) return record->error_by ? record->error_by : "";
  if (strcmp(what, "error_reason") == 0) return record->error_reason ? record->error_reason : "";
  for (int k = 0; k < HOOKE_RECORD_FACTS; k++)
    if (strcmp(what, facts[k]) == 0) return record->fact[k] ? record->fact[k] : "";
  return strcmp(what, "status") == 0 ? record->status : NULL;
}

const char *hk_record_path(const hooke_record *record) {
  return record->path;
}

double hk_record_time(const hooke_record *record, int64_t frame) {
  return record->time[frame];
}

int32_t hk_record_is_run(const hooke_record *record) {
  return record->is_run;
}

const char *hk_record_parts(const hooke_record *record) {
  return record->is_covered ? "checked" : "not-covered";
}

const hooke_options *hooke_record_options(const hooke_record *record) {
  return record->options;
}

int64_t hooke_record_count(const hooke_record *record, const char *what) {
  if (strcmp(what, "frames") == 0) return record->frame_count;
  return strcmp(what, "good_frames") == 0 ? record->good_count : -1;
}

static const char position[] = "/particles/all/position/value", velocity[] = "/particles/all/velocity/value";

static int32_t find_frame(const hooke_record *record, int64_t frame, int64_t *at) {
  *at = frame < 0 ? record->frame_count + frame : frame;
  if (*at >= 0 && *at < record->frame_count) {
    if (!isnan(record->time[*at])) return HOOKE_OK;
    return hk_fail(HOOKE_BAD_VALUE, NULL, "frame %lld of %s is damaged: it has no time", (long long)*at,
                   record->path);
  }
  return hk_fail(HOOKE_BAD_VALUE, "frame", "there is no frame %lld; %s has %lld", (long long)frame,
                 record->path, (long long)record->frame_count);
}

int32_t hooke_record_check(const hooke_record *record, int64_t frame) {
  int64_t at;
  int32_t status = find_frame(record, frame, &at);
  if (status != HOOKE_OK) return status;
  struct hk_h5_guard guard;
  hid_t file;
  status = open_file(record, &guard, &file);
  if (status == HOOKE_OK) status = hk_frame_check(&guard, file, record->path, position, at, NULL);
  close_file(&guard, file);
  return status;
}

/* To be released by hk_free(). The first array of a frame that is read triggers the check of the frame. */
static int32_t read_rows(const struct hooke_record *record, struct hk_h5_guard *guard, hid_t file,
                         const char *dataset, int64_t frame, int64_t size, double **values) {
  int64_t rows = 0, columns = 0;
  const int32_t status = hk_array_read_open(guard, file, record->path, dataset, frame, 1, dataset == position,
                                            values, &rows, &columns);
  if (status != HOOKE_OK || rows * columns == size) return status;
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: dataset %s has %lld numbers a frame; the state has %lld",
                 record->path, dataset, (long long)(rows * columns), (long long)size);
}

/* A state never mixes two frames. */
static void take_frame(hooke_state *state, double time, const double *q, const double *v) {
  const size_t bytes = (size_t)hooke_state_size(state) * sizeof *q;
  memcpy(hooke_state_position(state), q, bytes);
  memcpy(hooke_state_velocity(state), v, bytes);
  hooke_state_set_time(state, time);
}

int32_t hooke_record_read(const hooke_record *record, int64_t frame, hooke_state *state) {
  int64_t at;
  const int64_t size = hooke_state_size(state);
  double *q = NULL, *v = NULL;
  int32_t status = find_frame(record, frame, &at);
  if (status == HOOKE_OK) status = hk_state_check(state, size, 1); /* of a system */
  if (status != HOOKE_OK) return status;
  struct hk_h5_guard guard;
  hid_t file;
  status = open_file(record, &guard, &file);
  if (status == HOOKE_OK) status = read_rows(record, &guard, file, position, at, size, &q);
  if (status == HOOKE_OK) status = read_rows(record, &guard, file, velocity, at, size, &v);
  close_file(&guard, file);
  if (status == HOOKE_OK) take_frame(state, record->time[at], q, v);
  hk_free(v);
  hk_free(q);
  return status;
}

#else

#include <stddef.h>

int32_t hooke_record_open(const char *path, hooke_record **record) {
  *record = NULL;
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "%s: reading it needs HDF5, which this build of the library is without", path);
}

void hooke_record_close(hooke_record *record) {
  (void)record;
}

const char *hooke_record_text(const hooke_record *record, const char *what) {
  (void)record, (void)what;
  return NULL;
}

const char *hk_record_path(const hooke_record *record) {
  (void)record;
  return NULL;
}

double hk_record_time(const hooke_record *record, int64_t frame) {
  (void)record, (void)frame;
  return 0.0;
}

const char *hk_record_parts(const hooke_record *record) {
  (void)record;
  return "";
}

int32_t hk_record_check_count(const hooke_record *record) {
  (void)record;
  return HOOKE_OK;
}

int32_t hk_record_is_run(const hooke_record *record) {
  (void)record;
  return 0;
}

const hooke_options *hooke_record_options(const hooke_record *record) {
  (void)record;
  return NULL;
}

int64_t hooke_record_count(const hooke_record *record, const char *what) {
  (void)record, (void)what;
  return 0;
}

int32_t hooke_record_check(const hooke_record *record, int64_t frame) {
  (void)record, (void)frame;
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "reading trajectories needs HDF5, which this build of the library is without");
}

int32_t hooke_record_read(const hooke_record *record, int64_t frame, hooke_state *state) {
  (void)record, (void)frame, (void)state;
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "reading trajectories needs HDF5, which this build of the library is without");
}

#endif
