/* The classical Runge-Kutta method (Kutta 1901), order 4: four rates a step, at t, twice at t + h/2, and at t
 * + h. */
#include "integrate/method.h"

const struct hk_method hk_rk4 = {
    .name = "rk4",
    .summary = "fixed step, order 4, four force evaluations a step",
    .order = 4,
    .checked_by = "cvode-adams",
    .takes = HOOKE_TAKES_ALL,
    .steps = &hk_explicit_steps,
    .stages = {4, {2, 2, 1, 6}},
    .stability = {.kind = HOOKE_STABLE_BY_POLYNOMIAL, .degree = 4, .axis = 8.0, .half_disc = 2.6156},
    .by_tiles = 1};
