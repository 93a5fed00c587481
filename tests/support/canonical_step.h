/* Pieces of the canonical steps that the equations of solved steps are made of, too. */
#pragma once

#include "canonical.h"

static inline double canonical_dot(const double a[3], const double b[3]) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static inline void canonical_cross(const double a[3], const double b[3], double n[3]) {
  n[0] = a[1] * b[2] - a[2] * b[1];
  n[1] = a[2] * b[0] - a[0] * b[2];
  n[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double canonical_wind(const struct canonical *canonical, int a) {
  return canonical->wind ? canonical->wind[a] : 0.0;
}

void canonical_add_loads(const struct canonical *canonical, double t, double *force);
/* Drag of a fluid on segments, then on triangles. */
void canonical_add_pieces(const struct canonical *canonical, const double *q, const double *v, double *force);
/* f = -c w, or -c |w| w. */
void canonical_add_drag(const struct canonical *canonical, const double *each, int squared, const double *v,
                        double *force);
/* Of one particle. */
void canonical_push_out(const struct canonical_obstacle *o, const double *q, const double *v, double *force);

void canonical_accelerate(const struct canonical *canonical, double t, const double *q, const double *v,
                          const double *seen, double *acceleration);

void canonical_place(const struct canonical *canonical, double t, double *q, double *v);

int canonical_is_free(const struct canonical *canonical, int64_t k);

void canonical_predict(const struct canonical *canonical, double t, double end, double h, double *q,
                       double *v, double *half, double *a);
