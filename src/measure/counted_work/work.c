#include "measure/counted_work/work.h"

#include "model/coordinates/coordinates.h"
#include "model/sum/tiled.h"

#include <math.h>
#include <string.h>

/* Particles that a cache of the second level holds, some 100 bytes each. */
static const double NEAR = 30000.0;
/* Share of the derivative of a spring that is of its damping. */
static const double OF_DAMPING = 0.5;
/* Evaluations of forces that a pass over their elements takes. */
static const double PASS = 40.0;
/* Of all dampers, in a step of shardlow. */
static const double SWEEPS = 2.0;

static double damped_springs(const hooke_system *system) {
  int64_t sum = 0;
  for (int64_t r = 0; r < system->springs->run_count; r++)
    sum += system->springs->run[r].shape & HOOKE_RUN_DAMPED ? system->springs->run[r].count : 0;
  return (double)sum;
}

/* Of every force: its members, or all particles where it has none. The matrix of verlet has the damping of
 * springs alone. */
static void add_forces(const hooke_system *system, const struct hk_method *method,
                       const struct hk_counts *count, double *amount) {
  const double times[HOOKE_WORKS_OF_FORCE] = {(double)count->force_evaluations,
                                              (double)count->derivative_products, (double)count->matrices};
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->add == NULL) continue; /* gravity is in the moves */
    const double members = (double)(row->elements ? hk_force_count(system, row) : system->particle_count),
                 damped = row->kind & HOOKE_LOOPED ? damped_springs(system) : members;
    double *of = amount + HOOKE_WORKS_OF_FORCE * hk_force_number(row);
    of[0] = times[0] * members;
    for (int what = 1; what < HOOKE_WORKS_OF_FORCE; what++)
      of[what] = times[what] * (method == &hk_verlet ? OF_DAMPING * damped : members);
    if (method != &hk_shardlow || row->kind & HOOKE_UNIFORM || !hk_force_is_damped(system, row)) continue;
    if (row->kind & HOOKE_LOOPED)
      amount[HOOKE_WORK_DAMPER] = (double)count->steps * damped;
    else
      of[0] += SWEEPS * (double)count->steps * members; /* a damper finds its element anew */
  }
  amount[HOOKE_WORK_CURVED] = (times[0] + times[1] + times[2]) * (double)system->springs->curved;
  if (system->tiled->order)
    amount[HOOKE_WORK_SCATTERED] = (times[0] + times[1] + times[2]) * (double)system->springs->count;
  if (method->adaptive)
    amount[HOOKE_WORK_ROWS] = (times[1] + times[2]) * (double)hk_elements_of(system, HOOKE_KEPT);
}

static void add_bodies(const hooke_system *system, const struct hk_counts *count, double *amount) {
  int64_t particles = 0, acted = 0;
  for (int64_t k = 0; k < system->mover_count; k++) {
    const struct hk_mover *mover = &system->mover[k];
    int64_t some;
    mover->row->particles(mover->thing, &some);
    particles += some;
    acted += mover->row->acted(system, mover->thing);
  }
  amount[HOOKE_WORK_BODY] = (double)count->force_evaluations * (double)system->mover_count;
  amount[HOOKE_WORK_BODY_PARTICLE] = (double)count->force_evaluations * (double)acted +
                                     (double)count->derivative_products * (double)particles;
}

/* Particles that a step visits: nothing acts on the others, or a body carries them. */
static double visited(const hooke_system *system) {
  int64_t sum = 0;
  for (int64_t k = 0; k < system->span_count; k++)
    sum += system->span[k].count;
  return (double)sum;
}

static void find_amounts(const hooke_system *system, const struct hk_method *method, double particles,
                         const struct hk_counts *count, double *amount) {
  const double steps = (double)count->steps, evaluations = (double)count->force_evaluations,
               products = (double)count->derivative_products, matrices = (double)count->matrices;
  /* with error control: particles with positions and velocities, or halves of them */
  const double whole = system && !system->overdamped ? 1.0 : 0.5,
               adapted = method->adaptive ? whole * particles : 0.0,
               moved = system ? visited(system) : particles;
  memset(amount, 0, HOOKE_WORKS * sizeof *amount);
  if (system) add_forces(system, method, count, amount);
  if (system) add_bodies(system, count, amount);
  amount[HOOKE_WORK_STEP] = steps;
  amount[HOOKE_WORK_ADAPTIVE_STEP] = method->adaptive ? steps : 0.0;
  amount[HOOKE_WORK_ADAPTIVE_PARTICLE] = steps * adapted;
  amount[HOOKE_WORK_EVALUATION] = evaluations;
  amount[HOOKE_WORK_PARTICLE] = evaluations * moved;
  amount[HOOKE_WORK_FAR] = evaluations * fmax(0.0, moved - NEAR);
  amount[HOOKE_WORK_ADAPTIVE_EVALUATED] = evaluations * adapted;
  amount[HOOKE_WORK_PRODUCT] = products;
  amount[HOOKE_WORK_PRODUCT_PARTICLE] = products * particles;
  amount[HOOKE_WORK_MATRIX] = matrices;
  amount[HOOKE_WORK_MATRIX_PARTICLE] = matrices * particles;
  amount[HOOKE_WORK_VECTOR] = (double)count->space;
  amount[HOOKE_WORK_VECTOR_PARTICLE] = (double)count->space * adapted;
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

double hk_work_of_product(const hooke_system *system) {
  return work_of_counts(system, &hk_rk4, (struct hk_counts){.derivative_products = 1});
}

double hk_work_of_pass(const hooke_system *system) {
  return PASS * hk_work_of_evaluation(system);
}

double hk_work_at_least(const hooke_system *system, const char *name, int64_t steps) {
  const double work = hk_work_of_steps(system, name, steps);
  const int32_t twice = hk_method_find(name)->explicit_step != NULL; /* verlet evaluates, with damping */
  return !isnan(work) ? work : twice ? 2.0 * (double)steps * hk_work_of_evaluation(system) : 0.0;
}

double hk_work_of_steps(const hooke_system *system, const char *name, int64_t steps) {
  const struct hk_method *method = hk_method_find(name);
  if (method == NULL || method->adaptive || method->solved || !hk_method_suits(name, system)) return NAN;
  const struct hk_stability *stability = &method->stability;
  const int64_t stages = stability->kind == HOOKE_STABLE_BY_POLYNOMIAL ? stability->degree : 1;
  if (method->explicit_step && system->mover_count == 0 && hk_system_is_damped(system, ~HOOKE_UNIFORM))
    return NAN;
  return work_of_counts(system, method,
                        (struct hk_counts){.steps = steps, .force_evaluations = stages * steps});
}
