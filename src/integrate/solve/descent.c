#include "integrate/solve/descent.h"

#include "core/memory.h"
#include "core/sum.h"
#include "kernel/vector_loops.h"
#include "model/force/altitude.h"
#include "model/force/force.h"
#include "model/force/spring.h"
#include "model/medium.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* By how much rounding moves particles, in units of the largest coordinate. */
static const double ROUNDINGS = 4.0 * DBL_EPSILON;

int32_t hk_descent_create(hooke_integrator *it, struct hk_descent *descent) {
  const hooke_system *system = it->system;
  double kick = 0.0;
  if (system->force || system->medium->blows || system->altitudes->count > 0) return HOOKE_OK;
  descent->rows = hk_new(it->size, sizeof(double));
  if (descent->rows == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += it->size * (int64_t)sizeof(double);
  for (int64_t k = 0; k < it->size; k++)
    descent->rows[k] = NAN;
  descent->weight = hk_springs_curved(system->springs, HOOKE_STIFFEST, system->position).tension;
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->add_stiffness) row->add_stiffness(system, &descent->stiffness);
    if (row->add_pull) row->add_pull(system, &descent->weight, &kick);
  }
  for (int64_t p = 0; p < system->particle_count; p++)
    descent->drag += system->constrained[p] ? 0.0 : system->inertia[p];
  return HOOKE_OK;
}

void hk_descent_release(struct hk_descent *descent) {
  hk_free(descent->rows);
}

/* 1 if they were there before. */
static int take_rows(const struct hk_motion *m, int same, double *rows) {
  for (int a = 0; a < 3; a++) {
    for (int64_t p = 0; p < m->n; p++) {
      same &= rows[3 * p + a] == m->q[a][p];
      rows[3 * p + a] = m->q[a][p];
    }
  }
  return same;
}

/* What displacements that rounding makes change, at this energy of springs: at most, by
 * Cauchy and Schwarz. */
static double slack_of(const struct hk_descent *descent, const struct hk_motion *m, double stiffness,
                       double energy) {
  double extent = 0.0;
  for (int a = 0; a < 3; a++)
    extent = fmax(extent, hk_largest(m->n, m->q[a]));
  const double d = ROUNDINGS * extent, force = descent->weight + sqrt(2.0 * stiffness * fabs(energy));
  return (force + 0.5 * stiffness * d) * d;
}

double hk_descent_energy(struct hk_descent *descent, const hooke_integrator *it) {
  const int same = descent->t == descent->known || !it->system->springs->scaled;
  if (take_rows(it->motion, same, descent->rows)) return descent->energy;
  descent->known = descent->t;
  const struct hk_energies at =
      hk_state_energies(&(hooke_state){.t = &descent->t, .q = descent->rows}, it->system);
  descent->energy = at.potential;
  descent->slack = slack_of(descent, it->motion, descent->stiffness, at.elastic);
  return descent->energy;
}

double hk_descent_potential(struct hk_descent *descent, const hooke_integrator *it, double a, const double *v,
                            double *slack) {
  const hooke_system *system = it->system;
  const int64_t n = system->particle_count;
  const double energy = hk_descent_energy(descent, it);
  struct hk_sum square = {0.0, 0.0};
  for (int64_t p = 0; p < n; p++) {
    if (system->constrained[p]) continue;
    const double x = v[p], y = v[n + p], z = v[2 * n + p];
    hk_sum_add(&square, system->inertia[p] * ((x * x + y * y) + z * z));
  }
  const double moved = 0.5 * (system->overdamped ? a : 1.0) * hk_sum_value(&square);
  *slack =
      descent->slack + slack_of(descent, it->motion, descent->drag / (system->overdamped ? a : a * a), moved);
  return energy + moved;
}
