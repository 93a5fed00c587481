/* The loop of a competent user: an array of spring structs, positions in rows of x y z. */
#pragma once

#include "hooke.h"

struct baseline;

/* 1 if there is such a loop: for forward-euler, symplectic-euler, rk4, and without damping verlet. */
int baseline_has(const char *method, int is_damped);

/* Does steps of `method` under springs, their damping, and gravity, starting from a copy of `state`; NULL
 * without memory. A system without damping has loops that read no velocity. */
struct baseline *baseline_create(const hooke_system *system, const hooke_state *state, const char *method);
void baseline_destroy(struct baseline *baseline);

void baseline_step(struct baseline *baseline, double h, int64_t steps);

/* Positions, 3 a particle. */
const double *baseline_position(const struct baseline *baseline);
