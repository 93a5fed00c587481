#include "measure/why/growing.h"

#include "core/memory.h"
#include "integrate/method.h"
#include "measure/counted_work/work.h"
#include "model/force/force.h"

#include <math.h>
#include <string.h>

/* ---- products ---- */

/* out = (a K + b C) x, without constrained particles and the transverse stiffness of compressed springs; 0 if
 * budget ends. */
static int32_t multiply(struct hk_growing *g, const double *q, double a, double b) {
  const hooke_system *system = g->system;
  const double *const x[3] = {g->x, g->x + 1, g->x + 2};
  double *const out[3] = {g->out, g->out + 1, g->out + 2};
  memset(g->out, 0, 3 * (size_t)system->particle_count * sizeof(double));
  if (g->budget) hk_budget_spend(g->budget, hk_work_of_pass(system));
  struct hk_elements at;
  hk_begin_elements(system, g->t, q, NULL, &at);
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    if (at.k == at.count && at.batches % HOOKE_BATCHES_PER_LOOK == 0 &&
        hk_budget_ends(g->budget, "the motion that grows"))
      return 0;
    hk_element_multiply(e, a * e->k_along + b * e->c_along, a * fmax(0.0, e->k_across) + b * e->c_across, 3,
                        x, out);
  }
  for (int64_t p = 0; p < system->particle_count; p++) {
    for (int64_t k = 3 * p; k < 3 * p + 3 && system->constrained[p]; k++)
      g->out[k] = 0.0;
  }
  return 1;
}

/* ---- the direction ---- */

static double length_of(const struct hk_growing *g, const double *x) {
  double sum = 0.0;
  for (int64_t p = 0; p < g->system->particle_count; p++) {
    const double *a = x + 3 * p;
    if (!g->system->constrained[p])
      sum += g->system->inertia[p] * ((a[0] * a[0] + a[1] * a[1]) + a[2] * a[2]);
  }
  return sqrt(sum);
}

/* x = from / `length`, zero for constrained particles */
static void take(struct hk_growing *g, const double *from, double length) {
  for (int64_t p = 0; p < g->system->particle_count; p++) {
    for (int64_t k = 3 * p; k < 3 * p + 3; k++)
      g->x[k] = g->system->constrained[p] ? 0.0 : from[k] / length;
  }
}

double hk_growing_bytes(const hooke_system *system) {
  return 6.0 * (double)system->particle_count * sizeof(double);
}

int32_t hk_growing_create(const hooke_system *system, const double *v, struct hk_budget *budget,
                          struct hk_growing *g) {
  const int64_t size = 3 * system->particle_count;
  *g = (struct hk_growing){.system = system, .budget = budget};
  g->x = hk_new(size, sizeof(double));
  g->out = hk_new(size, sizeof(double));
  if (g->x == NULL || g->out == NULL) {
    hk_growing_release(g);
    return HOOKE_NO_MEMORY;
  }
  double length = length_of(g, v);
  if (!(length > 0.0) || !isfinite(length)) {
    /* neighbours against each other, in all directions */
    for (int64_t k = 0; k < size; k++)
      g->out[k] = ((k / 3 + k % 3) % 2 ? 1.0 : -1.0) + 0.1 * (double)(k % 7);
    length = length_of(g, g->out);
    v = g->out;
  }
  if (length > 0.0) take(g, v, length);
  return HOOKE_OK;
}

void hk_growing_release(struct hk_growing *g) {
  hk_free(g->x);
  hk_free(g->out);
  g->x = g->out = NULL;
}

double hk_growing_quotient(struct hk_growing *g, const double *q, double a, double b) {
  double energy = 0.0, square = 0.0;
  if (!multiply(g, q, a, b)) return 0.0;
  for (int64_t p = 0; p < g->system->particle_count; p++) {
    const double *x = g->x + 3 * p, *out = g->out + 3 * p;
    energy += (x[0] * out[0] + x[1] * out[1]) + x[2] * out[2];
    square += g->system->inertia[p] * ((x[0] * x[0] + x[1] * x[1]) + x[2] * x[2]);
  }
  return square > 0.0 ? energy / square : 0.0;
}

double hk_growing_turn(struct hk_growing *g, const double *q, double a, double b, double most, double rise,
                       int64_t turns) {
  double quotient = hk_growing_quotient(g, q, a, b), before = 0.0;
  for (int64_t k = 0; k < turns && !(quotient > most) && quotient > (1.0 + rise) * before; k++) {
    if (hk_budget_ends(g->budget, "the motion that grows")) break;
    before = quotient;
    for (int64_t p = 0; p < g->system->particle_count; p++) {
      for (int64_t i = 3 * p; i < 3 * p + 3; i++)
        g->out[i] *= g->system->inverse_mass[p];
    }
    const double length = length_of(g, g->out);
    if (!(length > 0.0) || !isfinite(length)) break;
    take(g, g->out, length);
    quotient = fmax(quotient, hk_growing_quotient(g, q, a, b));
  }
  return quotient;
}

/* ---- steps ---- */

int32_t hk_growing_rule(const hooke_system *system, const char *method, double h, double *a, double *b,
                        double *most) {
  const struct hk_stability *stability = hk_method_stability_in(method, system);
  *a = h * h;
  *b = stability->kind == HOOKE_STABLE_BY_K_AND_C ? 2.0 * h : 0.0;
  *most = 4.0;
  if (stability->kind == HOOKE_STABLE_BY_K_AND_C || stability->kind == HOOKE_STABLE_BY_K) return 1;
  *most = stability->axis; /* with damping the limit is not given by a quotient */
  return stability->axis > 0.0 && !hk_system_is_damped(system, 0);
}
