#include "kernel/step_loops.h"

void hooke_kick_then_drift(int64_t n, double h, const double *restrict w, const double *restrict f, double g,
                           double *restrict q, double *restrict v) {
  for (int64_t p = 0; p < n; p++) {
    v[p] += h * (w[p] * f[p] + g);
    q[p] += h * v[p];
  }
}

void hooke_drift_then_kick(int64_t n, double h, const double *restrict w, const double *restrict f, double g,
                           double *restrict q, double *restrict v) {
  for (int64_t p = 0; p < n; p++) {
    q[p] += h * v[p];
    v[p] += h * (w[p] * f[p] + g);
  }
}

void hooke_kick_then_drift_weightless(int64_t n, double h, const double *restrict w, const double *restrict f,
                                      double *restrict q, double *restrict v) {
  for (int64_t p = 0; p < n; p++) {
    v[p] += h * (w[p] * f[p]);
    q[p] += h * v[p];
  }
}

void hooke_drift_then_kick_weightless(int64_t n, double h, const double *restrict w, const double *restrict f,
                                      double *restrict q, double *restrict v) {
  for (int64_t p = 0; p < n; p++) {
    q[p] += h * v[p];
    v[p] += h * (w[p] * f[p]);
  }
}

void hooke_advance(int64_t n, double h, const double *restrict rate, double *restrict x) {
  for (int64_t p = 0; p < n; p++)
    x[p] += h * rate[p];
}
