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

static const struct hk_group *find(const hooke_system *system, const char *force, int64_t group) {
  const struct hk_force_row *found = force_with_groups(force);
  return found ? hk_system_group(system, found, group) : NULL;
}

int64_t hooke_system_group_count(const hooke_system *system, const char *force) {
  const struct hk_force_row *found = force_with_groups(force);
  return found ? hk_system_groups_of(system, found) : -1;
}

const char *hooke_system_group_name(const hooke_system *system, const char *force, int64_t group) {
  const struct hk_group *there = find(system, force, group);
  return there ? there->name : NULL;
}

int64_t hooke_system_group_size(const hooke_system *system, const char *force, int64_t group) {
  const struct hk_group *there = find(system, force, group);
  return there ? there->count : 0;
}

int64_t hooke_member_particles(const char *force) {
  const struct hk_force_row *found = force_with_groups(force);
  return found ? found->member_particles : 0;
}

/* Numbers `what` of the members from `first` on, 0 where the force has none; `out` may be NULL. */
static void copy_numbers(const struct hk_group *columns, int what, int64_t first, double *out) {
  const int32_t own = columns->force->width[what], width = own > 0 ? own : 1;
  for (int64_t k = 0; k < width * columns->count && out; k++)
    out[width * first + k] = own > 0 ? columns->number[what][k] : 0.0;
}

/* Some members at a time, in columns that take no memory. */
static void list(const hooke_system *system, const struct hk_force_row *force, int64_t *particles,
                 double *const number[3]) {
  enum { SOME = 64, WIDEST = 7 };
  int32_t particle[HOOKE_MEMBER_PARTICLES][SOME];
  double value[HOOKE_GROUP_NUMBERS][WIDEST * SOME];
  struct hk_group columns = {.force = force};
  for (int e = 0; e < HOOKE_MEMBER_PARTICLES; e++)
    columns.particle[e] = particle[e];
  for (int what = 0; what < HOOKE_GROUP_NUMBERS; what++)
    columns.number[what] = force->width[what] > 0 ? value[what] : NULL;
  const int64_t count = system->rest->member_count[hk_force_number(force)];
  const int32_t ends = force->member_particles;
  for (int64_t first = 0; first < count; first += SOME) {
    columns.count = count - first < SOME ? count - first : SOME;
    force->recall(system, first, &columns);
    for (int64_t k = 0; k < ends * columns.count && particles; k++)
      particles[ends * first + k] = particle[k % ends][k / ends];
    for (int what = 0; what < 3; what++)
      copy_numbers(&columns, what, first, number[what]);
  }
}

int32_t hooke_system_members(const hooke_system *system, const char *force, int64_t *particles,
                             double *stiffness, double *damping, double *rest_length) {
  const struct hk_force_row *found = force_with_groups(force);
  if (found == NULL) return hk_fail(HOOKE_BAD_VALUE, "force", "\"%.64s\" has no members", force);
  const int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  list(system, found, particles, (double *const[3]){stiffness, damping, rest_length});
  return HOOKE_OK;
}
