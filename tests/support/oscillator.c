#include "oscillator.h"

#include <math.h>
#include <string.h>

void oscillator_solution(long double zeta, long double tau, const long double start[2], long double end[2]) {
  const long double x = start[0], v = start[1];
  if (zeta < 1.0L) {
    const long double w = sqrtl((1.0L - zeta) * (1.0L + zeta)), decay = expl(-zeta * tau);
    const long double c = cosl(w * tau), s = sinl(w * tau) / w;
    end[0] = decay * (x * (c + zeta * s) + v * s);
    end[1] = decay * (v * (c - zeta * s) - x * s);
  } else if (zeta == 1.0L) {
    const long double decay = expl(-tau);
    end[0] = decay * (x + (x + v) * tau);
    end[1] = decay * (v - (x + v) * tau);
  } else {
    /* rates of both decays; the slow one without cancellation */
    const long double root = sqrtl((zeta - 1.0L) * (zeta + 1.0L)), fast = -(zeta + root), slow = 1.0L / fast;
    const long double b = (v - slow * x) / (fast - slow), a = x - b;
    end[0] = a * expl(slow * tau) + b * expl(fast * tau);
    end[1] = a * slow * expl(slow * tau) + b * fast * expl(fast * tau);
  }
}

static void multiply(const long double a[4], const long double b[4], long double out[4]) {
  const long double product[4] = {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3],
                                  a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]};
  memcpy(out, product, sizeof product);
}

static void apply(const long double a[4], const long double x[2], long double out[2]) {
  const long double product[2] = {a[0] * x[0] + a[1] * x[1], a[2] * x[0] + a[3] * x[1]};
  memcpy(out, product, sizeof product);
}

/* R(z) = 1 + z + ... + z^degree/degree! of z = h A. */
static void runge_kutta(int degree, long double zeta, long double h, long double m[4]) {
  const long double z[4] = {0.0L, h, -h, -2.0L * zeta * h};
  long double sum[4] = {1.0L, 0.0L, 0.0L, 1.0L};
  for (int k = degree; k >= 1; k--) { /* Horner */
    multiply(z, sum, m);
    for (int j = 0; j < 4; j++)
      sum[j] = m[j] / (long double)k + (j % 3 == 0 ? 1.0L : 0.0L);
  }
  memcpy(m, sum, sizeof sum);
}

/* (1 - a A)^-1 for A = (0, 1; -1, -c). */
static void solved(long double c, long double a, long double m[4]) {
  const long double d = 1.0L / (1.0L + c * a + a * a);
  memcpy(m, (long double[4]){(1.0L + c * a) * d, a * d, -a * d, d}, 4 * sizeof *m);
}

/* (1 - a A)^-1 (1 + a A) = 2 (1 - a A)^-1 - 1: also one step of the midpoint rule, with a = h/2. */
static void trapezoid(long double c, long double a, long double m[4]) {
  solved(c, a, m);
  for (int j = 0; j < 4; j++)
    m[j] = 2.0L * m[j] - (j % 3 == 0 ? 1.0L : 0.0L);
}

/* (1 - a A)^-1 ((1 + d) T - d) with T the trapezoidal rule to c h. */
static void tr_bdf2(long double damping, long double h, long double m[4]) {
  const long double root = sqrtl(2.0L), a = (2.0L - root) / 2.0L * h, d = (root - 1.0L) / 2.0L;
  long double last[4];
  trapezoid(damping, a, m);
  for (int j = 0; j < 4; j++)
    m[j] = (1.0L + d) * m[j] - (j % 3 == 0 ? d : 0.0L);
  solved(damping, a, last);
  multiply(last, m, m);
}

int32_t oscillator_step(const char *method, long double zeta, long double h, long double m[4]) {
  const long double c = 2.0L * zeta;
  if (strcmp(method, "forward-euler") == 0) {
    memcpy(m, (long double[4]){1.0L, h, -h, 1.0L - c * h}, 4 * sizeof *m);
  } else if (strcmp(method, "symplectic-euler") == 0) {
    memcpy(m, (long double[4]){1.0L - h * h, h * (1.0L - c * h), -h, 1.0L - c * h}, 4 * sizeof *m);
  } else if (strcmp(method, "verlet") == 0) {
    const long double kick[4] = {1.0L, 0.0L, -h / 2.0L, 1.0L - c * h / 2.0L},
                      drift[4] = {1.0L, h, 0.0L, 1.0L};
    const long double brake = 1.0L + c * h / 2.0L, last[4] = {1.0L, 0.0L, -h / 2.0L / brake, 1.0L / brake};
    multiply(drift, kick, m);
    multiply(last, m, m);
  } else if (strcmp(method, "verlet, explicit") == 0) {
    /* the velocity half-way, that ahead, and the place, by x and v */
    const long double kick[2] = {-h / 2.0L, -c * h / 2.0L}, half[2] = {kick[0], 1.0L + kick[1]},
                      ahead[2] = {2.0L * kick[0], 1.0L + 2.0L * kick[1]};
    for (int k = 0; k < 2; k++) {
      m[k] = (k == 0 ? 1.0L : 0.0L) + h * half[k];
      m[2 + k] = half[k] - h / 2.0L * (m[k] + c * ahead[k]);
    }
  } else if (strcmp(method, "shardlow") == 0) {
    const long double z = c * h / 2.0L, brake[4] = {1.0L, 0.0L, 0.0L, 1.0L / (1.0L + z + z * z / 2.0L)},
                      kick[4] = {1.0L, 0.0L, -h / 2.0L, 1.0L}, drift[4] = {1.0L, h, 0.0L, 1.0L};
    multiply(kick, brake, m);
    multiply(drift, m, m);
    multiply(kick, m, m);
    multiply(brake, m, m);
  } else if (strcmp(method, "rk4") == 0) {
    runge_kutta(4, zeta, h, m);
  } else if (strcmp(method, "heun") == 0) {
    runge_kutta(2, zeta, h, m);
  } else if (strcmp(method, "implicit-midpoint") == 0) {
    trapezoid(c, h / 2.0L, m);
  } else if (strcmp(method, "tr-bdf2") == 0) {
    tr_bdf2(c, h, m);
  } else if (strcmp(method, "backward-euler") == 0) {
    solved(c, h, m);
  } else {
    return 0;
  }
  return 1;
}

void oscillator_power(const long double matrix[4], int64_t count, const long double start[2],
                      long double end[2]) {
  long double power[4], x[2] = {start[0], start[1]};
  memcpy(power, matrix, sizeof power);
  for (; count > 0; count /= 2) {
    if (count % 2 == 1) apply(power, x, x);
    multiply(power, power, power);
  }
  memcpy(end, x, sizeof x);
}

int64_t oscillator_diverges(const long double matrix[4], int64_t count, const long double start[2]) {
  long double x[2] = {start[0], start[1]};
  const long double first = x[0] * x[0] + x[1] * x[1];
  for (int64_t k = 1; k <= count; k++) {
    apply(matrix, x, x);
    if (!(x[0] * x[0] + x[1] * x[1] <= 101.0L * first)) return k;
  }
  return 0;
}
