#include "measure/spectrum/node_blocks.h"

#include "core/memory.h"
#include "measure/counted_work/work.h"
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

int32_t hk_node_blocks_create(const hooke_system *system, const double *q, const double *v,
                              struct hk_node_blocks *blocks) {
  const int32_t status = hk_node_blocks_begin(system, blocks);
  if (status == HOOKE_OK) hk_node_blocks_fill(blocks, system->moment, q, v);
  return status;
}

void hk_node_blocks_fill(struct hk_node_blocks *blocks, double t, const double *q, const double *v) {
  const hooke_system *system = blocks->system;
  const size_t bytes = 6 * (size_t)system->particle_count * sizeof(double);
  memset(blocks->stiffness, 0, bytes);
  memset(blocks->damping, 0, bytes);
  blocks->least_ratio = INFINITY;
  if (blocks->budget) hk_budget_spend(blocks->budget, hk_work_of_pass(system));
  blocks->unknown = system->generalized || (v == NULL && hk_system_is_not_linear(system));
  struct hk_element room;
  struct hk_elements at;
  hk_begin_elements(system, t, q, NULL, &at);
  at.flow = v;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    if (at.k == at.count && at.batches % HOOKE_BATCHES_PER_LOOK == 0 &&
        hk_budget_ends(blocks->budget, "bounds"))
      return;
    add_element(blocks, hk_element_at_most(&at, e, &room));
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

/* 1 if h (h kk B + k B + c G) stays below `mass` at particle p; in this order nothing overflows. */
static int stays_below(const struct hk_node_blocks *blocks, int64_t p, struct hk_node_limit limit, double h,
                       double mass) {
  const double *stiffness = blocks->stiffness + 6 * p, *damping = blocks->damping + 6 * p;
  double gap[6];
  for (int k = 0; k < 6; k++)
    gap[k] = (k < 3 ? mass : 0.0) - h * ((h * limit.kk + limit.k) * stiffness[k] + limit.c * damping[k]);
  return is_positive(gap);
}

/* Equal particles differ by rounding: a new search is not worth its time for that. */
static const double ALIKE = 1.0 + 1e-15;
static const double PRECISE = 4e-16;

/* A step that is too large for particle p, or hardly small enough: the largest eigenvalue is at least every
 * number on the diagonal. */
static double too_large(const struct hk_node_blocks *blocks, int64_t p, struct hk_node_limit limit) {
  const double w = blocks->system->inverse_mass[p];
  double least = INFINITY;
  for (int64_t j = 6 * p; j < 6 * p + 3; j++) {
    const double b = blocks->stiffness[j] * w, g = blocks->damping[j] * w, by = limit.k * b + limit.c * g;
    /* h^2 kk b + h (k b + c g) = 1, written so that nothing cancels */
    least = fmin(least, 2.0 / (by + hypot(by, 2.0 * sqrt(limit.kk * b))));
  }
  return least;
}

double hk_node_blocks_reach(const struct hk_node_blocks *blocks, struct hk_node_limit limit, double most,
                            int64_t *particle) {
  const hooke_system *system = blocks->system;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->constrained[p] || stays_below(blocks, p, limit, most, ALIKE * system->inertia[p])) continue;
    const double start = too_large(blocks, p, limit);
    if (isinf(start)) continue; /* nothing acts on it */
    double high = fmin(most, start), low = 0.0;
    while (high - low > PRECISE * high) {
      const double middle = 0.5 * (low + high);
      if (stays_below(blocks, p, limit, middle, system->inertia[p]))
        low = middle;
      else
        high = middle;
    }
    most = low;
    if (particle) *particle = p;
  }
  return most;
}
