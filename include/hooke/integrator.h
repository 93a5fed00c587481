/* hooke/integrator.h - methods, and the loop that runs them.
 *
 * An integrator is a method with its options and its scratch, made for one system (or one first- or
 * second-order problem). It belongs to one thread at a time; many integrators may share a system, each with
 * its own state.
 *
 * Options of a run (hooke_options_create("run", ...)): method, step [s], duration [s], every [s], checkpoint
 * [s], newton, verlet_damping, rtol, atol [m], atol_velocity [m/s], max_order, linear_solver, max_steps,
 * past_divergence, frames_after, threads.
 *
 * Frames. With a fixed-step method `every` and `duration` are whole multiples of `step`; frame k is the state
 * after k m steps, frame 0 the initial one, and its time is t0 + k m step, never a running sum. Without
 * `every` it is the multiple of `step` nearest to duration/100. Error-controlled methods interpolate frames
 * to their order, or end a step at each. The end of a run is a frame, too: where `every` does not divide
 * `duration`, to 1e-9 relative, the last interval is shorter. */
#ifndef HOOKE_INTEGRATOR_H
#define HOOKE_INTEGRATOR_H

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_integrator hooke_integrator;

/* Receives the state after `step` steps; must not change it. Return 0 to go on, anything else to stop the
 * run. */
typedef int32_t hooke_observer(int64_t step, const hooke_state *state, void *ctx);

/* Receives progress: the fraction done (0..1) and the name of the running task. Return 0 to go on. */
typedef int32_t hooke_progress(double done, const char *what, void *ctx);

/* ---- methods ----
 * hooke_method_count() and hooke_method_name() list the ordinary methods. Two more exist for checking
 * references, "rk8pd" (GSL) and "arkode-esdirk" (SUNDIALS): the option `method` and the functions that take a
 * name accept them, too. */

HOOKE_API int64_t hooke_method_count(void);
/* Name of a method, "forward-euler"; NULL past the last. */
HOOKE_API const char *hooke_method_name(int64_t method);
/* The method that a word means, in capitals or not: itself, or the one that another common name stands for
 * ("leapfrog"); several, separated by blanks, to choose from ("euler") or as relatives of one that is not
 * there
 * ("trapezoidal"); "" if none. Options and scenes take names alone. */
HOOKE_API const char *hooke_method_meant(const char *word);
/* One-line description of a method; NULL if there is no such name. */
HOOKE_API const char *hooke_method_summary(const char *name);
/* 1 if the method chooses its steps from tolerances, 0 if it takes `step`, -1 if there is no such name. */
HOOKE_API int32_t hooke_method_is_adaptive(const char *name);
/* 1 if this build has the method. */
HOOKE_API int32_t hooke_method_is_built(const char *name);
/* 1 if the method takes a kind of problem: "second-order" (particles, q'' = W f(t, q, v)), with "bodies" that
 * move, "overdamped" systems, or "first-order" (x' = phi(t, x)). 0 if not: integrators of it are
 * HOOKE_UNSUITED, with the methods that do; -1 if there is no such name or kind. */
HOOKE_API int32_t hooke_method_is_suited(const char *name, const char *problem);

/* ---- making ---- */

/* Creates an integrator for a committed system, which must outlive it; `options` is copied. HOOKE_BAD_VALUE
 * (an option), HOOKE_BAD_CALL (not committed), HOOKE_UNSUITED (by hooke_method_is_suited(), or a scene that
 * lacks the callbacks of its run), HOOKE_NOT_BUILT, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_integrator_create(const hooke_system *system, const hooke_options *options,
                                          hooke_integrator **integrator);

/* Creates an integrator for x' = phi(t, x) of `size` numbers. HOOKE_UNSUITED for a method that needs
 * positions and velocities or their derivatives (hooke_method_is_suited()). HOOKE_BAD_VALUE, HOOKE_NOT_BUILT,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_integrator_create_first_order(int64_t size, hooke_rate *rate, void *ctx,
                                                      const hooke_options *options,
                                                      hooke_integrator **integrator);

/* Creates an integrator for q'' = W f(t, q, v) of `size` generalized coordinates, with W > 0 the constant
 * inverse masses: one for all (`mass_count` 1) or one for each, copied. `force` adds f to `size` zeros, and
 * `product` its derivative; `product` may be NULL, and both are those of hooke_system_set_force() with
 * `size` numbers in place of n particles. Where masses depend on q let `force` add M(q)^-1 f with the inverse
 * mass 1: no method is symplectic then. All methods take it; see docs/notes/methods.md for `verlet` where f
 * depends on v. Divergence is a number that is not finite. HOOKE_BAD_VALUE, HOOKE_NOT_BUILT,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_integrator_create_second_order(int64_t size, hooke_force *force,
                                                       hooke_force_product *product, void *ctx,
                                                       int64_t mass_count, const double *inverse_mass,
                                                       const hooke_options *options,
                                                       hooke_integrator **integrator);

HOOKE_API void hooke_integrator_destroy(hooke_integrator *integrator);

/* The integrator's own copy of its options, with `every`, `atol` and `atol_velocity` filled in; valid as
 * long as the integrator lives. */
