/* Rigid bodies: particles that move as one. A body's own coordinates are 13 numbers (HOOKE_BODY_*): its
 * point, a unit quaternion, the velocity of the point, and the angular momentum about it. The point is the
 * centre of mass or, if particles are pinned, the first pinned one. They are a function of the rows of three
 * of its particles (docs/design.md), so that a state is (t, q, v) with bodies as without. */
#pragma once

#include "model/coordinates/coordinates.h"

/* Places of a body's own coordinates. */
enum {
  HOOKE_BODY_POINT = 0,    /* [m] */
  HOOKE_BODY_TURN = 3,     /* quaternion (real part first) from the body's axes to those of space */
  HOOKE_BODY_VELOCITY = 7, /* of the point [m/s] */
  HOOKE_BODY_SPIN = 10,    /* angular momentum about the point, in the axes of space [kg m^2/s] */
  HOOKE_BODY_NUMBERS = 13
};

struct hk_body {
  char *name;
  int64_t part;    /* of a rigid part: its number; else -1 */
  int32_t project; /* 1: initial velocities become those of the nearest rigid motion */
  int64_t count;
  int32_t *particle; /* ascending from commit on */

  /* from commit on; nothing else is set of a body that does not move by itself */
  int32_t moves;
  double mass, inverse_mass; /* of the free particles; the inverse is 0 if one is pinned */
  double inertia[3]; /* about the axes through the point, ascending; 0: it does not turn about this one */
  double inverse_inertia[3]; /* 0 where `inertia` is */
  /* with factors phi of gravity: the sum of m phi over the mass; and, in the axes of the body, that of m phi
   * r over it, r from the point; without, 1, and the centre of mass, or 0 if that is the point */
  double lift, heavy[3];
  double *place;      /* particles from the point, in the axes of the body, 3 count */
  int32_t rank;       /* 0: a single point, 1: points in a line, 2: neither */
  int32_t base[3];    /* index in `particle` of the three particles of the rule; `rank` + 1 are used */
  double triad[3][3]; /* their directions e1, e2, e3 in the axes of the body */
  /* index in `particle`, ascending, of those three and of all that a force may act on, but for a callback */
  int64_t acted_count;
  int32_t *acted;
};

struct hk_bodies {
  int64_t count, capacity;
  struct hk_body *body;
  int32_t *of; /* from commit on, by particle: its body, or -1; NULL without bodies */
};

/* Adds a body of particles that exist; `part` is the number of a rigid part, or -1. HOOKE_NO_MEMORY. */
int32_t hk_system_add_body(struct hooke_system *system, const char *name, int64_t count,
                           const int64_t *particles, int32_t project, int64_t part);
/* Removes the bodies of parts from number `part` on. */
void hk_system_remove_bodies(struct hooke_system *system, int64_t part);

/* ---- for its row: the motion of one body ---- */

void hk_body_read(const void *body, const double *const q[3], const double *const v[3], int64_t stride,
                  double *own);
void hk_body_write(const struct hooke_system *system, const void *body, const double *own, double *const q[3],
                   double *const v[3], int64_t stride, int32_t only_acted);
void hk_body_push(const struct hooke_system *system, const void *body, const struct hk_motion *motion,
                  const double *own, double *push);
void hk_body_clear(const void *body, double *const f[3]);
void hk_body_kick(const void *body, double h, const double *push, double *own);
/* The free motion over h: order 2, symmetric, symplectic, with the same angular momentum. */
void hk_body_drift(const void *body, double h, double *own);
void hk_body_slope(const void *body, const double *own, const double *push, double *slope);
void hk_body_accelerate(const struct hooke_system *system, const void *body, const double *own,
                        const double *push, double *out);
void hk_body_normalise(double *own);
void hk_body_tolerance(const void *body, double position, double velocity, double *tolerance);

/* ---- for others ---- */

/* Own coordinates from rows of x y z, and its free particles' rows from them. */
void hk_body_read_rows(const struct hk_body *body, const double *q, const double *v, double *own);
void hk_body_write_rows(const struct hooke_system *system, const struct hk_body *body, const double *own,
                        double *q, double *v);
/* The quaternion `turn` = `from` + h (0, w) turn/2: a rotation by the angle 2 atan(h |w|/2) in space. */
void hk_body_turn(const double w[3], double h, const double from[4], double turn[4]);
/* The body's axes in space by its quaternion: m[i][k] is component i of axis k. */
void hk_body_axes(const double turn[4], double m[3][3]);

/* ---- for commit, and the initial velocities (body_frame.c) ---- */

/* Finds mass, inertia, axes and the three particles of the rule; leaves `moves` 0 if it is held or driven.
 * HOOKE_BAD_VALUE for particles that coincide, and if some are driven but not all; HOOKE_NO_MEMORY. */
int32_t hk_body_commit(struct hooke_system *system, struct hk_body *body);
/* Pins all particles of a body that is held still by some of them. */
void hk_body_pin_if_still(struct hooke_system *system, const struct hk_body *body);

/* Sets velocity and angular momentum of own coordinates to those of the initial velocities. */
void hk_body_fit(const struct hooke_system *system, const struct hk_body *body, double *own);

/* Makes a symmetric matrix m diagonal; the rows of `axis` become its eigenvectors. */
void hk_body_diagonalise(double m[3][3], double axis[3][3]);

/* The directions e1, e2, e3 of three points: that of `ab`, that of `ac` perpendicular to it, and
 * their cross product. Of points in a line (rank 1) the second is perpendicular in some way, and rank 0 has
 * the axes of space. */
void hk_body_triad(int32_t rank, const double ab[3], const double ac[3], double e[3][3]);
