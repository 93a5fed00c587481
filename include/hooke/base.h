/* hooke/base.h - status codes, messages and facts about this build.
 *
 * Every function that can fail returns an int32_t status: 0 is success, a negative value a failure (the
 * object it was called on is unchanged), a positive value an outcome of a run. hooke_last_error() then says
 * in words what went wrong, where, and what is allowed. The library never prints, never exits and keeps no
 * state but this message, which is one per thread.
 *
 * Threads. Any number may call at once, each with objects of its own; a committed system may be shared by
 * all. Files need no care of the caller's: one thread at a time is let into HDF5. A program that uses HDF5 in
 * other threads itself needs one that was built thread-safe.
 * What a program has set is left as it is: errno (after failures, too), rounding mode, treatment of
 * denormals, masks of floating-point exceptions, locale, signals, working folder. Exceptions raise their
 * flags as in any arithmetic, so a program that traps them masks them around its calls. In another rounding
 * mode results are other ones. Numbers are read and written with a decimal point in every locale.
 * Callbacks may leave by longjmp(): the integrator, state and system can then be destroyed or run again from
 * a state of its own, with the same results. Memory that a call had taken for itself is lost, which a run or
 * a step has only where difference quotients stand in for a missing product. An exception of C++ has to be
 * caught inside the callback. Texts are not NULL, unless it says so: HOOKE_BAD_VALUE, or by functions that
 * return no status what they return for an unknown word.
 * Handles. A Debug build (HOOKE_CHECK_HANDLES) refuses an object that was destroyed, never made, or is of
 * another type: HOOKE_BAD_CALL, or -1, NaN, NULL, 0 (no) by functions that return no status. It keeps a list
 * of all objects for it. */
#ifndef HOOKE_BASE_H
#define HOOKE_BASE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef HOOKE_API
#if defined(_WIN32)
#define HOOKE_API
#else
#define HOOKE_API __attribute__((visibility("default")))
#endif
#endif

#define HOOKE_VERSION "0.2.0"
#define HOOKE_ABI     1 /* the number in the soname; it changes when a caller has to be compiled again */

/* Statuses. The numbers are part of the ABI and never change. */
#define HOOKE_OK            0
#define HOOKE_STOPPED       1    /* a callback or an observer asked to stop */
#define HOOKE_DIVERGED      2    /* the run left every physical bound; see hooke_integrator_run() */
#define HOOKE_STEP_LIMIT    3    /* an error-controlled method used up `max_steps` */
#define HOOKE_NO_MEMORY     (-1) /* an allocation failed */
#define HOOKE_BAD_VALUE     (-2) /* an argument, an option or a scene has a value that is not allowed */
#define HOOKE_BAD_CALL      (-3) /* calls out of order: a system not yet committed, or changed after it was */
#define HOOKE_IO_FAILED     (-4) /* a file could not be read or written */
#define HOOKE_NOT_BUILT     (-5) /* this build of the library was made without the part asked for */
#define HOOKE_UNSUITED      (-6) /* the method does not take this kind of problem */
#define HOOKE_SOLVER_FAILED (-7) /* a nonlinear or error-controlled solver gave up */

/* The message of the last failure or outcome in this thread; "" if there was none. Valid until the next call
 * into the library from this thread. */
HOOKE_API const char *hooke_last_error(void);

/* A short name of a status, such as "bad value"; "unknown status" for a number that is none. */
HOOKE_API const char *hooke_status_name(int32_t status);

/* Version of the library that is running, which may be newer than the header: "0.2.0". */
HOOKE_API const char *hooke_version(void);

/* The ABI number of the library that is running. */
HOOKE_API int32_t hooke_abi(void);

/* One fact about this build, as text that lives as long as the process. `what` is one of
 *   "sundials", "cholmod", "lapack", "gsl", "arpack", "hdf5", "jansson",
 *   "chartjs", "threejs"                    the version in use, or "" when the build is without it
 *   "machine"                               the kind of processor that it was built for, "x86-64", "aarch64" or "other"
 *   "instructions"                          the instruction set that the force loops use on this machine
 *   "licence"                               the licence that this build falls under
 * NULL for any other word. */
HOOKE_API const char *hooke_build_fact(const char *what);

#ifdef __cplusplus
}
#endif
#endif
