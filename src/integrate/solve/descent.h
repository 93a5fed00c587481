/* What tells the right solution of an overdamped stage from a wrong one. With U the energy of the scene, F is
 * the gradient, by q' and times a, of
 *   P(q') = U(q') + gamma |q' - place|^2/(2 a)
 * over the free particles, with held ones where the stage has them. Where springs push, P has several places
 * of no gradient. A solution is right where P is no higher than where the stage begins, free particles at
 * their old places and held ones at their new ones. Then
 *   backward Euler     has U' + gamma |q' - q|^2/(2 h) <= U: energy falls, as it does in the motion itself;
 *   implicit midpoint  likewise to the middle of the step;
 *   the trapezoidal rule, with place = q - a grad U/gamma, has at both ends P = U + a |grad U|^2/(2 gamma),
 *                      which also falls in the motion wherever U is convex;
 *   the difference     has U no higher than at its start q_c, but for gamma |d (q_c - q)|^2/(2 a).
 * Over a whole step without drives U itself must not rise, which the last three do not imply. Where U is
 * convex there is one solution, and it passes all of this.
 *
 * There is no P with a callback or a wind, nor with altitude springs, whose energy jumps.
 *
 * In a system with inertia and from rest, backward Euler without damping is the same with M |q' - q|^2/(2
 * h^2): the search for a position of rest descends so (measure/rest). */
#pragma once

#include "integrate/integrator.h"

struct hk_descent {
  double *rows;         /* positions whose energy is known, as rows of x y z; NULL: the stage has no P */
  double t, known;      /* the time whose U is meant, that of the equations; and that of the energy below */
  double energy, slack; /* of these, and what rounding may make of it [J] */
  double stiffness, weight, drag; /* sums over the scene, for the slack */
};

/* Its memory is counted as the method's. HOOKE_NO_MEMORY. */
int32_t hk_descent_create(hooke_integrator *integrator, struct hk_descent *descent);
void hk_descent_release(struct hk_descent *descent);

/* U where the motion is, with its slack. */
double hk_descent_energy(struct hk_descent *descent, const hooke_integrator *integrator);
/* P there, for q' = place + a v, with its slack. */
double hk_descent_potential(struct hk_descent *descent, const hooke_integrator *integrator, double a,
                            const double *v, double *slack);
