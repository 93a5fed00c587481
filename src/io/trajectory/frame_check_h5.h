/* The check value of a frame, where it has one, against the numbers that are in the file now. */
#ifndef HOOKE_IO_TRAJECTORY_FRAME_CHECK_H5_H
#define HOOKE_IO_TRAJECTORY_FRAME_CHECK_H5_H

#include "io/hdf5/file_h5.h"

/* Of frame `frame` that the dataset "/particles/<group>/position/value", or velocity's, has. Other datasets,
 * and files without check values, pass. `known`: the numbers of this row if they are read already, else NULL.
 * HOOKE_BAD_VALUE for a frame that is damaged, HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hk_frame_check(struct hk_h5_guard *guard, hid_t file, const char *path, const char *dataset,
                       int64_t frame, const double *known);

#endif
