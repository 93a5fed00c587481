/* The frames of one run in an H5MD file:
 *
 *   /particles/<group>/position/value     [frames][n][3]   velocity likewise
 *   /particles/<group>/position/time      [frames]         the same array everywhere below, by hard links
 *   /particles/<group>/position/step      [frames]         likewise
 *   /particles/<group>/mass, species      [n]              species: 0 free, 1 pinned, 2 driven
 *   /observables[/<group>]/<name>/value   [frames] or [frames][3]; the group `all` has no folder of its own
 *   /hooke[/<group>]/frame_check          [frames]         CRC-32 of the frame's bytes: step, time, position,
 *                                                          velocity, observables in order (frame_file.h)
 *
 * Every array is contiguous, of its final size, and created before the first frame: filled with NaN, step
 * with -1. Position and velocity, which would take as long to fill as to write, are only allocated. A frame
 * is written in place (frame_file.h), its check value and then its time last: a time marks a complete frame.
 * Nothing else of the file changes, so the file is valid whenever the process is killed. */
#pragma once

#include "io/hdf5/dataset_h5.h"
#include "io/trajectory/frame_file.h"

/* Plans so many frames of a system. */
void hk_frame_arrays_plan(const hooke_system *system, const char *group, int64_t frame_count,
                          struct hk_frame_file *frames);

/* Creates the arrays in a file, and describes the particles. Negative on failure. */
herr_t hk_frame_arrays_create(hid_t file, struct hk_frame_file *frames);

/* Creates the arrays alone, for the numbers of frames and particles in `frames`, and finds their offsets. */
herr_t hk_frame_arrays_make(hid_t file, struct hk_frame_file *frames);

/* Finds the numbers and offsets of the group "all". HOOKE_NO_MEMORY. */
int32_t hk_frame_arrays_find(struct hk_h5_guard *guard, struct hk_frame_file *frames);

/* Checks frame `frame` of the dataset "/particles/<group>/position/value", or velocity's. Other datasets, and
 * files without check values, pass. `known`: the numbers of this row if they were read already, else NULL.
 * HOOKE_BAD_VALUE for a damaged frame, HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hk_frame_check(struct hk_h5_guard *guard, const char *dataset, int64_t frame, const double *known);
