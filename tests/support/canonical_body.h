/* The steps of systems with rigid bodies as plain loops, which the library reproduces: kicks to the bit,
 * Runge-Kutta methods, explicit and implicit, to rounding. */
#pragma once

#include "canonical.h"

/* What commit finds of a body that moves; not owned. */
struct canonical_body {
  int64_t count;
  const int32_t *particle; /* ascending */
  double mass, inverse_mass;
  const double *inertia, *inverse_inertia; /* 3 each, of the body's axes */
  const double *centre;                    /* of mass or weight, from the point, in these axes */
  double lift;                             /* factor of gravity */
  const double *place;                     /* of each particle, likewise */
  int32_t rank;                            /* 0: one point, 1: points in a line, 2: neither */
  const int32_t *base;                     /* index of the particles a, b, c */
  const double (*triad)[3];                /* e1, e2, e3 of these in the body's axes */
};

/* One step of any fixed-step method; one without a loop here fails the test. */
void canonical_body_step(const struct canonical *canonical, int64_t count, const struct canonical_body *body,
                         const char *method, double t, double end, double h, double *q, double *v);
