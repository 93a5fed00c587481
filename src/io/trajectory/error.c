/* Adds the error of a run to its trajectory file after the run. */
#include "core/keep_errno.h"
#include "core/status.h"
#include "hooke/estimate.h"
#include "io/file/atomic_file.h"
#include "io/trajectory/record.h"
#include "measure/estimate/estimate.h"

#include <stdio.h>

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
