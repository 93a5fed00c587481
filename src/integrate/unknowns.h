/* The problem as y' = phi(t, y), for methods that know nothing of particles: y = (q, v) of the free particles in rows
 * of x y z, or x of a first-order problem. Where nothing is free y is one number that stays 0, because solvers take no
 * empty vector. */
#ifndef HOOKE_INTEGRATE_UNKNOWNS_H
#define HOOKE_INTEGRATE_UNKNOWNS_H

#include "integrate/integrator.h"

struct hooke_unknowns {
  int64_t size; /* numbers in y */
  int64_t free_count;
  int32_t *free; /* free particles, NULL if all are */
  double *rows;  /* q, v, dq, dv, out in rows of all particles, for products with the derivative; or NULL */
};

/* What the functions below answer, as solvers understand it: a failure to recover from by a smaller step, or one that
 * ends the run because a callback asked for it. */
enum { HOOKE_SLOPE_FINE = 0, HOOKE_SLOPE_NOT_FINITE = 1, HOOKE_SLOPE_STOPPED = -1 };

/* `products`: 1 if products with the derivative will be asked for. HOOKE_NO_MEMORY. */
int32_t hooke_unknowns_create(hooke_integrator *integrator, int32_t products,
                              struct hooke_unknowns *unknowns);
void hooke_unknowns_release(struct hooke_unknowns *unknowns);

/* The absolute tolerance of each unknown, from atol and atol_velocity. */
void hooke_unknowns_tolerance(const hooke_integrator *integrator, const struct hooke_unknowns *unknowns,
                              double *tolerance);

/* From a state, and to one at time t: a drive may stop the run. */
void hooke_unknowns_load(hooke_integrator *integrator, const struct hooke_unknowns *unknowns,
                         const hooke_state *state, double *y);
int32_t hooke_unknowns_store(hooke_integrator *integrator, const struct hooke_unknowns *unknowns, double t,
                             const double *y, hooke_state *state);

/* slope = phi(t, y), counted. */
int hooke_unknowns_slope(hooke_integrator *integrator, const struct hooke_unknowns *unknowns, double t,
                         const double *y, double *slope);

/* Sets the point at which products of a second-order problem are taken; then product = (d phi/d y) direction there. */
int hooke_unknowns_linearise(hooke_integrator *integrator, const struct hooke_unknowns *unknowns, double t,
                             const double *y);
int hooke_unknowns_product(hooke_integrator *integrator, const struct hooke_unknowns *unknowns, double t,
                           const double *direction, double *product);

#endif
