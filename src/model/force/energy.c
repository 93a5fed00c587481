/* Energies, momentum and heat of a state: sums over the force table. */
#include "model/force/force.h"

#include "core/sum.h"

#include <math.h>

double hooke_system_kinetic_energy(const hooke_system *system, const double *v) {
  if (!system->committed) return NAN;
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->held[p]) continue;
    const double square = (v[3 * p] * v[3 * p] + v[3 * p + 1] * v[3 * p + 1]) + v[3 * p + 2] * v[3 * p + 2];
    hk_sum_add(&sum, 0.5 * system->mass[p] * square);
  }
  return hk_sum_value(&sum);
}

static double energy_of(const hooke_system *system, const struct hk_force_row *row, const double *q) {
  if (!system->committed) return NAN;
  return row->present(system) ? row->energy(system, q) : 0.0;
}

double hooke_system_spring_energy(const hooke_system *system, const double *q) {
  return energy_of(system, &hk_force_springs, q);
}

double hooke_system_bending_energy(const hooke_system *system, const double *q) {
  return energy_of(system, &hk_force_bending, q);
}

double hooke_system_altitude_energy(const hooke_system *system, const double *q) {
  return energy_of(system, &hk_force_altitude, q);
}

double hooke_system_gravity_energy(const hooke_system *system, const double *q) {
  return energy_of(system, &hk_force_gravity, q);
}

double hooke_system_potential_energy(const hooke_system *system, const double *q) {
  if (!system->committed) return NAN;
  double sum = 0.0;
  for (int32_t k = 0; k < system->force_row_count; k++) {
    if (system->force_row[k]->energy) sum += system->force_row[k]->energy(system, q);
  }
  return sum;
}

double hooke_system_energy(const hooke_system *system, const double *q, const double *v) {
  return hooke_system_kinetic_energy(system, v) + hooke_system_potential_energy(system, q);
}

double hooke_system_dissipated_power(const hooke_system *system, const double *q, const double *v) {
  if (!system->committed) return NAN;
  double sum = 0.0;
  for (int32_t k = 0; k < system->force_row_count; k++) {
    if (system->force_row[k]->heat) sum += system->force_row[k]->heat(system, q, v);
  }
  return sum;
}

void hooke_system_momentum(const hooke_system *system, const double *v, double *momentum) {
  struct hk_sum sum[3] = {{0.0, 0.0}};
  for (int64_t p = 0; system->committed && p < system->particle_count; p++) {
    if (system->held[p]) continue;
    for (int a = 0; a < 3; a++)
      hk_sum_add(&sum[a], system->mass[p] * v[3 * p + a]);
  }
  for (int a = 0; a < 3; a++)
    momentum[a] = hk_sum_value(&sum[a]);
}

void hooke_system_angular_momentum(const hooke_system *system, const double *q, const double *v,
                                   double *angular_momentum) {
  struct hk_sum sum[3] = {{0.0, 0.0}};
  for (int64_t p = 0; system->committed && p < system->particle_count; p++) {
    if (system->held[p]) continue;
    const double *x = q + 3 * p, *u = v + 3 * p, m = system->mass[p];
    hk_sum_add(&sum[0], m * (x[1] * u[2] - x[2] * u[1]));
    hk_sum_add(&sum[1], m * (x[2] * u[0] - x[0] * u[2]));
    hk_sum_add(&sum[2], m * (x[0] * u[1] - x[1] * u[0]));
  }
  for (int a = 0; a < 3; a++)
    angular_momentum[a] = hk_sum_value(&sum[a]);
}

double hk_elastic_energy(const hooke_system *system, const double *q) {
  double sum = 0.0;
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->elements && row->energy) sum += row->energy(system, q);
  }
  return sum;
}
