#include "model/start.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"
#include "model/variant/variant.h"

#include <string.h>

void hk_start_release(struct hk_start *start) {
  hk_free(start->position);
  hk_free(start->velocity);
  hk_free(start->undeformed);
  *start = (struct hk_start){.count = 0};
}

static double *copy_rows(int64_t count, const double *rows) {
  double *copy = hk_new(3 * count, sizeof *copy);
  if (copy && count > 0) memcpy(copy, rows, (size_t)(3 * count) * sizeof *copy);
  return copy;
}

int32_t hooke_system_start_at(hooke_system *system, int64_t count, const double *position,
                              const double *velocity) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK && count < 1)
    status = hk_fail(HOOKE_BAD_VALUE, "count", "%lld is not allowed; one place for each particle is",
                     (long long)count);
  if (status == HOOKE_OK) status = hk_require_finite("start.position", count, 3, position);
  if (status == HOOKE_OK && velocity) status = hk_require_finite("start.velocity", count, 3, velocity);
  if (status != HOOKE_OK) return status;
  struct hk_start start = {.count = count, .position = copy_rows(count, position)};
  if (velocity) start.velocity = copy_rows(count, velocity);
  if (start.position == NULL || (velocity && start.velocity == NULL)) {
    hk_start_release(&start);
    return HOOKE_NO_MEMORY;
  }
  hk_start_release(&system->rest->start);
  system->rest->start = start;
  return HOOKE_OK;
}

int32_t hk_start_check(hooke_system *system) {
  const struct hk_start *start = &system->rest->start;
  const int64_t n = system->particle_count;
  if (start->count == 0) return HOOKE_OK;
  if (start->count != n)
    return hk_fail(HOOKE_BAD_VALUE, "start.position", "%lld places for %lld particles; allowed: one for each",
                   (long long)start->count, (long long)n);
  for (int64_t k = 0; k < 3 * n; k++) {
    if (system->constrained[k / 3] != HOOKE_IS_PINNED || start->position[k] == system->position[k]) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL,
            "particle %lld is pinned at %.17g m, not at %.17g m; allowed: its own place", (long long)(k / 3),
            system->position[k], start->position[k]);
    return hk_fail_within(HOOKE_BAD_VALUE, "start.position[%lld][%d]", (long long)(k / 3), (int)(k % 3));
  }
  if (start->velocity) memcpy(system->velocity, start->velocity, (size_t)(3 * n) * sizeof(double));
  return HOOKE_OK;
}

void hk_start_commit(hooke_system *system) {
  struct hk_start *start = &system->rest->start;
  if (start->count == 0) return;
  start->undeformed = system->position;
  system->position = start->position;
  hk_free(start->velocity);
  start->position = start->velocity = NULL;
}

const double *hk_start_position(const hooke_system *system) {
  const double *start = system->rest->start.position;
  return start ? start : system->position;
}

const double *hk_undeformed_position(const hooke_system *system) {
  const double *undeformed = system->rest->start.undeformed;
  return undeformed ? undeformed : system->position;
}

int32_t hk_start_copy(const struct hk_variant_maker *maker) {
  const hooke_system *from = maker->from;
  const int64_t n = maker->made->particle_count;
  if (from->rest->start.undeformed == NULL) return HOOKE_OK;
  double *rows = hk_new(3 * n, sizeof *rows);
  int32_t status = rows ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < from->particle_count && status == HOOKE_OK; p++) {
    const int64_t to = maker->map->to[p];
    if (to < 0) continue;
    memcpy(rows + 3 * to, from->position + 3 * p, 3 * sizeof *rows);
    if (from->velocity) memcpy(maker->made->velocity + 3 * to, from->velocity + 3 * p, 3 * sizeof *rows);
    if (!hk_variant_is_same(maker->map, p))
      status = hk_fail(HOOKE_UNSUITED, NULL, "a start at other positions says nothing of particles between");
  }
  if (status == HOOKE_OK) status = hooke_system_start_at(maker->made, n, rows, NULL);
  hk_free(rows);
  return status;
}
