/* q' = v, v' = w f + g over the free particles, on one array. */
#include "integrate/unknowns.h"

#include "core/memory.h"
#include "model/force.h"

#include <string.h>

static int32_t list_free(const hooke_system *system, struct hooke_unknowns *u) {
  u->free = hooke_new(u->free_count, sizeof *u->free);
  if (u->free == NULL) return HOOKE_NO_MEMORY;
  for (int64_t p = 0, k = 0; p < system->particle_count; p++) {
    if (!system->held[p]) u->free[k++] = (int32_t)p;
  }
  return HOOKE_OK;
}

int32_t hooke_unknowns_create(hooke_integrator *it, int32_t products, struct hooke_unknowns *u) {
  *u = (struct hooke_unknowns){.size = it->size};
  if (it->rate) return HOOKE_OK;
  u->free_count = it->system->particle_count - it->system->held_count;
  u->size = u->free_count > 0 ? 6 * u->free_count : 1;
  if (it->system->held_count > 0 && list_free(it->system, u) != HOOKE_OK) return HOOKE_NO_MEMORY;
  if (!products) return HOOKE_OK;
  u->rows = hooke_new(5 * it->size, sizeof(double));
  it->own_memory += 5 * it->size * (int64_t)sizeof(double);
  return u->rows ? HOOKE_OK : HOOKE_NO_MEMORY;
}

void hooke_unknowns_release(struct hooke_unknowns *u) {
  hooke_free(u->free);
  hooke_free(u->rows);
  *u = (struct hooke_unknowns){0};
}

void hooke_unknowns_tolerance(const hooke_integrator *it, const struct hooke_unknowns *u, double *tolerance) {
  const double position = hooke_options_number(it->options, "atol");
  const double velocity = hooke_options_number(it->options, "atol_velocity");
  for (int64_t k = 0; k < u->size; k++)
    tolerance[k] = it->rate || k < 3 * u->free_count ? position : velocity;
}

/* ---- between y and rows of all particles; held ones keep what the rows have ---- */

static void pack(const struct hooke_unknowns *u, const double *q, const double *v, double *y) {
  const int64_t m = u->free_count;
  if (u->free == NULL) {
    memcpy(y, q, (size_t)(3 * m) * sizeof(double));
    memcpy(y + 3 * m, v, (size_t)(3 * m) * sizeof(double));
    return;
  }
  for (int64_t k = 0; k < m; k++) {
    memcpy(y + 3 * k, q + 3 * (int64_t)u->free[k], 3 * sizeof(double));
    memcpy(y + 3 * (m + k), v + 3 * (int64_t)u->free[k], 3 * sizeof(double));
  }
}

static void unpack(const struct hooke_unknowns *u, const double *y, double *q, double *v) {
  const int64_t m = u->free_count;
  if (u->free == NULL) {
    memcpy(q, y, (size_t)(3 * m) * sizeof(double));
    memcpy(v, y + 3 * m, (size_t)(3 * m) * sizeof(double));
    return;
  }
  for (int64_t k = 0; k < m; k++) {
    memcpy(q + 3 * (int64_t)u->free[k], y + 3 * k, 3 * sizeof(double));
    memcpy(v + 3 * (int64_t)u->free[k], y + 3 * (m + k), 3 * sizeof(double));
  }
}

void hooke_unknowns_load(hooke_integrator *it, const struct hooke_unknowns *u, const hooke_state *state,
                         double *y) {
  if (it->rate) {
    memcpy(y, state->q, (size_t)it->size * sizeof(double));
    return;
  }
  y[0] = 0.0; /* stays where nothing is free */
  hooke_motion_load(it->system, it->motion, state->q, state->v);
  pack(u, state->q, state->v, y);
}

int32_t hooke_unknowns_store(hooke_integrator *it, const struct hooke_unknowns *u, double t, const double *y,
                             hooke_state *state) {
  *state->t = t;
  if (it->rate) {
    memcpy(state->q, y, (size_t)it->size * sizeof(double));
    return HOOKE_OK;
  }
  const int32_t status = hooke_integrator_hold(it, t);
  hooke_motion_store(it->motion, state->q, state->v);
  unpack(u, y, state->q, state->v);
  return status;
}

/* ---- the right-hand side ---- */

