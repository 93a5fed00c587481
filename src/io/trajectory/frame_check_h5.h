/* Compares a frame in a file with its check value. */
#ifndef HOOKE_IO_TRAJECTORY_FRAME_CHECK_H5_H
#define HOOKE_IO_TRAJECTORY_FRAME_CHECK_H5_H

#include "io/hdf5/file_h5.h"

/* Checks frame `frame` of the dataset "/particles/<group>/position/value", or velocity's. Other datasets, and
 * files without check values, pass. `known`: the numbers of this row if they were read already, else NULL.
 * HOOKE_BAD_VALUE for a damaged frame, HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hk_frame_check(struct hk_h5_guard *guard, hid_t file, const char *path, const char *dataset,
                       int64_t frame, const double *known);

#endif
