/* q' = v, v' = w f + g over the free particles, on one array. */
#include "integrate/solve/unknowns.h"

#include "core/memory.h"
#include "model/coordinates/coordinates.h"
#include "model/force/force.h"

#include <string.h>

static int is_alone(const hooke_system *system, int64_t particle) {
  return !system->constrained[particle] && !hk_is_carried(system, particle);
}

/* Finds the stretches, or counts them before there is a list. */
static void find_stretches(const hooke_system *system, struct hk_unknowns *u) {
  u->free_count = u->stretch_count = 0;
  for (int64_t p = 0, from = 0; p <= system->particle_count; p++) {
    if (p < system->particle_count && is_alone(system, p)) continue;
    if (p > from) {
      if (u->stretch)
        u->stretch[u->stretch_count] = (struct hk_stretch_of_free){from, u->free_count, p - from};
      u->stretch_count++;
      u->free_count += p - from;
    }
    from = p + 1;
  }
}

int32_t hk_unknowns_create(hooke_integrator *it, int32_t products, struct hk_unknowns *u) {
  *u = (struct hk_unknowns){.size = it->size};
  if (it->rate) return HOOKE_OK;
  find_stretches(it->system, u);
  u->stretch = hk_new(u->stretch_count, sizeof *u->stretch);
  if (u->stretch == NULL) return HOOKE_NO_MEMORY;
  find_stretches(it->system, u);
  u->has_v = !it->system->overdamped;
  u->size = (u->has_v ? 6 : 3) * u->free_count + it->system->own_count;
  if (u->size == 0) u->size = 1;
  if (it->system->mover_count > 0) {
    u->push = hk_new(HOOKE_PUSH * it->system->mover_count, sizeof(double));
    if (u->push == NULL) return HOOKE_NO_MEMORY;
  }
  if (!products || it->system->mover_count > 0 || u->free_count == 0) return HOOKE_OK;
  u->rows = hk_rows_new(5 * it->size);
  it->own_memory += 5 * it->size * (int64_t)sizeof(double);
  return u->rows ? HOOKE_OK : HOOKE_NO_MEMORY;
}

void hk_unknowns_release(struct hk_unknowns *u) {
  hk_free(u->stretch);
  hooke_rows_hold(u->rows, -1);
  hk_free(u->push);
  *u = (struct hk_unknowns){0};
}

void hk_unknowns_tolerance(const hooke_integrator *it, const struct hk_unknowns *u, double *tolerance) {
  const double position = hooke_options_number(it->options, "atol");
  const double velocity = hooke_options_number(it->options, "atol_velocity");
  for (int64_t k = 0; k < u->size; k++)
    tolerance[k] = it->rate || k < 3 * u->free_count ? position : velocity;
  if (it->system) hk_movers_tolerance(it->system, position, velocity, tolerance + 6 * u->free_count);
}

/* ---- between y and all particles ---- */

void hk_unknowns_gather(const struct hk_unknowns *u, const double *all, ptrdiff_t stride, double *some) {
  for (int a = 0; a < 3; a++) {
    for (int64_t k = 0; k < u->stretch_count; k++) {
      const struct hk_stretch_of_free *s = &u->stretch[k];
      memcpy(some + a * u->free_count + s->unknown, all + a * stride + s->particle,
             (size_t)s->count * sizeof(double));
    }
  }
}

void hk_unknowns_spread(const struct hk_unknowns *u, const double *some, double *all, ptrdiff_t stride) {
  for (int a = 0; a < 3; a++) {
    for (int64_t k = 0; k < u->stretch_count; k++) {
      const struct hk_stretch_of_free *s = &u->stretch[k];
      memcpy(all + a * stride + s->particle, some + a * u->free_count + s->unknown,
             (size_t)s->count * sizeof(double));
    }
  }
}

/* Rows of x y z of the free particles; others are unchanged. */
static void spread_to_rows(const struct hk_unknowns *u, const double *some, double *rows) {
  for (int64_t k = 0; k < u->stretch_count; k++) {
    const struct hk_stretch_of_free *s = &u->stretch[k];
    for (int64_t p = 0; p < s->count; p++) {
      for (int a = 0; a < 3; a++)
        rows[3 * (s->particle + p) + a] = some[a * u->free_count + s->unknown + p];
    }
  }
}

void hk_unknowns_load(hooke_integrator *it, const struct hk_unknowns *u, const hooke_state *state,
                      double *y) {
  if (it->rate) {
    memcpy(y, state->q, (size_t)it->size * sizeof(double));
    return;
  }
  y[0] = 0.0; /* the value if nothing is free */
  hk_motion_load(it->system, it->motion, state->q, state->v);
  const ptrdiff_t stride = hk_motion_stride(it->motion);
  hk_unknowns_gather(u, it->motion->q[0], stride, y);
  if (u->has_v) hk_unknowns_gather(u, it->motion->v[0], stride, y + 3 * u->free_count);
  hk_movers_read(it->system, it->motion, y + 6 * u->free_count);
}

