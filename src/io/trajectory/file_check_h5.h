/* The check values of a file but for those of its frames (outcome.h). */
#ifndef HOOKE_IO_TRAJECTORY_FILE_CHECK_H5_H
#define HOOKE_IO_TRAJECTORY_FILE_CHECK_H5_H

#include "io/hdf5/file_h5.h"

/* Statuses of HDF5, HOOKE_BAD_VALUE and HOOKE_NO_MEMORY as of reading arrays. `scene` may be NULL. */
int32_t hk_file_check_description(struct hk_h5_guard *guard, hid_t file, const char *path, const char *scene,
                                  uint32_t *value);

/* Reads the array; `there` is 0 in older files, which have none. */
int32_t hk_file_check_read(struct hk_h5_guard *guard, hid_t file, const char *path, uint32_t *value,
                           int32_t *there);

#endif
