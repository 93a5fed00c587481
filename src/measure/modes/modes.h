/* Modes: free small motions about a state at rest, M x'' + C x' + K x = 0 with the signed stiffness of the
 * state (stiffness.h), as those without damping, and what damping does to each. */
#pragma once

#include "measure/measurement.h"
#include "measure/trial/budget.h"
#include "model/force/force.h"

/* Numbers that do not apply are NaN. */
struct hk_mode {
  double omega, frequency; /* [rad/s], [Hz]; of a mode that is pulled back */
  double growth;        /* [1/s]: e-folds of one that is pushed away; in an overdamped scene of every one */
  double damping_ratio; /* x.Cx/(2 omega x.Mx) */
  double mass[3];       /* effective mass, (x.M e)^2/x.Mx along the three axes [kg] */
  double *shape;        /* 3n displacements, rows of x y z; the largest is of length 1 */
  double *share;        /* by part of the stiffness: its x.Kx over the sum of all magnitudes */
};

/* Parts of the stiffness: groups of the system, forces whose members are in none, and what forces do to
 * bodies that turn. */
struct hk_modes_part {
  const char *name;
};

struct hk_modes {
  const hooke_system *system; /* as `at` has it at the time of the state */
  hooke_system at;
  double time, residual,
      largest_force; /* [N]: what is left on a particle or body, and the most in a spring */
  double skew;       /* of the stiffness, see stiffness.h */
  int32_t at_rest;   /* 1: what is left is next to nothing */
  int32_t moves;     /* 1: the state has velocities, which count for damping alone */
  int64_t unknowns;
  /* without stiffness; -1: not all are known. Of those found, connected pieces as rigid bodies. */
  int64_t zero_modes, zeros_found, translations, rotations, mechanisms;
  int64_t count, unstable; /* of `mode`; how many of these grow */
  struct hk_mode *mode;    /* ascending by x.Kx */
  int64_t part_count;
  struct hk_modes_part *part;
  double *block;          /* shapes and shares */
  const double *position; /* of the state (3n) */
};

/* The `count` lowest modes that have stiffness, of a committed system at positions q and velocities v (3n) of
 * time t. The budget (NULL: none) ends it early: HOOKE_STOPPED. HOOKE_NOT_BUILT without LAPACK, and of many
 * unknowns without CHOLMOD; HOOKE_SOLVER_FAILED, HOOKE_NO_MEMORY; HOOKE_BAD_VALUE for what is not finite. To
 * be released in any case. */
int32_t hk_modes_find(const hooke_system *system, double t, const double *q, const double *v, int64_t count,
                      struct hk_budget *budget, struct hk_modes *modes);
void hk_modes_release(struct hk_modes *modes);

extern const struct hk_table hk_modes_tables[];
/* What it says of its results (modes_claims.c). */
void hk_modes_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_measurement_kind hk_modes_kind;
