/* The equations of one stage of an implicit step, for the velocities v' of the free particles:
 *   q' = place + a v',  M (v' - speed) = a (f(t, q', v') + M g)
 * with `place` and `speed` given. Backward Euler is one such stage with a = h; other methods have one or two
 * of them with a smaller a. With F(v') = M (v' - speed - a g) - a f(t, place + a v', v'), K = df/dq and D =
 * df/dv,
 *   one iteration  (M - a D - a^2 K) dv = -F linearised at the state where the stage begins
 *   converged      S dv = -F at guess after guess, where S is the matrix with all that is not symmetric or
 *                  positive left out, element by element; with a search along dv. Where a correction has not
 *                  halved the one before, S with half of the compression of springs is tried first, and with
 *                  a callback after two such the whole matrix before that
 * For springs S is the Hessian, made positive spring by spring, of the potential whose least value is the
 * step where damping is gamma (r - r_old)/a along each spring (Liu and others 2013; Teran and others 2005),
 * so every dv leads downhill. The residual F is the true one throughout.
 *
 * An overdamped system has M = gamma, no g and no D, and its stage is gamma v' = f(t, q'): the same with
 * M v' = f in place of the second equation. In F, b = 1 stands for a, and 0 for `speed`; the matrix is
 * M - a K. Velocities are f/gamma at the beginning of a stage, and after a step.
 *
 * Rigid bodies add unknowns of their own (body_stage.h).
 *
 * Iterations end where the error of v', in the norm of S, is below `newton_tolerance` times the error that
 * the step makes itself. A stage that is not solved is a step that is split in two. */
#pragma once

#include "integrate/solve/body_stage.h"
#include "integrate/solve/descent.h"
#include "integrate/solve/reduced.h"

struct hk_equations {
  double t, a;
  const double *place, *speed; /* 3n each, x y z apart; behind `speed` own coordinates of bodies */
  double length; /* of the step from where the stage begins, for its error, of the order of the method */
};

/* The integrator's `own`. */
struct hk_stage {
  int32_t one_iteration, order, overdamped;
  double tolerance;
  struct hk_reduced reduced;
  struct hk_equations at;
  struct hk_body_stage body; /* what bodies add */
  struct hk_descent descent; /* of an overdamped system */
  int32_t descends;          /* 1: every correction must lower the potential */
  int32_t raised;            /* 1: the last part would have raised it */
  int64_t state_size;        /* numbers of a state: q and v, 6 components of n, and those of bodies */
  int64_t size;              /* numbers of velocities, 3n and those of bodies */
  double *start; /* the state at the start of the part of a step that is taken; begins all blocks */
  double *begin; /* of the motion where the stage begins */
  double *old;   /* velocities there */
  double *v, *change, *right, *moved; /* the guess, the correction, -F or a right-hand side, scratch */
  double *straight;                   /* velocities without any change of acceleration since the beginning */
  double *others;                     /* states of the method's own */
};

/* The state of the motion. */
void hk_stage_save(const struct hk_stage *stage, double *state);

/* Solves the stage from where the motion is, and leaves the motion at its solution. The caller has driven
 * held particles to `t`. After a failure the motion is anywhere: HOOKE_SOLVER_FAILED, or HOOKE_STOPPED by a
 * callback. */
int32_t hk_stage_solve(struct hk_stage *stage, const struct hk_equations *equations);

/* The same with another first solution, in `v` and the motion. A wrong one is not accepted (descent.h). */
typedef int32_t hk_first_solution(struct hk_stage *stage);
int32_t hk_stage_solve_by(struct hk_stage *stage, const struct hk_equations *equations,
                          hk_first_solution *first);

/* Downhill all the way from the state of rest where the motion is; only where there is a potential, and
 * without bodies. After a failure the motion is as far down as it came. */
int32_t hk_stage_descend(struct hk_stage *stage, const struct hk_equations *equations);
