#include "measure/spectrum/eigen/eigen.h"

#include <math.h>

enum { MOST_SWEEPS = 32 }; /* three to five suffice */

/* Off-diagonal entries below this fraction of the largest entry change no eigenvalue by more than rounding.
 */
static const double NOTHING = 1e-17;

/* Rotates p and q so that their entry a vanishes; updates b = (p, r) and c = (q, r). */
static void rotate(double *p, double *q, double *a, double *b, double *c) {
  if (*a == 0.0) return;
  const double half = (*q - *p) / (2.0 * *a);
  const double tangent = copysign(1.0, half) / (fabs(half) + sqrt(half * half + 1.0));
  const double cosine = 1.0 / sqrt(tangent * tangent + 1.0), sine = tangent * cosine;
  const double from_b = *b, from_c = *c;
  *p -= tangent * *a;
  *q += tangent * *a;
  *a = 0.0;
  *b = cosine * from_b - sine * from_c;
  *c = sine * from_b + cosine * from_c;
}

/* Jacobi's rotations: for close eigenvalues, as in blocks of a flat cloth, a closed formula loses half of the
 * digits. */
double hk_eigen_largest(const double matrix[6]) {
  double xx = matrix[0], yy = matrix[1], zz = matrix[2], xy = matrix[3], xz = matrix[4], yz = matrix[5];
  for (int sweep = 0; sweep < MOST_SWEEPS; sweep++) {
    const double on = fmax(fabs(xx), fmax(fabs(yy), fabs(zz)));
    const double off = fmax(fabs(xy), fmax(fabs(xz), fabs(yz)));
    if (off <= NOTHING * on) break;
    rotate(&xx, &yy, &xy, &xz, &yz);
    rotate(&xx, &zz, &xz, &xy, &yz);
    rotate(&yy, &zz, &yz, &xy, &xz);
  }
  return isnan(xx + yy + zz) ? NAN : fmax(xx, fmax(yy, zz));
}
