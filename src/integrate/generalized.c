#include "integrate/generalized.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/particles.h"
#include "model/size_limit.h"

#include <math.h>
#include <stddef.h>

/* ---- the callbacks of the system: those of the caller ---- */

static int32_t force(int64_t n, double t, const double *q, const double *v, double *out, void *ctx) {
  (void)n;
  const struct hk_generalized *c = ctx;
  return c->force(c->size, t, q, v, out, c->ctx);
}

static int32_t product(int64_t n, double t, const double *q, const double *v, const double *dq,
                       const double *dv, double *out, void *ctx) {
  (void)n;
  const struct hk_generalized *c = ctx;
  return c->product(c->size, t, q, v, dq, dv, out, c->ctx);
}

/* ---- making ---- */

static int32_t check(int64_t size, int64_t mass_count, const double *inverse_mass) {
  const int32_t status = hk_size_check(size, 13); /* its mass, and a third of what a particle needs */
  if (status != HOOKE_OK) return status;
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

static int32_t make_system(struct hk_generalized *c) {
  const int64_t particles = (c->size + 2) / 3;
  const double mass = 1.0;
  double *zeros = hk_new(3 * particles, sizeof(double));
  int32_t status = zeros ? hooke_system_create(&c->system) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK)
    status = hooke_system_add_particles(c->system, particles, zeros, NULL, 1, &mass, NULL);
  if (status == HOOKE_OK) status = hooke_system_set_force(c->system, force, c->product ? product : NULL, c);
  if (status == HOOKE_OK) c->system->force_scale = c->inverse_mass;
  if (status == HOOKE_OK) status = hooke_system_commit(c->system);
  hk_free(zeros);
  return status;
}

int32_t hk_generalized_create(int64_t size, hooke_force *given, hooke_force_product *derivative, void *ctx,
                              int64_t mass_count, const double *inverse_mass, struct hk_generalized **out) {
  int32_t status = check(size, mass_count, inverse_mass);
  if (status != HOOKE_OK) return status;
  struct hk_generalized *c = hk_new(1, sizeof *c);
  if (c == NULL) return HOOKE_NO_MEMORY;
  *c = (struct hk_generalized){.size = size, .force = given, .product = derivative, .ctx = ctx};
  c->inverse_mass = hk_new((size + 2) / 3 * 3, sizeof(double));
  for (int64_t k = 0; k < size && c->inverse_mass; k++)
    c->inverse_mass[k] = inverse_mass[mass_count == 1 ? 0 : k];
  status = c->inverse_mass ? make_system(c) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK)
    *out = c;
  else
    hk_generalized_destroy(c);
  return status;
}

void hk_generalized_destroy(struct hk_generalized *c) {
  if (c == NULL) return;
  hooke_system_destroy(c->system);
  hk_free(c->inverse_mass);
  hk_free(c);
}
