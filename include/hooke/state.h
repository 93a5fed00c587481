/* hooke/state.h - state of a motion: time, positions and velocities.
 *
 * A state is one block of doubles, t, then q (3n), then v (3n), rows of x y z in the caller's numbering,
 * which NumPy and HDF5 wrap without a copy. It is up to date at frames, in observers and callbacks, and when
 * a run or step returns; in between an integrator works on its own copy, and hooke_integrator_advance() works
 * on that copy alone. A state belongs to one thread at a time. */
#ifndef HOOKE_STATE_H
#define HOOKE_STATE_H

#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_state hooke_state;

/* The initial state of a committed system: t = 0, positions and velocities as added, driven particles at
 * their prescribed positions. The caller owns it. HOOKE_BAD_CALL, HOOKE_NO_MEMORY, HOOKE_STOPPED. */
HOOKE_API int32_t hooke_state_create(const hooke_system *system, hooke_state **state);

/* A state of `size` >= 1 zeros for a first-order problem x' = phi(t, x): hooke_state_position() is x; there
 * is no velocity. HOOKE_BAD_VALUE for a size below 1 or above 6442450941, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_state_create_first_order(int64_t size, hooke_state **state);

/* A state of `size` >= 1 zeros for a second-order problem q'' = W f(t, q, v): q and v have `size` numbers.
 * The same failures. */
HOOKE_API int32_t hooke_state_create_second_order(int64_t size, hooke_state **state);

/* Committed systems of problems without particles, from a start that is copied, at t = 0: for integrators,
 * states and the measurements "study" and "estimate", whose errors are the largest difference of any number,
 * in its unit. Other measurements, and files, are HOOKE_UNSUITED.
 * The first is q'' = W f(t, q, v) as in hooke_integrator_create_second_order(). The second is x' = phi(t, x),
 * which the methods for "first-order" take (hooke_method_is_suited()); its states have x as the position and
 * the rate as the velocity. HOOKE_BAD_VALUE for a start of the other kind, at another time or of numbers that
 * are not finite; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_create_second_order(hooke_force *force, hooke_force_product *product,
                                                   void *ctx, int64_t mass_count, const double *inverse_mass,
                                                   const hooke_state *start, hooke_system **system);
HOOKE_API int32_t hooke_system_create_first_order(hooke_rate *rate, void *ctx, const hooke_state *start,
                                                  hooke_system **system);

/* Releases a state; NULL is allowed. */
HOOKE_API void hooke_state_destroy(hooke_state *state);

/* Copies t, q and v. HOOKE_BAD_VALUE if the two differ in size, or one alone has velocities. */
HOOKE_API int32_t hooke_state_copy(const hooke_state *from, hooke_state *to);

HOOKE_API double hooke_state_time(const hooke_state *state);
HOOKE_API void hooke_state_set_time(hooke_state *state, double t);

/* Number of numbers in q: 3n, or the size of a first- or second-order problem. */
HOOKE_API int64_t hooke_state_size(const hooke_state *state);

/* Pointers to q and v, for reading and, except in an observer, for writing; valid as long as the state lives.
 * The velocity of a first-order problem is NULL. */
HOOKE_API double *hooke_state_position(const hooke_state *state);
HOOKE_API double *hooke_state_velocity(const hooke_state *state);

#ifdef __cplusplus
}
#endif
#endif
