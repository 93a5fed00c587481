/* What calls require of a system. */
#include "model/system.h"

#include "core/status.h"

#include <math.h>

int32_t hk_system_require_open(const hooke_system *system) {
  if (!system->rest->committed) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_CALL, NULL,
                 "the system is committed and can no longer be changed; build a new one");
}

int32_t hk_system_require_committed(const hooke_system *system) {
  if (system->rest->committed) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_CALL, NULL, "the system is not committed yet; call hooke_system_commit() first");
}

int32_t hk_require_finite(const char *where, int64_t rows, int32_t columns, const double *value) {
  for (int64_t k = 0; k < rows * columns; k++) {
    if (isfinite(value[k])) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; a finite number is", value[k]);
    if (columns > 1) hk_fail_within(HOOKE_BAD_VALUE, "[%d]", (int)(k % columns));
    if (rows > 1 || columns > 1) hk_fail_within(HOOKE_BAD_VALUE, "[%lld]", (long long)(k / columns));
    return hk_fail_within(HOOKE_BAD_VALUE, "%s", where);
  }
  return HOOKE_OK;
}

int32_t hk_system_check_particles(const hooke_system *system, const char *place, int64_t count,
                                  const int64_t *particles, int32_t refused) {
  for (int64_t k = 0; k < count; k++) {
    const int64_t p = particles[k];
    if (p < 0 || p >= system->particle_count) {
      hk_fail_index(NULL, "there is no particle", (double)p, system->particle_count);
    } else if (system->constrained[p] & refused) {
      hk_fail(HOOKE_BAD_VALUE, NULL,
              "particle %lld is already %s; a particle is pinned or driven, and driven once", (long long)p,
              system->constrained[p] == HOOKE_IS_PINNED ? "pinned" : "driven");
    } else {
      continue;
    }
    return hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld]", place, (long long)k);
  }
  return HOOKE_OK;
}
