/* Forward Euler: q += h v(old), v += h (w f + g); for first-order problems x += h phi(t, x). Order 1 (Euler
 * 1768). Unstable for every undamped oscillation at any step. */
#include "integrate/method/stages.h"

const struct hk_method hk_forward_euler = {.name = "forward-euler",
                                           .summary = "fixed step, order 1; unstable without damping",
                                           .built = 1,
                                           .order = 1,
                                           .judge = "verlet",
                                           .first_order = 1,
                                           .second_order = 1,
                                           .bodies = 1,
                                           .overdamped = 1,
                                           .stages = {1, {0.0}, {1.0}},
                                           .stability = {.kind = HOOKE_STABLE_BY_POLYNOMIAL, .degree = 1},
                                           .by_tiles = 1,
                                           .create = hk_stages_create,
                                           .destroy = hk_stages_destroy,
                                           .begin = hk_fixed_begin,
                                           .step = hk_stages_step,
                                           .store = hk_fixed_store};
