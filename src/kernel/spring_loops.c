/* Compiled once per instruction set, with HOOKE_ISA naming it. Forces of a block of springs go into a buffer
 * first, which vectorises whatever the ends are, and are then added in spring order, which keeps every sum
 * the same to the bit. */
#include "kernel/spring_body.h"
#include "kernel/spring_loops.h"

#include <stddef.h>

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b)       JOIN_NAMES(a, b)

enum { BLOCK = 256 };

struct block {
  double x[BLOCK], y[BLOCK], z[BLOCK];
};

/* The elastic and damping part s of F = -s d for spring k of the block, and d. */
#define SPRING(k, i, j)                                                                                      \
  do {                                                                                                       \
    double dx = qx[i] - qx[j], dy = qy[i] - qy[j], dz = qz[i] - qz[j];                                       \
    double r = hooke_spring_length(dx, dy, dz);                                                              \
    double ir = hooke_spring_inverse_length(r);                                                              \
    double kappa = mixed ? kappas[k] : run->kappa;                                                           \
    double rest = mixed ? rests[k] : run->rest_length;                                                       \
    double brake = 0.0;                                                                                      \
    if (damped) {                                                                                            \
      double gamma = mixed ? gammas[k] : run->gamma;                                                         \
      brake = gamma * ((((vx[i] - vx[j]) * dx + (vy[i] - vy[j]) * dy) + (vz[i] - vz[j]) * dz) * ir);         \
    }                                                                                                        \
    double s = hooke_spring_tension(r, rest, kappa, brake, damped, pull) * ir;                               \
    b->x[k] = s * dx;                                                                                        \
    b->y[k] = s * dy;                                                                                        \
    b->z[k] = s * dz;                                                                                        \
    lost += (r == 0.0) & (rest != 0.0);                                                                      \
  } while (0)

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

HOOKE_INLINE int64_t offset_loop(const struct hooke_run *run, const struct hooke_fields *fields,
                                 const int damped, const int mixed, const int pull) {
  struct block block;
  struct block *restrict b = &block;
  int64_t lost = 0;
  for (int64_t done = 0; done < run->count; done += BLOCK) {
    const ptrdiff_t count = run->count - done < BLOCK ? run->count - done : BLOCK;
    const ptrdiff_t base = run->start + done, offset = run->offset;
    const double *qx = fields->q[0] + base, *qy = fields->q[1] + base, *qz = fields->q[2] + base;
    const double *vx = damped ? fields->v[0] + base : NULL, *vy = damped ? fields->v[1] + base : NULL,
                 *vz = damped ? fields->v[2] + base : NULL;
    const double *kappas = mixed ? run->kappas + done : NULL, *gammas = mixed ? run->gammas + done : NULL,
                 *rests = mixed ? run->rest_lengths + done : NULL;
    for (ptrdiff_t k = 0; k < count; k++)
      SPRING(k, k, k + offset);
    add_block(fields->f[0], b->x, base, base + offset, count);
    add_block(fields->f[1], b->y, base, base + offset, count);
    add_block(fields->f[2], b->z, base, base + offset, count);
  }
  return lost;
}

HOOKE_INLINE int64_t indexed_loop(const struct hooke_run *run, const struct hooke_fields *fields,
                                  const int damped, const int mixed, const int pull) {
  struct block block;
  struct block *restrict b = &block;
  const double *qx = fields->q[0], *qy = fields->q[1], *qz = fields->q[2];
  const double *vx = fields->v[0], *vy = fields->v[1], *vz = fields->v[2];
  double *fx = fields->f[0], *fy = fields->f[1], *fz = fields->f[2];
  int64_t lost = 0;
  for (int64_t done = 0; done < run->count; done += BLOCK) {
    const ptrdiff_t count = run->count - done < BLOCK ? run->count - done : BLOCK;
    const int32_t *head = run->head + done, *tail = run->tail + done;
    const double *kappas = mixed ? run->kappas + done : NULL, *gammas = mixed ? run->gammas + done : NULL,
                 *rests = mixed ? run->rest_lengths + done : NULL;
    for (ptrdiff_t k = 0; k < count; k++)
      SPRING(k, head[k], tail[k]);
    for (ptrdiff_t k = 0; k < count; k++) {
      ptrdiff_t i = head[k], j = tail[k];
      fx[i] -= b->x[k];
      fy[i] -= b->y[k];
      fz[i] -= b->z[k];
      fx[j] += b->x[k];
      fy[j] += b->y[k];
      fz[j] += b->z[k];
    }
  }
  return lost;
}

#define LOOP_NAME(layout, damped, mixed, pull) layout##_##damped##mixed##pull
#define LOOP(layout, damped, mixed, pull)                                                                    \
  static int64_t LOOP_NAME(layout, damped, mixed, pull)(const struct hooke_run *run,                         \
                                                        const struct hooke_fields *f) {                      \
    return layout##_loop(run, f, damped, mixed, pull);                                                       \
  }
#define LOOPS_OF_LAYOUT(layout)                                                                              \
  LOOP(layout, 0, 0, 0)                                                                                      \
  LOOP(layout, 0, 0, 1)                                                                                      \
  LOOP(layout, 0, 1, 0)                                                                                      \
  LOOP(layout, 0, 1, 1)                                                                                      \
  LOOP(layout, 1, 0, 0)                                                                                      \
  LOOP(layout, 1, 0, 1)                                                                                      \
  LOOP(layout, 1, 1, 0)                                                                                      \
  LOOP(layout, 1, 1, 1)

LOOPS_OF_LAYOUT(offset)
LOOPS_OF_LAYOUT(indexed)

extern hooke_spring_loop *const JOIN(hooke_spring_loops_, HOOKE_ISA)[HOOKE_RUN_SHAPES];
hooke_spring_loop *const JOIN(hooke_spring_loops_, HOOKE_ISA)[HOOKE_RUN_SHAPES] = {
    [0] = offset_000,
    [HOOKE_RUN_PULL_ONLY] = offset_001,
    [HOOKE_RUN_MIXED] = offset_010,
    [HOOKE_RUN_MIXED | HOOKE_RUN_PULL_ONLY] = offset_011,
    [HOOKE_RUN_DAMPED] = offset_100,
    [HOOKE_RUN_DAMPED | HOOKE_RUN_PULL_ONLY] = offset_101,
    [HOOKE_RUN_DAMPED | HOOKE_RUN_MIXED] = offset_110,
    [HOOKE_RUN_DAMPED | HOOKE_RUN_MIXED | HOOKE_RUN_PULL_ONLY] = offset_111,
    [HOOKE_RUN_INDEXED] = indexed_000,
    [HOOKE_RUN_INDEXED | HOOKE_RUN_PULL_ONLY] = indexed_001,
    [HOOKE_RUN_INDEXED | HOOKE_RUN_MIXED] = indexed_010,
    [HOOKE_RUN_INDEXED | HOOKE_RUN_MIXED | HOOKE_RUN_PULL_ONLY] = indexed_011,
    [HOOKE_RUN_INDEXED | HOOKE_RUN_DAMPED] = indexed_100,
    [HOOKE_RUN_INDEXED | HOOKE_RUN_DAMPED | HOOKE_RUN_PULL_ONLY] = indexed_101,
    [HOOKE_RUN_INDEXED | HOOKE_RUN_DAMPED | HOOKE_RUN_MIXED] = indexed_110,
    [HOOKE_RUN_INDEXED | HOOKE_RUN_DAMPED | HOOKE_RUN_MIXED | HOOKE_RUN_PULL_ONLY] = indexed_111,
};
