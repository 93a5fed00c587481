#include "measure/spectrum/node_blocks.h"

#include "core/memory.h"
#include "core/status.h"
#include "measure/counted_work/work.h"
#include "measure/spectrum/eigen/eigen.h"
#include "model/force/force.h"

#include <math.h>
#include <string.h>

/* term = along u u^T + across (I - u u^T) */
static void find_axial(double term[6], const double u[3], double along, double across) {
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; k++)
    term[k] = (along - across) * u[row[k]] * u[column[k]] + (row[k] == column[k] ? across : 0.0);
}

static void add_element(struct hk_node_blocks *blocks, const struct hk_element *e) {
  const uint8_t *constrained = blocks->system->constrained;
  double before = -1.0, stiffness[6] = {0}, damping[6] = {0};
  if (!hk_element_moves(constrained, e)) return;
  blocks->unknown |= isnan(e->k_across);
  if (e->k_along > 0.0) blocks->least_ratio = fmin(blocks->least_ratio, e->c_along / e->k_along);
  if (hk_element_across(e) > 0.0) blocks->least_ratio = fmin(blocks->least_ratio, e->c_across / e->k_across);
  for (int j = 0; j < e->count; j++) {
    const int64_t p = e->particle[j];
    const double row = hk_element_row(constrained, e, j);
    if (constrained[p]) continue;
    if (row != before) { /* both ends of a spring have the same block */
      find_axial(stiffness, e->u, row * e->k_along, row * fmax(0.0, e->k_across));
      find_axial(damping, e->u, row * e->c_along, row * e->c_across);
    }
    before = row;
    for (int k = 0; k < 6; k++) {
      blocks->stiffness[6 * p + k] += stiffness[k];
      blocks->damping[6 * p + k] += damping[k];
    }
  }
}

int32_t hk_node_blocks_begin(const hooke_system *system, struct hk_node_blocks *blocks) {
  *blocks = (struct hk_node_blocks){.system = system, .least_ratio = INFINITY};
  blocks->stiffness = hk_new(6 * system->particle_count, sizeof(double));
  blocks->damping = hk_new(6 * system->particle_count, sizeof(double));
  if (blocks->stiffness == NULL || blocks->damping == NULL) {
    hk_node_blocks_release(blocks);
    return HOOKE_NO_MEMORY;
  }
  return HOOKE_OK;
}

int32_t hk_node_blocks_create(const hooke_system *system, const double *q, struct hk_node_blocks *blocks) {
  const int32_t status = hk_node_blocks_begin(system, blocks);
  if (status == HOOKE_OK) hk_node_blocks_fill(blocks, q);
  return status;
}

void hk_node_blocks_fill(struct hk_node_blocks *blocks, const double *q) {
  const hooke_system *system = blocks->system;
  const size_t bytes = 6 * (size_t)system->particle_count * sizeof(double);
  memset(blocks->stiffness, 0, bytes);
  memset(blocks->damping, 0, bytes);
  blocks->least_ratio = INFINITY;
  if (blocks->budget) hk_budget_spend(blocks->budget, hk_work_of_pass(system));
  blocks->unknown = 0;
  struct hk_elements at;
  hk_begin_elements(system, q, NULL, &at);
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    if (at.k == at.count && at.batches % HOOKE_BATCHES_PER_LOOK == 0 &&
        hk_budget_ends(blocks->budget, "bounds"))
      return;
    add_element(blocks, e);
  }
}

void hk_node_blocks_release(struct hk_node_blocks *blocks) {
  hk_free(blocks->stiffness);
  hk_free(blocks->damping);
  memset(blocks, 0, sizeof *blocks);
}

/* By the pivots of an elimination; non-finite numbers are not positive. */
static int is_positive(const double m[6]) {
  const double first = m[0], xy = m[3] / first, xz = m[4] / first;
  const double second = m[1] - xy * m[3], yz = m[5] - xy * m[4];
  return first > 0.0 && second > 0.0 && m[2] - xz * m[4] - yz * yz / second > 0.0;
}

