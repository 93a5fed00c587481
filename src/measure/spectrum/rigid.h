/* Movers (model/coordinates) in a linearised system, rigid bodies in the first place. Displacements are those
 * of all particles still, restricted to motions x = J y of each body, where y are the motions of its point
 * and about its axes, times the roots of mass and inertia, so that J^T M J = I: K, C and M of particles give
 * those of bodies by the restriction. What it leaves out is that forces at rest turn with the arms of a body,
 * the geometric stiffness (model/body_tangent.h): of gravity and tensions, callbacks left out. It is made
 * symmetric, which it is by itself in equilibrium, and what would tip a body over, like the transverse
 * stiffness of compressed springs, counts as 0. Components are `stride` apart. */
#pragma once

#include "model/coordinates/body_tangent.h"

struct hk_rigid {
  struct hk_body_tangents tangents; /* `geometric` is that of y [1/s^2], symmetric, without what tips over */
  double stiffest;                  /* largest eigenvalue of geometric stiffness over inertia [1/s^2] */
  int64_t tipping;                  /* bodies of which something was left out */
};

/* At rest at positions q (3n), with factors on the stiffness of springs, one each, that may be NULL; all
 * zeros without bodies. HOOKE_NO_MEMORY. */
int32_t hk_rigid_create(const hooke_system *system, const double *q, const double *spring_scale,
                        struct hk_rigid *rigid);
void hk_rigid_release(struct hk_rigid *rigid);

/* x becomes the nearest motion in which all bodies are rigid. */
void hk_rigid_project(const struct hk_rigid *rigid, double *const x[3], int64_t stride);
/* f, forces (K x + C v, say) on all particles, becomes masses times the accelerations that they make, after
 * `scale` times the geometric stiffness times x was added. */
void hk_rigid_reduce(const struct hk_rigid *rigid, double scale, const double *const x[3], double *const f[3],
                     int64_t stride);
/* x.Kx of the geometric stiffness. */
double hk_rigid_energy(const struct hk_rigid *rigid, const double *const x[3], int64_t stride);
/* The largest angular velocity of a body [rad/s]. */
double hk_rigid_spin(const struct hk_rigid *rigid, const double *v);

/* Unknowns of all bodies: of each the point's three (none where it is pinned), then one for every axis that
 * it turns about, times the roots of mass and inertia. */
int64_t hk_rigid_unknowns(const struct hk_rigid *rigid);
void hk_rigid_pack(const struct hk_rigid *rigid, const double *const x[3], int64_t stride, double *unknown);
void hk_rigid_unpack(const struct hk_rigid *rigid, const double *unknown, double *const x[3], int64_t stride);
