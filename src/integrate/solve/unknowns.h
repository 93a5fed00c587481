/* The problem as y' = phi(t, y), for methods that do not know particles: y = (q, v) of the free particles
 * with x, y and z apart, as the working copy of a state has them, then the own coordinates of movers
 * (model/coordinates); or x of a first-order problem. If nothing is free y is one number that stays 0,
 * because solvers accept no empty vector. */
#pragma once

#include "integrate/integrator.h"

/* `count` consecutive free particles that nothing carries; `particle` is the first, `unknown` its number
 * among the free ones. */
struct hk_stretch_of_free {
  int64_t particle, unknown, count;
};

struct hk_unknowns {
  int64_t size;  /* numbers in y */
  int32_t has_v; /* 1: positions, then velocities; 0: of an overdamped system, positions alone */
  int64_t free_count, stretch_count; /* free particles that nothing carries */
  struct hk_stretch_of_free *stretch;
  /* q, v, dq, dv, out in rows of all particles, for products with the derivative; NULL where these are not
   * known, of first-order problems and bodies, or not asked for, and where nothing is free */
  double *rows;
  double *push; /* on every mover (model/coordinates) */
};

/* Results of the functions below, as solvers interpret them: a failure to recover from by a smaller step, or
 * one that ends the run because a callback asked for it. */
enum { HOOKE_SLOPE_FINE = 0, HOOKE_SLOPE_NOT_FINITE = 1, HOOKE_SLOPE_STOPPED = -1 };

/* `products`: 1 if products with the derivative will be needed. HOOKE_NO_MEMORY. */
int32_t hk_unknowns_create(hooke_integrator *integrator, int32_t products, struct hk_unknowns *unknowns);
void hk_unknowns_release(struct hk_unknowns *unknowns);

/* The absolute tolerance of each unknown, from atol and atol_velocity. */
void hk_unknowns_tolerance(const hooke_integrator *integrator, const struct hk_unknowns *unknowns,
                           double *tolerance);

/* From a state, and to one at time t: a drive may stop the run. */
void hk_unknowns_load(hooke_integrator *integrator, const struct hk_unknowns *unknowns,
                      const hooke_state *state, double *y);
int32_t hk_unknowns_store(hooke_integrator *integrator, const struct hk_unknowns *unknowns, double t,
                          const double *y, hooke_state *state);

/* Three components of the free particles (3 free_count) from and to those of all, a stride apart; others are
 * unchanged. */
void hk_unknowns_gather(const struct hk_unknowns *unknowns, const double *all, ptrdiff_t stride,
                        double *some);
void hk_unknowns_spread(const struct hk_unknowns *unknowns, const double *some, double *all,
                        ptrdiff_t stride);

/* Loads y and the constrained particles of time t into the working copy; returns a status. */
int32_t hk_unknowns_place(hooke_integrator *integrator, const struct hk_unknowns *unknowns, double t,
                          const double *y);

/* slope = phi(t, y), counted. */
int hk_unknowns_slope(hooke_integrator *integrator, const struct hk_unknowns *unknowns, double t,
                      const double *y, double *slope);

/* Sets the point for products of a second-order problem; then product = (d phi/d y) direction there. */
int hk_unknowns_linearise(hooke_integrator *integrator, const struct hk_unknowns *unknowns, double t,
                          const double *y);
int hk_unknowns_product(hooke_integrator *integrator, struct hk_unknowns *unknowns, double t,
                        const double *direction, double *product);
