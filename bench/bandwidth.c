#include "bandwidth.h"

#include <stddef.h>
#include <stdlib.h>
#include <time.h>

enum { ELEMENTS = 1 << 24, SWEEPS = 8 };

double bench_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double bandwidth_measure(void) {
  double *a = malloc(3 * (size_t)ELEMENTS * sizeof *a), best = 0.0;
  if (a == NULL) return 0.0;
  double *b = a + ELEMENTS, *c = b + ELEMENTS;
  for (size_t k = 0; k < 3 * (size_t)ELEMENTS; k++)
    a[k] = 1.0 + (double)(k % 7);
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    const double begun = bench_seconds(), s = 1.0 + 0.001 * sweep;
    for (size_t k = 0; k < ELEMENTS; k++)
      a[k] = b[k] + s * c[k];
    const double rate = 24.0 * ELEMENTS / (bench_seconds() - begun);
    if (rate > best && a[sweep] > 0.0) best = rate;
  }
  free(a);
  return best;
}
