/* hooke/base.h - status codes, messages and facts about this build.
 *
 * Every function that can fail returns an int32_t status: 0 is success, a negative value a failure (the
 * object it was called on is unchanged), a positive value an outcome of a run. hooke_last_error() then says
 * in words what went wrong, where, and what is allowed. The library never prints, never exits and keeps no
 * state but this message, which is one per thread.
 *
 * Threads. Any number of threads may call at once, each with objects of its own; all may share a committed
 * system. Files need no locking by the caller: the library calls HDF5 from one thread at a time. A program
 * that itself uses HDF5 in other threads needs an HDF5 that was built thread-safe.
 * The library leaves the settings of the program unchanged: errno (after failures, too), rounding mode,
 * treatment of denormals, masks of floating-point exceptions, locale, signals, working folder. Floating-point
 * exceptions raise their flags as in any arithmetic, so a program that traps them masks them around its
 * calls. Results differ in other rounding modes. Numbers are read and written with a decimal point in every
 * locale.
 * Callbacks may leave by longjmp(): the integrator, state and system can then be destroyed or run again from
 * a state of its own, with the same results. Scratch memory of the interrupted call leaks; a run or a step
 * allocates some only where difference quotients replace a missing product. A C++ exception has to be caught
 * inside the callback.
 * NULL. Texts, arrays, callbacks and places for results must not be NULL unless the function says so, or the
 * count of an array is 0: NULL gives HOOKE_BAD_VALUE, or, from functions without a status, the value for an
 * unknown word. Objects must not be NULL either: HOOKE_BAD_CALL, or -1, NaN, NULL, 0 (no).
 * Handles. A Debug build (HOOKE_CHECK_HANDLES) refuses in the same way an object that was destroyed, never
 * made, or is of another type. For this it keeps a list of all objects. An array that is too short is
 * undefined behaviour. */
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

#define HOOKE_VERSION "0.4.0"
#define HOOKE_ABI     1 /* number in the soname; it increases when callers need recompiling */

/* Statuses. The numbers are part of the ABI and never change. */
#define HOOKE_OK            0
#define HOOKE_STOPPED       1    /* a callback or an observer asked to stop */
#define HOOKE_DIVERGED      2    /* the run left every physical bound; see hooke_integrator_run() */
#define HOOKE_STEP_LIMIT    3    /* an error-controlled method used up `max_steps` */
#define HOOKE_NO_MEMORY     (-1) /* an allocation failed */
#define HOOKE_BAD_VALUE     (-2) /* an argument, an option or a scene has a value that is not allowed */
#define HOOKE_BAD_CALL      (-3) /* calls out of order: a system not yet committed, or changed after commit */
#define HOOKE_IO_FAILED     (-4) /* a file could not be read or written */
#define HOOKE_NOT_BUILT     (-5) /* this build of the library lacks the requested part */
#define HOOKE_UNSUITED      (-6) /* the method does not support this kind of problem */
#define HOOKE_SOLVER_FAILED (-7) /* a nonlinear or error-controlled solver gave up */
#define HOOKE_INTERNAL      (-8) /* hooke found a defect of its own; nothing was measured */

/* Message of the last failure or outcome in this thread, with a line for each fault of a scene; "" if there
 * was none. Valid until the next call into the library from this thread. */
HOOKE_API const char *hooke_last_error(void);

/* Short name of a status, such as "bad value"; "unknown status" for any other number. */
HOOKE_API const char *hooke_status_name(int32_t status);

/* Version of the running library, which may be newer than the header: "0.4.0". */
HOOKE_API const char *hooke_version(void);

/* ABI number of the running library. */
HOOKE_API int32_t hooke_abi(void);

/* A fact about this build, as text that lives as long as the process, but for "blas". `what` is one of
 *   "sundials", "cholmod", "lapack", "gsl", "hdf5",
 *   "chartjs", "threejs"                    the version in use, or "" when the build is without it
 *   "blas"                                  name, version, processor and threads of the optimised BLAS that
 *                                           factors for cvode-bdf call, as they are now: "OpenBLAS 0.3.21
 *                                           Zen, 2 threads"; "" where they call none. Valid until the next
 *                                           call in this thread
 *   "machine"                               processor architecture of the build: "x86-64", "aarch64", "other"
 *   "instructions"                          the instruction set that the force loops use on this machine
 *   "licence"                               the licence that this build falls under
 * NULL for any other word. */
HOOKE_API const char *hooke_build_fact(const char *what);

#ifdef __cplusplus
}
#endif
#endif
