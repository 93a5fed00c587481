#include "kernel/step_loops.h"

#include <stddef.h>

void hk_advance(int64_t n, double h, const double *restrict rate, double *restrict x) {
  for (int64_t p = 0; p < n; p++)
    x[p] += h * rate[p];
}

/* ---- g NULL: no gravity, a = w f ---- */

void hk_kick_and_drift(int64_t n, double kick, double drift, const double *restrict w,
                       const double *restrict f, const double *g, double *restrict q, double *restrict v) {
  if (g == NULL) {
    for (int64_t p = 0; p < n; p++) {
      v[p] += kick * (w[p] * f[p]);
      q[p] += drift * v[p];
    }
    return;
  }
  const double gravity = *g;
  for (int64_t p = 0; p < n; p++) {
    v[p] += kick * (w[p] * f[p] + gravity);
    q[p] += drift * v[p];
  }
}

void hk_kick(int64_t n, double kick, const double *restrict w, const double *restrict f, const double *g,
             double *restrict v) {
  if (g == NULL) {
    for (int64_t p = 0; p < n; p++)
      v[p] += kick * (w[p] * f[p]);
    return;
  }
  const double gravity = *g;
  for (int64_t p = 0; p < n; p++)
    v[p] += kick * (w[p] * f[p] + gravity);
}

void hk_kick_with_drag(int64_t n, double kick, double drag, const double *restrict w,
                       const double *restrict f, const double *g, double *restrict v) {
  const double brake = kick * drag;
  if (g == NULL) {
    for (int64_t p = 0; p < n; p++)
      v[p] = (v[p] + kick * (w[p] * f[p])) / (1.0 + brake * w[p]);
    return;
  }
  const double gravity = *g;
  for (int64_t p = 0; p < n; p++)
    v[p] = (v[p] + kick * (w[p] * f[p] + gravity)) / (1.0 + brake * w[p]);
}

void hk_acceleration(int64_t n, const double *restrict w, const double *g, double *restrict f) {
  if (g == NULL) {
    for (int64_t p = 0; p < n; p++)
      f[p] = w[p] * f[p];
    return;
  }
  const double gravity = *g;
  for (int64_t p = 0; p < n; p++)
    f[p] = w[p] * f[p] + gravity;
}

void hk_first_stage(int64_t n, double h, const double *restrict rate, double *restrict sum,
                    double *restrict x) {
  for (int64_t p = 0; p < n; p++) {
    sum[p] = rate[p];
    x[p] += h * rate[p];
  }
}

void hk_middle_stage(int64_t n, double h, const double *restrict rate, const double *restrict start,
                     double *restrict sum, double *restrict x) {
  for (int64_t p = 0; p < n; p++) {
    sum[p] += 2.0 * rate[p];
    x[p] = start[p] + h * rate[p];
  }
}

void hk_last_stage(int64_t n, double part, const double *restrict rate, const double *restrict start,
                   const double *restrict sum, double *restrict x) {
  for (int64_t p = 0; p < n; p++)
    x[p] = start[p] + part * (sum[p] + rate[p]);
}
