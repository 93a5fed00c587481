/* What is written of a run after its first frame, as bytes, once HDF5 has closed the file: arrays of fixed
 * size in the group /hooke (h5md_h5.h); and the check values of everything but the frames. A killed process
 * could leave metadata that change in place torn. */
#pragma once

#include "hooke/base.h"

/* Columns of the numbers in the table of an estimate, and bytes of the texts. The status has fewer bytes than
 * a page, aligned to a multiple of them: it is never torn. */
enum { HOOKE_ERROR_COUNT = 9, HOOKE_ERROR_BY = 16, HOOKE_ERROR_REASON = 256, HOOKE_OUTCOME_STATUS = 16 };
extern const char *const hk_error_number[HOOKE_ERROR_COUNT];

enum hk_outcome_part {
  HOOKE_PART_STATUS,
  HOOKE_PART_BEYOND,
  HOOKE_PART_CHECK,
  HOOKE_PART_ERROR,
  HOOKE_PART_BY,
  HOOKE_PART_REASON,
  HOOKE_PART_COUNT
};
struct hk_outcome_part_row {
  const char *name;
  int64_t bytes;
};
extern const struct hk_outcome_part_row hk_outcome_parts[HOOKE_PART_COUNT];

/* Writes a part at its offset in the file, and nothing if that is -1: an older file does not have it. 0 or an
 * errno. */
int hk_outcome_write(int descriptor, const int64_t at[HOOKE_PART_COUNT], int part, const void *data);

/* The word for a status of hooke_integrator_run() or HOOKE_OUTCOME_RUNNING; and writing it: 0 or an errno. */
enum { HOOKE_OUTCOME_RUNNING = 1000 };
const char *hk_outcome_word(int32_t outcome);
int hk_outcome_write_status(int descriptor, const int64_t at[HOOKE_PART_COUNT], int32_t outcome);

/* 1 if the run came to an end, by its status (NULL: unknown): its file has just the frames that were
 * written. */
int32_t hk_outcome_is_end(const char *status);

/* The check value is a CRC-32 that is continued as more is known of the run:
 *
 *   description   the attributes of /hooke, but for `run`, and /hooke/options by name (name, NUL, then a text
 *                 with its NUL, or doubles), mass, species, springs, rest lengths as doubles, and the text of
 *                 the scene; then the random digits of the name of the run, which ends in this value
 *   outcome       after the description, once the run is over: the bytes of `status` and `beyond`, and the
 *                 number of frames; this value is in the array /hooke/file_check
 *   error         then the bytes of `error`, `error_by` and `error_reason`, once they are known; likewise
 *
 * Nothing of hooke reads what they leave out: /h5md, the box, references, names of the numbers of an error.
 */
uint32_t hk_outcome_check(uint32_t description, const char *status, int64_t beyond, int64_t frames);
uint32_t hk_outcome_check_error(uint32_t outcome, const double *numbers, const char *by, const char *reason);

/* The name of a run: 24 random hexadecimal digits, 8 of their check value and a NUL. Makes one; and whether
 * one fits. */
enum { HOOKE_RUN_RANDOM = 24, HOOKE_RUN_SIZE = 33 };
int32_t hk_outcome_new_run(uint32_t description, char run[HOOKE_RUN_SIZE]);
int32_t hk_outcome_check_run(uint32_t description, const char *run);
