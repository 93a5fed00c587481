/* Symplectic Euler: v += h (w f + g), q += h v(new). Order 1; undamped modes stay bounded up to h w = 2
 * (Hairer, Lubich and Wanner 2006, section I.1.2). */
#include "integrate/integrator.h"
#include "kernel/step_loops.h"

static int32_t step(hooke_integrator *it) {
  const int32_t status = hooke_integrator_forces(it, it->t);
  if (status != HOOKE_OK) return status;
  const hooke_system *system = it->system;
  struct hooke_motion *m = it->motion;
  const double h = it->schedule.step, *w = system->inverse_mass;
  for (int a = 0; a < 3; a++) {
    if (system->has_gravity)
      hooke_kick_then_drift(m->n, h, w, m->f[a], system->gravity[a], m->q[a], m->v[a]);
    else
      hooke_kick_then_drift_weightless(m->n, h, w, m->f[a], m->q[a], m->v[a]);
  }
  return HOOKE_OK;
}

const struct hooke_method hooke_symplectic_euler = {.name = "symplectic-euler",
                                                    .summary =
                                                        "fixed step, order 1; keeps undamped motion bounded",
                                                    .built = 1,
                                                    .order = 1,
                                                    .second_order = 1,
                                                    .begin = hooke_fixed_begin,
                                                    .step = step,
                                                    .store = hooke_fixed_store};
