/* The 3x3 blocks of -alpha df/dq - beta df/dv along springs, kept spring by spring for products.
 *
 * A spring gives B = u e^T + b I to its two ends, in the pattern (B, -B; -B, B), with u its direction and
 *   b = alpha T/r,   e = (alpha kappa + beta gamma - b) u + alpha gamma (v - (v.u) u)/r
 * for the tension T = kappa (r - l0) + gamma v.u; nothing where it is slack or has no direction, and b =
 * alpha kappa, e = 0 where its length and rest length are 0. With alpha = 0 all of it is g g^T, g = sqrt(beta
 * gamma) u. */
#pragma once

#include "kernel/spring/spring_loops.h"

/* By spring number. With alpha = 0, u is g, e is the same arrays, and b is NULL. */
struct hk_tangent {
  double *u[3], *e[3], *b;
};

/* The loops are compiled once for each instruction set; these functions use the best one of the machine. */

/* At the positions and velocities of `fields`. */
void hk_tangent_fill(const struct hk_run *run, const struct hk_fields *fields, double alpha, double beta,
                     const struct hk_tangent *tangent);

/* Springs of a run of constant offset are added in groups of this size, first ends and then second ends;
 * those of other runs one by one. */
enum { HOOKE_TANGENT_BLOCK = 256 };

/* out += the blocks times x; x, y and z apart. */
void hk_tangent_product(const struct hk_run *run, const struct hk_tangent *tangent, const double *const x[3],
                        double *const out[3]);

/* Adds a symmetric, non-negative part of B, (e.u + b) u u^T + max(0, b) (I - u u^T), to the diagonal block of
 * either end: xx, yy, zz, xy, xz, yz. */
void hk_tangent_diagonal(const struct hk_run *run, const struct hk_tangent *tangent, double *const block[6]);

/* Replaces B of the first `count` springs by the part of it that the diagonal has, and this share of b under
 * compression; not with alpha = 0. */
void hk_tangent_project(int64_t count, double share, const struct hk_tangent *tangent);

/* out += damping of springs for velocities x: gamma u (u.x) of those that are not slack. */
void hk_tangent_damping(const struct hk_run *run, const struct hk_tangent *tangent, const double *const x[3],
                        double *const out[3]);

/* The loops of one instruction set, under the names above. */
struct hk_tangent_set {
  void (*tangent_fill)(const struct hk_run *, const struct hk_fields *, double, double,
                       const struct hk_tangent *);
  void (*tangent_product)(const struct hk_run *, const struct hk_tangent *, const double *const[3],
                          double *const[3]);
  void (*tangent_diagonal)(const struct hk_run *, const struct hk_tangent *, double *const[6]);
  void (*tangent_project)(int64_t, double, const struct hk_tangent *);
  void (*tangent_damping)(const struct hk_run *, const struct hk_tangent *, const double *const[3],
                          double *const[3]);
};
