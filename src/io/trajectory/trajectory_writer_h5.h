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
#ifndef HOOKE_IO_TRAJECTORY_TRAJECTORY_WRITER_H5_H
#define HOOKE_IO_TRAJECTORY_TRAJECTORY_WRITER_H5_H

#include "io/hdf5/copy_h5.h"
#include "io/trajectory/frame_file.h"

#include <hdf5.h>

struct hk_trajectory_writer {
  const hooke_system *system;
  char group[48];
  int64_t frame_count, written;
  struct hk_frame_file file; /* its descriptor belongs to the file's owner, who sets it */
};

/* Space of a writer in a file, with springs and all data of the particles: an upper bound in bytes. And the
 * space of the planned frames from `first` on. */
double hk_trajectory_writer_bytes(const hooke_system *system, int64_t frame_count);
double hk_trajectory_writer_bytes_after(const struct hk_trajectory_writer *writer, int64_t first);

/* Path of an array of a writer: "/particles/all/position/value". */
enum { HOOKE_WRITER_PATH = 160 };
void hk_trajectory_writer_path(const char *group, int array, char path[HOOKE_WRITER_PATH]);

/* Creates the arrays in a file that has /hooke. Negative on failure. */
herr_t hk_trajectory_writer_create(hid_t file, const hooke_system *system, const char *group,
                                   int64_t frame_count, struct hk_trajectory_writer *writer);

/* Writes the next frame, for which there must be space. Returns 0 or an errno. */
int hk_trajectory_writer_write(struct hk_trajectory_writer *writer, int64_t step, const hooke_state *state);

/* Creates the same arrays in another file, which has /hooke, for another number of frames, with the constant
 * data. hk_frame_copy() then copies frames once HDF5 has closed the other file. */
herr_t hk_trajectory_writer_copy(const struct hk_trajectory_writer *from, hid_t from_file, hid_t file,
                                 int64_t frame_count, struct hk_trajectory_writer *to,
                                 struct hk_h5_copy *copy);

#endif
