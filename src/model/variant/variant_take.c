/* Some particles of a system, and all that acts on them alone. */
#include "model/variant/variant.h"

#include "core/status.h"
#include "model/callbacks.h"
#include "model/generalized.h"
#include "model/system.h"

#include <string.h>

static int32_t check_system(const hooke_system *system) {
  const int32_t called = hk_system_calls_back(system) | system->rest->called;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_system_require_scene(system, "system", "");
  if (status == HOOKE_OK && system->bodies->count > 0)
    status = hk_fail(HOOKE_UNSUITED, "system", "has the rigid body \"%.40s\"; a part of it takes none",
                     system->bodies->body[0].name);
  if (status == HOOKE_OK && called)
    status = hk_fail(HOOKE_UNSUITED, "system", "has callbacks (%s); a part of it takes none",
                     hk_callbacks_text(called));
  return status;
}

static int32_t check_ascending(int64_t count, const int64_t *particles) {
  if (count < 0)
    return hk_fail(HOOKE_BAD_VALUE, "count", "%lld is not allowed; 0 or more are", (long long)count);
  for (int64_t k = 1; k < count; k++) {
    if (particles[k] > particles[k - 1]) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "%lld after %lld; allowed: ascending numbers", (long long)particles[k],
            (long long)particles[k - 1]);
    return hk_fail_within(HOOKE_BAD_VALUE, "particles[%lld]", (long long)k);
  }
  return HOOKE_OK;
}

int32_t hooke_system_take(const hooke_system *system, int64_t count, const int64_t *particles,
                          hooke_system **taken) {
  struct hk_variant variant;
  struct hk_variant_map map;
  *taken = NULL;
  int32_t status = check_system(system);
  if (status == HOOKE_OK) status = hk_system_check_particles(system, "particles", count, particles, 0);
  if (status == HOOKE_OK) status = check_ascending(count, particles);
  if (status == HOOKE_OK) status = hk_variant_create(system, &variant);
  if (status != HOOKE_OK) return status;
  variant.loose = 1;
  memset(variant.particle, 1, (size_t)system->particle_count);
  for (int64_t k = 0; k < count; k++)
    variant.particle[particles[k]] = 0;
  status = hk_variant_make(system, &variant, taken, &map);
  if (status == HOOKE_OK) hk_variant_map_release(&map);
  hk_variant_release(&variant);
  return status;
}
