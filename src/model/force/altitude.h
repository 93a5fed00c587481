/* Altitude springs: their tetrahedra, in one array from commit on. */
#pragma once

#include "core/table/option.h"
#include "kernel/altitude_loops.h"
#include "model/group.h"

extern const struct hk_option_table hk_altitude_options;

struct hooke_system;

/* All tetrahedra of a committed system, in their order. */
struct hk_altitudes {
  int64_t count;
  int32_t damped;
  struct hk_tetrahedron *tetrahedron;
};

/* A tetrahedron at given positions and velocities (rows; v may be NULL), with its altitude and force. */
struct hk_tautness {
  struct hk_altitude altitude;
  double rate, tension, elastic;
  int32_t slack; /* pulls only, and is slack */
};
/* 0 if no altitude acts, such as where all particles are in a line. */
int32_t hk_tautness_find(const struct hk_tetrahedron *tetrahedron, const double *q, const double *v,
                         struct hk_tautness *tautness);

/* Rest lengths and orientation of a tetrahedron with corners x, rest lengths times `scale`. HOOKE_BAD_VALUE,
 * with the particles, if it is flat. */
int32_t hk_tetrahedron_rest(const double x[4][3], double scale, struct hk_tetrahedron *tetrahedron);

/* For builders: adds `count` tetrahedra of a part, number k of the particles first + k to first + k + 3, and
 * else as kind[k % 2]. */
int32_t hk_system_add_tetrahedra(struct hooke_system *system, const char *name, int64_t count, int64_t first,
                                 const struct hk_tetrahedron kind[2]);
