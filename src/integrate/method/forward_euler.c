/* Forward Euler: q += h v(old), v += h (w f + g); for first-order problems x += h phi(t, x). Order 1 (Euler
 * 1768). Unstable for every undamped oscillation at any step. */
#include "integrate/method.h"

const struct hk_method hk_forward_euler = {.name = "forward-euler",
                                           .summary = "fixed step, order 1; unstable without damping",
                                           .order = 1,
                                           .judge = "verlet",
                                           .takes = HOOKE_TAKES_ALL,
                                           .steps = &hk_explicit_steps,
                                           .stages = {1, {1}},
                                           .stability = {.kind = HOOKE_STABLE_BY_POLYNOMIAL, .degree = 1},
                                           .by_tiles = 1};
