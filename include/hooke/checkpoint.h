/* hooke/checkpoint.h - places from which a run goes on as if it had never stopped: the same bits, frames and
 * counts.
 *
 * A checkpoint is a file of its own. It is written under another name, brought to the disk and renamed; the
 * one before it stays beside it as "<path>.previous". A run with a fixed step can go on from any step; one of
 * an error-controlled method from the times t0 + k `checkpoint` of the option of that name alone, where it
 * starts anew in every case. */
#ifndef HOOKE_CHECKPOINT_H
#define HOOKE_CHECKPOINT_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes where the run of `integrator` stands. With a fixed step `state` is the one after its last step, as
 * observers have it and as hooke_integrator_run() leaves it where it was stopped; with error control it is
 * not looked at: what is written is the last of the times above. `run` (up to 63 bytes; NULL: none) says
 * which run it is. HOOKE_BAD_CALL before a run, HOOKE_BAD_VALUE for another state or one that is not finite,
 * HOOKE_UNSUITED for an error-controlled method without the option `checkpoint`; HOOKE_IO_FAILED,
 * HOOKE_NO_MEMORY. A file that was there then stays, as itself or as the previous. */
HOOKE_API int32_t hooke_checkpoint_write(const char *path, const hooke_integrator *integrator,
                                         const hooke_state *state, const char *run);

/* Puts `integrator`, and `state` with it, at the place that the file holds, for hooke_integrator_resume() or,
 * in a loop of the caller's own, hooke_integrator_step(). Where the file is missing or damaged the previous
 * one is taken. HOOKE_BAD_VALUE for files that are damaged, or of another system, other options (but for
 * `threads`), or another `run` (NULL: any); HOOKE_IO_FAILED for files that cannot be read, HOOKE_NO_MEMORY,
 * and the failures of a run's beginning. The state then stays as it is. */
HOOKE_API int32_t hooke_checkpoint_read(const char *path, const char *run, hooke_integrator *integrator,
                                        hooke_state *state);

/* ---- beside a trajectory ---- */

/* Brings the trajectory to the disk and writes "<its path>.checkpoint", labelled with hooke_trajectory_run():
 * every frame that was reported up to there is then in the trajectory. hooke_trajectory_close() removes it
 * after a run that finished. The failures of hooke_trajectory_sync() and hooke_checkpoint_write(). */
HOOKE_API int32_t hooke_trajectory_checkpoint(hooke_trajectory *trajectory,
                                              const hooke_integrator *integrator, const hooke_state *state);

/* Opens the trajectory of a run that was killed, stopped or ended early, for the frames that are missing, and
 * puts `integrator`, new and with the options of that run (but for `threads`), and `state`, its initial one,
 * where the run goes on: hooke_integrator_resume() is next, with hooke_trajectory_write() for each frame.
 * That is at the checkpoint beside the file; if there is none of this run, at the last whole frame with a
 * fixed step, whose counts then begin there (but for "steps"), and at the first frame with error control.
 * `trajectory` is NULL if the run has finished: nothing is to do. HOOKE_BAD_VALUE for another system, other
 * options, or a file that is no trajectory of one run; HOOKE_IO_FAILED, also if another run is writing the
 * file; HOOKE_NOT_BUILT, HOOKE_NO_MEMORY; the state then stays as it is. */
HOOKE_API int32_t hooke_trajectory_resume(const char *path, const hooke_system *system,
                                          hooke_integrator *integrator, hooke_state *state,
                                          hooke_trajectory **trajectory);
/* From where a run went on, in words, and why not from a checkpoint; "" for a trajectory that was not opened
 * so. */
HOOKE_API const char *hooke_trajectory_origin(const hooke_trajectory *trajectory);

#ifdef __cplusplus
}
#endif
#endif
