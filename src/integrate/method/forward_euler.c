/* Forward Euler: q += h v(old), v += h (w f + g); for first-order problems x += h phi(t, x). Order 1 (Euler
 * 1768). Unstable for every undamped oscillation at any step. */
#include "integrate/method/stages.h"
#include "kernel/step_loops.h"

static int32_t step_rate(hooke_integrator *it) {
  const int32_t status = hk_integrator_rate(it, it->t, it->x, it->slope);
  if (status == HOOKE_OK) hk_advance(it->size, it->schedule.step, it->slope, it->x);
  return status;
}

const struct hk_stages hk_forward_euler_stages = {1, {0.0}, {1.0}};

/* An overdamped system has one stage: q += h v. */
static int32_t create(hooke_integrator *it) {
  return it->system && it->system->friction > 0.0 ? hk_stages_create(it, &hk_forward_euler_stages) : HOOKE_OK;
}

static int32_t step(hooke_integrator *it) {
  if (it->rate) return step_rate(it);
  if (it->own) return hk_stages_step(it);
  const double h = it->schedule.step;
  struct hk_move move;
  hk_integrator_move_of(it, HOOKE_DRIFT_THEN_KICK, h, h, &move);
  return hk_integrator_move(it, it->t, &move);
}

const struct hk_method hk_forward_euler = {.name = "forward-euler",
                                           .summary = "fixed step, order 1; unstable without damping",
                                           .built = 1,
                                           .order = 1,
                                           .judge = "verlet",
                                           .first_order = 1,
                                           .second_order = 1,
                                           .bodies = &hk_forward_euler_bodies,
                                           .overdamped = 1,
                                           .stability = {.kind = HOOKE_STABLE_BY_POLYNOMIAL, .degree = 1},
                                           .by_tiles = 1,
                                           .create = create,
                                           .destroy = hk_stages_destroy,
                                           .begin = hk_fixed_begin,
                                           .step = step,
                                           .store = hk_fixed_store};
