/* Steps of the library compared with canonical steps. */
#pragma once

#include "random_scene.h"

/* Fails unless `steps` steps of a fixed-step method from time `start` give the canonical positions,
 * velocities and times to the bit, compared after every step, all in one call, and one by one. For an
 * implicit method the equations have to hold after every step, and the bits have to be the same in each of
 * these ways. Backward Euler may end at a step without solution if springs that only pull are damped. A scene
 * with driven particles starts at 0, where hooke_state_create() places them. */
void check_lockstep(const struct random_scene *scene, const char *method, int32_t threads, double start,
                    double step, int64_t steps);