/* Puts y and the held particles of time t into the working copy. */
static int32_t place(hooke_integrator *it, const struct hooke_unknowns *u, double t, const double *y) {
  struct hooke_motion *motion = it->motion;
  const int64_t m = u->free_count;
  if (u->free == NULL) {
    hooke_components_from_rows(m, y, motion->q);
    hooke_components_from_rows(m, y + 3 * m, motion->v);
    return HOOKE_OK;
  }
  for (int a = 0; a < 3; a++) {
    for (int64_t k = 0; k < m; k++) {
      motion->q[a][u->free[k]] = y[3 * k + a];
      motion->v[a][u->free[k]] = y[3 * (m + k) + a];
    }
  }
  return hooke_integrator_hold(it, t);
}

/* v' of the free particles; 0 times their sum tells whether all are finite. */
static double accelerations(const hooke_integrator *it, const struct hooke_unknowns *u, double *out) {
  const hooke_system *system = it->system;
  double sum = 0.0;
  for (int64_t k = 0; k < u->free_count; k++) {
    const int64_t p = u->free ? u->free[k] : k;
    for (int a = 0; a < 3; a++) {
      const double force = system->inverse_mass[p] * it->motion->f[a][p];
      out[3 * k + a] = system->has_gravity ? force + system->gravity[a] : force;
      sum += 0.0 * out[3 * k + a];
    }
  }
  return sum;
}

static int first_order_slope(hooke_integrator *it, double t, const double *x, double *slope) {
  if (hooke_integrator_rate(it, t, x, slope) != HOOKE_OK) return HOOKE_SLOPE_STOPPED;
  double sum = 0.0;
  for (int64_t k = 0; k < it->size; k++)
    sum += 0.0 * slope[k];
  return sum == 0.0 ? HOOKE_SLOPE_FINE : HOOKE_SLOPE_NOT_FINITE;
}

int hooke_unknowns_slope(hooke_integrator *it, const struct hooke_unknowns *u, double t, const double *y,
                         double *slope) {
  /* a solver may take a stop for a reason to try a smaller step */
  if (it->stop_value != 0) return HOOKE_SLOPE_STOPPED;
  if (it->rate) return first_order_slope(it, t, y, slope);
  if (u->free_count == 0) {
    slope[0] = 0.0;
    return HOOKE_SLOPE_FINE;
  }
  if (place(it, u, t, y) != HOOKE_OK || hooke_integrator_forces(it, t) != HOOKE_OK)
    return HOOKE_SLOPE_STOPPED;
  const int64_t m = u->free_count;
  memcpy(slope, y + 3 * m, (size_t)(3 * m) * sizeof(double));
  return accelerations(it, u, slope + 3 * m) == 0.0 ? HOOKE_SLOPE_FINE : HOOKE_SLOPE_NOT_FINITE;
}

/* ---- its derivative ---- */

int hooke_unknowns_linearise(hooke_integrator *it, const struct hooke_unknowns *u, double t,
                             const double *y) {
  if (u->free_count == 0) return HOOKE_SLOPE_FINE;
  if (place(it, u, t, y) != HOOKE_OK) return HOOKE_SLOPE_STOPPED;
  hooke_motion_store(it->motion, u->rows, u->rows + it->size);
  return HOOKE_SLOPE_FINE;
}

int hooke_unknowns_product(hooke_integrator *it, const struct hooke_unknowns *u, double t,
                           const double *direction, double *product) {
  if (u->free_count == 0) {
    product[0] = 0.0;
    return HOOKE_SLOPE_FINE;
  }
  double *q = u->rows, *v = q + it->size, *dq = v + it->size, *dv = dq + it->size, *out = dv + it->size;
  unpack(u, direction, dq, dv); /* held particles: zero from the start */
  it->count.derivative_products++;
  int32_t stop_value = 0;
  const struct hooke_point point = {t, q, v, dq, dv, &stop_value};
  if (hooke_forces_product(it->system, &point, NULL, out) != HOOKE_OK) {
    it->stop_value = stop_value;
    return HOOKE_SLOPE_STOPPED;
  }
  const int64_t m = u->free_count;
  memcpy(product, direction + 3 * m, (size_t)(3 * m) * sizeof(double));
  for (int64_t k = 0; k < m; k++) {
    const int64_t p = u->free ? u->free[k] : k;
    for (int a = 0; a < 3; a++)
      product[3 * (m + k) + a] = it->system->inverse_mass[p] * out[3 * p + a];
  }
  return HOOKE_SLOPE_FINE;
}
