/* Heun's method (1900), the explicit trapezoidal rule, order 2: two rates a step, at t and at t + h. Undamped
 * oscillations grow by (omega h)^4/8 a step. */
#include "integrate/method/stages.h"

const struct hk_method hk_heun = {
    .name = "heun",
    .summary = "fixed step, order 2, two force evaluations a step; unstable without damping",
    .built = 1,
    .order = 2,
    .judge = "rk4",
    .first_order = 1,
    .second_order = 1,
    .bodies = 1,
    .overdamped = 1,
    .stages = {2, {0.0, 1.0}, {1.0, 2.0}},
    .stability = {.kind = HOOKE_STABLE_BY_POLYNOMIAL, .degree = 2},
    .by_tiles = 1,
    .create = hk_stages_create,
    .destroy = hk_stages_destroy,
    .begin = hk_fixed_begin,
    .step = hk_stages_step,
    .store = hk_fixed_store};
