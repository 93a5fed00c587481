/* A trajectory that is being written, new or continued. HDF5 makes its file and closes it; all else is
 * written as bytes. */
#pragma once

#include "hooke/checkpoint.h"
#include "io/file/atomic_file.h"
#include "io/trajectory/frame_file.h"
#include "io/trajectory/outcome.h"

struct hooke_trajectory {
  struct hk_atomic_file file;
  struct hk_frame_file frames;
  int64_t at[HOOKE_PART_COUNT];
  struct hk_frame_thread *thread; /* NULL: frames are written as they come */
  int64_t taken;                  /* frames, the one on its way included */
  int64_t there;                  /* whole frames that the file had when it was opened again */
  int64_t beyond;                 /* the first frame after divergence; -1: there is none */
  uint32_t description;           /* its check value */
  char run[HOOKE_RUN_SIZE];
  char origin[512];  /* from where the run continued; "" if it did not */
  char failure[512]; /* message of the write that made the file bad; "" while it is good */
};

hooke_trajectory *hk_trajectory_new(void);

/* Releases everything without changing the file. */
void hk_trajectory_release(hooke_trajectory *trajectory);

/* Makes the file of a new trajectory, which has its name when all is there but the frames. HOOKE_IO_FAILED,
 * HOOKE_NO_MEMORY, HOOKE_NOT_BUILT. */
int32_t hk_trajectory_make(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                           const char *scene_text, hooke_trajectory *trajectory);

/* Makes the file again under a temporary name, for `frame_count` frames, with the first `copied` of them; it
 * replaces the older one when it is committed. After a failure it is the older one. HOOKE_IO_FAILED,
 * HOOKE_NO_MEMORY. */
int32_t hk_trajectory_remake(hooke_trajectory *trajectory, int64_t frame_count, int64_t copied);

/* Opens the file of a run that was killed or ended early, for the frames of the same run from `frames_kept`
 * on. The file of a killed run has its planned length and is written in place: its frames beyond the first
 * `frames_kept` are overwritten one by one by the same bits, so that no reported frame is lost. A file that
 * was truncated when its run ended early is replaced by one of the planned length, with all frames. The
 * status becomes "running" again. Every kept frame is checked before anything is changed: HOOKE_BAD_VALUE for
 * a damaged frame, for a file not written by hooke, of another system or of another number of frames.
 * HOOKE_IO_FAILED, HOOKE_NO_MEMORY, HOOKE_NOT_BUILT. The requirements of hooke_trajectory_create() apply
 * here, too. */
int32_t hk_trajectory_reopen(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                             int64_t frames_kept, hooke_trajectory **trajectory);

/* Of the checkpoint beside a trajectory, which goes when its run is finished. */
#define HOOKE_CHECKPOINT_ENDING ".checkpoint"
