/* hooke/checkpoint.h - checkpoints: a run continues from one as if it had never stopped, with the same bits,
 * frames and counts.
 *
 * A checkpoint is a file of its own. It is written under a temporary name, flushed to the disk and renamed;
 * the checkpoint before it is kept as "<path>.previous". A run with a fixed step can continue from any step.
 * A run of an error-controlled method can continue only from the times t0 + k `checkpoint` of the option of
 * that name, where the method always restarts. */
#ifndef HOOKE_CHECKPOINT_H
#define HOOKE_CHECKPOINT_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes a checkpoint of the run of `integrator`. With a fixed step `state` is the state after its last step,
 * as observers receive it and as hooke_integrator_run() leaves it when stopped. With error control `state` is
 * ignored and the last of the times above is written. `run` (up to 63 bytes; NULL: none) identifies the run.
 * HOOKE_BAD_CALL before a run, HOOKE_BAD_VALUE for another state or a non-finite one, HOOKE_UNSUITED for an
 * error-controlled method without the option `checkpoint`; HOOKE_IO_FAILED, HOOKE_NO_MEMORY. An older file
 * then stays, as itself or as the previous checkpoint. */
HOOKE_API int32_t hooke_checkpoint_write(const char *path, const hooke_integrator *integrator,
                                         const hooke_state *state, const char *run);

/* Sets `integrator` and `state` to the point that the file holds, for hooke_integrator_resume() or, in a time
 * loop of the caller's own, hooke_integrator_step(). If the file is missing or damaged, the previous one is
 * read. HOOKE_BAD_VALUE for files that are damaged, or of another system, other options (but for `threads`),
 * or another `run` (NULL: any); HOOKE_UNSUITED if the run had other callbacks; HOOKE_IO_FAILED for files that
 * cannot be read, HOOKE_NO_MEMORY, and the failures of starting a run. The state is then unchanged. */
HOOKE_API int32_t hooke_checkpoint_read(const char *path, const char *run, hooke_integrator *integrator,
                                        hooke_state *state);

/* ---- beside a trajectory ---- */

/* Flushes the trajectory to the disk and writes "<its path>.checkpoint", labelled with
 * "run" of hooke_trajectory_text(). The trajectory then holds every frame that was reported before the
 * checkpoint. hooke_trajectory_close() removes the checkpoint after a run that finished. Failures are
 * those of hooke_trajectory_sync() and hooke_checkpoint_write(). */
HOOKE_API int32_t hooke_trajectory_checkpoint(hooke_trajectory *trajectory,
                                              const hooke_integrator *integrator, const hooke_state *state);

/* Opens the trajectory of a run that was killed, stopped or ended early, for its missing frames, and sets
 * `integrator` (new, with the options of that run but for `threads`) and `state` (the initial one) to the
 * point where the run continues. The caller then calls hooke_integrator_resume(), with
 * hooke_trajectory_write() for each frame. The run continues from the checkpoint beside the file. Without one
 * of this run, it continues from the last whole frame with a fixed step (all counts but "steps" then begin
 * there) and from the first frame with error control. `trajectory` is NULL if the run has finished.
 * HOOKE_UNSUITED if the run had other callbacks; HOOKE_BAD_VALUE for another system, other options, or a file
 * that is no trajectory of one run; HOOKE_IO_FAILED, also if another run is writing the file;
 * HOOKE_NOT_BUILT, HOOKE_NO_MEMORY; the state is then unchanged. */
HOOKE_API int32_t hooke_trajectory_resume(const char *path, const hooke_system *system,
                                          hooke_integrator *integrator, hooke_state *state,
                                          hooke_trajectory **trajectory);

#ifdef __cplusplus
}
#endif
#endif
