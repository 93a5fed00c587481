/* Solutions of y' = f(t, y) to nearly all digits of long double, by a method that the library does not have:
 * the modified midpoint rule with 2, 4, 6, ... substeps, extrapolated to substeps of no length (Gragg,
 * Bulirsch and Stoer), with step and order by the error of each step. */
#ifndef TESTS_SUPPORT_EXTRAPOLATION_H
#define TESTS_SUPPORT_EXTRAPOLATION_H

#include <stdint.h>

struct extrapolation {
  int64_t size;
  /* Writes f(t, y), and where y is prescribed puts it in its place first. */
  void (*rate)(long double t, long double *y, long double *f, void *ctx);
  /* Writes what an error of each component is measured by. */
  void (*scale)(const long double *y, const long double *f, long double *scale, void *ctx);
  void *ctx;
  long double tolerance;    /* of each step, in these scales */
  int64_t most_evaluations; /* where it gives up */
  /* written */
  int64_t evaluations, steps, rejected;
};

/* From y at t to y at `end`; `step` [s] is the first one tried, then the one to go on with. 0, or -1 where
 * the evaluations are spent or steps have shrunk to nothing. */
int32_t extrapolate(struct extrapolation *problem, long double t, long double end, long double *step,
                    long double *y);

#endif
