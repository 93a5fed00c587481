/* Questions to the groups of each force. */
#include "model/force/force.h"

#include <stddef.h>

static const char *name_of(const hooke_system *system, const struct hk_force_row *force, int64_t group) {
  const struct hk_group *found = hk_system_group(system, force, group);
  return found ? found->name : NULL;
}

static int64_t size_of(const hooke_system *system, const struct hk_force_row *force, int64_t group) {
  const struct hk_group *found = hk_system_group(system, force, group);
  return found ? found->count : 0;
}

int64_t hooke_system_spring_count(const hooke_system *system) {
  return hk_system_members_of(system, &hk_force_springs);
}

int64_t hooke_system_group_count(const hooke_system *system) {
  return hk_system_groups_of(system, &hk_force_springs);
}

const char *hooke_system_group_name(const hooke_system *system, int64_t group) {
  return name_of(system, &hk_force_springs, group);
}

int64_t hooke_system_group_size(const hooke_system *system, int64_t group) {
  return size_of(system, &hk_force_springs, group);
}

int64_t hooke_system_bending_count(const hooke_system *system) {
  return hk_system_members_of(system, &hk_force_bending);
}

int64_t hooke_system_bending_group_count(const hooke_system *system) {
  return hk_system_groups_of(system, &hk_force_bending);
}

const char *hooke_system_bending_group_name(const hooke_system *system, int64_t group) {
  return name_of(system, &hk_force_bending, group);
}

int64_t hooke_system_bending_group_size(const hooke_system *system, int64_t group) {
  return size_of(system, &hk_force_bending, group);
}

int64_t hooke_system_altitude_count(const hooke_system *system) {
  return hk_system_members_of(system, &hk_force_altitude);
}

int64_t hooke_system_altitude_group_count(const hooke_system *system) {
  return hk_system_groups_of(system, &hk_force_altitude);
}

const char *hooke_system_altitude_group_name(const hooke_system *system, int64_t group) {
  return name_of(system, &hk_force_altitude, group);
}

int64_t hooke_system_altitude_group_size(const hooke_system *system, int64_t group) {
  return size_of(system, &hk_force_altitude, group);
}
