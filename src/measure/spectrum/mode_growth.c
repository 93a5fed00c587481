#include "measure/spectrum/mode_growth.h"

#include <complex.h>
#include <math.h>

/* The larger modulus of the roots of a z^2 - b z + c = 0. */
static double larger_root(double a, double b, double c) {
  const double complex root = csqrt(b * b - 4.0 * a * c);
  return fmax(cabs((b + root) / (2.0 * a)), cabs((b - root) / (2.0 * a)));
}

/* |R(h lambda)|, R the exponential series up to `degree`. */
static double polynomial(int32_t degree, double complex z) {
  double complex sum = 1.0, term = 1.0;
  for (int32_t k = 1; k <= degree; k++) {
    term *= z / k;
    sum += term;
  }
  return cabs(sum);
}

/* The trace and the determinant of the matrix of a step; c is its damping. */
static double by_prediction(double k, double c) {
  return larger_root(1.0, 2.0 - k - c + 0.25 * k * c + 0.5 * c * c, 1.0 - c + 0.5 * c * c - 0.25 * k * c);
}

/* Damping multiplies volume in (x, v), and the trace of the step without it in the mean with 1. */
static double by_stiffness(double k, double c, int32_t apart) {
  const double brake = 1.0 / (1.0 + c * (1.0 + 0.5 * c)),
               volume = apart ? brake * brake : (1.0 - c) / (1.0 + c);
  return larger_root(1.0, (1.0 - 0.5 * k) * (1.0 + volume), volume);
}

double hk_mode_growth(const struct hk_stability *stability, double h, double frequency, double decay) {
  const double k = h * h * frequency * frequency, c = h * decay;
  if (stability->kind == HOOKE_STABLE_BY_K_AND_C) return larger_root(1.0, 2.0 - k - 2.0 * c, 1.0 - 2.0 * c);
  if (stability->kind == HOOKE_STABLE_BY_K) return by_stiffness(k, c, stability->damps_apart);
  if (stability->kind == HOOKE_STABLE_BY_PREDICTION) return by_prediction(k, 2.0 * c);
  if (stability->kind != HOOKE_STABLE_BY_POLYNOMIAL) return NAN;
  const double complex root = csqrt(decay * decay - frequency * frequency);
  return fmax(polynomial(stability->degree, h * (root - decay)),
              polynomial(stability->degree, h * (-root - decay)));
}

double hk_eigenvalue_growth(const struct hk_stability *stability, double h, double real, double imaginary) {
  return stability->kind == HOOKE_STABLE_BY_POLYNOMIAL
             ? polynomial(stability->degree, h * (real + I * imaginary))
             : (double)NAN;
}
