/* Queries of the groups of each force, and of their members. */
#include "core/status.h"
#include "model/system.h"

#include <string.h>

const struct hk_force_row *hk_force_find(const char *name) {
  for (int32_t k = 0; hk_force_table(k); k++) {
    if (strcmp(hk_force_table(k)->name, name) == 0) return hk_force_table(k);
  }
  return NULL;
}

static const struct hk_force_row *force_with_groups(const char *name) {
  const struct hk_force_row *force = hk_force_find(name);
  return force && force->member_particles > 0 ? force : NULL;
}

int64_t hooke_system_group_count(const hooke_system *system, const char *force) {
  const struct hk_force_row *found = force_with_groups(force);
  return found ? hk_system_groups_of(system, found) : -1;
}

const char *hooke_system_group_name(const hooke_system *system, const char *force, int64_t group) {
  const struct hk_force_row *found = force_with_groups(force);
  const struct hk_group *there = found ? hk_system_group(system, found, group) : NULL;
  return there ? there->name : NULL;
}

int64_t hooke_system_group_size(const hooke_system *system, const char *force, int64_t group) {
  const struct hk_force_row *found = force_with_groups(force);
  const struct hk_group *there = found ? hk_system_group(system, found, group) : NULL;
  return there ? there->count : 0;
}

int64_t hooke_member_particles(const char *force) {
  const struct hk_force_row *found = force_with_groups(force);
  return found ? found->member_particles : 0;
}

int32_t hooke_system_members(const hooke_system *system, const char *force, int64_t *particles,
                             double *stiffness, double *damping, double *rest_length) {
  const struct hk_force_row *found = force_with_groups(force);
  if (found == NULL) return hk_fail(HOOKE_BAD_VALUE, "force", "\"%.64s\" has no members", force);
  const int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  struct hk_members members = {particles, stiffness, damping, rest_length};
  found->list(system, &members);
  return HOOKE_OK;
}
