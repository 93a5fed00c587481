/* Reads trajectory files by HDF5. */
#include "core/memory.h"
#include "core/status.h"
#include "io/trajectory/record.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/dataset_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/trajectory/h5md_h5.h"

#include <math.h>

/* ---- texts and options ---- */

static int32_t unreadable(const char *name) {
  return hk_fail(HOOKE_IO_FAILED, NULL, "%s of the run could not be read", name);
}

static int32_t read_word(hid_t attribute, hooke_options *options, const char *name) {
  char *word = hk_h5_attribute_text(attribute);
  const int32_t status = word ? hooke_options_set_text(options, name, word) : unreadable(name);
  if (word) H5free_memory(word);
  return status;
}

/* Below 0 if that is not known. */
static htri_t has_attribute(hid_t group, const char *name) {
  return group >= 0 ? H5Aexists(group, name) : 0;
}

/* "" if there is none. */
static int32_t read_attribute(hid_t group, const char *name, char **text) {
  const htri_t there = has_attribute(group, name);
  hid_t attribute = there > 0 ? H5Aopen(group, name, H5P_DEFAULT) : -1;
  char *word = attribute >= 0 ? hk_h5_attribute_text(attribute) : NULL;
  const int32_t read = there == 0 || word;
  *text = read ? hk_copy_text(word ? word : "") : NULL;
  if (word) H5free_memory(word);
  hk_h5_drop(attribute);
  return *text ? HOOKE_OK : read ? HOOKE_NO_MEMORY : unreadable(name);
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
  else /* leaving it out would describe another run */
    status = hk_fail(HOOKE_BAD_VALUE, name, "is neither a single number nor a text in /hooke/options");
  hk_h5_drop(space);
  hk_h5_drop(type);
  return status;
}

static int32_t read_options(hid_t group, hooke_options *options) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; group >= 0 && k < hooke_options_row_count(options) && status == HOOKE_OK; k++) {
    const char *name = hooke_options_row(options, k, "name");
    const htri_t there = has_attribute(group, name);
    if (there == 0) continue;
    hid_t attribute = there > 0 ? H5Aopen(group, name, H5P_DEFAULT) : -1;
    status = attribute >= 0 ? read_option(attribute, options, name) : unreadable(name);
    hk_h5_drop(attribute);
  }
  return status;
}

/* ---- a record ---- */

/* The contents of the group of hooke. */
static int32_t read_own(struct hooke_record *record, hid_t file) {
  hid_t group = hk_h5_open_own(file, "hooke"), options = hk_h5_open_own(group, "options");
  int32_t status = HOOKE_OK;
  for (int k = 0; status == HOOKE_OK && k < HOOKE_RECORD_TEXTS; k++) {
    if (k < HOOKE_RECORD_ARRAYS)
      status = hk_h5_read_text(group, hk_record_texts[k], &record->text[k]);
    else
      status = read_attribute(group, hk_record_texts[k], &record->text[k]);
  }
  const htri_t is_run = has_attribute(group, "method");
  record->is_run = is_run > 0;
  if (status == HOOKE_OK && is_run < 0) status = unreadable("method");
  hk_h5md_find(file, record->at);
  if (status == HOOKE_OK) status = read_options(options, record->options);
  hk_h5_drop(options);
  hk_h5_drop(group);
  return status;
}

/* A run that came to an end left a file of just its frames, so that one without a time is damaged. */
static int32_t read_times(struct hooke_record *record, struct hk_h5_guard *guard) {
  const struct hk_dataset times = {guard, "/particles/all/position/time", -1, 1, {0}};
  int64_t rows, columns;
  const int32_t status = hk_array_read_open(guard, times.name, 0, 0, 0, &record->time, &rows, &columns);
  if (status == HOOKE_OK && columns != 1) return hk_dataset_refuse(&times, "is no column");
  const int is_over = hk_outcome_is_end(record->text[HOOKE_RECORD_STATUS]);
  while (status == HOOKE_OK && record->frame_count < rows &&
         (is_over || !isnan(record->time[record->frame_count])))
    record->frame_count++;
  return status;
}

