/* Solutions of y' = f(t, y) to nearly all digits of long double, by a method that the library does not have:
 * the modified midpoint rule with 2, 4, 6, ... substeps, extrapolated to zero substep (Gragg, Bulirsch and
 * Stoer), with step and order chosen by the error of each step. */
#pragma once

#include <stdint.h>

struct extrapolation {
  int64_t size;
  /* Writes f(t, y); if y is prescribed, it first sets it. */
  void (*rate)(long double t, long double *y, long double *f, void *ctx);
  /* Writes the error scale of each component. */
  void (*scale)(const long double *y, const long double *f, long double *scale, void *ctx);
  void *ctx;
  long double tolerance;    /* of each step, in these scales */
  int64_t most_evaluations; /* maximum number of evaluations */
  /* written */
  int64_t evaluations, steps, rejected;
};

/* From y at t to y at `end`; `step` [s] is the first step tried, then the suggested next one. Returns 0, or
 * -1 if the evaluations are used up or steps have shrunk to nothing. */
int32_t extrapolate(struct extrapolation *problem, long double t, long double end, long double *step,
                    long double *y);
