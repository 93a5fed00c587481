/* The definition of the sums that every path of the library reproduces to the bit.
 *
 * Forces on a particle are added in this order: its springs in ascending spring number (added to the first
 * end, subtracted from the second), triples of bending in ascending number, tetrahedra of altitude springs
 * likewise, anchors likewise, obstacles in order, segments in a fluid, triangles in a fluid, drag, quadratic
 * drag, loads in ascending number, the callback. The acceleration is w f, then gravity is added to it, or its
 * product with a factor of the particle. Particles that are constrained (pinned or driven) have none. */
#pragma once

#include "hooke/system.h"

/* Springs of groups whose name has the word "follows" in it follow time, by tables of two samples each, which
 * are straight lines as far as rounding goes; those with "strain" in it by the strain law. The options of
 * such a group, or of a family of a part ("stretch."), are set by canonical_follow(). */
enum { CANONICAL_FOLLOWS = 1, CANONICAL_BY_STRAIN = 2 };
void canonical_follow(hooke_options *options, const char *family);

/* A plane (0), a sphere (1) or a cylinder (2) that pushes out all free particles; axis: the unit normal, or
 * axis. */
struct canonical_obstacle {
  int shape;
  double point[3], axis[3], radius, stiffness, damping, friction, friction_speed, clearance;
};

struct canonical {
  int64_t particle_count, spring_count;
  int64_t *ends;                       /* 2 spring_count */
  double *kappa, *gamma, *rest_length; /* spring_count */
  int32_t leaves_out;                  /* 1: skips dampings of zero, which are multiplied otherwise */
  unsigned char *pull_only;            /* spring_count */
  unsigned char *follows;              /* spring_count: CANONICAL_FOLLOWS and so on; 0: it does not */
  int64_t triple_count;
  int64_t *triples;    /* 3 triple_count */
  double *coefficient; /* triple_count */
  int64_t tetrahedron_count;
  int64_t *corners;                  /* 4 tetrahedron_count */
  double *altitude[3];               /* stiffness, damping; 7 rest lengths, with a sign */
  unsigned char *altitude_pull_only; /* tetrahedron_count */
  int64_t anchor_count;
  int64_t *anchored;    /* anchor_count: the particle of each */
  double *anchor_point; /* 3 anchor_count */
  double *anchor[3];    /* stiffness, damping and rest length */
  int64_t obstacle_count;
  const struct canonical_obstacle *obstacle; /* the caller's */
  int64_t load_count;
  int64_t *loaded;           /* load_count: the particle of each */
  const hooke_system *loads; /* of load_count particles, each with the load of that number; NULL: none */
  double *inverse_mass;      /* particle_count */
  const double *gravity;     /* NULL: none */
  const double *factor;      /* of gravity, particle_count; NULL: 1 */
  double drag;               /* 0: none */
  /* particle_count, or NULL: drag of each particle, in place of the number where there is a wind (NULL: none)
   */
  const double *drags, *quadratic, *wind;
  int64_t piece_count;         /* in a fluid; a segment repeats its second particle */
  int64_t *pieces;             /* 3 piece_count */
  double *normal, *tangential; /* piece_count */
  hooke_force *force;          /* NULL: none */
  void *ctx;
  /* moves driven particles to their positions at time t; NULL: there are none */
  void (*place)(double t, double *q, double *v, void *place_ctx);
  void *place_ctx;
};

/* Gravity's share of component k of the accelerations. */
static inline double canonical_fall(const struct canonical *canonical, int64_t k) {
  const double g = canonical->gravity ? canonical->gravity[k % 3] : 0.0;
  return canonical->factor ? canonical->factor[k / 3] * g : g;
}

/* Copies the numbers of a committed system. Springs of groups whose name begins with "pull" only pull; the
 * caller fills in gravity, drag of all kinds, wind and callback. */
void canonical_create(const hooke_system *system, struct canonical *canonical);
void canonical_destroy(struct canonical *canonical);
/* Destroyed where its block ends. */
#define owned_canonical __attribute__((cleanup(canonical_destroy))) struct canonical

/* A = n.n of the seven altitudes of a tetrahedron with these corners, each of three numbers: six times the
 * volume over the root of A is the altitude. */
void canonical_altitudes(const double *const x[4], double square[7]);

/* Accelerations, 3 particle_count. */
void canonical_acceleration(const struct canonical *canonical, double t, const double *q, const double *v,
                            double *acceleration);

/* One step of a fixed-step method from time t to `end`, of length h up to rounding; pinned particles stay. */
enum { CANONICAL_UNKNOWN, CANONICAL_STEPPED, CANONICAL_SOLVED };
/* CANONICAL_UNKNOWN for a method without a definition here; CANONICAL_SOLVED, with q and v unchanged, for an
 * implicit one. */
int32_t canonical_step(const struct canonical *canonical, const char *method, double t, double end, double h,
                       double *q, double *v);

/* The step [s] up to which damping may be explicit in Verlet, wherever the particles are: h^2 K + 2 h C <= 4,
 * with rows of every spring, triple and anchor taken in the direction in which it does most. */
double canonical_explicit_bound(const struct canonical *canonical);

/* How far such a step from q0, v0 to q1, v1 is from solving its equations, over what is allowed, and what a
 * few roundings of the numbers in the equations make of it. Of Verlet the defects of all, 1e-3 of what the
 * predicted velocity leaves, times how large that is beside the kick; of the midpoint rule the defects of
 * all, 1e-9 of the change of all; of the others the largest defect of a velocity, 1e-9 of the largest change
 * of one. Infinity unless positions follow from the velocities to the bit, or, where they go through those of
 * stages, but for a few roundings. */
double canonical_defect(const struct canonical *canonical, const char *method, double t, double end, double h,
                        const double *q0, const double *v0, const double *q1, const double *v1);
