/* Verlet of bodies, which takes damping at a predicted velocity: stable where h^2 K + 2 h C - h^2 C^2 < 4 and
 * h C < 2, over the masses. An eigenvalue of its step is -1 or 1 where one of these is met, whatever K and C
 * are; of one mode its eigenvalues leave the unit circle nowhere else. */
#include "core/memory.h"
#include "core/status.h"
#include "kernel/vector_loops.h"
#include "measure/spectrum/eigen/dense.h"
#include "measure/spectrum/limit_rules.h"

#include <math.h>
#include <string.h>

enum { MOST_TURNS = 30 };

static const double TOLERANCE = 1e-10;

static const char *const TOO_LARGE =
    "not known: damping out of proportion is at predicted velocities, and the "
    "scene too large to solve for all motion at once";
static const char *const NOT_ALL =
    "with damping out of proportion it is not proved that no motion grows below the prediction";

void hk_limit_take_mode(const struct hk_spectrum *s, const double *mode, struct hk_prediction *out) {
  out->has_mode = mode != NULL;
  if (mode) memcpy(out->mode, mode, (size_t)s->linearised->size * sizeof(double));
}

/* h^2 (k - d) + 2 h c = 4, written so that nothing cancels; infinity if it is met nowhere. */
static double reach(double k, double c, double d) {
  const double square = c * c + 4.0 * (k - d);
  return square >= 0.0 && c + sqrt(square) > 0.0 ? 4.0 / (c + sqrt(square)) : INFINITY;
}

static double by_damping(double c) {
  return c > 0.0 ? 2.0 / c : INFINITY;
}

double hk_limit_predicted_step(double k, double c) {
  return fmin(reach(k, c, c * c), by_damping(c));
}

/* Where C = beta K + delta M, the stiffest mode meets both first. */
static void proportional(const struct hk_spectrum *s, struct hk_prediction *out) {
  out->limit = hk_limit_predicted_step(s->stiffest, s->beta * s->stiffest + s->delta);
  hk_limit_take_mode(s, s->stiffest_mode, out);
}

struct search {
  int64_t n;
  double *k, *c, *sum, *value, *vector, *product; /* n x n: k, c, sum, vector */
};

/* out = m x */
static void multiply(int64_t n, const double *m, const double *x, double *out) {
  for (int64_t i = 0; i < n; i++)
    out[i] = hk_dot(n, m + i * n, x);
}

/* sum = h^2 K + 2 h C - h^2 C^2; C is symmetric. */
static void combine(struct search *z, double h) {
  for (int64_t i = 0; i < z->n; i++) {
    multiply(z->n, z->c, z->c + i * z->n, z->product);
    for (int64_t j = 0; j < z->n; j++) {
      const int64_t at = i * z->n + j;
      z->sum[at] = h * h * (z->k[at] - z->product[j]) + 2.0 * h * z->c[at];
    }
  }
}

/* The value of a vector is that of the matrix at least, so the h that it gives is at most too large; Newton's
 * iteration from above. */
static int32_t search(struct search *z, double *h) {
  double change = INFINITY;
  int32_t status = HOOKE_OK;
  for (int turn = 0; turn < MOST_TURNS && status == HOOKE_OK && change > TOLERANCE; turn++) {
    combine(z, *h);
    status = hk_dense_symmetric(z->n, z->sum, z->value, z->vector);
    if (status != HOOKE_OK) break;
    multiply(z->n, z->k, z->vector, z->product);
    const double k = hk_dot(z->n, z->vector, z->product);
    multiply(z->n, z->c, z->vector, z->product);
    const double c = hk_dot(z->n, z->vector, z->product), d = hk_dot(z->n, z->product, z->product);
    const double next = reach(k, c, d);
    change = fabs(next - *h) / next;
    *h = next;
  }
  return status;
}

static int32_t out_of_proportion(struct hk_spectrum *s, struct hk_prediction *out) {
  struct hk_linearised *lin = s->linearised;
  const int64_t n = lin->unknowns;
  double *block = hk_new(4 * n * n + 2 * n, sizeof(double));
  struct search z = {.n = n, .k = block};
  if (block == NULL) return HOOKE_NO_MEMORY;
  z.c = z.k + n * n;
  z.sum = z.c + n * n;
  z.vector = z.sum + n * n;
  z.value = z.vector + n * n;
  z.product = z.value + n;
  int32_t status = HOOKE_OK;
  for (int j = 0; j < 2 && status == HOOKE_OK; j++) {
    hk_linearised_combine(lin, j == 0, j == 1);
    status = hk_linearised_assemble(lin, j == 0 ? z.k : z.c);
  }
  out->limit = reach(s->stiffest, s->fastest_decay, 0.0); /* too small: the mode of a first turn */
  if (status == HOOKE_OK) status = search(&z, &out->limit);
  if (status == HOOKE_OK) hk_linearised_unpack(lin, z.vector, out->mode);
  out->has_mode = status == HOOKE_OK;
  hk_free(block);
  return status;
}

int32_t hk_limit_rule_predicted(struct hk_spectrum *s, struct hk_prediction *out) {
  if (s->proportional) {
    proportional(s, out);
    return HOOKE_OK;
  }
  if (s->linearised->unknowns > HOOKE_SPECTRUM_DAMPED) {
    out->limit = NAN;
    out->note = TOO_LARGE;
    return HOOKE_OK;
  }
  const int32_t status = out_of_proportion(s, out);
  out->limit = fmin(out->limit, by_damping(s->fastest_decay));
  out->exact = 0;
  out->note = NOT_ALL;
  return status;
}
