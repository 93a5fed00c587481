/* Compiled once per instruction set, with HOOKE_ISA naming it. */
#include "kernel/vector_loops.h"

#include "kernel/instruction_set.h"

#include <math.h>
#include <string.h>

enum { PARTS = 8, LONG_PARTS = 32 };

static double sum_of(const double part[PARTS]) {
  return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

static double dot(int64_t size, const double *restrict x, const double *restrict y) {
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

static double dot_weighed(int64_t n, const double *restrict weight, const double *restrict x,
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

static double lanczos_begin(int64_t n, const double *restrict mass, const double *restrict inverse, double a,
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

static double lanczos_end(int64_t n, const double *restrict mass, double b, const double *restrict x,
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

static void add_multiple(int64_t size, double a, const double *restrict x, double *restrict y) {
  for (int64_t k = 0; k < size; k++)
    y[k] += a * x[k];
}

static void scale_and_add(int64_t size, double b, const double *restrict x, double *restrict y) {
  for (int64_t k = 0; k < size; k++)
    y[k] = x[k] + b * y[k];
}

static double descend(int64_t size, double a, const double *restrict p, const double *restrict ap,
                      double *restrict x, double *restrict r) {
  double part[PARTS] = {0.0};
  const int64_t whole = size / PARTS * PARTS;
  for (int64_t k = 0; k < whole; k += PARTS) {
    for (int i = 0; i < PARTS; i++) {
      x[k + i] += a * p[k + i];
      r[k + i] += -a * ap[k + i];
      part[i] += r[k + i] * r[k + i];
    }
  }
  for (int64_t k = whole; k < size; k++) {
    x[k] += a * p[k];
    r[k] += -a * ap[k];
    part[k - whole] += r[k] * r[k];
  }
  return sum_of(part);
}

static void factorise_blocks(int64_t n, double *block) {
  double *xx = block, *yy = block + n, *zz = block + 2 * n, *xy = block + 3 * n, *xz = block + 4 * n,
         *yz = block + 5 * n;
  HOOKE_VECTORISE
  for (int64_t p = 0; p < n; p++) {
    const double l11 = sqrt(xx[p]), l21 = xy[p] / l11, l31 = xz[p] / l11;
    const double l22 = sqrt(yy[p] - l21 * l21), l32 = (yz[p] - l31 * l21) / l22;
    const double l33 = sqrt((zz[p] - l31 * l31) - l32 * l32);
    const double w11 = 1.0 / l11, w22 = 1.0 / l22, w33 = 1.0 / l33;
    xx[p] = w11;
    yy[p] = w22;
    zz[p] = w33;
    xy[p] = -l21 * w11 * w22;
    xz[p] = (l21 * l32 - l31 * l22) * w11 * w22 * w33;
    yz[p] = -l32 * w22 * w33;
  }
}

static void apply_factor_transposed(int64_t n, const double *restrict w, const double *restrict x,
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
static void apply_factor(int64_t n, const double *restrict w, double *x) {
  const double *w11 = w, *w22 = w + n, *w33 = w + 2 * n, *w21 = w + 3 * n, *w31 = w + 4 * n, *w32 = w + 5 * n;
  double *restrict a = x, *restrict b = x + n, *restrict c = x + 2 * n;
  for (int64_t p = 0; p < n; p++)
    c[p] = (w31[p] * a[p] + w32[p] * b[p]) + w33[p] * c[p];
  for (int64_t p = 0; p < n; p++)
    b[p] = w21[p] * a[p] + w22[p] * b[p];
  for (int64_t p = 0; p < n; p++)
    a[p] = w11[p] * a[p];
}

static void apply_diagonal(int64_t n, const double *restrict d, const double *restrict x,
                           double *restrict y) {
  for (int a = 0; a < 3; a++) {
    for (int64_t p = 0; p < n; p++)
      y[a * n + p] = d[p] * x[a * n + p];
  }
}

static void begin_product(int64_t n, const double *w, const double *d, const double *x, double *y,
                          double *out) {
  HOOKE_VECTORISE
  for (int64_t p = 0; p < n; p++) {
    const double a = (w[p] * x[p] + w[3 * n + p] * x[n + p]) + w[4 * n + p] * x[2 * n + p];
    const double b = w[n + p] * x[n + p] + w[5 * n + p] * x[2 * n + p], c = w[2 * n + p] * x[2 * n + p];
    y[p] = a;
    y[n + p] = b;
    y[2 * n + p] = c;
    out[p] = d[p] * a;
    out[n + p] = d[p] * b;
    out[2 * n + p] = d[p] * c;
  }
}

/* ---- one by one ---- */

static void linear_sum(int64_t size, double a, const double *x, double b, const double *y, double *z) {
  HOOKE_VECTORISE
  for (int64_t k = 0; k < size; k++)
    z[k] = a * x[k] + b * y[k];
}

static void scale(int64_t size, double a, const double *x, double *z) {
  HOOKE_VECTORISE
  for (int64_t k = 0; k < size; k++)
    z[k] = a * x[k];
}

static void multiply(int64_t size, const double *x, const double *y, double *z) {
  HOOKE_VECTORISE
  for (int64_t k = 0; k < size; k++)
    z[k] = x[k] * y[k];
}

static void divide(int64_t size, const double *x, const double *y, double *z) {
  HOOKE_VECTORISE
  for (int64_t k = 0; k < size; k++)
    z[k] = x[k] / y[k];
}

static void invert(int64_t size, const double *x, double *z) {
  HOOKE_VECTORISE
  for (int64_t k = 0; k < size; k++)
    z[k] = 1.0 / x[k];
}

static void absolute(int64_t size, const double *x, double *z) {
  HOOKE_VECTORISE
  for (int64_t k = 0; k < size; k++)
    z[k] = x[k] < 0.0 ? -x[k] : x[k];
}

static double sum_of_long(double part[LONG_PARTS]) {
  double first[PARTS];
  for (int p = 0; p < PARTS; p++)
    first[p] = (part[p] + part[PARTS + p]) + (part[2 * PARTS + p] + part[3 * PARTS + p]);
  return sum_of(first);
}

static double sum_of_squares(int64_t size, const double *x, const double *y) {
  double part[LONG_PARTS] = {0.0};
  const int64_t whole = size / LONG_PARTS * LONG_PARTS;
  for (int64_t k = 0; k < whole; k += LONG_PARTS) {
    for (int p = 0; p < LONG_PARTS; p++)
      part[p] += (x[k + p] * y[k + p]) * (x[k + p] * y[k + p]);
  }
  for (int64_t k = whole; k < size; k++)
    part[k - whole] += (x[k] * y[k]) * (x[k] * y[k]);
  return sum_of_long(part);
}

static double long_dot(int64_t size, const double *x, const double *y) {
  double part[LONG_PARTS] = {0.0};
  const int64_t whole = size / LONG_PARTS * LONG_PARTS;
  for (int64_t k = 0; k < whole; k += LONG_PARTS) {
    for (int p = 0; p < LONG_PARTS; p++)
      part[p] += x[k + p] * y[k + p];
  }
  for (int64_t k = whole; k < size; k++)
    part[k - whole] += x[k] * y[k];
  return sum_of_long(part);
}

static double largest(int64_t size, const double *x) {
  double part[PARTS] = {0.0}, most = 0.0;
  const int64_t whole = size / PARTS * PARTS;
  for (int64_t k = 0; k < whole; k += PARTS) {
    for (int p = 0; p < PARTS; p++) {
      const double value = x[k + p] < 0.0 ? -x[k + p] : x[k + p];
      part[p] = value > part[p] ? value : part[p];
    }
  }
  for (int64_t k = whole; k < size; k++)
    part[0] = x[k] > part[0] ? x[k] : -x[k] > part[0] ? -x[k] : part[0];
  for (int p = 0; p < PARTS; p++)
    most = part[p] > most ? part[p] : most;
  return most;
}

static void join_rows(int64_t n, const double *restrict x, const double *restrict y, const double *restrict z,
                      double *restrict rows) {
  for (int64_t p = 0; p < n; p++) {
    rows[3 * p] = x[p];
    rows[3 * p + 1] = y[p];
    rows[3 * p + 2] = z[p];
  }
}

static inline uint64_t difference(const double *a, const double *b) {
  uint64_t bits[2];
  memcpy(&bits[0], a, sizeof bits[0]);
  memcpy(&bits[1], b, sizeof bits[1]);
  return bits[0] ^ bits[1];
}

static uint64_t differing_bits(int64_t n, const double *x, const double *y, const double *z,
                               const double *rows) {
  uint64_t bits = 0;
  for (int64_t p = 0; p < n; p++) {
    const double *row = rows + 3 * p;
    bits |= difference(row, x + p) | difference(row + 1, y + p) | difference(row + 2, z + p);
  }
  return bits;
}

const struct hk_vector_set HOOKE_VECTOR_SET = {
    .dot = dot,
    .add_multiple = add_multiple,
    .scale_and_add = scale_and_add,
    .dot_weighed = dot_weighed,
    .lanczos_begin = lanczos_begin,
    .lanczos_end = lanczos_end,
    .descend = descend,
    .factorise_blocks = factorise_blocks,
    .apply_factor_transposed = apply_factor_transposed,
    .apply_factor = apply_factor,
    .apply_diagonal = apply_diagonal,
    .begin_product = begin_product,
    .linear_sum = linear_sum,
    .scale = scale,
    .multiply = multiply,
    .divide = divide,
    .invert = invert,
    .absolute = absolute,
    .sum_of_squares = sum_of_squares,
    .long_dot = long_dot,
    .largest = largest,
    .join_rows = join_rows,
    .differing_bits = differing_bits,
};
