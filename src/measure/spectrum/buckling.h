/* Buckling of an overdamped system: springs under compression that push each other aside. */
#ifndef HOOKE_MEASURE_SPECTRUM_BUCKLING_H
#define HOOKE_MEASURE_SPECTRUM_BUCKLING_H

#include "hooke/system.h"

/* A rate [1/s] at which some motion of the system linearised at q and time t grows by itself: a lower bound
 * of the largest one, by a vector that shows it; 0 if none was found, which proves nothing. HOOKE_NO_MEMORY;
 * HOOKE_STOPPED by a callback. */
int32_t hk_buckling_rate(const hooke_system *system, double t, const double *q, double *rate);

#endif
