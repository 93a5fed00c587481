/* Displaced starts: a result that only the exact start has is no result. */
#ifndef HOOKE_MEASURE_TRIAL_DISPLACED_H
#define HOOKE_MEASURE_TRIAL_DISPLACED_H

#include "hooke/state.h"
#include "model/particles.h"

/* Adds to every coordinate of a free particle a normal number times `length` [m]; a rigid body goes where the
 * three particles go that say where it is. */
void hk_displace(hooke_state *state, const hooke_system *system, double length, uint64_t *random);

#endif
