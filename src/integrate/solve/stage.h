/* The equations of one stage of an implicit step, for the velocities v' of the free particles:
 *   q' = place + a v',  M (v' - speed) = a (f(t, q', v') + M g)
 * with `place` and `speed` given. Backward Euler is one such stage with a = h; other methods have one or two
 * of them with a smaller a. With F(v') = M (v' - speed - a g) - a f(t, place + a v', v'), K = df/dq and
 * D = df/dv,
 *   one iteration  (M - a D - a^2 K) dv = -F linearised at the state where the stage begins
 *   converged      from there on, Newton: (M - a D - a^2 K) dv = -F at the last guess, with a line search on
 *                  F.M^-1 F
 * Held particles are where the drives have last said in F, and on their way to it in the first iteration: K
 * and D times their change of position and velocity stand on its right-hand side. */
#ifndef HOOKE_INTEGRATE_SOLVE_STAGE_H
#define HOOKE_INTEGRATE_SOLVE_STAGE_H

#include "integrate/solve/reduced.h"

struct hk_stage {
  int32_t one_iteration;
  struct hk_reduced reduced;
  double *begin; /* q and v of the motion where the stage begins, 6 components of n */
  double *v, *change, *right,
      *moved; /* the guess, the correction, F or a right-hand side, scratch; 3n each */
  double t, a;
  const double *place, *speed; /* 3n each, x y z apart; they may be those of `begin` */
};

/* Reads the option `newton`. Its memory is counted as the method's. */
int32_t hk_stage_create(hooke_integrator *integrator, struct hk_stage *stage);
void hk_stage_release(struct hk_stage *stage);

/* Solves the stage from where the motion is, and leaves the motion at its solution. The caller has driven held
 * particles to `t`. After a failure the motion is anywhere, and HOOKE_SOLVER_FAILED or HOOKE_STOPPED is
 * returned. */
int32_t hk_stage_solve(struct hk_stage *stage, double t, double a, const double *place, const double *speed);

/* A step that solves stages: `step` with the motion saved in `start` (6 components of n) and put back after a
 * failure, which is counted. A step that a callback stopped is taken again by whoever goes on, so it counts
 * nothing. */
typedef int32_t hk_stages_of_step(hooke_integrator *integrator);
int32_t hk_stage_step(hooke_integrator *integrator, double *start, hk_stages_of_step *step);

#endif
