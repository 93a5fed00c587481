/* Reading trajectory files: scene, options, outcome and frames. */
#include "io/trajectory/record.h"

#include "core/handle.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/status.h"
#include "hooke/estimate.h"
#include "integrate/integrator.h"
#include "io/file/atomic_file.h"
#include "io/file/bytes.h"
#include "io/hdf5/array_h5.h"
#include "measure/estimate/estimate.h"
#include "model/state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

const char *const hk_record_texts[HOOKE_RECORD_TEXTS] = {
    "scene", "status",       "error_by", "error_reason", "run",        "version",    "sundials",    "cholmod",
    "blas",  "instructions", "machine",  "callbacks",    "force_file", "force_name", "force_sha256"};

int32_t hk_record_is_one(const char *path) {
  static const char signature[8] = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  char begin[sizeof signature] = {0};
  const int file = hk_file_open(path);
  if (file < 0) return 0;
  const int error = hk_bytes_read(file, 0, sizeof begin, begin);
  close(file);
  return error == 0 && memcmp(begin, signature, sizeof begin) == 0;
}

int32_t hk_record_require_run(const hooke_record *record) {
  if (record->is_run) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of several runs; allowed: a trajectory of one run",
                 record->path);
}

int32_t hk_record_check_count(const hooke_record *record) {
  const struct hk_method *method = hk_method_find(hooke_options_text(record->options, "method"));
  struct hk_schedule planned;
  if (!record->is_run || !method || strcmp(hooke_record_text(record, "status"), "finished") != 0)
    return HOOKE_OK;
  const int32_t status = hk_schedule_read(method, record->options, &planned);
  if (status != HOOKE_OK || planned.frames == record->frame_count) return status;
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s is damaged: it has %lld frames, and its finished run has %lld",
                 record->path, (long long)record->frame_count, (long long)planned.frames);
}

int32_t hooke_record_open(const char *path, hooke_record **out) {
  HOOKE_KEEP_ERRNO;
  *out = NULL;
  struct hooke_record *record = hk_handle_new("hooke_record", sizeof *record);
  if (record == NULL) return HOOKE_NO_MEMORY;
  record->path = hk_copy_text(path);
  int32_t status = record->path ? hooke_options_create("run", &record->options) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hk_record_load(record);
  if (status == HOOKE_OK && record->text[HOOKE_RECORD_STATUS] == NULL)
    status = hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is no trajectory of hooke: it has no /hooke/status", path);
  return HOOKE_HAND_OVER(status, record, out, hooke_record_close);
}

void hooke_record_close(hooke_record *record) {
  if (record == NULL) return;
  hooke_options_destroy(record->options);
  for (int k = 0; k < HOOKE_RECORD_TEXTS; k++)
    hk_free(record->text[k]);
  hk_free(record->path);
  hk_free(record->time);
  hk_free(record->kept.value);
  hk_handle_free(record);
}

const char *hooke_record_text(const hooke_record *record, const char *what) {
  for (int k = 0; k < HOOKE_RECORD_TEXTS; k++)
    if (strcmp(what, hk_record_texts[k]) == 0) return record->text[k] ? record->text[k] : "";
  return NULL;
}

const char *hk_record_path(const hooke_record *record) {
  return record->path;
}

const hooke_options *hooke_record_options(const hooke_record *record) {
  return record->options;
}

int64_t hooke_record_count(const hooke_record *record, const char *what) {
  if (strcmp(what, "frames") == 0) return record->frame_count;
  return strcmp(what, "good_frames") == 0 ? record->good_count : -1;
}

/* ---- frames ---- */

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
  const int32_t status = find_frame(record, frame, &at);
  return status == HOOKE_OK ? hk_record_read_frame(record, at, 0, NULL, NULL) : status;
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
  if (status == HOOKE_OK) status = hk_record_read_frame(record, at, size, &q, &v);
  if (status == HOOKE_OK) take_frame(state, record->time[at], q, v);
  hk_free(v);
  hk_free(q);
  return status;
}

/* ---- whole arrays ---- */

static int32_t find_dataset(const char *what, char *dataset, size_t capacity) {
  static const struct {
    const char *what, *dataset;
  } known[] = {{"time", "/particles/all/position/time"}, {"step", "/particles/all/position/step"},
               {"springs", "/connectivity/springs"},     {"mass", "/particles/all/mass"},
               {"species", "/particles/all/species"},    {"error", "/hooke/error"}};
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
    if (strcmp(what, known[k].what) != 0) continue;
    snprintf(dataset, capacity, "%s", known[k].dataset);
    return HOOKE_OK;
  }
  for (int k = 0; k < HOOKE_OBSERVABLE_COUNT; k++) {
    if (strcmp(what, hk_observables[k].name) != 0) continue;
    snprintf(dataset, capacity, "/observables/%s/value", what);
    return HOOKE_OK;
  }
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "a trajectory has no \"%.80s\"; allowed: time, step, springs, mass, species, error, or a "
                 "quantity such as kinetic_energy",
                 what);
}

