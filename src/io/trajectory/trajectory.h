/* Continuing the trajectory of an unfinished run. */
#ifndef HOOKE_IO_TRAJECTORY_TRAJECTORY_H
#define HOOKE_IO_TRAJECTORY_TRAJECTORY_H

#include "hooke/checkpoint.h"

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

/* For a trajectory opened by this function: number of whole frames that the file had; and declares the first
 * `frames` of them kept. */
int64_t hk_trajectory_there(const hooke_trajectory *trajectory);
void hk_trajectory_keep(hooke_trajectory *trajectory, int64_t frames);

/* Absolute path of the file. */
const char *hk_trajectory_path(const hooke_trajectory *trajectory);
/* "origin" of hooke_trajectory_text(). */
void hk_trajectory_set_origin(hooke_trajectory *trajectory, const char *words);

/* Of the checkpoint beside a trajectory, which goes when its run is finished. */
#define HOOKE_CHECKPOINT_ENDING ".checkpoint"

#endif