HOOKE_API const hooke_options *hooke_integrator_options(const hooke_integrator *integrator);

/* ---- watching: at most one observer of each kind; NULL removes it ---- */

HOOKE_API int32_t hooke_integrator_on_frame(hooke_integrator *integrator, hooke_observer *observer,
                                            void *ctx);
/* Called every `stride` >= 1 steps. */
HOOKE_API int32_t hooke_integrator_on_step(hooke_integrator *integrator, int64_t stride,
                                           hooke_observer *observer, void *ctx);
/* Called at the checkpoints of the option `checkpoint`, after the frame of that time. With a fixed step,
 * checkpoints are a constant number of steps apart, at least one, as near to the option as whole steps allow.
 * With error control they are at t0 + k checkpoint, where the method restarts whether or not an observer is
 * set. At these times hooke_checkpoint_write() can save everything that the run needs to go on. */
HOOKE_API int32_t hooke_integrator_on_checkpoint(hooke_integrator *integrator, hooke_observer *observer,
                                                 void *ctx);

/* Called between two steps, after every `seconds` >= 0 of work, with the fraction of `duration` that is done
 * and the name of the method. It has no measurable cost and changes no bits. It lets a program show progress
 * or stop a run. Stopping leaves the state of the last whole step. HOOKE_BAD_VALUE. */
HOOKE_API int32_t hooke_integrator_on_progress(hooke_integrator *integrator, double seconds,
                                               hooke_progress *progress, void *ctx);

/* ---- running ---- */

/* Runs `duration` from the state's time on, reporting frames; `state` is the final state on return.
 * HOOKE_STOPPED: an observer, force, drive or progress returned non-zero, the count "stop_value"; the state
 * is that of the last whole step. HOOKE_DIVERGED: a component is not finite, or, without callbacks and
 * drives, the energy rose by more than 100 times what the scene had; tested at frames and every 1000 steps;
 * the state is the last one that passed, and "diverged_at" of hooke_integrator_number() tells when it was
 * noticed. With the option `past_divergence` frames come after that, until a number is not finite.
 * HOOKE_STEP_LIMIT, HOOKE_SOLVER_FAILED: the state is the last one reached. HOOKE_BAD_VALUE: no
 * `duration`, one that does not change the time of an error-controlled method, or a state with numbers
 * that are not finite or rows of a rigid body that are not those of a rigid motion. */
HOOKE_API int32_t hooke_integrator_run(hooke_integrator *integrator, hooke_state *state);

/* Continues a run to its end from where hooke_checkpoint_read() placed the integrator and the state, or from
 * where an observer or callback stopped a run with a fixed step. Bits and counts are those of an
 * uninterrupted run. Frames that were reported are not reported again. Outcomes are those of
 * hooke_integrator_run(); HOOKE_BAD_CALL if there is no run to continue. */
HOOKE_API int32_t hooke_integrator_resume(hooke_integrator *integrator, hooke_state *state);

/* ---- time loops of the caller's own ---- */

/* Takes `steps` steps of a fixed-step method, or internal steps of an error-controlled one, without frames.
 * It continues from the state that the last call left, or begins anew if the caller has changed that state;
 * with 0 steps it only does the latter. `state` is valid on return. The statuses are those of
 * hooke_integrator_run(), except that numbers are tested for being finite after every call. */
HOOKE_API int32_t hooke_integrator_step(hooke_integrator *integrator, hooke_state *state, int64_t steps);

/* Begins a motion at `state`, as the one after `step` >= 0 steps of a motion that began at time t0: the times
 * of its steps are those of that motion, t0 + k h, to the bit, and so has to be that of `state`. If the
 * integrator has an earlier step of a motion that began at t0, this is the same one: divergence is then
 * judged by its energies, here as well. HOOKE_DIVERGED; HOOKE_BAD_VALUE, also for a state of another time;
 * HOOKE_UNSUITED for an error-controlled method. */
HOOKE_API int32_t hooke_integrator_begin(hooke_integrator *integrator, hooke_state *state, double t0,
                                         int64_t step);

/* Takes `steps` steps of the integrator's own motion, continuing from where the last call left it;
 * hooke_integrator_step() with 0 steps begins a motion at a state. It gives the same bits at the cost of a
 * step of a run, since it neither reads nor writes a state: the caller's state is stale until
 * hooke_integrator_sync(). Divergence is tested every 1000 steps. The statuses are those of
 * hooke_integrator_step(); HOOKE_BAD_CALL if there is no motion, or if it ended early and did not stop. */
HOOKE_API int32_t hooke_integrator_advance(hooke_integrator *integrator, int64_t steps);
/* Writes time, positions and velocities of the motion into `state`; after HOOKE_DIVERGED, the last good ones.
 * hooke_integrator_step() then continues from there. HOOKE_DIVERGED, with the last good state, for non-finite
 * numbers; HOOKE_BAD_CALL if there is no motion. */
