#include "integrate/solve/krylov.h"

#include "hooke/base.h"
#include "kernel/vector_loops.h"

#include <math.h>
#include <string.h>

static double norm(int64_t size, const double *x) {
  return sqrt(hk_dot(size, x, x));
}

static void copy(int64_t size, const double *from, double *to) {
  memcpy(to, from, (size_t)size * sizeof(double));
}

/* x = 0, or b if it is 0 or not finite: then there is nothing to solve. */
static int begin(int64_t size, const double *b, double *x, double *length, struct hk_solution *solution) {
  *length = norm(size, b);
  *solution = (struct hk_solution){.converged = !(*length > 0.0 && *length < INFINITY)};
  if (solution->converged)
    copy(size, b, x);
  else
    memset(x, 0, (size_t)size * sizeof(double));
  return !solution->converged;
}

int32_t hk_solve_symmetric(const struct hk_operator *a, const double *b, double tolerance, int64_t limit,
                           double *scratch, double *x, struct hk_solution *solution) {
  const int64_t size = a->size;
  double *r = scratch, *p = r + size, *ap = p + size, length;
  if (!begin(size, b, x, &length, solution)) return HOOKE_OK;
  copy(size, b, r);
  copy(size, b, p);
  double square = hk_dot(size, r, r);
  while (!solution->converged && solution->iterations < limit) {
    const int32_t status = a->apply(a->ctx, p, ap);
    if (status != HOOKE_OK) return status;
    const double curvature = hk_dot(size, p, ap);
    if (curvature <= 0.0) {
      if (solution->iterations == 0) copy(size, b, x);
      return HOOKE_OK;
    }
    const double alpha = square / curvature;
    const double before = square;
    square = hk_descend(size, alpha, p, ap, x, r);
    hk_scale_and_add(size, square / before, r, p);
    solution->iterations++;
    solution->residual = sqrt(square) / length;
    /* non-finite numbers will not improve */
    solution->converged = !(solution->residual > tolerance);
  }
  return HOOKE_OK;
}

/* ---- conjugate gradients to a known error ---- */

enum { TILE = 256, LOOK_BACK = 6 };
static const double ROUNDING = 1e-15;

static double tiled_dot(int64_t size, const double *x, const double *y) {
  const int64_t n = size / 3;
  double sum = 0.0;
  for (int64_t p = 0; p < n; p += TILE) {
    const int64_t count = n - p < TILE ? n - p : TILE;
    for (int a = 0; a < 3; a++)
      sum += hk_dot(count, x + a * n + p, y + a * n + p);
  }
  return sum;
}

/* What the last few iterations have come nearer in the norm of A, squared: less than is left, but most of it
 * where they converge. */
static double sum_of(const double gained[LOOK_BACK]) {
  double sum = 0.0;
  for (int k = 0; k < LOOK_BACK; k++)
    sum += gained[k];
  return sum;
}

int32_t hk_solve_positive(const struct hk_operator *a, const double *b, double relative, double absolute,
                          int64_t limit, double *scratch, double *x, struct hk_solution *solution) {
  const int64_t size = a->size;
  double *r = scratch, *p = r + size, *ap = p + size, length, gained[LOOK_BACK] = {0.0}, all = 0.0;
  if (!begin(size, b, x, &length, solution)) return HOOKE_OK;
  copy(size, b, r);
  copy(size, b, p);
  double square = tiled_dot(size, r, r);
  while (!solution->converged && solution->iterations < limit) {
    const int32_t status = a->apply(a->ctx, p, ap);
    if (status != HOOKE_OK) return status;
    const double curvature = tiled_dot(size, p, ap);
    if (!(curvature > 0.0)) return HOOKE_OK;
    const double fraction = square / curvature, before = square;
    hk_add_multiple(size, fraction, p, x);
    hk_add_multiple(size, -fraction, ap, r);
    square = tiled_dot(size, r, r);
    hk_scale_and_add(size, square / before, r, p);
    gained[solution->iterations++ % LOOK_BACK] = fraction * before;
    all += fraction * before;
    solution->residual = sqrt(square) / length;
    const double left = sum_of(gained);
    /* numbers that are not finite will not get better */
    solution->converged =
        !(solution->residual > ROUNDING) ||
        (solution->iterations > LOOK_BACK && left <= fmax(relative * relative * all, absolute * absolute));
  }
  return HOOKE_OK;
}

/* ---- BiCGSTAB(L) ---- */

enum { L = HOOKE_GENERAL_SWEEP };

struct general {
  const struct hk_operator *a;
  double *r[L + 1], *u[L + 1], *shadow;
  double rho, alpha, omega;
  double length, shadow_length; /* of b and of the shadow */
};

