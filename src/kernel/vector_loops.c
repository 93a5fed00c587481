#include "kernel/vector_loops.h"

enum { PARTS = 8 };

static double sum_of(const double part[PARTS]) {
  return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

double hooke_dot(int64_t size, const double *restrict x, const double *restrict y) {
  double part[PARTS] = {0.0};
  const int64_t whole = size / PARTS * PARTS;
  for (int64_t k = 0; k < whole; k += PARTS) {
    for (int p = 0; p < PARTS; p++)
      part[p] += x[k + p] * y[k + p];
  }
  for (int64_t k = whole; k < size; k++)
    part[k - whole] += x[k] * y[k];
  return sum_of(part);
}

double hooke_dot_weighed(int64_t n, const double *restrict weight, const double *restrict x,
                         const double *restrict y) {
  double part[PARTS] = {0.0};
  const int64_t whole = n / PARTS * PARTS;
  for (int a = 0; a < 3; a++, x += n, y += n) {
    for (int64_t k = 0; k < whole; k += PARTS) {
      for (int p = 0; p < PARTS; p++)
        part[p] += weight[k + p] * x[k + p] * y[k + p];
    }
    for (int64_t k = whole; k < n; k++)
      part[k - whole] += weight[k] * x[k] * y[k];
  }
  return sum_of(part);
}

double hooke_lanczos_begin(int64_t n, const double *restrict mass, const double *restrict inverse, double a,
                           double b, const double *restrict before, const double *restrict x,
                           double *restrict out) {
  double part[PARTS] = {0.0};
  const int64_t whole = n / PARTS * PARTS;
  for (int c = 0; c < 3; c++, x += n, out += n, before += n) {
    for (int64_t k = 0; k < whole; k += PARTS) {
      for (int p = 0; p < PARTS; p++) {
        out[k + p] = a * inverse[k + p] * out[k + p] - b * before[k + p];
        part[p] += mass[k + p] * out[k + p] * x[k + p];
      }
    }
    for (int64_t k = whole; k < n; k++) {
      out[k] = a * inverse[k] * out[k] - b * before[k];
      part[k - whole] += mass[k] * out[k] * x[k];
    }
  }
  return sum_of(part);
}

double hooke_lanczos_end(int64_t n, const double *restrict mass, double b, const double *restrict x,
                         double *restrict out) {
  double part[PARTS] = {0.0};
  const int64_t whole = n / PARTS * PARTS;
  for (int c = 0; c < 3; c++, x += n, out += n) {
    for (int64_t k = 0; k < whole; k += PARTS) {
      for (int p = 0; p < PARTS; p++) {
        out[k + p] -= b * x[k + p];
        part[p] += mass[k + p] * out[k + p] * out[k + p];
      }
    }
    for (int64_t k = whole; k < n; k++) {
      out[k] -= b * x[k];
      part[k - whole] += mass[k] * out[k] * out[k];
    }
  }
  return sum_of(part);
}

void hooke_add_multiple(int64_t size, double a, const double *restrict x, double *restrict y) {
  for (int64_t k = 0; k < size; k++)
    y[k] += a * x[k];
}

void hooke_scale_and_add(int64_t size, double b, const double *restrict x, double *restrict y) {
  for (int64_t k = 0; k < size; k++)
    y[k] = x[k] + b * y[k];
}

void hooke_apply_factor_transposed(int64_t n, const double *restrict w, const double *restrict x,
                                   double *restrict y) {
  const double *w11 = w, *w22 = w + n, *w33 = w + 2 * n, *w21 = w + 3 * n, *w31 = w + 4 * n, *w32 = w + 5 * n;
  for (int64_t p = 0; p < n; p++)
    y[p] = (w11[p] * x[p] + w21[p] * x[n + p]) + w31[p] * x[2 * n + p];
  for (int64_t p = 0; p < n; p++)
    y[n + p] = w22[p] * x[n + p] + w32[p] * x[2 * n + p];
  for (int64_t p = 0; p < n; p++)
    y[2 * n + p] = w33[p] * x[2 * n + p];
}

/* From the last component up, so that each finds those it needs. */
void hooke_apply_factor(int64_t n, const double *restrict w, double *x) {
  const double *w11 = w, *w22 = w + n, *w33 = w + 2 * n, *w21 = w + 3 * n, *w31 = w + 4 * n, *w32 = w + 5 * n;
  double *restrict a = x, *restrict b = x + n, *restrict c = x + 2 * n;
  for (int64_t p = 0; p < n; p++)
    c[p] = (w31[p] * a[p] + w32[p] * b[p]) + w33[p] * c[p];
  for (int64_t p = 0; p < n; p++)
    b[p] = w21[p] * a[p] + w22[p] * b[p];
  for (int64_t p = 0; p < n; p++)
    a[p] = w11[p] * a[p];
}

void hooke_apply_diagonal(int64_t n, const double *restrict d, const double *restrict x, double *restrict y) {
  for (int a = 0; a < 3; a++) {
    for (int64_t p = 0; p < n; p++)
      y[a * n + p] = d[p] * x[a * n + p];
  }
}
