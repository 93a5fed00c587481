/* Steps of the library beside canonical steps. */
#ifndef TESTS_SUPPORT_LOCKSTEP_H
#define TESTS_SUPPORT_LOCKSTEP_H

#include "random_scene.h"

/* Fails unless `steps` steps of a fixed-step method from time `start` give the canonical positions,
 * velocities and times to the bit, seen after every step, all in one call, and one by one. Where a step is
 * the solution of equations they have to hold after every step, and the bits to be the same in each of these
 * ways. Backward Euler may end at a step without solution where damped springs only pull. A scene with driven
 * particles starts at 0, where hooke_state_create() puts them. */
void check_lockstep(const struct random_scene *scene, const char *method, int32_t threads, double start,
                    double step, int64_t steps);

#endif
