/* The frames of one run in an H5MD file:
 *
 *   /particles/<group>/position/value     [frames][n][3]   velocity likewise
 *   /particles/<group>/position/time      [frames]         the same array everywhere below, by hard links
 *   /particles/<group>/position/step      [frames]         likewise
 *   /particles/<group>/mass, species      [n]              species: 0 free, 1 pinned, 2 driven
 *   /observables[/<group>]/<name>/value   [frames] or [frames][3]; the group `all` has no folder of its own
 *   /hooke[/<group>]/frame_check          [frames]         CRC-32 of the frame's bytes: step, time, position, velocity,
 *                                                          observables in their order (frame_file.h)
 *
 * Every array is contiguous, of its final size, and there before the first frame: filled with NaN, step with
 * -1, position and velocity, which would take as long to fill as to write, with nothing but room for them. A
 * frame is written in place (frame_file.h), its check value and then its time last: time is the mark that the
 * frame is there. Nothing else of the file changes, so the file is valid whenever the process is killed. */
#ifndef HOOKE_IO_TRAJECTORY_TRAJECTORY_WRITER_H5_H
#define HOOKE_IO_TRAJECTORY_TRAJECTORY_WRITER_H5_H

#include "io/hdf5/copy_h5.h"
#include "io/trajectory/frame_file.h"

#include <hdf5.h>

struct hk_trajectory_writer {
  const hooke_system *system;
  char group[48];
  int64_t frame_count, written;
  struct hk_frame_file file; /* its descriptor is of the file's owner, who sets it */
};

/* What a writer takes in a file, with springs and everything about the particles: an upper bound in bytes.
 * And what the frames from `first` on take that were planned. */
double hk_trajectory_writer_bytes(const hooke_system *system, int64_t frame_count);
double hk_trajectory_writer_bytes_after(const struct hk_trajectory_writer *writer, int64_t first);

/* Where a writer's array is: "/particles/all/position/value". */
enum { HOOKE_WRITER_PATH = 160 };
void hk_trajectory_writer_path(const char *group, int array, char path[HOOKE_WRITER_PATH]);

/* Makes the arrays in a file that has /hooke. Negative on failure. */
herr_t hk_trajectory_writer_create(hid_t file, const hooke_system *system, const char *group,
                                   int64_t frame_count, struct hk_trajectory_writer *writer);

/* Writes the next frame; there has to be room for it. 0, or the number of the system's error. */
int hk_trajectory_writer_write(struct hk_trajectory_writer *writer, int64_t step, const hooke_state *state);

/* Makes the same arrays in another file, which has /hooke, for another number of frames, and what does not
 * change with time. hk_frame_copy() copies frames, when HDF5 is done with the other file. */
herr_t hk_trajectory_writer_copy(const struct hk_trajectory_writer *from, hid_t from_file, hid_t file,
                                 int64_t frame_count, struct hk_trajectory_writer *to,
                                 struct hk_h5_copy *copy);

#endif
