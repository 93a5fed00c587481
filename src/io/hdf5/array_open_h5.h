/* Arrays of numbers in an open HDF5 file. */
#ifndef HOOKE_IO_HDF5_ARRAY_OPEN_H5_H
#define HOOKE_IO_HDF5_ARRAY_OPEN_H5_H

#include "io/hdf5/file_h5.h"

/* Like hk_array_read(); `path` is for messages. Without `check` a frame is not compared with its check value.
 */
int32_t hk_array_read_open(struct hk_h5_guard *guard, hid_t file, const char *path, const char *dataset,
                           int64_t frame, int32_t has_frame, int32_t check, double **values, int64_t *rows,
                           int64_t *columns);

#endif
