/* Blocks of springs go through a buffer, like their forces: numbers first, which vectorises for any ends,
 * sums in spring order afterwards. Compiled once per instruction set, with HOOKE_ISA naming it. */
#include "kernel/spring/tangent_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/spring/spring_body.h"
#include "kernel/vector_unit.h"

#include <stddef.h>

enum { BLOCK = HOOKE_TANGENT_BLOCK };

/* ---- filling ---- */

/* Location of the material of a run: shared, in arrays of its own, or anywhere. */
enum { SHARED, OWN, ANYWHERE };

HOOKE_INLINE struct hk_material material_of(const struct hk_run *run, ptrdiff_t k, const int where) {
  if (where == ANYWHERE) return hk_run_material(run, k);
  if (where == OWN) return (struct hk_material){run->kappas[k], run->gammas[k], run->rest_lengths[k]};
  return (struct hk_material){run->kappa, run->gamma, run->rest_length};
}

HOOKE_INLINE void fill(const struct hk_run run, const struct hk_fields fields, const double alpha,
                       const double beta, const struct hk_tangent tangent, const int axial, const int indexed,
                       const int where, const ptrdiff_t from, const ptrdiff_t to) {
  const double *const *q = fields.q, *const *v = fields.v;
  const int pull = (run.shape & HOOKE_RUN_PULL_ONLY) != 0;
  HOOKE_VECTORISE
  for (ptrdiff_t k = from; k < to; k++) {
    const ptrdiff_t i = indexed ? run.head[k] : run.start + k, j = indexed ? run.tail[k] : i + run.offset;
    const struct hk_material material = material_of(&run, k, where);
    const double kappa = material.kappa, gamma = material.gamma, rest_length = material.rest_length;
    const double d[3] = {q[0][i] - q[0][j], q[1][i] - q[1][j], q[2][i] - q[2][j]};
    const double w[3] = {v[0][i] - v[0][j], v[1][i] - v[1][j], v[2][i] - v[2][j]};
    const double r = hk_spring_length(d[0], d[1], d[2]), ir = hk_spring_inverse_length(r);
    const double rate = ((w[0] * d[0] + w[1] * d[1]) + w[2] * d[2]) * ir;
    const double tension = kappa * (r - rest_length) + gamma * rate;
    const double taut = (pull & ((r <= rest_length) | (tension < 0.0))) ? 0.0 : 1.0;
    const ptrdiff_t s = run.first + k;
    if (axial) {
      const double size = taut * sqrt(beta * gamma) * ir;
      for (int a = 0; a < 3; a++)
        tangent.u[a][s] = size * d[a];
      continue;
    }
    const double isotropic = ((rest_length == 0.0) & !pull) ? kappa : 0.0;
    const double b = r == 0.0 ? alpha * isotropic : alpha * taut * tension * ir;
    const double along = taut * (alpha * kappa + beta * gamma) - b, turning = taut * alpha * gamma * ir;
    for (int a = 0; a < 3; a++) {
      const double u = taut * d[a] * ir;
      tangent.u[a][s] = u;
      tangent.e[a][s] = along * u + turning * (w[a] - rate * u);
    }
    tangent.b[s] = b;
  }
}

/* Whole vectors, of which the last overlaps the one before: runs are often short, such as a row of a cloth.
 */
HOOKE_INLINE void fill_run(const struct hk_run run, const struct hk_fields fields, const double alpha,
                           const double beta, const struct hk_tangent tangent, const int axial,
                           const int indexed, const int where) {
  const ptrdiff_t last = run.count - HOOKE_WIDTH;
  if (last < 0) {
    fill(run, fields, alpha, beta, tangent, axial, indexed, where, 0, run.count);
    return;
  }
  for (ptrdiff_t k = 0; k < run.count; k += HOOKE_WIDTH) {
    const ptrdiff_t from = k < last ? k : last;
    fill(run, fields, alpha, beta, tangent, axial, indexed, where, from, from + HOOKE_WIDTH);
  }
}

