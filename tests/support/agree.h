/* Compares a system with its canonical twin, to the bit. */
#pragma once

#include "canonical.h"
#include "hooke.h"

/* Accelerations at (q, v), and three steps from the initial state by each explicit method; energy
 * and heat of springs. */
void check_agrees(const hooke_system *system, const struct canonical *canonical, const double *q,
                  const double *v);
