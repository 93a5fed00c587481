/* What rigid bodies add to the stage of an implicit step (stage.h). Behind the velocities of particles,
 * which are 0 for those of bodies, each body has 6 unknowns: the velocity u of its point, and z with p = J0
 * z for its moment of inertia J0 where the stage begins; behind the q and v of a state are its own
 * coordinates (model/body.h). From X, Q, V and L its stage goes to
 *   X' = X + a u,  Q' = Q + a (0, w) Q'/2,  m (u - V) = a F,  p = P (L + a T),  J w = p
 * with force F and torque T there, gravity included, and its moment of inertia J and the projection P on the
 * axes that it turns about in the position X', Q'. About other axes J has a moment of its own, so that w has
 * no component there. Q' follows from w by a rotation in Cayley form, and w from p body by body, down to
 * rounding: so a free body keeps its angular momentum whatever the tolerance.
 *
 * The whole matrix is the derivative of all this. S is T^T S T of the particles' S, with the displacements
 * T of the particles of bodies and with J0 as inertia: changes of arms and axes are left out. */
#pragma once

#include "integrate/integrator.h"
#include "integrate/solve/reduced.h"
#include "model/coordinates/body_tangent.h"

struct hk_stage;

enum { HOOKE_BODY_VELOCITIES = 6 };

struct hk_body_rotation {
  double begin[3][3];   /* axes where the stage begins */
  double w[3];          /* of the motion */
  double inverse[3][3]; /* dw/dp there */
  double spin[3];       /* L + a T, where the matrix was last set */
};

struct hk_body_stage {
  int64_t count;                    /* bodies that move; 0: nothing else is there */
  struct hk_body_tangents tangents; /* by which the matrix was last set */
  struct hk_body_rotation *rotation;
  double *own;          /* own coordinates of the motion, 13 each; begins the block of all */
  double *push;         /* force and torque on each, with gravity */
  double *factor;       /* 6 x 6 lower triangles of the diagonal blocks of S, 36 each */
  double *dq, *dv, *df; /* of particles, 3n each */
};

/* HOOKE_UNSUITED for `linear_solver` direct, HOOKE_NO_MEMORY. */
int32_t hk_body_stage_create(hooke_integrator *integrator, struct hk_body_stage *body);
void hk_body_stage_release(struct hk_body_stage *body);

/* Own coordinates and rows at velocities v. */
void hk_body_stage_place(struct hk_stage *stage, const double *v);
/* Unit quaternions, and rows, at the end of a step. */
void hk_body_stage_end(struct hk_stage *stage);
/* Velocities where the stage begins, into `old`. */
void hk_body_stage_begin(struct hk_stage *stage);
/* The bodies' part of `right`, from the forces of the motion. */
void hk_body_stage_residual(struct hk_stage *stage, const double *v);

/* The bodies' part of linearise(), where the change of the forces is in `moved`, and their own change is in
 * arms and axes: `right` and `straight`. */
void hk_body_stage_linearise(struct hk_stage *stage);

/* The part of the square of a distance. */
double hk_body_stage_distance(const struct hk_stage *stage, const double *from);

/* out = y + a y' of own coordinates y, by the forces of the motion; and on from the middle of a
 * step to its end. */
void hk_body_stage_explicit(struct hk_stage *stage, double a, double *out);
void hk_body_stage_go_on(struct hk_stage *stage);

/* ---- body_matrix.c ---- */

/* Arms and axes of the matrix are from here on those of the motion. */
void hk_body_stage_aim(struct hk_stage *stage);
/* The matrix, after that of the particles; force and torque into `push`. */
void hk_body_stage_set(struct hk_stage *stage);
/* The unknowns of bodies in the linear equations. */
struct hk_more_unknowns hk_body_stage_unknowns(struct hk_stage *stage);
/* Force and torque of f, which is of particles, on body k. */
void hk_body_stage_gather(const struct hk_stage *stage, int64_t k, const double *f, double push[6]);
/* Sets 0 for particles of bodies, 3 components of n. */
void hk_body_stage_clear(const struct hk_stage *stage, double *x);
/* p = J0 z */
void hk_body_momentum(const struct hk_stage *stage, int64_t k, const double z[3], double p[3]);
/* The turn by a change of w, for a rotation in Cayley form over h. */
void hk_body_turn_by(const double w[3], double h, const double change[3], double turn[3]);
/* Moments of inertia, where those of axes that the body does not turn about are replaced. */
void hk_body_moments(const struct hk_body *body, double moment[3]);
/* out = the sum over the axes e of weight e (e.x). */
void hk_body_weigh(const double axes[3][3], const double weight[3], const double x[3], double out[3]);
/* out = P x, which lies in the axes that the body turns about. */
void hk_body_project(const struct hk_body *body, const double axes[3][3], const double x[3], double out[3]);
