#include "measure/trial/balance.h"

#include "core/memory.h"
#include "model/force/force.h"
#include "model/particles.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double FACTOR = 4.0; /* twice the first-order value */

static double largest_energy(const hooke_system *system, double t, const double *q, const double *v) {
  double sum = fabs(hooke_system_energy(system, "kinetic", NULL, v));
  for (int64_t k = 0; hooke_system_force_name(system, k); k++) {
    const double energy = hooke_system_energy_at(system, hooke_system_force_name(system, k), t, q, NULL);
    if (!isnan(energy)) sum += fabs(energy); /* drag and callbacks have none */
  }
  return sum;
}

/* Adds the power of the callback, in rows that it may keep. */
static int32_t call_force(struct hk_balance *balance, const hooke_state *state, double *in) {
  const hooke_system *system = balance->system;
  const int64_t size = 3 * system->particle_count;
  if (hk_rows_renew(3 * size, &balance->rows) != HOOKE_OK) return HOOKE_NO_MEMORY;
  double *q = balance->rows, *v = q + size, *f = v + size;
  memcpy(q, hooke_state_position(state), (size_t)size * sizeof *q);
  memcpy(v, hooke_state_velocity(state), (size_t)size * sizeof *v);
  memset(f, 0, (size_t)size * sizeof *f);
  if (system->force(system->particle_count, hooke_state_time(state), q, v, f, system->force_ctx) != 0)
    return HOOKE_STOPPED;
  for (int64_t k = 0; k < size; k++)
    *in += f[k] * v[k];
  return HOOKE_OK;
}

/* Power of drives and of what else does work from outside, and dissipated power, at a state. */
static int32_t find_powers(struct hk_balance *balance, const hooke_state *state, double *in, double *out) {
  const hooke_system *system = balance->system;
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  *out = balance->dissipated_power(system, hooke_state_time(state), q, v);
  *in = hk_forces_power(system, hooke_state_time(state), q, v);
  if (balance->force == NULL) return HOOKE_OK;
  const int32_t called = system->force ? call_force(balance, state, in) : HOOKE_OK;
  if (called != HOOKE_OK) return called;
  const int32_t status = hooke_system_force(system, hooke_state_time(state), q, v, balance->force);
  for (int64_t p = 0; status == HOOKE_OK && p < system->particle_count; p++) {
    if (system->constrained[p] != HOOKE_IS_DRIVEN) continue;
    for (int a = 0; a < 3; a++)
      *in -= balance->force[3 * p + a] * v[3 * p + a];
  }
  return status;
}

int32_t hk_balance_begin(struct hk_balance *balance, const hooke_system *system, const hooke_state *state) {
  *balance = (struct hk_balance){.system = system, .dissipated_power = hooke_system_dissipated_power_at};
  if (system->drive_count > 0 || system->force) {
    balance->force = hk_new(3 * system->particle_count, sizeof(double));
    balance->rows = hk_rows_new(9 * system->particle_count);
    if (balance->force == NULL || balance->rows == NULL) return HOOKE_NO_MEMORY;
  }
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  balance->time = hooke_state_time(state);
  balance->energy = hooke_system_energy_at(system, "total", balance->time, q, v);
  balance->scale = largest_energy(system, balance->time, q, v);
  return find_powers(balance, state, &balance->power_in, &balance->power_out);
}

int32_t hk_balance_step(struct hk_balance *balance, const hooke_state *state) {
  double in, out;
  const int32_t status = find_powers(balance, state, &in, &out);
  const double step = hooke_state_time(state) - balance->time;
  if (status != HOOKE_OK || step == 0.0) return status;
  balance->work += 0.5 * step * (balance->power_in + in);
  balance->heat += 0.5 * step * (balance->power_out + out);
  balance->power_in = in;
  balance->power_out = out;
  balance->time = hooke_state_time(state);
  balance->points++;
  return HOOKE_OK;
}

void hk_balance_close(struct hk_balance *balance, const hooke_state *state) {
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const double t = hooke_state_time(state);
  const double energy = hooke_system_energy_at(balance->system, "total", t, q, v);
  balance->residual = ((energy - balance->energy) - balance->work) + balance->heat;
  balance->scale = fmax(balance->scale, largest_energy(balance->system, t, q, v));
  balance->scale = fmax(balance->scale, fabs(balance->work) + balance->heat);
}

void hk_balance_release(struct hk_balance *balance) {
  hk_free(balance->force);
  hooke_rows_hold(balance->rows, -1);
  balance->force = balance->rows = NULL;
}

double hk_balance_floor(const struct hk_balance *balance) {
  return 8.0 * DBL_EPSILON * (double)(balance->points + 8) * balance->scale;
}

int32_t hk_balance_holds(int64_t count, const double *coarse, const double *fine, double floor,
                         double *largest, double *bound) {
  double difference = 0.0;
  *largest = 0.0;
  for (int64_t k = 0; k < count; k++) {
    *largest = fmax(*largest, fabs(coarse[k]));
    difference = fmax(difference, fabs(coarse[k] - fine[k]));
  }
  *bound = FACTOR * difference + floor;
  return *largest <= *bound;
}
