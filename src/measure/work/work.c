#include "measure/work/work.h"

#include "model/force/force.h"

#include <math.h>
#include <string.h>

/* Of every force: its members, or all particles where it has none. */
static void add_forces(const hooke_system *system, const struct hk_counts *count, double *amount) {
  const double times[HOOKE_WORKS_OF_FORCE] = {(double)count->force_evaluations,
                                              (double)count->derivative_products, (double)count->matrices};
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    const double members = (double)(row->count ? row->count(system) : system->particle_count);
    for (int what = 0; what < HOOKE_WORKS_OF_FORCE; what++)
      amount[HOOKE_WORKS_OF_FORCE * hk_force_number(row) + what] = times[what] * members;
  }
  const double springs = times[0] * (double)system->springs.count;
  amount[HOOKE_WORK_UNORDERED] = system->strided.count == 0 ? springs : 0.0;
  amount[HOOKE_WORK_SCATTERED] = system->tiled.order ? springs : 0.0;
  amount[HOOKE_WORK_BODY] = times[0] * (double)system->bodies.moving;
}

static void find_amounts(const hooke_system *system, const struct hk_method *method, double particles,
                         const struct hk_counts *count, double *amount) {
  const double steps = (double)count->steps, evaluations = (double)count->force_evaluations,
               products = (double)count->derivative_products, matrices = (double)count->matrices,
               iterations = (double)count->linear_iterations, adaptive = method->adaptive;
  memset(amount, 0, HOOKE_WORKS * sizeof *amount);
  if (system) add_forces(system, count, amount);
  amount[HOOKE_WORK_STEP] = steps;
  amount[HOOKE_WORK_ADAPTIVE_STEP] = adaptive * steps;
  amount[HOOKE_WORK_ADAPTIVE_PARTICLE] = adaptive * steps * particles;
  amount[HOOKE_WORK_EVALUATION] = evaluations;
  amount[HOOKE_WORK_PARTICLE] = evaluations * particles;
  amount[HOOKE_WORK_ADAPTIVE_EVALUATED] = adaptive * evaluations * particles;
  if (method == &hk_shardlow) amount[HOOKE_WORK_DAMPER] = steps * (double)system->springs.count;
  amount[HOOKE_WORK_PRODUCT] = products;
  amount[HOOKE_WORK_PRODUCT_PARTICLE] = products * particles;
  amount[HOOKE_WORK_MATRIX] = matrices;
  amount[HOOKE_WORK_MATRIX_PARTICLE] = matrices * particles;
  amount[HOOKE_WORK_ITERATION] = iterations * particles;
  amount[HOOKE_WORK_SPACE] = adaptive * iterations * particles;
  amount[HOOKE_WORK_FACTOR_PRODUCT] = (double)count->factor_products;
  amount[HOOKE_WORK_FACTOR_NUMBER] = (double)count->factor_numbers;
}

static double cost_of(const double *amount) {
  double sum = 0.0;
  for (int k = 0; k < HOOKE_WORKS; k++)
    sum += hk_costs[k] * amount[k];
  return 1e-9 * sum;
}

void hk_work_amounts(const hooke_integrator *it, double amount[HOOKE_WORKS]) {
  find_amounts(it->system, it->method, (double)it->size / 3.0, &it->count, amount);
}

double hk_work_of(const hooke_integrator *it) {
  double amount[HOOKE_WORKS];
  hk_work_amounts(it, amount);
  return cost_of(amount);
}

static double work_of_counts(const hooke_system *system, const struct hk_method *method,
                             struct hk_counts count) {
  double amount[HOOKE_WORKS];
  find_amounts(system, method, (double)system->particle_count, &count, amount);
  return cost_of(amount);
}

double hk_work_of_evaluation(const hooke_system *system) {
  return work_of_counts(system, &hk_rk4, (struct hk_counts){.force_evaluations = 1});
}

double hk_work_of_steps(const hooke_system *system, const char *name, int64_t steps) {
  const struct hk_method *method = hk_method_find(name);
  if (method == NULL || method->adaptive || method->implicit || !hk_method_suits(name, system)) return NAN;
  const struct hk_stability *stability = &method->stability;
  const int64_t stages = stability->kind == HOOKE_STABLE_BY_POLYNOMIAL ? stability->degree : 1;
  if (method->explicit_step && system->bodies.moving == 0 && hk_elements_are_damped(system)) return NAN;
  return work_of_counts(system, method,
                        (struct hk_counts){.steps = steps, .force_evaluations = stages * steps});
}