HOOKE_API int32_t hooke_integrator_sync(hooke_integrator *integrator, hooke_state *state);

/* Positions and velocities (3 `count` each; NULL: not those) of some particles of the motion, read and
 * written at a cost that goes with their number: with error control with that of all, and writing has the
 * method start anew. Pinned particles are held where they are put; driven ones stay where their motion has
 * them. Since writing may bring any energy, only numbers that are not finite are divergence from then on.
 * HOOKE_BAD_CALL as for hooke_integrator_advance(), HOOKE_BAD_VALUE for a particle that does not exist or a
 * number that is not finite, HOOKE_UNSUITED for a first- or second-order problem and for writing a particle
 * of a rigid body that moves, HOOKE_NO_MEMORY; nothing is written then. */
HOOKE_API int32_t hooke_integrator_get(hooke_integrator *integrator, int64_t count, const int64_t *particles,
                                       double *q, double *v);
HOOKE_API int32_t hooke_integrator_put(hooke_integrator *integrator, int64_t count, const int64_t *particles,
                                       const double *q, const double *v);

/* ---- counts and times since the integrator was made; after hooke_checkpoint_read(), since the run began
 * ---- */

/* A count: "steps", "force_evaluations", "derivative_products", "nonlinear_iterations",
 * "nonlinear_failures", "linear_iterations", "error_test_failures", "explicit_damping" (1 of verlet that
 * takes the damping of springs at the predicted velocity, 0 where it solves for it and of anything else),
 * "coincident_springs" (springs and contacts without direction in the last force evaluation), "zero_passages"
 * (times that a spring or an anchor with a rest length passed through length zero, where its ends go through
 * each other; -1: not known, as a part of the run was before a checkpoint or a frame that it goes on
 * from, or without memory), "memory_bytes"; "frames" that hooke_integrator_run() reports, the initial one
 * included; "recent": states that hooke_integrator_recent() has; "stop_value": what the callback that
 * stopped the run returned, 0 if none did; "factor_bytes": what a factor of its equations takes, which an
 * implicit method makes where that pays; they are analysed for it. 0 if it makes none, or is told to; -1
 * without memory, with hooke_last_error(). -1 for any other word. */
HOOKE_API int64_t hooke_integrator_count(const hooke_integrator *integrator, const char *what);
/* "wall_seconds": time spent stepping [s], observers and output left out; "diverged_at": time at which
 * divergence was noticed [s], NaN if it was not. NaN for another word. */
HOOKE_API double hooke_integrator_number(const hooke_integrator *integrator, const char *what);
/* "zero_passages": that, which of them was the first, and what to do, in a sentence; "" if there was
 * none. It is valid until the integrator takes a step. NULL for another word. */
HOOKE_API const char *hooke_integrator_text(const hooke_integrator *integrator, const char *what);
/* Copies into `state` one of the states of this run that passed the check (see hooke_integrator_run()), to
 * see how the run went wrong. `place` 0 is the last one, which is always kept, 1 the one before it, and so
 * on: eight at most, as far as 16 MB hold them. HOOKE_BAD_VALUE if there is none, or if the state is of
 * another size. */
HOOKE_API int32_t hooke_integrator_recent(const hooke_integrator *integrator, int64_t place,
                                          hooke_state *state);

/* ---- a warning before a run blows up ---- Told that the step is no longer safe at the time t [s]. `kind` is
 * "near-limit" (within 5 % of hooke_step_bound() there), "above-limit" or "never-stable" (the bound is 0);
 * each is told once a run. `sentence` has everything in words: step, `limit` [s] (the bound), and what
 * determines it, `particle` and the spring that weighs most there, `spring` (-1: none, or bending or an
 * altitude spring weighs more). Return 0 to go on, anything else to stop the run. */
typedef int32_t hooke_warning(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                              int64_t particle, void *ctx);

/* Warns of what a committed system may be, but is seldom meant to be, of kind "no-stiffness" (a part or a
 * group of springs), "same-pair" (three springs of a group between two particles), "added-mass" (a rope no
 * heavier than the liquid that it displaces), "jump" (springs that only pull, whose curve is above 0 at the
 * rest length) or "nothing-moves". `limit` is NaN, and spring and particle are -1 where there is none.
 * HOOKE_BAD_CALL before commit, HOOKE_NO_MEMORY; HOOKE_STOPPED if a warning returned anything but 0. */
HOOKE_API int32_t hooke_system_warnings(const hooke_system *system, hooke_warning *warning, void *ctx);

/* Turns on warnings for the runs of `integrator`: those of hooke_system_warnings() come at once, from this
 * call. It checks the step at the start of a run, then at as many of the checks for divergence as cost less
 * than a hundredth of the stepping. Results do not depend on it. NULL turns them off. A method without a
 * bound, and a system with rigid bodies, have no warnings of the step. HOOKE_UNSUITED for a first- or
 * second-order problem; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_integrator_on_warning(hooke_integrator *integrator, hooke_warning *warning,
                                              void *ctx);

#ifdef __cplusplus
}
#endif
#endif