static void drop_kept(hooke_record *record) {
  hk_free(record->kept.value);
  record->kept.value = NULL;
}

/* Reads the array unless it is the cached one. */
static int32_t keep(hooke_record *record, const char *what) {
  char dataset[sizeof record->kept.dataset];
  const int32_t status = find_dataset(what, dataset, sizeof dataset);
  if (status != HOOKE_OK) return status;
  if (record->kept.value && strcmp(record->kept.dataset, dataset) == 0) return HOOKE_OK;
  drop_kept(record);
  snprintf(record->kept.dataset, sizeof record->kept.dataset, "%s", dataset);
  const int32_t read = hk_array_read(record->path, dataset, 0, 0, &record->kept.value, &record->kept.rows,
                                     &record->kept.columns);
  const int unknown = strcmp(what, "error") == 0 && !hooke_record_text(record, "error_by")[0] &&
                      !hooke_record_text(record, "error_reason")[0];
  for (int64_t k = 0; read == HOOKE_OK && unknown && k < record->kept.rows * record->kept.columns; k++)
    record->kept.value[k] = NAN;
  return read;
}

int32_t hooke_record_size(hooke_record *record, const char *what, int64_t *rows, int64_t *columns) {
  const int32_t status = keep(record, what);
  *rows = status == HOOKE_OK ? record->kept.rows : 0;
  *columns = status == HOOKE_OK ? record->kept.columns : 0;
  return status;
}

int32_t hooke_record_numbers(hooke_record *record, const char *what, double *values) {
  const int32_t status = keep(record, what);
  if (status != HOOKE_OK) return status;
  const size_t count = (size_t)(record->kept.rows * record->kept.columns);
  if (count > 0) memcpy(values, record->kept.value, count * sizeof(double));
  drop_kept(record);
  return HOOKE_OK;
}

/* ---- offsets ---- */

int64_t hooke_record_place(const hooke_record *record, const char *what) {
  if (strcmp(what, "position") == 0) return record->frames.at[HOOKE_FRAME_POSITION];
  return strcmp(what, "velocity") == 0 ? record->frames.at[HOOKE_FRAME_VELOCITY] : -1;
}

/* ---- the error of a run, which is added after it ---- */

/* An error that is not yet there as a whole counts as unknown. */
static int write_at(int descriptor, const struct hooke_record *record, const hooke_measurement *estimate) {
  double number[HOOKE_ERROR_COUNT];
  char by[HOOKE_ERROR_BY] = {0}, reason[HOOKE_ERROR_REASON] = {0};
  const char *source = hooke_measurement_text(estimate, "estimate", 0, "by");
  for (int k = 0; k < HOOKE_ERROR_COUNT; k++)
    number[k] = hooke_measurement_number(estimate, "estimate", 0, hk_error_number[k]);
  snprintf(by, sizeof by, "%s", source ? source : "");
  snprintf(reason, sizeof reason, "%s", hooke_measurement_text(estimate, "estimate", 0, "reason"));
  const uint32_t check = hk_outcome_check_error(record->outcome, number, by, reason);
  const struct {
    int part;
    const void *data;
  } parts[] = {{HOOKE_PART_CHECK, &record->outcome},
               {HOOKE_PART_REASON, reason},
               {HOOKE_PART_ERROR, number},
               {HOOKE_PART_BY, by},
               {HOOKE_PART_CHECK, &check}};
  int error = 0;
  for (int k = 0; error == 0 && k < 5; k++)
    error = hk_outcome_write(descriptor, record->at, parts[k].part, parts[k].data);
  return error;
}

static int32_t write_to(struct hk_atomic_file *file, const struct hooke_record *record,
                        const hooke_measurement *estimate) {
  for (int k = HOOKE_PART_ERROR; k < HOOKE_PART_COUNT; k++)
    if (record->at[k] < 0)
      return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is no trajectory that has room for the error of its run",
                     file->path);
  if (record->is_covered && !hk_outcome_is_end(record->text[HOOKE_RECORD_STATUS]))
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of a run that is not over, which has no error yet",
                   file->path);
  const int error = write_at(file->descriptor, record, estimate);
  return error ? hk_file_fail(file->path, "write the error of the run", error) : hk_atomic_file_finish(file);
}

int32_t hooke_estimate_write_h5(const hooke_measurement *estimate, const char *path) {
  HOOKE_KEEP_ERRNO;
  struct hk_atomic_file file = HOOKE_NO_ATOMIC_FILE;
  hooke_record *record = NULL;
  int32_t status = hk_measurement_require(estimate, &hk_estimate_kind, "hooke_estimate_write_h5");
  if (status == HOOKE_OK) status = hk_atomic_file_lock(path, &file);
  if (status == HOOKE_OK) status = hooke_record_open(file.path, &record);
  if (status == HOOKE_OK) status = write_to(&file, record, estimate);
  hooke_record_close(record);
  hk_atomic_file_release(&file);
  return status;
}
