/* Adds the error of a run to its trajectory file after the run. */
#include "hooke/estimate.h"

#include "core/keep_errno.h"
#include "core/status.h"

#include <stddef.h>

#if HOOKE_HAVE_HDF5

#include "io/file/bytes.h"
#include "io/trajectory/error_h5.h"
#include "io/trajectory/file_check_h5.h"
#include "io/hdf5/file_h5.h"
#include "io/trajectory/h5md_h5.h"
#include "io/file/atomic_file.h"
#include "measure/estimate/estimate.h"

#include <stdio.h>

struct places {
  int64_t numbers, by, reason, check;
};

static int32_t find_places(struct hk_h5_guard *guard, const struct hk_h5_file *file, struct places *at) {
  hid_t id;
  const int32_t status = hk_h5_file_open(guard, file, &id);
  if (status != HOOKE_OK) return status;
  at->numbers = hk_h5md_place(id, "hooke/error", HOOKE_ERROR_COUNT * sizeof(double));
  at->by = hk_h5md_place(id, "hooke/error_by", HOOKE_ERROR_BY);
  at->reason = hk_h5md_place(id, "hooke/error_reason", HOOKE_ERROR_REASON);
  at->check = hk_h5md_find_check(id);
  H5Fclose(id);
  if (guard->no_memory) return hk_h5_fail(guard, file->atomic.path, "find the room for the error");
  if (at->numbers >= 0 && at->by >= 0 && at->reason >= 0) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is no trajectory that has room for the error of its run",
                 file->atomic.path);
}

static int write_at(int descriptor, const struct places *at, const hooke_measurement *estimate) {
  double number[HOOKE_ERROR_COUNT];
  char by[HOOKE_ERROR_BY] = {0}, reason[HOOKE_ERROR_REASON] = {0};
  const char *source = hooke_measurement_text(estimate, "estimate", 0, "by");
  for (int k = 0; k < HOOKE_ERROR_COUNT; k++)
    number[k] = hooke_measurement_number(estimate, "estimate", 0, hk_error_number[k]);
  snprintf(by, sizeof by, "%s", source ? source : "");
  snprintf(reason, sizeof reason, "%s", hooke_measurement_text(estimate, "estimate", 0, "reason"));
  int error = hk_bytes_write(descriptor, at->reason, sizeof reason, reason);
  if (error == 0) error = hk_bytes_write(descriptor, at->numbers, sizeof number, number);
  if (error == 0) error = hk_bytes_write(descriptor, at->by, sizeof by, by);
  const uint32_t check = hk_file_check_error(number, by, reason);
  return error ? error : hk_file_check_write(descriptor, at->check, HOOKE_CHECK_ERROR, check);
}

static int32_t write_to(struct hk_h5_guard *guard, struct hk_h5_file *file,
                        const hooke_measurement *estimate) {
  struct places at;
  const int32_t status = find_places(guard, file, &at);
  if (status != HOOKE_OK) return status;
  const int error = write_at(file->atomic.descriptor, &at, estimate);
  return error ? hk_file_fail(file->atomic.path, "write the error of the run", error)
               : hk_h5_file_close(file);
}

int32_t hooke_estimate_write_h5(const hooke_measurement *estimate, const char *path) {
  HOOKE_KEEP_ERRNO;
  struct hk_h5_file file = HOOKE_NO_H5_FILE;
  struct hk_h5_guard guard;
  int32_t status = hk_measurement_require(estimate, &hk_estimate_kind, "hooke_estimate_write_h5");
  if (status != HOOKE_OK) return status;
  hk_h5_guard_begin(&guard);
  status = hk_atomic_file_lock(path, &file.atomic);
  if (status == HOOKE_OK) status = write_to(&guard, &file, estimate);
  hk_h5_file_release(&file);
  hk_h5_guard_end(&guard);
  return status;
}

#else

int32_t hooke_estimate_write_h5(const hooke_measurement *estimate, const char *path) {
  (void)estimate, (void)path;
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "trajectories need HDF5, and this build of the library is without it");
}

#endif
