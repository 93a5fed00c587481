/* Check values of what the file of a run has beside its frames, which have their own: the array
 * /hooke/file_check, 3 CRC-32:
 *
 *   description   the attributes of /hooke, but for `run`, and /hooke/options by name (name, NUL, then a text
 *                 with its NUL, or doubles), mass, species, springs, rest lengths as doubles, and the text of
 *                 the scene
 *   outcome       the bytes of `status` and `beyond`, and the number of frames, once the run is over
 *   error         the bytes of `error`, `error_by` and `error_reason`
 *
 * The name of the run ends in its own. Nothing of hooke reads what they leave out: /h5md, the box,
 * references, names of the numbers of an error. */
#ifndef HOOKE_IO_TRAJECTORY_FILE_CHECK_H5_H
#define HOOKE_IO_TRAJECTORY_FILE_CHECK_H5_H

#include "io/hdf5/file_h5.h"

enum { HOOKE_CHECK_DESCRIPTION, HOOKE_CHECK_OUTCOME, HOOKE_CHECK_ERROR, HOOKE_FILE_CHECKS };

/* Statuses of HDF5, HOOKE_BAD_VALUE and HOOKE_NO_MEMORY as of reading arrays. `scene` may be NULL. */
int32_t hk_file_check_description(struct hk_h5_guard *guard, hid_t file, const char *path, const char *scene,
                                  uint32_t *value);
int32_t hk_file_check_run(const char *run);
uint32_t hk_file_check_outcome(const char *status, int64_t beyond, int64_t frames);
uint32_t hk_file_check_error(const double *numbers, const char *by, const char *reason);

/* Creates the array in a new file that has everything else. */
int32_t hk_file_check_create(struct hk_h5_guard *guard, hid_t file, const char *path, const char *scene);

/* Reads it; `there` is 0 in older files, which have none. */
int32_t hk_file_check_read(struct hk_h5_guard *guard, hid_t file, const char *path, uint32_t value[],
                           int32_t *there);

/* Writes one of them into a file that has the array at `at`; nothing if that is negative. 0 or an errno. */
int hk_file_check_write(int descriptor, int64_t at, int which, uint32_t value);

#endif
