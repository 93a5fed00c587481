/* Altitude springs: groups of tetrahedra while a system is built, and all of them in one array from commit
 * on. */
#ifndef HOOKE_MODEL_FORCE_ALTITUDE_H
#define HOOKE_MODEL_FORCE_ALTITUDE_H

#include "core/option.h"
#include "kernel/altitude_loops.h"

struct hooke_system;
struct hk_altitudes;

int32_t hk_altitude_options_create(hooke_options **options);

struct hk_altitude_group {
  char *name;
  int64_t count; /* from commit on without tetrahedra that have neither stiffness nor damping */
  int32_t from_part;
  int64_t part;                       /* of those from parts: which */
  struct hk_tetrahedron *tetrahedron; /* count; NULL from commit on */
};

/* All tetrahedra of a committed system, in their order. */
struct hk_altitudes {
  int64_t count;
  int32_t damped;
  struct hk_tetrahedron *tetrahedron;
};

/* A tetrahedron at given positions and velocities (rows; v may be NULL), its altitude and what that does. */
struct hk_tautness {
  struct hk_altitude altitude;
  double rate, tension, elastic;
  int32_t slack; /* pulls only, and has nothing to pull */
};
/* 0 if no altitude acts, as where all particles are in a line. */
int32_t hk_tautness_find(const struct hk_tetrahedron *tetrahedron, const double *q, const double *v,
                         struct hk_tautness *tautness);

/* Its change under dq and dv: of u, the weights and the tension. */
struct hk_tautness_change {
  double u[3], weight[4], tension;
};
void hk_tautness_differentiate(const struct hk_tetrahedron *tetrahedron, const struct hk_tautness *tautness,
                               const double *q, const double *v, const double *dq, const double *dv,
                               struct hk_tautness_change *change);

/* What altitude springs add to a matrix in the directions they act in: size (g g^T) (u u^T). Zeros where none
 * acts. */
struct hk_altitude_tangent {
  int32_t particle[4];
  double size, u[3], weight[4];
};
/* One for each tetrahedron, of size (alpha ks + beta kd)/l; x, y and z apart. */
void hk_altitude_tangents(const struct hk_altitudes *altitudes, const double *const q[3],
                          const double *const v[3], double alpha, double beta,
                          struct hk_altitude_tangent *tangent);
/* u.(sum of g_j x_j) */
double hk_altitude_tangent_along(const struct hk_altitude_tangent *tangent, const double *const x[3]);
/* out += the matrix times x. */
void hk_altitude_tangent_add(int64_t count, const struct hk_altitude_tangent *tangent,
                             const double *const x[3], double *const out[3]);
/* Its blocks on the diagonal: xx, yy, zz, xy, xz, yz. */
void hk_altitude_tangent_diagonal(int64_t count, const struct hk_altitude_tangent *tangent,
                                  double *const block[6]);

/* A tetrahedron at q as small displacements from rest see it: stiffness and damping along its altitude, those
 * that only pull being taut, and what tension does to the stiffness left out. The tangent has size 0. 0 if no
 * altitude acts. */
struct hk_altitude_view {
  struct hk_altitude_tangent tangent;
  int32_t choice;
  double kappa, gamma, length, tension;
};
int32_t hk_altitude_see(const struct hk_tetrahedron *tetrahedron, const double *q,
                        struct hk_altitude_view *view);

/* 1 if a corner is not held. */
int32_t hk_tetrahedron_moves(const struct hooke_system *system, const struct hk_tetrahedron *tetrahedron);

/* ks/l and kd/l of the altitude that is shortest at rest: the largest that there are. */
double hk_tetrahedron_kappa(const struct hk_tetrahedron *tetrahedron);
double hk_tetrahedron_gamma(const struct hk_tetrahedron *tetrahedron);

/* Particle j's row of g g^T, summed in size over the particles that are not held: the diagonal matrix of
 * these is at least g g^T. */
double hk_altitude_row(const struct hooke_system *system, const int32_t particle[4], const double weight[4],
                       int j);

/* Rest lengths and the side of a tetrahedron with corners x, rest lengths times `scale`. HOOKE_BAD_VALUE,
 * said of the particles that it has, if it is flat. */
int32_t hk_tetrahedron_rest(const double x[4][3], double scale, struct hk_tetrahedron *tetrahedron);

/* Adds tetrahedra as they are: particles, rest lengths and all. `name` may be NULL. HOOKE_BAD_VALUE for
 * particles that do not exist or are named twice. */
int32_t hk_system_add_tetrahedra(struct hooke_system *system, const char *name, int32_t from_part,
                                 int64_t count, const struct hk_tetrahedron *tetrahedron);

/* Takes over what acts of the groups. HOOKE_NO_MEMORY leaves `altitudes` empty. */
int32_t hk_altitudes_create(const struct hk_altitude_group *group, int64_t group_count,
                            struct hk_altitudes *altitudes);
void hk_altitudes_release(struct hk_altitudes *altitudes);
int64_t hk_altitudes_memory(const struct hk_altitudes *altitudes);

/* Frees what only building needed: all of a group but its name and its count, which is of what acts from now
 * on. */
void hk_altitude_group_strip(struct hk_altitude_group *group);
void hk_altitude_group_release(struct hk_altitude_group *group);

#endif