/* The recurrences restart from the true residual each time that it has decreased by this factor, which keeps
 * their residual true and their cosines above rounding; cosines below the second number are rounding. */
static const double SWEEP = 1e-6, BROKEN = 1e-9;

/* Residual from x itself, and a restart of the recurrences. */
static int32_t restart(struct general *g, const double *b, const double *x) {
  const int64_t size = g->a->size;
  const int32_t status = g->a->apply(g->a->ctx, x, g->u[0]);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < size; k++)
    g->r[0][k] = b[k] - g->u[0][k];
  copy(size, g->r[0], g->shadow);
  g->shadow_length = norm(size, g->shadow);
  memset(g->u[0], 0, (size_t)size * sizeof(double));
  g->rho = g->omega = 1.0;
  g->alpha = 0.0;
  return HOOKE_OK;
}

/* Step j of the L biconjugate ones; `broken` if its numbers fail. */
static int32_t biconjugate_step(struct general *g, int j, double *x, int *broken) {
  const int64_t size = g->a->size;
  const double rho = hk_dot(size, g->r[j], g->shadow), beta = g->alpha * (rho / g->rho);
  g->rho = rho;
  for (int i = 0; i <= j; i++)
    hk_scale_and_add(size, -beta, g->r[i], g->u[i]);
  int32_t status = g->a->apply(g->a->ctx, g->u[j], g->u[j + 1]);
  if (status != HOOKE_OK) return status;
  const double curvature = hk_dot(size, g->u[j + 1], g->shadow);
  g->alpha = rho / curvature;
  *broken = !(fabs(g->alpha) < INFINITY) || rho == 0.0 ||
            !(fabs(curvature) > BROKEN * g->shadow_length * norm(size, g->u[j + 1]));
  if (*broken) return HOOKE_OK;
  hk_add_multiple(size, g->alpha, g->u[0], x);
  for (int i = 0; i <= j; i++)
    hk_add_multiple(size, -g->alpha, g->u[i + 1], g->r[i]);
  return HOOKE_OK;
}

/* The part that makes the residual smallest over r1 .. rL, by Gram and Schmidt. */
static void smooth(struct general *g, double *x, int *broken) {
  const int64_t size = g->a->size;
  double **r = g->r, **u = g->u;
  double tau[L + 1][L + 1], square[L + 1], along[L + 1], gamma[L + 1];
  for (int j = 1; j <= L; j++) {
    for (int i = 1; i < j; i++) {
      tau[i][j] = hk_dot(size, r[j], r[i]) / square[i];
      hk_add_multiple(size, -tau[i][j], r[i], r[j]);
    }
    square[j] = hk_dot(size, r[j], r[j]);
    along[j] = hk_dot(size, r[0], r[j]) / square[j];
    *broken |= !(fabs(along[j]) < INFINITY);
  }
  *broken |= along[L] == 0.0;
  if (*broken) return;
  for (int j = L; j >= 1; j--) {
    gamma[j] = along[j];
    for (int i = j + 1; i <= L; i++)
      gamma[j] -= tau[j][i] * gamma[i];
  }
  hk_add_multiple(size, gamma[1], r[0], x);
  for (int j = 1; j < L; j++) {
    double fraction = gamma[j + 1];
    for (int i = j + 1; i < L; i++)
      fraction += tau[j][i] * gamma[i + 1];
    hk_add_multiple(size, fraction, r[j], x);
  }
  for (int j = 1; j <= L; j++) {
    hk_add_multiple(size, -gamma[j], u[j], u[0]);
    hk_add_multiple(size, -along[j], r[j], r[0]);
  }
  g->omega = gamma[L];
}

/* The residual over b. */
static double residual_of(const struct general *g) {
  return norm(g->a->size, g->r[0]) / g->length;
}

/* Iterates until the residual reaches `goal`, the limit, or numbers fail. */
static int32_t sweep(struct general *g, double goal, int64_t limit, double *x, struct hk_solution *solution) {
  int broken = 0;
  while (!broken && solution->iterations < limit) {
    g->rho = -g->omega * g->rho;
    for (int j = 0; j < L; j++) {
      int32_t status = biconjugate_step(g, j, x, &broken);
      solution->iterations++;
      if (status != HOOKE_OK || broken || residual_of(g) <= goal) return status;
      status = g->a->apply(g->a->ctx, g->r[j], g->r[j + 1]);
      if (status != HOOKE_OK) return status;
    }
    smooth(g, x, &broken);
    if (residual_of(g) <= goal) return HOOKE_OK;
  }
  return HOOKE_OK;
}

