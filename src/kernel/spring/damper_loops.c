/* Compiled once per instruction set, with HOOKE_ISA naming it. What a block of springs does goes into a
 * buffer first, which vectorises, and then to the particles. */
#include "kernel/spring/damper_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/spring/spring_body.h"

enum { BLOCK = 256 };

struct block {
  double x[BLOCK], y[BLOCK], z[BLOCK];
};

HOOKE_INLINE void fill(const struct hk_damped_springs springs, ptrdiff_t count, const double *restrict qx,
                       const double *restrict qy, const double *restrict qz, const double *restrict vx,
                       const double *restrict vy, const double *restrict vz, double *restrict bx,
                       double *restrict by, double *restrict bz, const int pull) {
  const int32_t *restrict head = springs.head, *restrict tail = springs.tail;
  const double *restrict impulse_per_rate = springs.impulse_per_rate, *restrict kappa = springs.kappa,
                         *restrict rest = springs.rest_length;
  HOOKE_VECTORISE
  for (ptrdiff_t k = 0; k < count; k++) {
    const ptrdiff_t i = head[k], j = tail[k];
    const double dx = qx[i] - qx[j], dy = qy[i] - qy[j], dz = qz[i] - qz[j];
    const double r = hk_spring_length(dx, dy, dz), ir = hk_spring_inverse_length(r);
    const double rate = (((vx[i] - vx[j]) * dx + (vy[i] - vy[j]) * dy) + (vz[i] - vz[j]) * dz) * ir;
    double impulse = impulse_per_rate[k] * rate;
    if (pull) {
      const double least = -(springs.half * (kappa[k] * (r - rest[k])));
      impulse = impulse < least ? least : impulse;
      impulse = r <= rest[k] ? 0.0 : impulse;
    }
    const double s = impulse * ir;
    bx[k] = s * dx;
    by[k] = s * dy;
    bz[k] = s * dz;
  }
}

HOOKE_INLINE void apply(const struct hk_damped_springs springs, ptrdiff_t count,
                        const struct hk_damper_point *at, const int pull) {
  struct block b;
  fill(springs, count, at->q[0], at->q[1], at->q[2], at->v[0], at->v[1], at->v[2], b.x, b.y, b.z, pull);
  double *x = at->v[0], *y = at->v[1], *z = at->v[2];
  for (ptrdiff_t k = 0; k < count; k++) {
    const ptrdiff_t i = springs.head[k], j = springs.tail[k];
    const double wi = at->w[i], wj = at->w[j];
    x[i] -= wi * b.x[k];
    y[i] -= wi * b.y[k];
    z[i] -= wi * b.z[k];
    x[j] += wj * b.x[k];
    y[j] += wj * b.y[k];
    z[j] += wj * b.z[k];
  }
}

void HOOKE_DAMPER_LOOP(const struct hk_damped_springs *springs, ptrdiff_t count,
                       const struct hk_damper_point *at) {
  struct hk_damped_springs some = *springs;
  const int pull = some.kappa != NULL;
  for (ptrdiff_t done = 0; done < count; done += BLOCK) {
    const ptrdiff_t next = count - done < BLOCK ? count - done : BLOCK;
    if (pull)
      apply(some, next, at, 1);
    else
      apply(some, next, at, 0);
    some.head += next, some.tail += next, some.impulse_per_rate += next;
    if (pull) some.kappa += next, some.rest_length += next;
  }
}
