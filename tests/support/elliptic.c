#include "elliptic.h"

#include <math.h>

enum { MOST = 16 };
static const double PI = 3.14159265358979323846;

/* Means a[0] .. a[n] and differences c; returns n. */
static int means(double k, double a[MOST], double c[MOST]) {
  double b = sqrt((1.0 - k) * (1.0 + k));
  int n = 0;
  a[0] = 1.0;
  c[0] = k;
  while (fabs(c[n]) > 1e-16 * a[n] && n + 1 < MOST) {
    a[n + 1] = 0.5 * (a[n] + b);
    c[n + 1] = 0.5 * (a[n] - b);
    b = sqrt(a[n] * b);
    n++;
  }
  return n;
}

double elliptic_k(double k) {
  double a[MOST], c[MOST];
  return 0.5 * PI / a[means(k, a, c)];
}

void elliptic_jacobi(double u, double k, double *sn, double *cn, double *dn) {
  double a[MOST], c[MOST], before = 0.0;
  const int n = means(k, a, c);
  double phi = ldexp(a[n], n) * u;
  before = phi;
  for (int j = n; j > 0; j--) {
    before = phi;
    phi = 0.5 * (phi + asin(c[j] / a[j] * sin(phi)));
  }
  *sn = sin(phi);
  *cn = cos(phi);
  *dn = n > 0 && fabs(cos(before - phi)) > 0.1 ? *cn / cos(before - phi) : sqrt(1.0 - k * k * *sn * *sn);
}
