/* Heun's method (1900), the explicit trapezoidal rule, order 2: two rates a step, at t and at t + h. Undamped
 * oscillations grow by (omega h)^4/8 a step. */
#include "integrate/method.h"

const struct hk_method hk_heun = {
    .name = "heun",
    .summary = "fixed step, order 2, two force evaluations a step; unstable without damping",
    .order = 2,
    .judge = "rk4",
    .takes = HOOKE_TAKES_ALL,
    .steps = &hk_explicit_steps,
    .stages = {2, {1, 2}},
    .stability = {.kind = HOOKE_STABLE_BY_POLYNOMIAL, .degree = 2},
    .by_tiles = 1};
