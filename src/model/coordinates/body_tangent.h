/* Small motions of movers (coordinates.h) about a state, and of rigid bodies among them. A motion of a body
 * is `move`, of its point [m], and `turn`, about the point in the axes of space [rad]; it displaces the
 * body's free particles by move + turn x arm (spread), and forces on these act as force and torque (gather).
 * Where forces f act at the state, a turn takes their arms along: the torque changes by sum (turn x arm) x f
 * = -geometric turn, too. Components are `stride` apart. */
#pragma once

#include "model/coordinates/body.h"
#include "model/particles.h"

struct hk_body_tangent {
  const struct hk_mover *mover;
  const struct hk_body *body; /* NULL, and nothing below is set: the mover is no body */
  double axes[3][3];          /* [i][k]: component i, in space, of axis k of the body */
  double *arm;                /* from the point to each particle of the body, in the axes of space, 3 count */
  double geometric[3]
                  [3]; /* [N m], of the last hk_body_tangents_stiffen(); 0 before. Symmetric in equilibrium */
};

struct hk_body_tangents {
  const struct hooke_system *system;
  int64_t count; /* movers */
  struct hk_body_tangent *body;
  double *arms;
};

/* At the rows q (3n). HOOKE_NO_MEMORY, with nothing to release. */
int32_t hk_body_tangents_create(const struct hooke_system *system, const double *q,
                                struct hk_body_tangents *tangents);
void hk_body_tangents_release(struct hk_body_tangents *tangents);
/* The same at other rows, in the existing memory; `geometric` becomes 0. */
void hk_body_tangents_set(struct hk_body_tangents *tangents, const double *q);
/* Finds `geometric` of forces on all particles, gravity among them (hooke_system_force()). */
void hk_body_tangents_stiffen(struct hk_body_tangents *tangents, const double *const force[3],
                              int64_t stride);

/* Displacements of the free particles of a body; other rows are unchanged. */
void hk_body_spread(const struct hooke_system *system, const struct hk_body_tangent *tangent,
                    const double move[3], const double turn[3], double *const to[3], int64_t stride);
/* Sum of `from` over the free particles, and of its moments about the point, each times the particle's weight
 * (NULL: 1). */
void hk_body_gather(const struct hooke_system *system, const struct hk_body_tangent *tangent,
                    const double *weight, const double *const from[3], int64_t stride, double sum[3],
                    double moment[3]);
/* torque -= scale geometric turn */
void hk_body_turn_forces(const struct hk_body_tangent *tangent, double scale, const double turn[3],
                         double torque[3]);

/* For its row: motions y, those of its point and about its axes, times the roots of mass and inertia. */
void hk_body_spread_unit(const struct hooke_system *system, const struct hk_body_tangent *tangent,
                         const double *y, double *const x[3], int64_t stride);
void hk_body_gather_unit(const struct hooke_system *system, const struct hk_body_tangent *tangent,
                         const double *weight, const double *const x[3], int64_t stride, double *y);
int32_t hk_body_has(const void *body, int k);
double hk_body_reach(const struct hk_body_tangent *tangent, int64_t particle);
/* The rows of `axis` are the body's axes in space over the roots of their inertia, 0 where that is 0. */
void hk_body_unit_axes(const struct hk_body_tangent *tangent, double axis[3][3]);
