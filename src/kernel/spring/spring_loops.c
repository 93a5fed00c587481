/* Compiled once per instruction set, with HOOKE_ISA naming it. Forces of a block of springs go into a buffer
 * first, which vectorises for any ends, and are then added in spring order, which keeps every sum the same to
 * the bit. */
#include "kernel/instruction_set.h"
#include "kernel/spring/spring_body.h"

#include <stddef.h>

enum { BLOCK = 256 };

struct block {
  double x[BLOCK], y[BLOCK], z[BLOCK];
};

/* Data of a run for a loop, in locals that no store can change: materials, and the ends of its springs. */
struct springs {
  double kappa, gamma, rest_length;
  const double *kappas, *gammas, *rest_lengths;
  const int32_t *head, *tail; /* NULL: spring k joins k and k + offset */
  ptrdiff_t offset;
};

/* b = s d for every spring of a block, with F = -s d; returns how short they are (spring_body.h). */
HOOKE_INLINE int64_t fill_block(double *restrict bx, double *restrict by, double *restrict bz,
                                const double *restrict qx, const double *restrict qy,
                                const double *restrict qz, const double *restrict vx,
                                const double *restrict vy, const double *restrict vz,
                                const struct springs springs, const ptrdiff_t count, const int indexed,
                                const int damped, const int mixed, const int pull) {
  int64_t lost = 0;
  HOOKE_VECTORISE
  for (ptrdiff_t k = 0; k < count; k++) {
    const ptrdiff_t i = indexed ? springs.head[k] : k, j = indexed ? springs.tail[k] : k + springs.offset;
    const double kappa = mixed ? springs.kappas[k] : springs.kappa;
    const double rest_length = mixed ? springs.rest_lengths[k] : springs.rest_length;
    const double dx = qx[i] - qx[j], dy = qy[i] - qy[j], dz = qz[i] - qz[j];
    const double r = hk_spring_length(dx, dy, dz), ir = hk_spring_inverse_length(r);
    double brake = 0.0;
    if (damped) {
      const double gamma = mixed ? springs.gammas[k] : springs.gamma;
      brake = gamma * ((((vx[i] - vx[j]) * dx + (vy[i] - vy[j]) * dy) + (vz[i] - vz[j]) * dz) * ir);
    }
    const double s = hk_spring_tension(r, rest_length, kappa, brake, damped, pull) * ir;
    bx[k] = s * dx;
    by[k] = s * dy;
    bz[k] = s * dz;
    lost += hk_spring_shortness(r, rest_length);
  }
  return lost;
}

HOOKE_INLINE void add_shifted(double *restrict f, const double *restrict b, ptrdiff_t count) {
  for (ptrdiff_t k = 0; k < count; k++)
    f[k] += b[k];
}

HOOKE_INLINE void subtract(double *restrict f, const double *restrict b, ptrdiff_t count) {
  for (ptrdiff_t k = 0; k < count; k++)
    f[k] -= b[k];
}

/* The sum at a particle goes by spring number: with a positive offset it is second end first, first end
 * later. */
HOOKE_INLINE void add_block(double *f, const double *b, ptrdiff_t i, ptrdiff_t j, ptrdiff_t count) {
  if (j > i) {
    add_shifted(f + j, b, count);
    subtract(f + i, b, count);
  } else {
    subtract(f + i, b, count);
    add_shifted(f + j, b, count);
  }
}

HOOKE_INLINE struct springs springs_from(const struct hk_run *run, int64_t done, int mixed) {
  struct springs springs = {
      .kappa = run->kappa, .gamma = run->gamma, .rest_length = run->rest_length, .offset = run->offset};
  if (mixed) {
    springs.kappas = run->kappas + done;
    springs.gammas = run->gammas + done;
    springs.rest_lengths = run->rest_lengths + done;
  }
  return springs;
}

HOOKE_INLINE int64_t offset_loop(const struct hk_run *run, const struct hk_fields *fields, const int damped,
                                 const int mixed, const int pull) {
  struct block b;
  int64_t lost = 0;
  for (int64_t done = 0; done < run->count; done += BLOCK) {
    const ptrdiff_t count = run->count - done < BLOCK ? run->count - done : BLOCK;
    const ptrdiff_t i = run->start + done, j = i + run->offset;
    const double *const *q = fields->q, *const *v = fields->v;
    lost += fill_block(b.x, b.y, b.z, q[0] + i, q[1] + i, q[2] + i, v[0] + i, v[1] + i, v[2] + i,
                       springs_from(run, done, mixed), count, 0, damped, mixed, pull);
    add_block(fields->f[0], b.x, i, j, count);
    add_block(fields->f[1], b.y, i, j, count);
    add_block(fields->f[2], b.z, i, j, count);
  }
  return lost;
}