/* Older files do not tell, and have none. */
static int64_t read_beyond(struct hooke_record *record, hid_t file) {
  int64_t first = -1;
  hid_t data = record->at[HOOKE_PART_BEYOND] < 0 ? -1 : H5Dopen2(file, "hooke/beyond", H5P_DEFAULT);
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

static int32_t check_error(struct hooke_record *record, struct hk_h5_guard *guard, uint32_t stored) {
  double *number;
  int64_t rows, columns;
  const char *by = record->text[HOOKE_RECORD_BY], *reason = record->text[HOOKE_RECORD_REASON];
  int32_t status = hk_array_read_open(guard, "/hooke/error", 0, 0, 0, &number, &rows, &columns);
  if (status == HOOKE_OK && (rows * columns != HOOKE_ERROR_COUNT || !by || !reason ||
                             hk_outcome_check_error(record->outcome, number, by, reason) != stored))
    status = damaged(record, "the outcome of its run, its number of frames or its error");
  hk_free(number);
  return status;
}

/* An error is of the run as it ended. */
static int32_t check_parts(struct hooke_record *record, struct hk_h5_guard *guard, int64_t beyond) {
  char *const *text = record->text;
  const char *run_status = text[HOOKE_RECORD_STATUS];
  uint32_t stored = 0;
  int32_t status = hk_file_check_read(guard, &stored, &record->is_covered);
  if (status != HOOKE_OK || !record->is_covered || !run_status) return status;
  status = hk_file_check_description(guard, text[HOOKE_RECORD_SCENE], &record->description);
  if (status == HOOKE_OK && !hk_outcome_check_run(record->description, text[HOOKE_RECORD_RUN]))
    status = damaged(record, "the name of its run, its scene, options, masses or springs");
  if (status != HOOKE_OK) return status;
  record->outcome = hk_outcome_check(record->description, run_status, beyond, record->frame_count);
  if (hk_outcome_is_end(run_status) && record->outcome != stored) return check_error(record, guard, stored);
  for (int k = HOOKE_RECORD_BY; k <= HOOKE_RECORD_REASON; k++)
    if (text[k]) text[k][0] = '\0';
  return HOOKE_OK;
}

int32_t hk_record_load(hooke_record *record) {
  struct hk_h5_guard guard;
  int32_t status = hk_h5_guard_read(&guard, record->path);
  if (status == HOOKE_OK) status = read_own(record, guard.file);
  if (status == HOOKE_BAD_VALUE) status = hk_fail_before(status, "%s: ", record->path);
  /* an unreadable object is not a missing one */
  if (status == HOOKE_OK && guard.reason[0]) status = hk_h5_fail(&guard, "read the file");
  if (status == HOOKE_OK) status = read_times(record, &guard);
  if (status == HOOKE_OK) status = check_parts(record, &guard, read_beyond(record, guard.file));
  if (status == HOOKE_OK) status = hk_frame_arrays_find(&guard, &record->frames);
  hk_h5_guard_end(&guard);
  return status;
}

/* ---- frames ---- */

static const char position[] = "/particles/all/position/value", velocity[] = "/particles/all/velocity/value";

/* To be released by hk_free(). The first array of a frame that is read triggers the check of the frame. */
static int32_t read_rows(struct hk_h5_guard *guard, const char *dataset, int64_t frame, int64_t size,
                         double **values) {
  int64_t rows, columns;
  const int32_t status =
      hk_array_read_open(guard, dataset, frame, 1, dataset == position, values, &rows, &columns);
  if (status != HOOKE_OK || rows * columns == size) return status;
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: dataset %s has %lld numbers a frame; the state has %lld",
                 guard->path, dataset, (long long)(rows * columns), (long long)size);
}

int32_t hk_record_read_frame(const hooke_record *record, int64_t at, int64_t size, double **q, double **v) {
  struct hk_h5_guard guard;
  int32_t status = hk_h5_guard_read(&guard, record->path);
  if (status == HOOKE_OK && q == NULL) status = hk_frame_check(&guard, position, at, NULL);
  if (status == HOOKE_OK && q) status = read_rows(&guard, position, at, size, q);
  if (status == HOOKE_OK && v) status = read_rows(&guard, velocity, at, size, v);
  hk_h5_guard_end(&guard);
  return status;
}

#else

static int32_t not_built(const hooke_record *record) {
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "%s: reading it needs HDF5, which this build of the library is without", record->path);
}

int32_t hk_record_load(hooke_record *record) {
  return not_built(record);
}

int32_t hk_record_read_frame(const hooke_record *record, int64_t at, int64_t size, double **q, double **v) {
  (void)at, (void)size, (void)q, (void)v;
  return not_built(record);
}

#endif
