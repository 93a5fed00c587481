/* All dampers of a system, applied to velocities one after the other for a time h, each exactly but for the
 * form of its factor (Shardlow 2003). An element with weights g, strength c along u and the inverse masses w
 * of its particles acts on W = sum of g_j^2 w_j, and takes the part 1 - 1/(1 + z + z^2/2) of its rate, z = h
 * c W.
 *
 * Their order, which is backwards in the second sweep of a step: damped springs by colour, where the colour
 * of a spring is the lowest that no damped spring before it has at either end; then the other forces in the
 * order of the sum, with their elements in ascending number; then drag. */
#pragma once

#include "model/sum/motion.h"

struct hk_dampers;

/* For sweeps of the time `h` each. HOOKE_NO_MEMORY. */
int32_t hk_dampers_create(const hooke_system *system, double h, struct hk_dampers **dampers);
void hk_dampers_destroy(struct hk_dampers *dampers);
int64_t hk_dampers_memory(const struct hk_dampers *dampers);

/* Changes the velocities of `motion`, whose particles have the caller's numbers, by the dampers of time t and
 * in its wind. */
void hk_dampers_sweep(struct hk_dampers *dampers, struct hk_motion *motion, double t, int32_t backwards);
