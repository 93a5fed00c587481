/* Adds the error of a run to its trajectory file after the run. */
#include "hooke/estimate.h"

#include "core/keep_errno.h"
#include "core/status.h"

#include <stddef.h>

#if HOOKE_HAVE_HDF5

#include "io/trajectory/error_h5.h"
#include "io/trajectory/file_check_h5.h"
#include "io/trajectory/record_h5.h"
#include "measure/estimate/estimate.h"

#include <stdio.h>

/* An error that is not yet there as a whole counts as unknown. */
static int write_at(int descriptor, const struct hooke_record *record, const hooke_measurement *estimate) {
  const struct hk_h5md_places *at = &record->at;
  double number[HOOKE_ERROR_COUNT];
  char by[HOOKE_ERROR_BY] = {0}, reason[HOOKE_ERROR_REASON] = {0};
  const char *source = hooke_measurement_text(estimate, "estimate", 0, "by");
  for (int k = 0; k < HOOKE_ERROR_COUNT; k++)
    number[k] = hooke_measurement_number(estimate, "estimate", 0, hk_error_number[k]);
  snprintf(by, sizeof by, "%s", source ? source : "");
  snprintf(reason, sizeof reason, "%s", hooke_measurement_text(estimate, "estimate", 0, "reason"));
  int error = hk_h5md_write(descriptor, at->check, sizeof record->outcome, &record->outcome);
  if (error == 0) error = hk_h5md_write(descriptor, at->error_reason, sizeof reason, reason);
  if (error == 0) error = hk_h5md_write(descriptor, at->error, sizeof number, number);
  if (error == 0) error = hk_h5md_write(descriptor, at->error_by, sizeof by, by);
  const uint32_t check = hk_file_check_error(record->outcome, number, by, reason);
  return error ? error : hk_h5md_write(descriptor, at->check, sizeof check, &check);
}

static int32_t write_to(struct hk_h5_file *file, const struct hooke_record *record,
                        const hooke_measurement *estimate) {
  const struct hk_h5md_places *at = &record->at;
  const char *path = file->atomic.path;
  if (at->error < 0 || at->error_by < 0 || at->error_reason < 0)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is no trajectory that has room for the error of its run",
                   path);
  if (record->is_covered && !hk_h5md_is_end(record->status))
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of a run that is not over, which has no error yet", path);
  const int error = write_at(file->atomic.descriptor, record, estimate);
  return error ? hk_file_fail(path, "write the error of the run", error) : hk_h5_file_close(file);
}

int32_t hooke_estimate_write_h5(const hooke_measurement *estimate, const char *path) {
  HOOKE_KEEP_ERRNO;
  struct hk_h5_file file = HOOKE_NO_H5_FILE;
  hooke_record *record = NULL;
  int32_t status = hk_measurement_require(estimate, &hk_estimate_kind, "hooke_estimate_write_h5");
  if (status == HOOKE_OK) status = hk_atomic_file_lock(path, &file.atomic);
  if (status == HOOKE_OK) status = hooke_record_open(file.atomic.path, &record);
  if (status == HOOKE_OK) status = write_to(&file, record, estimate);
  hooke_record_close(record);
  hk_h5_file_release(&file);
  return status;
}

#else

int32_t hooke_estimate_write_h5(const hooke_measurement *estimate, const char *path) {
  (void)estimate, (void)path;
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "trajectories need HDF5, and this build of the library is without it");
}

#endif