/* 1 if no eigenvalue of a B + b G at particle p reaches `most`. */
static int stays_below(const struct hk_node_blocks *blocks, int64_t p, double a, double b, double most) {
  const double *stiffness = blocks->stiffness + 6 * p, *damping = blocks->damping + 6 * p;
  double gap[6];
  for (int k = 0; k < 6; k++)
    gap[k] = (k < 3 ? most : 0.0) - (a * stiffness[k] + b * damping[k]);
  return is_positive(gap);
}

/* Equal particles differ by rounding: new eigenvalues are not worth their time for that. */
static const double ALIKE = 1.0 + 1e-15;

/* The largest eigenvalue over particles of block/m, B or G. */
static double largest_rate(const struct hk_node_blocks *blocks, const double *block) {
  const int stiff = block == blocks->stiffness;
  double most = 0.0;
  for (int64_t p = 0; p < blocks->system->particle_count; p++) {
    if (blocks->system->constrained[p]) continue;
    if (stays_below(blocks, p, stiff, !stiff, ALIKE * most * blocks->system->inertia[p])) continue;
    most = fmax(most, hk_eigen_largest(block + 6 * p) * blocks->system->inverse_mass[p]);
  }
  return most;
}

double hk_node_blocks_frequency(const struct hk_node_blocks *blocks) {
  return sqrt(largest_rate(blocks, blocks->stiffness));
}

double hk_node_blocks_damping_rate(const struct hk_node_blocks *blocks) {
  return largest_rate(blocks, blocks->damping);
}

int32_t hk_node_blocks_stay_below(const struct hk_node_blocks *blocks, double a, double b, double limit,
                                  int64_t *particle) {
  const hooke_system *system = blocks->system;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->constrained[p]) continue;
    if (stays_below(blocks, p, a, b, limit * system->inertia[p])) continue;
    *particle = p;
    return 0;
  }
  return 1;
}

/* The largest eigenvalue of (h^2 B + 2 h G)/m at particle p. */
static double growth(const struct hk_node_blocks *blocks, int64_t p, double h) {
  double matrix[6];
  for (int k = 0; k < 6; k++) {
    matrix[k] = h * (h * blocks->stiffness[6 * p + k] + 2.0 * blocks->damping[6 * p + k]);
  }
  return hk_eigen_largest(matrix) * blocks->system->inverse_mass[p];
}

/* A step that is too large for particle p: the largest eigenvalue is at least a third of the trace. */
static double too_large(const struct hk_node_blocks *blocks, int64_t p) {
  const double *b = blocks->stiffness + 6 * p, *g = blocks->damping + 6 * p;
  const double w = blocks->system->inverse_mass[p];
  const double trace_b = (b[0] + b[1] + b[2]) * w, trace_g = (g[0] + g[1] + g[2]) * w;
  if (!(trace_b > 0.0) && !(trace_g > 0.0)) return INFINITY;
  /* h^2 b + 2 h g = 12 over the mass, written so that nothing cancels */
  return 12.0 / (trace_g + sqrt(trace_g * trace_g + 12.0 * trace_b));
}

double hk_node_blocks_step(const struct hk_node_blocks *blocks) {
  double best = INFINITY;
  for (int64_t p = 0; p < blocks->system->particle_count; p++) {
    if (blocks->system->constrained[p]) continue;
    const double start = too_large(blocks, p);
    double high = fmin(best, start), low = 0.0;
    if (isinf(high)) continue;
    if (best < INFINITY &&
        stays_below(blocks, p, best * best, 2.0 * best, ALIKE * 4.0 * blocks->system->inertia[p]))
      continue;
    if (growth(blocks, p, high) <= 4.0) low = high;
    while (high - low > 1e-12 * high) {
      const double middle = 0.5 * (low + high);
      if (growth(blocks, p, middle) <= 4.0)
        low = middle;
      else
        high = middle;
    }
    best = low;
  }
  return best;
}