int32_t hk_solve_general(const struct hk_operator *a, const double *b, double tolerance, int64_t limit,
                         double *scratch, double *x, struct hk_solution *solution) {
  const int64_t size = a->size;
  struct general g = {.a = a, .shadow = scratch + (int64_t)2 * (L + 1) * size};
  for (int k = 0; k <= L; k++) {
    g.r[k] = scratch + k * size;
    g.u[k] = scratch + (L + 1 + k) * size;
  }
  if (!begin(size, b, x, &g.length, solution)) return HOOKE_OK;
  for (double best = INFINITY;;) {
    int32_t status = restart(&g, b, x);
    if (status != HOOKE_OK) return status;
    solution->residual = residual_of(&g);
    solution->converged = solution->residual <= tolerance;
    if (solution->converged || solution->iterations >= limit) return HOOKE_OK;
    /* no better than at its last start: rounding allows no more */
    if (!(solution->residual < 0.5 * best)) return HOOKE_OK;
    best = solution->residual;
    status = sweep(&g, fmax(0.5 * tolerance, SWEEP * best), limit, x, solution);
    if (status != HOOKE_OK) return status;
  }
}

/* ---- GMRES ---- */

enum { SPACE = HOOKE_MINIMAL_SPACE };

struct minimal {
  const struct hk_operator *a;
  double *v[SPACE + 1];       /* an orthonormal basis */
  double h[SPACE][SPACE + 1]; /* columns of the triangle */
  double c[SPACE], s[SPACE];  /* rotations */
  double right[SPACE + 1];    /* rotated */
};

/* Column j of the basis and of the triangle. `broken` if there is no new direction, or a non-finite number.
 */
static int32_t extend(struct minimal *g, int j, int *broken) {
  const int64_t size = g->a->size;
  double *h = g->h[j], *next = g->v[j + 1];
  const int32_t status = g->a->apply(g->a->ctx, g->v[j], next);
  if (status != HOOKE_OK) return status;
  for (int i = 0; i <= j; i++) {
    h[i] = hk_long_dot(size, next, g->v[i]);
    hk_add_multiple(size, -h[i], g->v[i], next);
  }
  const double length = sqrt(hk_long_dot(size, next, next));
  for (int i = 0; i < j; i++) {
    const double first = g->c[i] * h[i] + g->s[i] * h[i + 1];
    h[i + 1] = g->c[i] * h[i + 1] - g->s[i] * h[i];
    h[i] = first;
  }
  const double radius = sqrt(h[j] * h[j] + length * length);
  *broken = !(radius > 0.0 && radius < INFINITY);
  if (*broken) return HOOKE_OK;
  g->c[j] = h[j] / radius;
  g->s[j] = length / radius;
  h[j] = radius;
  g->right[j + 1] = -g->s[j] * g->right[j];
  g->right[j] *= g->c[j];
  if (length > 0.0) hk_scale(size, 1.0 / length, next, next);
  return HOOKE_OK;
}

/* x += the combination of the first `count` basis vectors given by the triangle. */
static void combine(struct minimal *g, int count, double *x) {
  double fraction[SPACE];
  for (int j = count - 1; j >= 0; j--) {
    double left = g->right[j];
    for (int i = j + 1; i < count; i++)
      left -= g->h[i][j] * fraction[i];
    fraction[j] = left / g->h[j][j];
  }
  for (int j = 0; j < count; j++)
    hk_add_multiple(g->a->size, fraction[j], g->v[j], x);
}

int32_t hk_solve_minimal(const struct hk_operator *a, const double *b, double tolerance, int64_t limit,
                         double *scratch, double *x, struct hk_solution *solution) {
  const int64_t size = a->size;
  struct minimal g = {.a = a};
  for (int k = 0; k <= SPACE; k++)
    g.v[k] = scratch + k * size;
  *solution = (struct hk_solution){0};
  memset(x, 0, (size_t)size * sizeof(double));
  copy(size, b, g.v[0]);
  for (int broken = 0;;) {
    const double length = solution->residual = norm(size, g.v[0]);
    solution->converged = length <= tolerance;
    if (solution->converged || solution->iterations >= limit || !(length < INFINITY)) return HOOKE_OK;
    hk_scale(size, 1.0 / length, g.v[0], g.v[0]);
    g.right[0] = length;
    int count = 0;
    while (count < SPACE && solution->iterations < limit && solution->residual > tolerance) {
      const int32_t status = extend(&g, count, &broken);
      if (status != HOOKE_OK) return status;
      if (broken) break;
      solution->residual = fabs(g.right[++count]);
      solution->iterations++;
    }
    combine(&g, count, x);
    solution->converged = !broken && solution->residual <= tolerance;
    if (solution->converged || broken) return HOOKE_OK;
    const int32_t status = a->apply(a->ctx, x, g.v[1]);
    if (status != HOOKE_OK) return status;
    for (int64_t k = 0; k < size; k++)
      g.v[0][k] = b[k] - g.v[1][k];
  }
}