HOOKE_INLINE void fill_any(const struct hk_run *run, const struct hk_fields *fields, const double alpha,
                           const double beta, const struct hk_tangent *tangent, const int axial) {
  const int indexed = run->shape & HOOKE_RUN_INDEXED, mixed = run->shape & HOOKE_RUN_MIXED;
  if (mixed && (run->slot || run->kappas == NULL))
    fill_run(*run, *fields, alpha, beta, *tangent, axial, indexed, ANYWHERE);
  else if (mixed && indexed)
    fill_run(*run, *fields, alpha, beta, *tangent, axial, 1, OWN);
  else if (mixed)
    fill_run(*run, *fields, alpha, beta, *tangent, axial, 0, OWN);
  else if (indexed)
    fill_run(*run, *fields, alpha, beta, *tangent, axial, 1, SHARED);
  else
    fill_run(*run, *fields, alpha, beta, *tangent, axial, 0, SHARED);
}

static void tangent_fill(const struct hk_run *run, const struct hk_fields *fields, double alpha, double beta,
                         const struct hk_tangent *tangent) {
  if (tangent->b)
    fill_any(run, fields, alpha, beta, tangent, 0);
  else
    fill_any(run, fields, 0.0, beta, tangent, 1);
}

/* ---- products ---- */

struct block {
  double x[BLOCK], y[BLOCK], z[BLOCK];
};

/* Arrays of a run, in locals that no store can change. */
struct numbers {
  const double *ux, *uy, *uz, *ex, *ey, *ez, *b;
  const int32_t *head, *tail; /* NULL: spring k joins k and k + offset */
  ptrdiff_t offset;
};

HOOKE_INLINE struct numbers numbers_of(const struct hk_run *run, const struct hk_tangent *t, int64_t done,
                                       int axial) {
  const int64_t s = run->first + done;
  struct numbers numbers = {.ux = t->u[0] + s, .uy = t->u[1] + s, .uz = t->u[2] + s, .offset = run->offset};
  if (!axial) {
    numbers.ex = t->e[0] + s;
    numbers.ey = t->e[1] + s;
    numbers.ez = t->e[2] + s;
    numbers.b = t->b + s;
  }
  if (run->shape & HOOKE_RUN_INDEXED) {
    numbers.head = run->head + done;
    numbers.tail = run->tail + done;
  }
  return numbers;
}

HOOKE_INLINE void fill_block(double *restrict bx, double *restrict by, double *restrict bz,
                             const double *restrict x, const double *restrict y, const double *restrict z,
                             const struct numbers s, const ptrdiff_t count, const int indexed,
                             const int axial) {
  HOOKE_VECTORISE
  for (ptrdiff_t k = 0; k < count; k++) {
    const ptrdiff_t i = indexed ? s.head[k] : k, j = indexed ? s.tail[k] : k + s.offset;
    const double dx = x[i] - x[j], dy = y[i] - y[j], dz = z[i] - z[j];
    if (axial) {
      const double along = (s.ux[k] * dx + s.uy[k] * dy) + s.uz[k] * dz;
      bx[k] = along * s.ux[k];
      by[k] = along * s.uy[k];
      bz[k] = along * s.uz[k];
    } else {
      const double along = (s.ex[k] * dx + s.ey[k] * dy) + s.ez[k] * dz;
      bx[k] = along * s.ux[k] + s.b[k] * dx;
      by[k] = along * s.uy[k] + s.b[k] * dy;
      bz[k] = along * s.uz[k] + s.b[k] * dz;
    }
  }
}

/* Runs of constant offset are often short, such as a row of a cloth. Their loops end with a whole vector,
 * which overlaps the one before. */

HOOKE_INLINE void fill_vector(struct block *b, const double *const x[3], const struct numbers *s,
                              const ptrdiff_t k, const int axial) {
  const double *const u[3] = {s->ux + k, s->uy + k, s->uz + k};
  const double *const e[3] = {axial ? u[0] : s->ex + k, axial ? u[1] : s->ey + k, axial ? u[2] : s->ez + k};
  double *const to[3] = {b->x + k, b->y + k, b->z + k};
  hk_vector d[3];
  for (int a = 0; a < 3; a++)
    d[a] = hk_load(x[a] + k) - hk_load(x[a] + k + s->offset);
  const hk_vector along = (hk_load(e[0]) * d[0] + hk_load(e[1]) * d[1]) + hk_load(e[2]) * d[2];
  for (int a = 0; a < 3; a++) {
    hk_vector part = along * hk_load(u[a]);
    if (!axial) part = part + hk_load(s->b + k) * d[a];
    hk_store(to[a], part);
  }
}

