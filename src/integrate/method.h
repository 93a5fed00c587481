/* The table of methods. A new method is one file and one row in method.c. */
#ifndef HOOKE_INTEGRATE_METHOD_H
#define HOOKE_INTEGRATE_METHOD_H

#include "hooke/integrator.h"

/* What a row says of itself, and how it is run. `create` and `destroy` may be NULL. All return a status. */
struct hk_method {
  const char *name, *summary;
  const char *needs;                 /* library that it needs, NULL: none */
  int32_t built;                     /* 0: this build is without that */
  int32_t reference;                 /* 1: there to check references with, left out of lists; found by name */
  int32_t adaptive;                  /* 1: chooses its steps from tolerances; 0: takes `step` */
  int32_t order;                     /* of a fixed-step method, on smooth forces */
  int32_t first_order, second_order; /* problems it takes: x' = phi(t, x); q' = v, v' = W f */
  int32_t by_tiles;                  /* 1: steps by hk_integrator_move() alone */
  const char *no_first_order; /* why it takes none, if not for stepping positions and velocities apart */
  int32_t (*create)(hooke_integrator *integrator);
  void (*destroy)(hooke_integrator *integrator);
  /* forgets what it keeps of a motion that was changed by hand; NULL if it keeps nothing. An adaptive method
   * begins anew instead. */
  void (*forget)(hooke_integrator *integrator);
  /* takes up t, q and v */
  int32_t (*begin)(hooke_integrator *integrator, const hooke_state *state);
  /* one step; an adaptive method moves integrator->t, a fixed-step one has it moved for it */
  int32_t (*step)(hooke_integrator *integrator);
  /* writes the solution at time t, which lies within the last step */
  int32_t (*store)(hooke_integrator *integrator, double t, hooke_state *state);
};

extern const struct hk_method hk_forward_euler, hk_symplectic_euler, hk_verlet, hk_rk4, hk_backward_euler,
    hk_cvode_bdf, hk_cvode_adams, hk_rk8pd, hk_arkode_esdirk;

/* Row of this name, or NULL. */
const struct hk_method *hk_method_find(const char *name);

#endif
