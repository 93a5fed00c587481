/* A trajectory that is being written, new or continued. */
#ifndef HOOKE_IO_TRAJECTORY_TRAJECTORY_H5_H
#define HOOKE_IO_TRAJECTORY_TRAJECTORY_H5_H

#include "hooke/trajectory.h"
#include "io/hdf5/file_h5.h"
#include "io/trajectory/frame_thread.h"
#include "io/trajectory/h5md_h5.h"
#include "io/trajectory/trajectory_writer_h5.h"

struct hooke_trajectory {
  struct hk_h5_file file;
  struct hk_trajectory_writer writer;
  struct hk_frame_thread *thread; /* NULL: frames are written as they come */
  int64_t taken;                  /* frames, the one on its way included */
  int64_t there;                  /* whole frames that the file had when it was opened again */
  int64_t good;                   /* frames before divergence that it had then */
  int64_t beyond;                 /* the first frame after divergence; -1: there is none */
  struct hk_h5md_places at;
  uint32_t description; /* its check value */
  char run[HOOKE_RUN_SIZE];
  char origin[512];  /* from where the run continued; "" if it did not */
  char failure[512]; /* message of the write that made the file bad; "" while it is good */
};

hooke_trajectory *hk_trajectory_new(void);

/* Releases everything without changing the file. */
void hk_trajectory_release(hooke_trajectory *trajectory);

/* Replaces the file by one with space for `frame_count` frames, with the first `copied` of them and this
 * outcome. `made` is the new one, and `trajectory` can only be released afterwards. HOOKE_IO_FAILED,
 * HOOKE_NO_MEMORY. */
int32_t hk_trajectory_remake(struct hk_h5_guard *guard, hooke_trajectory *trajectory, int64_t frame_count,
                             int64_t copied, int32_t outcome, hooke_trajectory *made);

#endif
