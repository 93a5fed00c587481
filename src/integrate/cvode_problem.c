/* The problem as CVODE sees it: q' = v, v' = w f + g over the free particles. */
#if HOOKE_HAVE_SUNDIALS

#include "integrate/cvode.h"

#include <math.h>
#include <string.h>

/* Return values by CVODE's rules. */
enum { FINE = 0, TRY_SMALLER = 1, GIVE_UP = -1 };

void hooke_cvode_pack(const hooke_integrator *it, const double *q, const double *v, double *y) {
  const struct hooke_cvode *own = it->own;
  const int64_t m = own->free_count;
  if (own->free == NULL) {
    memcpy(y, q, (size_t)(3 * m) * sizeof(double));
    memcpy(y + 3 * m, v, (size_t)(3 * m) * sizeof(double));
    return;
  }
  for (int64_t k = 0; k < m; k++) {
    memcpy(y + 3 * k, q + 3 * (int64_t)own->free[k], 3 * sizeof(double));
    memcpy(y + 3 * (m + k), v + 3 * (int64_t)own->free[k], 3 * sizeof(double));
  }
}

void hooke_cvode_unpack(const hooke_integrator *it, const double *y, double *q, double *v) {
  const struct hooke_cvode *own = it->own;
  const int64_t m = own->free_count;
  if (own->free == NULL) {
    memcpy(q, y, (size_t)(3 * m) * sizeof(double));
    memcpy(v, y + 3 * m, (size_t)(3 * m) * sizeof(double));
    return;
  }
  for (int64_t k = 0; k < m; k++) {
    memcpy(q + 3 * (int64_t)own->free[k], y + 3 * k, 3 * sizeof(double));
    memcpy(v + 3 * (int64_t)own->free[k], y + 3 * (m + k), 3 * sizeof(double));
  }
}

/* Puts y and the held particles of time t into the working copy. */
static int32_t place(hooke_integrator *it, double t, const double *y) {
  const struct hooke_cvode *own = it->own;
  struct hooke_motion *motion = it->motion;
  const int64_t m = own->free_count;
  if (own->free == NULL) {
    hooke_components_from_rows(m, y, motion->q);
    hooke_components_from_rows(m, y + 3 * m, motion->v);
    return HOOKE_OK;
  }
  for (int a = 0; a < 3; a++) {
    for (int64_t k = 0; k < m; k++) {
      motion->q[a][own->free[k]] = y[3 * k + a];
      motion->v[a][own->free[k]] = y[3 * (m + k) + a];
    }
  }
  return hooke_integrator_hold(it, t);
}

/* v' of the free particles; 0 times their sum tells whether all are finite. */
static double accelerations(const hooke_integrator *it, double *out) {
  const struct hooke_cvode *own = it->own;
  const hooke_system *system = it->system;
  double sum = 0.0;
  for (int64_t k = 0; k < own->free_count; k++) {
    const int64_t p = own->free ? own->free[k] : k;
    for (int a = 0; a < 3; a++) {
      const double force = system->inverse_mass[p] * it->motion->f[a][p];
      out[3 * k + a] = system->has_gravity ? force + system->gravity[a] : force;
      sum += 0.0 * out[3 * k + a];
    }
  }
  return sum;
}

int hooke_cvode_rhs(realtype t, N_Vector y, N_Vector slope, void *ctx) {
  hooke_integrator *it = ctx;
  const struct hooke_cvode *own = it->own;
  const double *from = N_VGetArrayPointer(y);
  double *to = N_VGetArrayPointer(slope);
  /* CVODE may take a failure for a reason to try a smaller step */
  if (it->stop_value != 0) return GIVE_UP;
  if (it->rate) return hooke_integrator_rate(it, t, from, to) == HOOKE_OK ? FINE : GIVE_UP;
  if (own->free_count == 0) {
    to[0] = 0.0;
    return FINE;
  }
  if (place(it, t, from) != HOOKE_OK || hooke_integrator_forces(it, t) != HOOKE_OK) return GIVE_UP;
  const int64_t m = own->free_count;
  memcpy(to, from + 3 * m, (size_t)(3 * m) * sizeof(double));
  return accelerations(it, to + 3 * m) == 0.0 ? FINE : TRY_SMALLER;
}

/* Called once per linear solve: the point at which products are taken, in rows. */
int hooke_cvode_product_setup(realtype t, N_Vector y, N_Vector slope, void *ctx) {
  (void)slope;
  hooke_integrator *it = ctx;
  const struct hooke_cvode *own = it->own;
  if (own->free_count == 0) return FINE;
  if (place(it, t, N_VGetArrayPointer(y)) != HOOKE_OK) return GIVE_UP;
  hooke_motion_store(it->motion, own->rows, own->rows + it->size);
  return FINE;
}

int hooke_cvode_product(N_Vector v, N_Vector product, realtype t, N_Vector y, N_Vector slope, void *ctx,
                        N_Vector scratch) {
  (void)y, (void)slope, (void)scratch;
  hooke_integrator *it = ctx;
  const struct hooke_cvode *own = it->own;
  const double *from = N_VGetArrayPointer(v);
  double *to = N_VGetArrayPointer(product);
  if (own->free_count == 0) {
    to[0] = 0.0;
    return FINE;
  }
  double *q = own->rows, *rate = q + it->size, *dq = rate + it->size, *dv = dq + it->size,
         *out = dv + it->size;
  hooke_cvode_unpack(it, from, dq, dv); /* held particles: zero from the start */
  it->count.derivative_products++;
  if (hooke_system_derivative_product(it->system, t, q, rate, dq, dv, out) != HOOKE_OK) return GIVE_UP;
  const int64_t m = own->free_count;
  memcpy(to, from + 3 * m, (size_t)(3 * m) * sizeof(double));
  for (int64_t k = 0; k < m; k++) {
    const int64_t p = own->free ? own->free[k] : k;
    for (int a = 0; a < 3; a++)
      to[3 * (m + k) + a] = it->system->inverse_mass[p] * out[3 * p + a];
  }
  return FINE;
}

#else
typedef int hooke_cvode_problem_is_not_built;
#endif