HOOKE_INLINE void fill_vectors(struct block *b, const double *const x[3], const struct numbers s,
                               const ptrdiff_t count, const int axial) {
  const ptrdiff_t last = count - HOOKE_WIDTH;
  for (ptrdiff_t k = 0; k < last; k += HOOKE_WIDTH)
    fill_vector(b, x, &s, k, axial);
  fill_vector(b, x, &s, last, axial);
}

enum { FIRST = 1, SECOND = 2 };

HOOKE_INLINE hk_vector add_vector(hk_vector sum, const double *first, const double *second, const int ends) {
  if (ends & FIRST) sum = sum + hk_load(first);
  if (ends & SECOND) sum = sum - hk_load(second);
  return sum;
}

/* Adds springs to their first ends, and subtracts springs from their second ends. The last vector is computed
 * before the loop changes the sums that it shares. */
HOOKE_INLINE void add_springs(double *out, const double *first, const double *second, const ptrdiff_t count,
                              const int ends) {
  const ptrdiff_t last = count - HOOKE_WIDTH;
  if (last < 0) {
    for (ptrdiff_t k = 0; k < count; k++) {
      if (ends & FIRST) out[k] += first[k];
      if (ends & SECOND) out[k] -= second[k];
    }
    return;
  }
  const hk_vector end = add_vector(hk_load(out + last), first + last, second + last, ends);
  for (ptrdiff_t k = 0; k < last; k += HOOKE_WIDTH)
    hk_store(out + k, add_vector(hk_load(out + k), first + k, second + k, ends));
  hk_store(out + last, end);
}

/* All first ends precede the second ones; particles that are both are visited once. */
HOOKE_INLINE void add_to_ends(double *out, const double *b, ptrdiff_t i, ptrdiff_t j, ptrdiff_t count) {
  const ptrdiff_t offset = j - i, apart = offset > 0 && offset < count ? offset : count;
  add_springs(out + i, b, b, apart, FIRST);
  add_springs(out + i + apart, b + apart, b, count - apart, FIRST | SECOND);
  add_springs(out + j + count - apart, b, b + count - apart, apart, SECOND);
}

HOOKE_INLINE void multiply(const struct hk_run *run, const struct hk_tangent *tangent,
                           const double *const x[3], double *const out[3], const int indexed,
                           const int axial) {
  struct block b;
  for (int64_t done = 0; done < run->count; done += BLOCK) {
    const ptrdiff_t count = run->count - done < BLOCK ? run->count - done : BLOCK;
    const struct numbers s = numbers_of(run, tangent, done, axial);
    const ptrdiff_t i = indexed ? 0 : run->start + done, j = i + run->offset;
    const double *const from[3] = {x[0] + i, x[1] + i, x[2] + i};
    if (indexed || count < HOOKE_WIDTH)
      fill_block(b.x, b.y, b.z, from[0], from[1], from[2], s, count, indexed, axial);
    else
      fill_vectors(&b, from, s, count, axial);
    if (!indexed) {
      add_to_ends(out[0], b.x, i, j, count);
      add_to_ends(out[1], b.y, i, j, count);
      add_to_ends(out[2], b.z, i, j, count);
      continue;
    }
    for (ptrdiff_t k = 0; k < count; k++) {
      const ptrdiff_t head = s.head[k], tail = s.tail[k];
      out[0][head] += b.x[k];
      out[1][head] += b.y[k];
      out[2][head] += b.z[k];
      out[0][tail] -= b.x[k];
      out[1][tail] -= b.y[k];
      out[2][tail] -= b.z[k];
    }
  }
}

static void tangent_product(const struct hk_run *run, const struct hk_tangent *tangent,
                            const double *const x[3], double *const out[3]) {
  const int indexed = run->shape & HOOKE_RUN_INDEXED, axial = tangent->b == NULL;
  if (indexed && axial)
    multiply(run, tangent, x, out, 1, 1);
  else if (indexed)
    multiply(run, tangent, x, out, 1, 0);
  else if (axial)
    multiply(run, tangent, x, out, 0, 1);
  else
    multiply(run, tangent, x, out, 0, 0);
}

