/* Going on with a trajectory that a run left behind. */
#ifndef HOOKE_IO_TRAJECTORY_TRAJECTORY_H
#define HOOKE_IO_TRAJECTORY_TRAJECTORY_H

#include "hooke/checkpoint.h"

/* Opens the file of a run that was killed or ended early, for the frames of the same run from `frames_kept`
 * on. Of a run that was killed the file has its planned length and is written in place: frames that it has
 * beyond the first `frames_kept` are overwritten one by one by the same bits, so that no frame is lost that
 * was reported. Where a run that ended early has shortened its file, a new one of the planned length takes
 * its place, with all frames. The status is "running" again. Every frame that is kept is checked before
 * anything is changed: HOOKE_BAD_VALUE for one that is damaged, for a file that is none of hooke's, of
 * another system or of another number of frames. HOOKE_IO_FAILED, HOOKE_NO_MEMORY, HOOKE_NOT_BUILT. What is
 * asked of hooke_trajectory_create() is asked here, too. */
int32_t hk_trajectory_reopen(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                             int64_t frames_kept, hooke_trajectory **trajectory);

/* Of a trajectory that was opened so: whole frames that the file had; and taking the first `frames` of them
 * for kept. */
int64_t hk_trajectory_there(const hooke_trajectory *trajectory);
void hk_trajectory_keep(hooke_trajectory *trajectory, int64_t frames);

/* The file, from the root. */
const char *hk_trajectory_path(const hooke_trajectory *trajectory);
/* What hooke_trajectory_origin() says. */
void hk_trajectory_set_origin(hooke_trajectory *trajectory, const char *words);

/* A run that has finished needs the checkpoint beside its trajectory no more. */
void hk_trajectory_drop_checkpoint(const char *path);

#endif
