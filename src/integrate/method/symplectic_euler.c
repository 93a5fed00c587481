/* Symplectic Euler: v += h (w f + g), q += h v(new). Order 1; undamped modes stay bounded up to h w = 2
 * (Hairer, Lubich and Wanner 2006, section I.1.2). */
#include "integrate/integrator.h"

static int32_t step(hooke_integrator *it) {
  const double h = it->schedule.step;
  struct hk_move move;
  hk_integrator_move_of(it, HOOKE_KICK_THEN_DRIFT, h, h, &move);
  return hk_integrator_move(it, it->t, &move);
}

static const struct hk_steps steps = {NULL, NULL, NULL, hk_fixed_begin, step, hk_fixed_store};

const struct hk_method hk_symplectic_euler = {.name = "symplectic-euler",
                                              .summary = "fixed step, order 1; keeps undamped motion bounded",
                                              .order = 1,
                                              .judge = "verlet",
                                              .takes = HOOKE_TAKES_BODIES,
                                              .stability = {.kind = HOOKE_STABLE_BY_K_AND_C},
                                              .by_tiles = 1,
                                              .steps = &steps};
