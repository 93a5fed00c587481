/* Velocity Verlet with its damping split off (Shardlow 2003, with Strang's splitting): every damper is
 * applied to its pair alone, for half a step before and, in the reverse order, for half a step after a step
 * of Verlet without damping. Of order 2. Each damper takes energy and never gives any, and Verlet keeps a
 * quadratic form of an oscillation up to h w = 2, so that this is the limit at any damping; pairs keep their
 * momentum. What strong damping does to the order is in docs/notes/methods.md. */
#include "core/memory.h"
#include "integrate/method/verlet.h"
#include "model/sum/dampers.h"

#include <stddef.h>

struct shardlow {
  struct hk_dampers *dampers;
  double *zero; /* n */
};

static int32_t make(hooke_integrator *it, struct shardlow *own) {
  const int64_t n = it->system->particle_count;
  own->zero = hk_new(n, sizeof(double));
  if (own->zero == NULL) return HOOKE_NO_MEMORY;
  it->motion->zero = own->zero;
  const int32_t status = hk_dampers_create(it->system, it->schedule.step / 2.0, &own->dampers);
  if (status != HOOKE_OK) return status;
  it->own_memory += n * (int64_t)sizeof(double) + hk_dampers_memory(own->dampers);
  return HOOKE_OK;
}

static int32_t create(hooke_integrator *it) {
  struct shardlow *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->around = own;
  const int32_t status = make(it, own);
  return status == HOOKE_OK ? hk_verlet.steps->create(it) : status;
}

static void destroy(hooke_integrator *it) {
  struct shardlow *own = it->around;
  if (it->own) hk_verlet.steps->destroy(it);
  hk_dampers_destroy(own->dampers);
  hk_free(own->zero);
  hk_free(own);
  it->around = NULL;
}

static int32_t step(hooke_integrator *it) {
  struct shardlow *own = it->around;
  hk_dampers_sweep(own->dampers, it->motion, it->t, 0);
  it->goes_on = 0; /* dampers come in between */
  const int32_t status = hk_verlet.steps->step(it);
  if (status != HOOKE_OK) return status;
  if (it->system->constrained_count > 0) hk_motion_hold(it->system, it->motion); /* kicks move them, too */
  hk_dampers_sweep(own->dampers, it->motion, hk_integrator_next_time(it), 1);
  return HOOKE_OK;
}

static const struct hk_steps steps = {create,          destroy, hk_verlet_forget,
                                      hk_verlet_begin, step,    hk_fixed_store};

const struct hk_method hk_shardlow = {
    .name = "shardlow",
    .summary = "fixed step, order 2; Verlet, and each damper on its pair alone, stable at any damping",
    .order = 2,
    .stability = {.kind = HOOKE_STABLE_BY_K, .damps_implicitly = 1, .damps_apart = 1},
    .steps = &steps};
