#include "model/generalized.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/state.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

/* ---- the callbacks, which are those of the caller ---- */

static int32_t call_force(int64_t n, double t, const double *q, const double *v, double *out, void *ctx) {
  (void)n;
  const struct hk_generalized *g = ctx;
  return g->force(g->size, t, q, v, out, g->ctx);
}

static int32_t call_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                            const double *dv, double *out, void *ctx) {
  (void)n;
  const struct hk_generalized *g = ctx;
  return g->product(g->size, t, q, v, dq, dv, out, g->ctx);
}

static int32_t call_rate(int64_t n, double t, const double *q, const double *v, double *out, void *ctx) {
  (void)n;
  (void)v;
  const struct hk_generalized *g = ctx;
  return g->rate(g->size, t, q, out, g->ctx);
}

/* ---- making ---- */

static int32_t check_masses(int64_t size, int64_t mass_count, const double *inverse_mass) {
  if (mass_count != 1 && mass_count != size) {
    return hk_fail(HOOKE_BAD_VALUE, "inverse_mass",
                   "%lld for %lld coordinates; allowed: one, or one for each", (long long)mass_count,
                   (long long)size);
  }
  for (int64_t k = 0; k < mass_count; k++) {
    if (inverse_mass[k] > 0.0 && isfinite(inverse_mass[k])) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; a number > 0 is", inverse_mass[k]);
    return hk_fail_within(HOOKE_BAD_VALUE, "inverse_mass[%lld]", (long long)k);
  }
  return HOOKE_OK;
}

/* Of `kept`, which the system owns from here on. */
static int32_t add_coordinates(hooke_system *system, struct hk_generalized *kept, const hooke_state *start) {
  const int64_t particles = (kept->size + 2) / 3;
  const size_t bytes = (size_t)kept->size * sizeof(double);
  const double mass = 1.0;
  double *q = hk_new(6 * particles, sizeof(double)), *v = q + 3 * particles;
  system->generalized = kept;
  if (q == NULL) return HOOKE_NO_MEMORY;
  if (start) memcpy(q, start->q, bytes);
  if (start && start->has_v) memcpy(v, start->v, bytes);
  int32_t status = hooke_system_set_dynamics(system, kept->rate ? "overdamped" : "inertial");
  if (status == HOOKE_OK) status = hooke_system_add_particles(system, particles, q, v, 1, &mass, NULL);
  if (status == HOOKE_OK && kept->rate) status = hooke_system_set_drag(system, 1.0);
  if (status == HOOKE_OK)
    status = hooke_system_set_force(system, kept->rate ? call_rate : call_force,
                                    kept->product ? call_product : NULL, kept);
  system->force_scale = kept->inverse_mass;
  hk_free(q);
  return status == HOOKE_OK ? hooke_system_commit(system) : status;
}

static int32_t create(struct hk_generalized given, int64_t mass_count, const double *inverse_mass,
                      const hooke_state *start, hooke_system **out) {
  hooke_system *system = NULL;
  struct hk_generalized *kept = hk_new(1, sizeof *kept);
  if (kept == NULL) return HOOKE_NO_MEMORY;
  *kept = given;
  if (inverse_mass) kept->inverse_mass = hk_new((given.size + 2) / 3 * 3, sizeof(double));
  for (int64_t k = 0; k < given.size && kept->inverse_mass; k++)
    kept->inverse_mass[k] = inverse_mass[mass_count == 1 ? 0 : k];
  int32_t status = inverse_mass && kept->inverse_mass == NULL ? HOOKE_NO_MEMORY : HOOKE_OK;
  if (status == HOOKE_OK) status = hooke_system_create(&system);
  if (status != HOOKE_OK) {
    hk_generalized_destroy(kept);
    return status;
  }
  status = add_coordinates(system, kept, start);
  return HOOKE_HAND_OVER(status, system, out, hooke_system_destroy);
}

int32_t hk_generalized_create(int64_t size, hooke_force *force, hooke_force_product *product, void *ctx,
                              int64_t mass_count, const double *inverse_mass, const hooke_state *start,
                              hooke_system **system) {
  int32_t status = hk_size_check(size, 13); /* its mass, and a third of what a particle needs */
  if (status == HOOKE_OK) status = check_masses(size, mass_count, inverse_mass);
  if (status != HOOKE_OK) return status;
  const struct hk_generalized given = {.size = size, .force = force, .product = product, .ctx = ctx};
  return create(given, mass_count, inverse_mass, start, system);
}

static int32_t check_start(const hooke_state *start, int32_t has_v) {
  const int64_t size = hooke_state_size(start);
  int32_t status = hk_state_check(start, size, has_v);
  if (status == HOOKE_OK && *start->t != 0.0)
    status = hk_fail(HOOKE_BAD_VALUE, "start", "a start at t = %g s is not allowed; t = 0 is", *start->t);
  if (status == HOOKE_OK) status = hk_require_finite(has_v ? "start.q" : "start.x", size, 1, start->q);
  return status == HOOKE_OK && has_v ? hk_require_finite("start.v", size, 1, start->v) : status;
}

int32_t hooke_system_create_second_order(hooke_force *force, hooke_force_product *product, void *ctx,
                                         int64_t mass_count, const double *inverse_mass,
                                         const hooke_state *start, hooke_system **system) {
  const int32_t status = check_start(start, 1);
  if (status != HOOKE_OK) return status;
  return hk_generalized_create(hooke_state_size(start), force, product, ctx, mass_count, inverse_mass, start,
                               system);
}

int32_t hooke_system_create_first_order(hooke_rate *rate, void *ctx, const hooke_state *start,
                                        hooke_system **system) {
  const int64_t size = hooke_state_size(start);
  int32_t status = check_start(start, 0);
  if (status == HOOKE_OK) status = hk_size_check(size, 13);
  if (status != HOOKE_OK) return status;
  return create((struct hk_generalized){.size = size, .rate = rate, .ctx = ctx}, 0, NULL, start, system);
}

void hk_generalized_destroy(struct hk_generalized *generalized) {
  if (generalized) hk_free(generalized->inverse_mass);
  hk_free(generalized);
}

/* ---- asking ---- */

int32_t hk_is_first_order(const hooke_system *system) {
  return system->generalized && system->generalized->rate;
}

int64_t hk_system_numbers(const hooke_system *system) {
  return system->generalized ? system->generalized->size : 3 * system->particle_count;
}

const char *hk_metres(const hooke_system *system) {
  return system->generalized ? "" : " m";
}

int32_t hk_system_require_scene(const hooke_system *system, const char *place, const char *what) {
  if (system->generalized == NULL) return HOOKE_OK;
  return hk_fail(HOOKE_UNSUITED, place, "%sneeds particles, and this is a %s-order problem", what,
                 hk_is_first_order(system) ? "first" : "second");
}
