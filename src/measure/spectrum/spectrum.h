/* Eigenvalues lambda of lambda^2 M + lambda C + K: all of them for small scenes, those of the fastest modes
 * for large ones. Numbers in the units of the linearised system (rate = 1); modes are displacements, x, y and
 * z apart (3n). */
#pragma once

#include "measure/spectrum/linearised.h"

/* All eigenvalues are computed up to this number of unknowns; or up to this one if damping is proportional, C
 * = beta K + delta M (including no damping), since then those of K suffice. */
enum { HOOKE_SPECTRUM_DAMPED = 400, HOOKE_SPECTRUM_PROPORTIONAL = 1500 };

struct hk_eigenvalue {
  double real, imaginary; /* the latter >= 0 */
  double stiffness;       /* k of its mode: lambda^2 + lambda c + k = 0 */
  const double *mode;     /* NULL if unknown */
  int64_t number;         /* in the order in which they were found */
};

struct hk_spectrum {
  struct hk_linearised *linearised;
  double accuracy;
  int32_t decisive; /* no omitted eigenvalue limits any method further */
  int32_t proportional;
  double beta, delta;
  double stiffest, fastest_decay; /* largest eigenvalues of M^-1 K and M^-1 C */
  double *stiffest_mode;          /* 3n */
  int64_t count;
  struct hk_eigenvalue *value; /* the largest first */
  double *block;               /* the numbers of modes */
};

/* Extent of the computation: the stiffest mode, and whether damping is proportional; in addition the fastest
 * decay, and the deciding modes if C = beta K; or as many modes as possible. */
enum hk_spectrum_extent { HOOKE_SPECTRUM_STIFFEST, HOOKE_SPECTRUM_EXTREMES, HOOKE_SPECTRUM_ALL };

/* `start`: the stiffest mode of a nearby state, or NULL. The linearised system must outlive it.
 * HOOKE_NOT_BUILT without LAPACK; HOOKE_NO_MEMORY. */
int32_t hk_spectrum_create(struct hk_linearised *linearised, double accuracy, enum hk_spectrum_extent extent,
                           const double *start, struct hk_spectrum *spectrum);
void hk_spectrum_release(struct hk_spectrum *spectrum);

/* The roots of lambda^2 + c lambda + k, the larger one first, the imaginary part of conjugates positive. */
void hk_spectrum_roots(double c, double k, double real[2], double imaginary[2]);