/* ---- diagonal ---- */

/* Blocks xx, yy, zz, xy, xz, yz of springs. */
HOOKE_INLINE void fill_blocks(double (*restrict block)[BLOCK], const struct numbers s, const ptrdiff_t count,
                              const int axial) {
  for (ptrdiff_t k = 0; k < count; k++) {
    const double ux = s.ux[k], uy = s.uy[k], uz = s.uz[k];
    double along = 1.0, across = 0.0;
    if (!axial) {
      across = s.b[k] > 0.0 ? s.b[k] : 0.0;
      along = ((s.ex[k] * ux + s.ey[k] * uy) + s.ez[k] * uz) + s.b[k] - across;
      along = along > -across ? along : -across; /* a curve may fall */
    }
    block[0][k] = along * ux * ux + across;
    block[1][k] = along * uy * uy + across;
    block[2][k] = along * uz * uz + across;
    block[3][k] = along * ux * uy + 0.0;
    block[4][k] = along * ux * uz + 0.0;
    block[5][k] = along * uy * uz + 0.0;
  }
}

/* Every particle sums its springs in ascending number. */
static void tangent_diagonal(const struct hk_run *run, const struct hk_tangent *t, double *const block[6]) {
  double own[6][BLOCK];
  const int axial = t->b == NULL;
  for (int64_t done = 0; done < run->count; done += BLOCK) {
    const ptrdiff_t count = run->count - done < BLOCK ? run->count - done : BLOCK;
    const struct numbers s = numbers_of(run, t, done, axial);
    const ptrdiff_t i = run->start + done, j = i + run->offset;
    if (axial)
      fill_blocks(own, s, count, 1);
    else
      fill_blocks(own, s, count, 0);
    for (int c = 0; c < 6; c++) {
      if (!(run->shape & HOOKE_RUN_INDEXED)) {
        add_springs(block[c] + (j > i ? j : i), own[c], own[c], count, FIRST);
        add_springs(block[c] + (j > i ? i : j), own[c], own[c], count, FIRST);
        continue;
      }
      for (ptrdiff_t k = 0; k < count; k++) {
        block[c][s.head[k]] += own[c][k];
        block[c][s.tail[k]] += own[c][k];
      }
    }
  }
}

/* ---- damping ---- */

static void tangent_damping(const struct hk_run *run, const struct hk_tangent *t, const double *const x[3],
                            double *const out[3]) {
  const int indexed = run->shape & HOOKE_RUN_INDEXED;
  for (ptrdiff_t k = 0; k < run->count; k++) {
    const ptrdiff_t i = indexed ? run->head[k] : run->start + k, j = indexed ? run->tail[k] : i + run->offset;
    const ptrdiff_t s = run->first + k;
    const double gamma = hk_run_material(run, k).gamma;
    const double u[3] = {t->u[0][s], t->u[1][s], t->u[2][s]};
    const double along =
        gamma * (((x[0][i] - x[0][j]) * u[0] + (x[1][i] - x[1][j]) * u[1]) + (x[2][i] - x[2][j]) * u[2]);
    for (int a = 0; a < 3; a++) {
      out[a][i] += along * u[a];
      out[a][j] -= along * u[a];
    }
  }
}

/* ---- the part of the diagonal ---- */

static void tangent_project(int64_t count, double share, const struct hk_tangent *t) {
  const double *const ux = t->u[0], *const uy = t->u[1], *const uz = t->u[2];
  double *const ex = t->e[0], *const ey = t->e[1], *const ez = t->e[2], *const b = t->b;
  HOOKE_VECTORISE
  for (int64_t s = 0; s < count; s++) {
    const double across = b[s] > 0.0 ? b[s] : share * b[s];
    const double along = ((ex[s] * ux[s] + ey[s] * uy[s]) + ez[s] * uz[s]) + b[s] - across;
    const double part = along > 0.0 ? along : 0.0;
    ex[s] = part * ux[s];
    ey[s] = part * uy[s];
    ez[s] = part * uz[s];
    b[s] = across;
  }
}

const struct hk_tangent_set HOOKE_TANGENT_SET = {tangent_fill, tangent_product, tangent_diagonal,
                                                 tangent_project, tangent_damping};
