/* Compiled once per instruction set, with HOOKE_ISA naming it. Ends are looked up as rows, strengths computed on whole
 * vectors in between. */
#include "kernel/net_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/spring_body.h"

/* Four numbers of a row, and two; compilers split them where the instruction set has shorter vectors. */
typedef double quad __attribute__((vector_size(32), may_alias));
typedef double couple __attribute__((vector_size(16), may_alias));

/* ---- springs ---- */

struct batch {
  _Alignas(64) double d[4 * HOOKE_NET_BATCH]; /* dx, dy, dz, dvz */
  _Alignas(64) double w[2 * HOOKE_NET_BATCH]; /* dvx, dvy */
  _Alignas(64) double s[HOOKE_NET_BATCH];
};

HOOKE_INLINE size_t index_at(const void *index, ptrdiff_t k, const int wide) {
  return wide ? ((const uint32_t *)index)[k] : ((const uint16_t *)index)[k];
}

HOOKE_INLINE void subtract_rows(const uint8_t *restrict lower, const void *restrict upper, ptrdiff_t count,
                                const double *restrict low, const double *restrict up,
                                struct batch *restrict batch, const int damped, const int wide) {
  for (ptrdiff_t k = 0; k < count; k++) {
    const double *i = low + HOOKE_NET_ROW * (size_t)lower[k],
                 *j = up + HOOKE_NET_ROW * index_at(upper, k, wide);
    *(quad *)(batch->d + 4 * k) = *(const quad *)i - *(const quad *)j;
    if (damped) *(couple *)(batch->w + 2 * k) = *(const couple *)(i + 4) - *(const couple *)(j + 4);
  }
}

HOOKE_INLINE int64_t find_strengths(const struct hooke_net_springs springs, ptrdiff_t count,
                                    const double *restrict d, const double *restrict w, double *restrict s,
                                    const int damped, const int pull, const int material) {
  int64_t lost = 0;
  HOOKE_VECTORISE
  for (ptrdiff_t k = 0; k < count; k++) {
    const double dx = d[4 * k], dy = d[4 * k + 1], dz = d[4 * k + 2];
    const double rest_length = material ? springs.rest_lengths[k] : springs.rest_length;
    const double kappa = material == HOOKE_NET_MIXED    ? springs.kappas[k]
                         : material == HOOKE_NET_STRAIN ? springs.kappa / rest_length
                                                        : springs.kappa;
    const double r = hooke_spring_length(dx, dy, dz), ir = hooke_spring_inverse_length(r);
    double brake = 0.0;
    if (damped) {
      const double gamma = material == HOOKE_NET_MIXED    ? springs.gammas[k]
                           : material == HOOKE_NET_STRAIN ? springs.gamma / rest_length
                                                          : springs.gamma;
      brake = gamma * (((w[2 * k] * dx + w[2 * k + 1] * dy) + d[4 * k + 3] * dz) * ir);
    }
    s[k] = hooke_spring_tension(r, rest_length, kappa, brake, damped, pull) * ir;
    lost += (r == 0.0) & (rest_length != 0.0);
  }
  return lost;
}

HOOKE_INLINE void write_pairs(ptrdiff_t count, const struct batch *restrict batch, double *restrict pair) {
  for (ptrdiff_t k = 0; k < count; k++) {
    const double s = batch->s[k];
    const quad strength = {s, s, s, s};
    const quad b = strength * *(const quad *)(batch->d + 4 * k);
    *(quad *)(pair + HOOKE_NET_ROW * k) = b;
    *(quad *)(pair + HOOKE_NET_ROW * k + 4) = -b;
  }
}

HOOKE_INLINE int64_t fill(const struct hooke_net_springs *springs, ptrdiff_t count, const double *lower,
                          const double *upper, double *pair, const int damped, const int pull, const int wide,
                          const int material) {
  struct batch batch;
  subtract_rows(springs->lower, springs->upper, count, lower, upper, &batch, damped, wide);
  const int64_t lost = find_strengths(*springs, count, batch.d, batch.w, batch.s, damped, pull, material);
  write_pairs(count, &batch, pair);
  return lost;
}

/* ---- sums ---- */

HOOKE_INLINE const void *sum(ptrdiff_t count, const uint16_t *restrict degree, const void *half,
                             const double *restrict pair, double *const f[3], const int wide) {
  double *restrict x = f[0], *restrict y = f[1], *restrict z = f[2];
  ptrdiff_t k = 0;
  for (ptrdiff_t p = 0; p < count; p++) {
    const ptrdiff_t end = k + degree[p];
    quad total = {0.0, 0.0, 0.0, 0.0};
    for (; k + 1 < end; k += 2) {
      total += *(const quad *)(pair + 4 * index_at(half, k, wide));
      total += *(const quad *)(pair + 4 * index_at(half, k + 1, wide));
    }
    if (k < end) total += *(const quad *)(pair + 4 * index_at(half, k++, wide));
    x[p] = total[0];
    y[p] = total[1];
    z[p] = total[2];
  }
  return wide ? (const void *)((const uint32_t *)half + k) : (const void *)((const uint16_t *)half + k);
}

static const void *sum_narrow(ptrdiff_t count, const uint16_t *degree, const void *half, const double *pair,
                              double *const f[3]) {
  return sum(count, degree, half, pair, f, 0);
}

static const void *sum_wide(ptrdiff_t count, const uint16_t *degree, const void *half, const double *pair,
                            double *const f[3]) {
  return sum(count, degree, half, pair, f, 1);
}

/* ---- the set ---- */

#define NAME(shape) fill_##shape
#define FILL(shape)                                                                                          \
  static int64_t NAME(shape)(const struct hooke_net_springs *springs, ptrdiff_t count, const double *lower,  \
                             const double *upper, double *pair) {                                            \
    return fill(springs, count, lower, upper, pair, (shape)&HOOKE_NET_DAMPED, (shape)&HOOKE_NET_PULL_ONLY,   \
                (shape)&HOOKE_NET_WIDE, (shape)&HOOKE_NET_MIXED);                                            \
  }
#define FOUR(what, a, b, c, d) what(a) what(b) what(c) what(d)
#define EVERY(what)                                                                                          \
  FOUR(what, 0, 1, 2, 3)                                                                                     \
  FOUR(what, 4, 5, 6, 7)                                                                                     \
  FOUR(what, 8, 9, 10, 11)                                                                                   \
  FOUR(what, 12, 13, 14, 15)                                                                                 \
  FOUR(what, 16, 17, 18, 19)                                                                                 \
  FOUR(what, 20, 21, 22, 23) FOUR(what, 24, 25, 26, 27) FOUR(what, 28, 29, 30, 31)
EVERY(FILL)

#define ENTRY(shape) NAME(shape),

const struct hooke_net_loops HOOKE_NET_LOOPS = {.fill = {EVERY(ENTRY)}, .sum = {sum_narrow, sum_wide}};
