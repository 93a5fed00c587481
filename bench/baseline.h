/* The loop that a competent user would write: an array of spring structs, positions in rows of x y z. */
#ifndef BENCH_BASELINE_H
#define BENCH_BASELINE_H

#include "hooke.h"

struct baseline;

/* A copy of a committed system at its initial state; NULL without memory. */
struct baseline *baseline_create(const hooke_system *system);
void baseline_destroy(struct baseline *baseline);

/* Steps of symplectic Euler under springs, their damping, and gravity. */
void baseline_step(struct baseline *baseline, double h, int64_t steps);

/* Positions, 3 a particle. */
const double *baseline_position(const struct baseline *baseline);

#endif
