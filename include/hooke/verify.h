/* hooke/verify.h - whether a trajectory is what its scene gives.
 *
 * A slice of the run is run again from what the file holds and compared with its frames to the bit; every
 * frame is held against its check value, and the first one against the scene. With a fixed step a slice
 * begins at any frame; an error-controlled method is run from the start. Along the slice the balance of
 * energy is taken, what driven particles put in = change + what damping and drag turn into heat, and the
 * slice is run once more with half the step, or tolerances a hundredth: what is left over in the balance has
 * to get smaller, as the error of a method does, and the difference between the two estimates the error.
 *
 * Where the file was made with other versions of SUNDIALS or CHOLMOD, or on another machine, error-controlled
 * methods and backward-euler may differ in bits: frames then have to agree to within four times the estimate.
 *
 * Options (hooke_verify_options_create): slice [s] (from, to), all (1: every frame), budget [s] of work where
 * neither is given, bits (1: compare the bits alone). */
#ifndef HOOKE_VERIFY_H
#define HOOKE_VERIFY_H

#include "io.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_verify hooke_verify;

/* Options of a verification, for the caller to set and destroy. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_verify_options_create(hooke_options **options);

/* Opens a trajectory and makes its scene again, with `limits` as in hooke_scene_load_within(); both sorts of
 * options may be NULL, and are copied or read here. HOOKE_BAD_VALUE for a file that holds no scene or no
 * frames, a scene that is wrong, or a slice without two frames; HOOKE_IO_FAILED, HOOKE_NOT_BUILT,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_verify_create(const char *path, const hooke_options *options,
                                      const hooke_options *limits, hooke_verify **verify);
/* NULL is allowed. */
HOOKE_API void hooke_verify_destroy(hooke_verify *verify);

HOOKE_API void hooke_verify_on_progress(hooke_verify *verify, hooke_progress *progress, void *ctx);

/* Does all of it. HOOKE_BAD_VALUE if the file is not what its scene gives, with the first frame, particle and
 * component that differ and both numbers, the frame that is damaged, or the balance that does not hold;
 * HOOKE_STOPPED if the progress callback asked for it; HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_verify_run(hooke_verify *verify);

/* What was found. "verdict": "agrees" (to the bit), "within-tolerance", "disagrees", "stopped", NULL before;
 * "balance": "holds", "does-not-hold", "unresolved" (the step is too long to tell) or "not-checked";
 * "difference": the message of a failure; "method"; "run": the name of the run; of what made the file
 * "version", "sundials", "cholmod", "instructions", "machine", and of what verified it "version_here" and so
 * on; "" where it is not known. NULL for another word. */
HOOKE_API const char *hooke_verify_text(const hooke_verify *verify, const char *what);
/* "frames" in the file; "frames_checked" by check value; "frame_first", "frame_last" that were compared,
 * "time_first", "time_last" [s], "steps" taken for it; "step" [s], "rtol", "atol" [m]; "step_limit" [s] that
 * is predicted at the first frame and "step_share" of it that is used; "energy_change", "work", "heat",
 * "residual" [J] of the balance over the slice, "residual_refined" with half the step, and "residual_bound";
 * "error_estimate" [m], of any coordinate over the slice; "check_scene" and "check_last": CRC-32 of the text
 * of the scene, and of positions and velocities of the last frame compared. NaN where it does not apply, and
 * for another word. */
HOOKE_API double hooke_verify_number(const hooke_verify *verify, const char *what);

#ifdef __cplusplus
}
#endif
#endif
