/* Reads arrays of numbers from untrusted HDF5 files: sizes are checked before anything is allocated, and no
 * links out of the file are followed. */
#pragma once

#include "hooke/base.h"

/* Reads a dataset of integers or floating-point numbers into `values` (rows x columns, released by the caller
 * with hk_free()): one of rank 1 (one column), of rank 2, or one frame of rank 3, [frames][rows][columns].
 * Frames count from 0; negative ones from the end, -1 being the last; without `has_frame` it is the last. If
 * the dataset has a sibling `time` (H5MD), only the frames before the first without a time (NaN) exist,
 * unless the file says that its run is over: then all exist, and a missing time is damage. A frame of a
 * trajectory's position or velocity is compared with its check value, if it has one, and refused with
 * HOOKE_BAD_VALUE if it is damaged. HOOKE_IO_FAILED, HOOKE_BAD_VALUE, HOOKE_NO_MEMORY, HOOKE_NOT_BUILT.
 */
int32_t hk_array_read(const char *path, const char *dataset, int64_t frame, int32_t has_frame,
                      double **values, int64_t *rows, int64_t *columns);
/* The same with at most `memory_limit` bytes; 0, as above: the machine's memory. */
int32_t hk_array_read_within(double memory_limit, const char *path, const char *dataset, int64_t frame,
                             int32_t has_frame, double **values, int64_t *rows, int64_t *columns);
