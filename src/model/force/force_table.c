/* The table of forces, and what follows from its rows alone. */
#include "model/system.h"

#include <string.h>

#define HOOKE_ADDRESS(name) &hk_force_##name,
static const struct hk_force_row *const table[HOOKE_FORCES] = {HOOKE_FORCE_ROWS(HOOKE_ADDRESS)};

const struct hk_force_row *hk_force_table(int32_t k) {
  return k >= 0 && k < HOOKE_FORCES ? table[k] : NULL;
}

int32_t hk_force_number(const struct hk_force_row *row) {
  int32_t k = 0;
  while (table[k] != row)
    k++;
  return k;
}

int64_t hk_force_count(const hooke_system *system, const struct hk_force_row *row) {
  return row->count ? row->count(system) : system->rest->member_count[hk_force_number(row)];
}

int32_t hk_force_is_present(const hooke_system *system, const struct hk_force_row *row) {
  return row->present ? row->present(system) : hk_force_count(system, row) > 0;
}

int32_t hk_force_is_damped(const hooke_system *system, const struct hk_force_row *row) {
  int32_t damped = row->damped && row->damped(system);
  for (int64_t g = 0; g < system->group_count; g++)
    damped |= system->group[g].force == row && system->group[g].damped;
  return damped;
}

int32_t hk_system_is_damped(const hooke_system *system, int32_t kinds) {
  int32_t damped = 0;
  for (int32_t k = 0; hk_force_table(k); k++)
    damped |= (kinds == 0 || table[k]->kind & kinds) && hk_force_is_damped(system, table[k]);
  return damped;
}

int32_t hk_system_has_dampers(const hooke_system *system) {
  int32_t damped = 0;
  for (int32_t k = 0; hk_force_table(k); k++)
    damped |= !table[k]->is_drag && hk_force_is_damped(system, table[k]);
  return damped;
}

int32_t hk_system_is_not_linear(const hooke_system *system) {
  int32_t found = system->rest->linear.of_velocities;
  for (int32_t k = 0; k < system->force_row_count; k++)
    found |= system->force_row[k]->not_linear && hk_force_is_damped(system, system->force_row[k]);
  return found;
}

void hk_forces_release(hooke_system *system) {
  memset(system->rest->member_count, 0, sizeof system->rest->member_count);
  for (int32_t k = 0; hk_force_table(k); k++) {
    if (table[k]->release) table[k]->release(system);
  }
}

int64_t hk_elements_of(const hooke_system *system, int32_t kinds) {
  int64_t count = 0;
  for (int32_t k = 0; hk_force_table(k); k++)
    count += table[k]->kind & kinds && hk_force_is_present(system, table[k])
                 ? hk_force_count(system, table[k])
                 : 0;
  return count;
}
