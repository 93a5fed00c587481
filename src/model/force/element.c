#include "model/force/element.h"

#include "model/force/force.h"

#include <stddef.h>
#include <string.h>

void hk_begin_elements(const hooke_system *system, double t, const double *q, const double *v,
                       struct hk_elements *at) {
  memset(at, 0, offsetof(struct hk_elements, element));
  at->system = system;
  at->t = t;
  at->q = q;
  at->v = v;
}

static int is_wanted(const struct hk_elements *at, const struct hk_force_row *force) {
  if (force->elements == NULL || !hk_force_is_present(at->system, force)) return 0;
  return (at->only == NULL || at->only == force) && (at->kinds == 0 || force->kind & at->kinds);
}

/* Fetches the next elements of the current force; 0 if there are none. */
static int32_t fill(struct hk_elements *at) {
  const struct hk_force_row *force = at->force;
  at->done += at->count;
  at->k = 0;
  at->count = !at->by_number && force->stored_elements ? force->stored_elements(at) : -1;
  if (at->count < 0) {
    const int64_t left = hk_force_count(at->system, force) - at->done;
    at->first = at->done;
    at->count = left < HOOKE_ELEMENTS ? left : HOOKE_ELEMENTS;
    const double *v = at->v || !force->not_linear ? at->v : at->flow;
    if (at->count > 0) force->elements(at->system, at->t, at->q, v, at->first, at->count, at->element);
  }
  at->batches += at->count > 0;
  return at->count > 0;
}

int32_t hk_fill_elements(struct hk_elements *at) {
  while (at->force == NULL || !fill(at)) {
    do {
      at->force = hk_force_table(at->next++);
      if (at->force == NULL) return 0;
    } while (!is_wanted(at, at->force));
    at->done = at->count = at->k = 0;
    memset(at->place, 0, sizeof at->place);
  }
  return 1;
}

/* u.(sum of g_j x_j), and the sum itself if needed. */
static double gather(const struct hk_element *e, double across, int64_t stride, const double *const x[3],
                     double sum[3]) {
  double along = 0.0;
  sum[0] = sum[1] = sum[2] = 0.0;
  for (int j = 0; j < e->count; j++) {
    const int64_t p = stride * e->particle[j];
    along += e->weight[j] * ((e->u[0] * x[0][p] + e->u[1] * x[1][p]) + e->u[2] * x[2][p]);
    for (int a = 0; a < 3 && across != 0.0; a++)
      sum[a] += e->weight[j] * x[a][p];
  }
  return along;
}

void hk_element_multiply(const struct hk_element *e, double along, double across, int64_t stride,
                         const double *const x[3], double *const out[3]) {
  double sum[3];
  const double size = (along - across) * gather(e, across, stride, x, sum);
  for (int j = 0; j < e->count; j++) {
    const int64_t p = stride * e->particle[j];
    const double s = size * e->weight[j], isotropic = across * e->weight[j];
    for (int a = 0; a < 3; a++)
      out[a][p] += across != 0.0 ? s * e->u[a] + isotropic * sum[a] : s * e->u[a];
  }
}
