/* Compiled once per instruction set, with HOOKE_ISA naming it. The changes of a block of springs go into a
 * buffer first, which vectorises, and then to the particles. */
#include "kernel/spring/derivative_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/spring/spring_body.h"

enum { BLOCK = 128 };

/* Springs of a run from number `done` on. */
struct part {
  ptrdiff_t done, count;
};

HOOKE_INLINE double product(const double *a, const double *b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

HOOKE_INLINE void fill(const struct hk_run run, const struct part part, const struct hk_derivative_rows rows,
                       double *restrict bx, double *restrict by, double *restrict bz, const int indexed,
                       const int shared) {
  const double *q = rows.q, *v = rows.v, *dq = rows.dq, *dv = rows.dv;
  const int pull = (run.shape & HOOKE_RUN_PULL_ONLY) != 0;
  const struct hk_material all = {run.kappa, run.gamma, run.rest_length};
  HOOKE_VECTORISE
  for (ptrdiff_t k = 0; k < part.count; k++) {
    const ptrdiff_t s = part.done + k, i = 3 * (indexed ? run.head[s] : run.start + s),
                    j = indexed ? 3 * (ptrdiff_t)run.tail[s] : i + 3 * (ptrdiff_t)run.offset;
    const struct hk_material m = shared ? all : hk_run_material(&run, s);
    const double d[3] = {q[i] - q[j], q[i + 1] - q[j + 1], q[i + 2] - q[j + 2]};
    const double e[3] = {v[i] - v[j], v[i + 1] - v[j + 1], v[i + 2] - v[j + 2]};
    const double y[3] = {dq[i] - dq[j], dq[i + 1] - dq[j + 1], dq[i + 2] - dq[j + 2]};
    const double z[3] = {dv[i] - dv[j], dv[i + 1] - dv[j + 1], dv[i + 2] - dv[j + 2]};
    const double r = hk_spring_length(d[0], d[1], d[2]), ir = hk_spring_inverse_length(r);
    const double u[3] = {d[0] * ir, d[1] * ir, d[2] * ir}, rate = product(e, d) * ir;
    const double tension = m.kappa * (r - m.rest_length) + m.gamma * rate, b = tension / r;
    const int slack = pull & ((r <= m.rest_length) | (tension < 0.0));
    const double isotropic = ((m.rest_length == 0.0) & !pull) ? m.kappa : 0.0;
    double c[3];
    for (int a = 0; a < 3; a++)
      c[a] = m.kappa * u[a] + m.gamma * (e[a] - rate * u[a]) / r;
    const double along = product(u, y), p = product(c, y) + m.gamma * product(u, z);
    double change[3];
    for (int a = 0; a < 3; a++) {
      const double whole = p * u[a] + b * (y[a] - along * u[a]);
      change[a] = r == 0.0 ? isotropic * y[a] : slack ? 0.0 : whole;
    }
    bx[k] = change[0];
    by[k] = change[1];
    bz[k] = change[2];
  }
}

void HOOKE_DERIVATIVE_LOOP(const struct hk_run *run, const struct hk_derivative_rows *rows) {
  const int indexed = run->shape & HOOKE_RUN_INDEXED;
  double bx[BLOCK], by[BLOCK], bz[BLOCK];
  for (struct part part = {0, 0}; part.done < run->count; part.done += part.count) {
    part.count = run->count - part.done < BLOCK ? run->count - part.done : BLOCK;
    if (run->shape & HOOKE_RUN_MIXED)
      fill(*run, part, *rows, bx, by, bz, indexed, 0);
    else if (indexed)
      fill(*run, part, *rows, bx, by, bz, 1, 1);
    else
      fill(*run, part, *rows, bx, by, bz, 0, 1);
    for (ptrdiff_t k = 0; k < part.count; k++) {
      double *first = rows->out + 3 * hk_run_head(run, part.done + k),
             *second = rows->out + 3 * hk_run_tail(run, part.done + k);
      first[0] -= bx[k];
      first[1] -= by[k];
      first[2] -= bz[k];
      second[0] += bx[k];
      second[1] += by[k];
      second[2] += bz[k];
    }
  }
}
