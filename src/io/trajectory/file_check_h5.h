/* The check value of what the file of a run has beside its frames, which have their own: a CRC-32 that is
 * continued as more is known of the run:
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
#ifndef HOOKE_IO_TRAJECTORY_FILE_CHECK_H5_H
#define HOOKE_IO_TRAJECTORY_FILE_CHECK_H5_H

#include "io/hdf5/file_h5.h"

/* Statuses of HDF5, HOOKE_BAD_VALUE and HOOKE_NO_MEMORY as of reading arrays. `scene` may be NULL. */
int32_t hk_file_check_description(struct hk_h5_guard *guard, hid_t file, const char *path, const char *scene,
                                  uint32_t *value);
int32_t hk_file_check_run(uint32_t description, const char *run); /* true or not */
uint32_t hk_file_check_outcome(uint32_t description, const char *status, int64_t beyond, int64_t frames);
uint32_t hk_file_check_error(uint32_t outcome, const double *numbers, const char *by, const char *reason);

/* Reads the array; `there` is 0 in older files, which have none. */
int32_t hk_file_check_read(struct hk_h5_guard *guard, hid_t file, const char *path, uint32_t *value,
                           int32_t *there);

#endif
