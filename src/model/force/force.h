/* The table of forces: one row each, in the order in which they are summed at a particle. A new force is one
 * file (force_*.c) and one row in force.c. */
#ifndef HOOKE_MODEL_FORCE_FORCE_H
#define HOOKE_MODEL_FORCE_FORCE_H

#include "model/sum/motion.h"
#include "model/sum/pattern.h"

/* A state in rows of x y z, with a displacement of it for derivatives. */
struct hk_point {
  double t;
  const double *q, *v, *dq, *dv;
  int32_t *stop_value; /* receives what a callback that stopped returned */
};

/* Everything but `name` and `present` may be NULL: the force then has no such part. */
struct hk_force_row {
  const char *name;
  int32_t (*present)(const hooke_system *system);
  /* f += force, on the working copy; HOOKE_STOPPED if a callback asked for it */
  int32_t (*add)(const hooke_system *system, struct hk_motion *motion, double t);
  /* potential energy [J], and power turned into heat [W] */
  double (*energy)(const hooke_system *system, const double *q);
  double (*heat)(const hooke_system *system, const double *q, const double *v);
  /* out += (df/dq) dq + (df/dv) dv */
  int32_t (*add_product)(const hooke_system *system, const struct hk_point *point, double *out);
  /* adds df/dq and df/dv to 3x3 blocks; either may be NULL */
  void (*add_blocks)(const hooke_system *system, const double *q, const double *v,
                     const struct hk_pattern *pattern, double *dfdq, double *dfdv);
};

extern const struct hk_force_row hk_force_springs, hk_force_bending, hk_force_altitude, hk_force_drag,
    hk_force_callback, hk_force_gravity;

/* out = (df/dq) dq + (df/dv) dv of the forces that a committed system has, but for those that `left_out`
 * (NULL: none) says. HOOKE_STOPPED, with the point's stop value, if a callback asked for it. */
int32_t hk_forces_product(const hooke_system *system, const struct hk_point *point,
                          int (*left_out)(const struct hk_force_row *row), double *out);

/* Row `k` of the table, NULL past the last. */
const struct hk_force_row *hk_force_table(int32_t k);

#endif
