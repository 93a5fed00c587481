/* Energies, momentum and heat of a state: sums over the force table. */

#include "core/sum.h"
#include "model/state.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

/* An overdamped system has no inertia; v may be NULL, at rest. */
static double kinetic_energy(const hooke_system *system, const double *v) {
  struct hk_sum sum = {0.0, 0.0};
  if (system->overdamped || v == NULL) return 0.0;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->constrained[p]) continue;
    const double square = (v[3 * p] * v[3 * p] + v[3 * p + 1] * v[3 * p + 1]) + v[3 * p + 2] * v[3 * p + 2];
    hk_sum_add(&sum, 0.5 * system->mass[p] * square);
  }
  return hk_sum_value(&sum);
}

static int has_inertia(const hooke_system *system) {
  return system->rest->committed && !system->overdamped;
}

/* Of gamma (v - u). */
static double friction_heat(const hooke_system *system, double t, const double *v) {
  struct hk_sum sum = {0.0, 0.0};
  double wind[3];
  if (!system->overdamped) return 0.0;
  hk_wind_at(system, t, wind);
  for (int64_t k = 0; k < 3 * system->particle_count; k++) {
    const double w = v[k] - wind[k % 3];
    hk_sum_add(&sum, system->constrained[k / 3] ? 0.0 : system->inertia[k / 3] * w * w);
  }
  return hk_sum_value(&sum);
}

static void add_potentials(const hooke_system *system, double t, const double *q, struct hk_energies *sum) {
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    const double energy = row->energy ? row->energy(system, t, q) : 0.0;
    if (row->energy) sum->potential += energy;
    if (row->energy) *(row->elements ? &sum->elastic : &sum->gravity) += energy;
  }
}

struct hk_energies hk_state_energies(const hooke_state *state, const hooke_system *system) {
  if (state->known && state->known->system == system) return *state->known;
  struct hk_energies sum = {.system = system, .kinetic = kinetic_energy(system, state->v)};
  add_potentials(system, *state->t, state->q, &sum);
  return sum;
}

double hooke_system_energy(const hooke_system *system, const char *what, const double *q, const double *v) {
  return hooke_system_energy_at(system, what, 0.0, q, v);
}

double hooke_system_energy_at(const hooke_system *system, const char *what, double t, const double *q,
                              const double *v) {
  const int kinetic = strcmp(what, "kinetic") == 0, total = strcmp(what, "total") == 0;
  const int lacks = (kinetic ? v == NULL : q == NULL) || (total && v == NULL);
  if (!system->rest->committed || (lacks && system->particle_count > 0)) return NAN;
  if (kinetic) return kinetic_energy(system, v);
  if (total || strcmp(what, "potential") == 0) {
    struct hk_energies sum = {0};
    add_potentials(system, t, q, &sum);
    return total ? kinetic_energy(system, v) + sum.potential : sum.potential;
  }
  const struct hk_force_row *row = hk_force_find(what);
  if (row == NULL || row->energy == NULL) return NAN;
  return hk_force_is_present(system, row) ? row->energy(system, t, q) : 0.0;
}

static double heat_of(const hooke_system *system, const struct hk_force_row *row, double t, const double *q,
                      const double *v) {
  if (row->heat) return row->heat(system, t, q, v);
  if (row->elements == NULL || !hk_force_is_damped(system, row)) return 0.0;
  const double *const x[3] = {v, v + 1, v + 2};
  struct hk_sum sum = {0.0, 0.0};
  struct hk_elements at;
  hk_begin_elements(system, t, q, v, &at);
  at.only = row;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;)
    hk_sum_add(&sum, hk_element_energy(e, e->c_along / e->over, e->c_across / e->over, 3, x));
  return hk_sum_value(&sum);
}

double hooke_system_dissipated_power(const hooke_system *system, const double *q, const double *v) {
  return hooke_system_dissipated_power_at(system, 0.0, q, v);
}

double hooke_system_dissipated_power_at(const hooke_system *system, double t, const double *q,
                                        const double *v) {
  if (!system->rest->committed) return NAN;
  double sum = friction_heat(system, t, v);
  for (int32_t k = 0; k < system->force_row_count; k++)
    sum += heat_of(system, system->force_row[k], t, q, v);
  return sum;
}

int32_t hk_forces_do_work(const hooke_system *system) {
  int32_t some = 0;
  for (int32_t k = 0; k < system->force_row_count; k++)
    some |= system->force_row[k]->does_work && system->force_row[k]->does_work(system);
  return some;
}

int32_t hk_system_takes_work(const hooke_system *system) {
  return system->drive_count > 0 || hk_forces_do_work(system);
}

double hk_forces_power(const hooke_system *system, double t, const double *q, const double *v) {
  double sum = 0.0;
  for (int32_t k = 0; k < system->force_row_count; k++)
    sum += system->force_row[k]->power ? system->force_row[k]->power(system, t, q, v) : 0.0;
  return sum;
}

void hooke_system_momentum(const hooke_system *system, const double *v, double *momentum) {
  struct hk_sum sum[3] = {{0.0, 0.0}};
  for (int64_t p = 0; has_inertia(system) && p < system->particle_count; p++) {
    if (system->constrained[p]) continue;
    for (int a = 0; a < 3; a++)
      hk_sum_add(&sum[a], system->mass[p] * v[3 * p + a]);
  }
  for (int a = 0; a < 3; a++)
    momentum[a] = hk_sum_value(&sum[a]);
}

void hooke_system_angular_momentum(const hooke_system *system, const double *q, const double *v,
                                   double *angular_momentum) {
  struct hk_sum sum[3] = {{0.0, 0.0}};
  for (int64_t p = 0; has_inertia(system) && p < system->particle_count; p++) {
    if (system->constrained[p]) continue;
    const double *x = q + 3 * p, *u = v + 3 * p, m = system->mass[p];
    hk_sum_add(&sum[0], m * (x[1] * u[2] - x[2] * u[1]));
    hk_sum_add(&sum[1], m * (x[2] * u[0] - x[0] * u[2]));
    hk_sum_add(&sum[2], m * (x[0] * u[1] - x[1] * u[0]));
  }
  for (int a = 0; a < 3; a++)
    angular_momentum[a] = hk_sum_value(&sum[a]);
}