int32_t hk_unknowns_store(hooke_integrator *it, const struct hk_unknowns *u, double t, const double *y,
                          hooke_state *state) {
  *state->t = t;
  if (it->rate) {
    memcpy(state->q, y, (size_t)it->size * sizeof(double));
    return HOOKE_OK;
  }
  int32_t status = hk_unknowns_place(it, u, t, y);
  if (status == HOOKE_OK) status = hk_integrator_flow(it, t);
  if (status == HOOKE_OK || u->has_v) hk_motion_store(it->motion, state->q, state->v);
  return status;
}

/* ---- the right-hand side ---- */

int32_t hk_unknowns_place(hooke_integrator *it, const struct hk_unknowns *u, double t, const double *y) {
  const ptrdiff_t stride = hk_motion_stride(it->motion);
  hk_unknowns_spread(u, y, it->motion->q[0], stride);
  if (u->has_v) hk_unknowns_spread(u, y + 3 * u->free_count, it->motion->v[0], stride);
  hk_movers_write(it->system, it->motion, y + 6 * u->free_count, 0);
  return hk_integrator_hold(it, t);
}

/* v' of the free particles from the forces of the working copy. */
static void find_accelerations(const hooke_integrator *it, const struct hk_unknowns *u, double *out) {
  const hooke_system *system = it->system;
  for (int a = 0; a < 3; a++) {
    const double g = system->fall[a];
    for (int64_t k = 0; k < u->stretch_count; k++) {
      const struct hk_stretch_of_free *s = &u->stretch[k];
      const double *w = system->inverse_mass + s->particle, *f = it->motion->f[a] + s->particle;
      double *to = out + a * u->free_count + s->unknown;
      const double *factor = system->gravity_factor ? system->gravity_factor + s->particle : NULL;
      for (int64_t p = 0; p < s->count; p++)
        to[p] = !system->falls ? w[p] * f[p] : factor ? w[p] * f[p] + factor[p] * g : w[p] * f[p] + g;
    }
  }
}

static int slope_is_finite(int64_t count, const double *slope) {
  return hk_all_finite(count, slope) ? HOOKE_SLOPE_FINE : HOOKE_SLOPE_NOT_FINITE;
}

int hk_unknowns_slope(hooke_integrator *it, const struct hk_unknowns *u, double t, const double *y,
                      double *slope) {
  /* a solver may interpret a stop as a reason to try a smaller step */
  if (it->stop_value != 0) return HOOKE_SLOPE_STOPPED;
  if (it->rate && hk_integrator_rate(it, t, y, slope) != HOOKE_OK) return HOOKE_SLOPE_STOPPED;
  if (it->rate) return slope_is_finite(it->size, slope);
  if (u->free_count == 0 && it->system->mover_count == 0) {
    slope[0] = 0.0;
    return HOOKE_SLOPE_FINE;
  }
  if (hk_unknowns_place(it, u, t, y) != HOOKE_OK || hk_integrator_forces(it, t) != HOOKE_OK)
    return HOOKE_SLOPE_STOPPED;
  const int64_t m = u->has_v ? u->free_count : 0;
  memcpy(slope, y + 3 * m, (size_t)(3 * m) * sizeof(double));
  const double *own = y + 6 * u->free_count;
  find_accelerations(it, u, slope + 3 * m);
  hk_movers_push(it->system, it->motion, own, u->push);
  hk_movers_slope(it->system, own, u->push, slope + 6 * u->free_count);
  return slope_is_finite(u->size - 3 * m, slope + 3 * m);
}

/* ---- its derivative ---- */

int hk_unknowns_linearise(hooke_integrator *it, const struct hk_unknowns *u, double t, const double *y) {
  if (hk_unknowns_place(it, u, t, y) != HOOKE_OK) return HOOKE_SLOPE_STOPPED;
  hk_motion_store(it->motion, u->rows, u->rows + it->size);
  return HOOKE_SLOPE_FINE;
}

int hk_unknowns_product(hooke_integrator *it, struct hk_unknowns *u, double t, const double *direction,
                        double *product) {
  double *dq = u->rows + 2 * it->size;
  const int64_t m = u->free_count;
  spread_to_rows(u, direction, dq); /* constrained particles: zero from the start */
  if (u->has_v) spread_to_rows(u, direction + 3 * m, dq + it->size);
  it->count.derivative_products++;
  int32_t stop_value = 0;
  if (hk_forces_product_in_rows(it->system, t, 0, &u->rows, &stop_value) != HOOKE_OK) {
    it->stop_value = stop_value;
    return HOOKE_SLOPE_STOPPED;
  }
  const double *out = u->rows + 4 * it->size;
  const int first = u->has_v ? 3 : 0;
  memcpy(product, direction + first * m, (size_t)(first * m) * sizeof(double));
  for (int64_t k = 0; k < u->stretch_count; k++) {
    const struct hk_stretch_of_free *s = &u->stretch[k];
    for (int64_t p = 0; p < s->count; p++) {
      for (int a = 0; a < 3; a++)
        product[(first + a) * m + s->unknown + p] =
            it->system->inverse_mass[s->particle + p] * out[3 * (s->particle + p) + a];
    }
  }
  return HOOKE_SLOPE_FINE;
}