HOOKE_INLINE int64_t indexed_loop(const struct hk_run *run, const struct hk_fields *fields, const int damped,
                                  const int mixed, const int pull) {
  struct block b;
  double *fx = fields->f[0], *fy = fields->f[1], *fz = fields->f[2];
  int64_t lost = 0;
  for (int64_t done = 0; done < run->count; done += BLOCK) {
    const ptrdiff_t count = run->count - done < BLOCK ? run->count - done : BLOCK;
    const double *const *q = fields->q, *const *v = fields->v;
    struct springs springs = springs_from(run, done, mixed);
    springs.head = run->head + done;
    springs.tail = run->tail + done;
    lost +=
        fill_block(b.x, b.y, b.z, q[0], q[1], q[2], v[0], v[1], v[2], springs, count, 1, damped, mixed, pull);
    for (ptrdiff_t k = 0; k < count; k++) {
      const ptrdiff_t i = springs.head[k], j = springs.tail[k];
      fx[i] -= b.x[k];
      fy[i] -= b.y[k];
      fz[i] -= b.z[k];
      fx[j] += b.x[k];
      fy[j] += b.y[k];
      fz[j] += b.z[k];
    }
  }
  return lost;
}

/* ---- the set ---- */

#define NAME(what, damped, mixed, pull) what##_##damped##mixed##pull
#define LOOPS(damped, mixed, pull)                                                                           \
  static int64_t NAME(offset, damped, mixed, pull)(const struct hk_run *run, const struct hk_fields *f) {    \
    return offset_loop(run, f, damped, mixed, pull);                                                         \
  }                                                                                                          \
  static int64_t NAME(indexed, damped, mixed, pull)(const struct hk_run *run, const struct hk_fields *f) {   \
    return indexed_loop(run, f, damped, mixed, pull);                                                        \
  }
LOOPS(0, 0, 0)
LOOPS(0, 0, 1)
LOOPS(0, 1, 0)
LOOPS(0, 1, 1)
LOOPS(1, 0, 0)
LOOPS(1, 0, 1)
LOOPS(1, 1, 0)
LOOPS(1, 1, 1)

#define BY_SHAPE(what, rest)                                                                                 \
  [(rest)] = NAME(what, 0, 0, 0), [(rest) | HOOKE_RUN_PULL_ONLY] = NAME(what, 0, 0, 1),                      \
  [(rest) | HOOKE_RUN_MIXED] = NAME(what, 0, 1, 0),                                                          \
  [(rest) | HOOKE_RUN_MIXED | HOOKE_RUN_PULL_ONLY] = NAME(what, 0, 1, 1),                                    \
  [(rest) | HOOKE_RUN_DAMPED] = NAME(what, 1, 0, 0),                                                         \
  [(rest) | HOOKE_RUN_DAMPED | HOOKE_RUN_PULL_ONLY] = NAME(what, 1, 0, 1),                                   \
  [(rest) | HOOKE_RUN_DAMPED | HOOKE_RUN_MIXED] = NAME(what, 1, 1, 0),                                       \
  [(rest) | HOOKE_RUN_DAMPED | HOOKE_RUN_MIXED | HOOKE_RUN_PULL_ONLY] = NAME(what, 1, 1, 1)

#define TEXT_OF(word) #word
#define TEXT(word)    TEXT_OF(word)

const struct hk_spring_set HOOKE_SPRING_SET = {
    .name = TEXT(HOOKE_ISA),
    .loop = {BY_SHAPE(offset, 0), BY_SHAPE(indexed, HOOKE_RUN_INDEXED)},
    .strided = HOOKE_STRIDED_LOOP,
    .tiled = &HOOKE_TILED_LOOPS,
    .dampers = HOOKE_DAMPER_LOOP,
    .derivative = HOOKE_DERIVATIVE_LOOP,
    .tetrahedra = HOOKE_TETRAHEDRON_LOOP,
    .move = HOOKE_MOVE_LOOP,
    .bending = HOOKE_BENDING_LOOP,
    .vector = &HOOKE_VECTOR_SET,
    .tangent = &HOOKE_TANGENT_SET,
    .energy = &HOOKE_ENERGY_SET,
    .triangle = &HOOKE_TRIANGLE_SET,
};
