/* The loop that multiplies the derivative of spring forces by a change (dq, dv) of positions and velocities.
 *
 * To the parenthesis, for a spring from i to j of length r and tension T, with d = x_i - x_j, e = v_i - v_j,
 * y = dq_i - dq_j and z = dv_i - dv_j, u = (1/r) d and rate = ((ex*dx + ey*dy) + ez*dz)*(1/r):
 *   c = kappa u + (gamma (e - rate u))/r     p = c.y + gamma (u.z)     b = p u + (T/r) (y - (u.y) u)
 *   out_i -= b     out_j += b
 * b = 0 where the spring is slack; where r = 0, too, unless the rest length is 0: b = kappa y. */
#pragma once

struct hk_run;

/* Rows x y z of particles. */
struct hk_derivative_rows {
  const double *q, *v, *dq, *dv;
  double *out;
};

/* Adds the springs of a run to each particle in ascending number. */
typedef void hk_derivative_loop(const struct hk_run *run, const struct hk_derivative_rows *rows);
