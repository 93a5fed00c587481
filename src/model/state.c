#include "model/state.h"

#include "core/handle.h"
#include "core/memory.h"
#include "core/status.h"
#include "model/force/drive.h"
#include "model/force/force.h"
#include "model/generalized.h"
#include "model/system.h"

#include <string.h>

int32_t hk_state_create_sized(int64_t numbers, int32_t has_v, hooke_state **out) {
  const int64_t padding = has_v ? (3 - numbers % 3) % 3 : 0, size = numbers + padding;
  hooke_state *state = hk_handle_new("hooke_state", sizeof *state);
  double *block = hk_new(1 + (has_v ? 2 : 1) * size, sizeof(double));
  if (state == NULL || block == NULL) {
    hk_handle_free(state);
    hk_free(block);
    return HOOKE_NO_MEMORY;
  }
  *state = (hooke_state){.size = size, .padding = padding, .has_v = has_v, .t = block, .q = block + 1};
  state->v = has_v ? block + 1 + size : NULL;
  *out = state;
  return HOOKE_OK;
}

int32_t hk_state_check(const hooke_state *state, int64_t numbers, int32_t has_v) {
  const int64_t has = hooke_state_size(state);
  if (has == numbers && state->has_v == has_v) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "state", "a state of %lld numbers does not fit a problem of %lld%s",
                 (long long)has, (long long)numbers,
                 state->has_v == has_v ? ""
                 : has_v               ? " with velocities"
                                       : " without velocities");
}

int32_t hk_state_check_system(const hooke_state *state, const hooke_system *system) {
  return hk_state_check(state, hk_system_numbers(system), 1);
}

/* Moves driven particles to their prescribed positions at t = 0. */
static int32_t place_driven(const hooke_system *system, hooke_state *state) {
  for (int64_t g = 0; g < system->drive_count; g++) {
    const struct hk_drive_group *drive = &system->drive[g];
    double *q = hk_rows_new(6 * drive->count);
    if (q == NULL) return HOOKE_NO_MEMORY;
    double *v = q + 3 * drive->count;
    const int32_t value = hk_drive_evaluate(drive, 0.0, q, v);
    for (int64_t k = 0; k < drive->count && value == 0; k++) {
      memcpy(state->q + 3 * (int64_t)drive->particle[k], q + 3 * k, 3 * sizeof(double));
      memcpy(state->v + 3 * (int64_t)drive->particle[k], v + 3 * k, 3 * sizeof(double));
    }
    hooke_rows_hold(q, -1);
    if (value != 0) return hk_fail(HOOKE_STOPPED, NULL, "a drive callback returned %d at t = 0", (int)value);
  }
  return HOOKE_OK;
}

int32_t hooke_state_create(const hooke_system *system, hooke_state **out) {
  hooke_state *state = NULL;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_state_create_sized(hk_system_numbers(system), 1, &state);
  if (status != HOOKE_OK) return status;
  if (system->particle_count > 0) {
    const size_t bytes = (size_t)state->size * sizeof(double);
    memcpy(state->q, system->position, bytes);
    if (system->velocity) memcpy(state->v, system->velocity, bytes); /* otherwise zeros, as allocated */
  }
  status = place_driven(system, state);
  return HOOKE_HAND_OVER(status, state, out, hooke_state_destroy);
}

int32_t hooke_state_create_first_order(int64_t size, hooke_state **state) {
  const int32_t status = hk_size_check(size, 1);
  return status == HOOKE_OK ? hk_state_create_sized(size, 0, state) : status;
}

int32_t hooke_state_create_second_order(int64_t size, hooke_state **state) {
  const int32_t status = hk_size_check(size, 2);
  return status == HOOKE_OK ? hk_state_create_sized(size, 1, state) : status;
}

void hooke_state_destroy(hooke_state *state) {
  if (state == NULL) return;
  hk_free(state->t);
  hk_handle_free(state);
}

int32_t hooke_state_copy(const hooke_state *from, hooke_state *to) {
  const int32_t status = hk_state_check(to, hooke_state_size(from), from->has_v);
  if (status != HOOKE_OK) return status;
  memcpy(to->t, from->t, (size_t)(1 + (from->has_v ? 2 : 1) * from->size) * sizeof(double));
  return HOOKE_OK;
}

double hooke_state_time(const hooke_state *state) {
  return *state->t;
}

void hooke_state_set_time(hooke_state *state, double t) {
  *state->t = t;
}

int64_t hooke_state_size(const hooke_state *state) {
  return state->size - state->padding;
}

double *hooke_state_position(const hooke_state *state) {
  return state->q;
}

double *hooke_state_velocity(const hooke_state *state) {
  return state->v;
}
