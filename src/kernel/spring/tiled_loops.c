/* Compiled once per instruction set, with HOOKE_ISA naming it. Ends are looked up as rows and transposed to
 * vectors of one component each; strengths are computed from those, and forces written some groups behind. */
#include "kernel/spring/tiled_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/vector_unit.h"

#include <string.h>

typedef hk_vector vec;

/* Four numbers of a row, and two; compilers split them where the instruction set has shorter vectors. */
typedef double quad __attribute__((vector_size(32), may_alias));
typedef double couple __attribute__((vector_size(16), may_alias));

/* Springs processed at once. */
enum { GROUP = HOOKE_WIDTH };

/* Springs in the pipeline: differences of the rows of their ends, and intermediate results. */
struct batch {
  _Alignas(64) double s[HOOKE_TILED_BATCH];
  hk_vector_mask lost[GROUP / HOOKE_WIDTH];
};

/* Indices of springs, and their forces on their ends. */
struct ends {
  const uint8_t *lower;
  const void *upper;
  const double *low, *up;
  double *on_lower, *on_upper;
};

/* Differences of GROUP springs, component by component. */
struct group {
  _Alignas(64) double x[GROUP], y[GROUP], z[GROUP], vx[GROUP], vy[GROUP], vz[GROUP];
};

HOOKE_INLINE size_t index_at(const void *index, ptrdiff_t k, const int wide) {
  return wide ? ((const uint32_t *)index)[k] : ((const uint16_t *)index)[k];
}

HOOKE_INLINE const double *lower_row(const struct ends *ends, ptrdiff_t k) {
  return ends->low + HOOKE_TILED_ROW * (size_t)ends->lower[k];
}

HOOKE_INLINE const double *upper_row(const struct ends *ends, ptrdiff_t k, const int wide) {
  return ends->up + HOOKE_TILED_ROW * index_at(ends->upper, k, wide);
}

/* ---- differences: d of each spring is stored where the force on its upper end goes ---- */

typedef double loose_quad __attribute__((vector_size(32), aligned(8), may_alias));

#if defined(__clang__)
#define PICK(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
typedef int64_t places __attribute__((vector_size(32)));
#define PICK(a, b, ...) __builtin_shuffle(a, b, (places){__VA_ARGS__})
#endif

#define KEEP(ends, k, d) *(quad *)((ends)->on_upper + HOOKE_TILED_FORCE * (k)) = (d)

HOOKE_INLINE void subtract_one(const struct ends *ends, ptrdiff_t k, struct group *group, const int damped,
                               const int wide) {
  const double *i = lower_row(ends, k), *j = upper_row(ends, k, wide);
  const quad d = *(const quad *)i - *(const quad *)j;
  KEEP(ends, k, d);
  group->x[0] = d[0];
  group->y[0] = d[1];
  group->z[0] = d[2];
  group->vz[0] = d[3];
  if (!damped) return;
  group->vx[0] = i[4] - j[4];
  group->vy[0] = i[5] - j[5];
}

#if HOOKE_WIDTH == 8

HOOKE_INLINE __m512d subtract_rows(const struct ends *ends, ptrdiff_t k, const int wide) {
  const __m512d d =
      _mm512_sub_pd(_mm512_load_pd(lower_row(ends, k)), _mm512_load_pd(upper_row(ends, k, wide)));
  KEEP(ends, k, (quad)_mm512_castpd512_pd256(d));
  return d;
}

/* Couples of numbers: two of a, two of b. */
#define COUPLES(a, b, a0, a1, b0, b1) _mm512_shuffle_f64x2(a, b, (a0) | (a1) << 2 | (b0) << 4 | (b1) << 6)

/* Rows are x y z vz vx vy: from each pair of rows, numbers in even places lie couple by couple in `even`, the
 * others in `odd`. */
HOOKE_INLINE void subtract_group(const struct ends *ends, ptrdiff_t k, struct group *group, const int damped,
                                 const int wide) {
#define TWO(n)                                                                                               \
  const __m512d a##n = subtract_rows(ends, k + (n), wide), b##n = subtract_rows(ends, k + (n) + 1, wide),    \
                even##n = _mm512_unpacklo_pd(a##n, b##n), odd##n = _mm512_unpackhi_pd(a##n, b##n)
  TWO(0);
  TWO(2);
  TWO(4);
  TWO(6);
  const __m512d xz0 = COUPLES(even0, even2, 0, 1, 0, 1), xz4 = COUPLES(even4, even6, 0, 1, 0, 1),
                yvz0 = COUPLES(odd0, odd2, 0, 1, 0, 1), yvz4 = COUPLES(odd4, odd6, 0, 1, 0, 1);
  _mm512_store_pd(group->x, COUPLES(xz0, xz4, 0, 2, 0, 2));
  _mm512_store_pd(group->y, COUPLES(yvz0, yvz4, 0, 2, 0, 2));
  _mm512_store_pd(group->z, COUPLES(xz0, xz4, 1, 3, 1, 3));
  if (!damped) return;
  _mm512_store_pd(group->vz, COUPLES(yvz0, yvz4, 1, 3, 1, 3));
  const __m512d vx0 = COUPLES(even0, even2, 2, 2, 2, 2), vx4 = COUPLES(even4, even6, 2, 2, 2, 2),
                vy0 = COUPLES(odd0, odd2, 2, 2, 2, 2), vy4 = COUPLES(odd4, odd6, 2, 2, 2, 2);
  _mm512_store_pd(group->vx, COUPLES(vx0, vx4, 0, 2, 0, 2));
  _mm512_store_pd(group->vy, COUPLES(vy0, vy4, 0, 2, 0, 2));
}

#elif HOOKE_WIDTH == 4

HOOKE_INLINE void subtract_group(const struct ends *ends, ptrdiff_t k, struct group *group, const int damped,
                                 const int wide) {
#define ROW(n)                                                                                               \
  const double *i##n = lower_row(ends, k + (n)), *j##n = upper_row(ends, k + (n), wide);                     \
  const quad d##n = *(const quad *)i##n - *(const quad *)j##n;                                               \
  KEEP(ends, k + (n), d##n)
  ROW(0);
  ROW(1);
  ROW(2);
  ROW(3);
  const quad even0 = PICK(d0, d1, 0, 4, 2, 6), even2 = PICK(d2, d3, 0, 4, 2, 6),
             odd0 = PICK(d0, d1, 1, 5, 3, 7), odd2 = PICK(d2, d3, 1, 5, 3, 7);
  *(quad *)group->x = PICK(even0, even2, 0, 1, 4, 5);
  *(quad *)group->y = PICK(odd0, odd2, 0, 1, 4, 5);
  *(quad *)group->z = PICK(even0, even2, 2, 3, 6, 7);
  if (!damped) return;
  *(quad *)group->vz = PICK(odd0, odd2, 2, 3, 6, 7);
#define FLOW(n) const couple v##n = *(const couple *)(i##n + 4) - *(const couple *)(j##n + 4)
  FLOW(0);
  FLOW(1);
  FLOW(2);
  FLOW(3);
  const quad v02 = {v0[0], v0[1], v2[0], v2[1]}, v13 = {v1[0], v1[1], v3[0], v3[1]};
  *(quad *)group->vx = PICK(v02, v13, 0, 4, 2, 6);
  *(quad *)group->vy = PICK(v02, v13, 1, 5, 3, 7);
}

#else

/* Two numbers of a row, the `at`-th and the next, of two springs. */
HOOKE_INLINE void subtract_couples(const struct ends *ends, ptrdiff_t k, ptrdiff_t at, double *first,
                                   double *second, const int wide) {
  const couple a =
      *(const couple *)(lower_row(ends, k) + at) - *(const couple *)(upper_row(ends, k, wide) + at);
  const couple b =
      *(const couple *)(lower_row(ends, k + 1) + at) - *(const couple *)(upper_row(ends, k + 1, wide) + at);
  *(couple *)first = (couple){a[0], b[0]};
  *(couple *)second = (couple){a[1], b[1]};
  if (at >= HOOKE_TILED_FORCE) return;
  *(couple *)(ends->on_upper + HOOKE_TILED_FORCE * k + at) = a;
  *(couple *)(ends->on_upper + HOOKE_TILED_FORCE * (k + 1) + at) = b;
}

HOOKE_INLINE void subtract_group(const struct ends *ends, ptrdiff_t k, struct group *group, const int damped,
                                 const int wide) {
  subtract_couples(ends, k, 0, group->x, group->y, wide);
  subtract_couples(ends, k, 2, group->z, group->vz, wide);
  if (damped) subtract_couples(ends, k, 4, group->vx, group->vy, wide);
}

#endif

/* ---- strengths and forces ---- */

/* Stiffness or damping of the springs from k on: their own, over the rest length, or one for all. */
HOOKE_INLINE vec strength_of(const double *own, double shared, ptrdiff_t k, vec rest, const int material) {
  if (material == HOOKE_TILED_MIXED) return hk_load(own + k);
  if (material == HOOKE_TILED_STRAIN) return hk_all(shared) / rest;
  return hk_all(shared);
}

HOOKE_INLINE void find_strengths(const struct hk_tiled_springs *springs, ptrdiff_t from,
                                 const struct group *group, struct batch *batch, const int damped,
                                 const int pull, const int material) {
  for (ptrdiff_t n = 0; n < GROUP; n += HOOKE_WIDTH) {
    const ptrdiff_t k = from + n;
    const vec dx = hk_load(group->x + n), dy = hk_load(group->y + n), dz = hk_load(group->z + n);
    const vec rest = material ? hk_load(springs->rest_lengths + k) : hk_all(springs->rest_length);
    const vec kappa = strength_of(springs->kappas, springs->kappa, k, rest, material);
    const vec r = hk_vector_sqrt((dx * dx + dy * dy) + dz * dz);
    const hk_vector_mask together = (hk_vector_mask)(r == 0.0);
    const vec ir = (vec)((hk_vector_mask)(1.0 / r) & ~together);
    vec tension = kappa * (r - rest);
    if (damped) {
      const vec gamma = strength_of(springs->gammas, springs->gamma, k, rest, material);
      const vec vx = hk_load(group->vx + n), vy = hk_load(group->vy + n), vz = hk_load(group->vz + n);
      tension = tension + gamma * (((vx * dx + vy * dy) + vz * dz) * ir);
    }
    if (pull) tension = (vec)((hk_vector_mask)tension & ~((r <= rest) | (tension < 0.0)));
    hk_store(batch->s + k, tension * ir);
    const hk_vector_mask shorter = (hk_vector_mask)(r + r < rest);
    batch->lost[n / HOOKE_WIDTH] += shorter & ((together & HOOKE_LOST) + 1);
  }
}

/* For the first spring of a group only. */
HOOKE_INLINE int64_t find_strength(const struct hk_tiled_springs *springs, ptrdiff_t k,
                                   const struct group *group, struct batch *batch, const int damped,
                                   const int pull, const int material) {
  const double dx = group->x[0], dy = group->y[0], dz = group->z[0];
  const double rest_length = material ? springs->rest_lengths[k] : springs->rest_length;
  const double divisor = material == HOOKE_TILED_STRAIN ? rest_length : 1.0;
  const double kappa = material == HOOKE_TILED_MIXED ? springs->kappas[k] : springs->kappa / divisor;
  const double r = hk_spring_length(dx, dy, dz), ir = hk_spring_inverse_length(r);
  double brake = 0.0;
  if (damped) {
    const double gamma = material == HOOKE_TILED_MIXED ? springs->gammas[k] : springs->gamma / divisor;
    brake = gamma * (((group->vx[0] * dx + group->vy[0] * dy) + group->vz[0] * dz) * ir);
  }
  batch->s[k] = hk_spring_tension(r, rest_length, kappa, brake, damped, pull) * ir;
  return hk_spring_shortness(r, rest_length);
}

HOOKE_INLINE void write_forces(const struct ends *ends, ptrdiff_t from, ptrdiff_t to, const double *s) {
  for (ptrdiff_t k = from; k < to; k++) {
    const quad strength = {s[k], s[k], s[k], s[k]};
    const quad b = strength * *(const quad *)(ends->on_upper + HOOKE_TILED_FORCE * k);
    *(quad *)(ends->on_upper + HOOKE_TILED_FORCE * k) = b;
    *(quad *)(ends->on_lower + HOOKE_TILED_FORCE * k) = -b;
  }
}

/* Forces are written this many springs after their strengths were begun, since groups would otherwise wait
 * for roots and quotients. */
enum { BEHIND = 3 * GROUP };

/* Of the springs in places `first` and later of their groups, since the last call. */
HOOKE_INLINE int64_t take_lost(ptrdiff_t first, struct batch *batch) {
  int64_t lost = 0;
  for (ptrdiff_t n = first; n < GROUP; n++)
    lost += batch->lost[n / HOOKE_WIDTH][n % HOOKE_WIDTH];
  memset(batch->lost, 0, sizeof batch->lost);
  return lost;
}

HOOKE_INLINE int64_t fill(const struct hk_tiled_springs *springs, ptrdiff_t count, const double *low,
                          const double *up, double *on_lower, double *on_upper, const int damped,
                          const int pull, const int wide, const int material) {
  const struct ends ends = {springs->lower, springs->upper, low, up, on_lower, on_upper};
  struct batch batch;
  struct group group;
  memset(batch.lost, 0, sizeof batch.lost);
  ptrdiff_t k = 0;
  for (; k + GROUP <= count; k += GROUP) {
    subtract_group(&ends, k, &group, damped, wide);
    find_strengths(springs, k, &group, &batch, damped, pull, material);
    if (k >= BEHIND) write_forces(&ends, k - BEHIND, k - BEHIND + GROUP, batch.s);
  }
  const ptrdiff_t written = k > BEHIND ? k - BEHIND : 0, rest = count - k;
  int64_t lost = take_lost(0, &batch);
  if (rest > 0 && k > 0) { /* one more whole group, whose first springs are computed again */
    k = count - GROUP;
    subtract_group(&ends, k, &group, damped, wide);
    find_strengths(springs, k, &group, &batch, damped, pull, material);
    lost += take_lost(GROUP - rest, &batch);
    k = count;
  }
  for (; k < count; k++) {
    subtract_one(&ends, k, &group, damped, wide);
    lost += find_strength(springs, k, &group, &batch, damped, pull, material);
  }
  write_forces(&ends, written, count, batch.s);
  return lost;
}

/* ---- sums ---- */

HOOKE_INLINE const quad *force_at(const double *force, const void *slot, ptrdiff_t k, const int wide) {
  return (const quad *)(force + HOOKE_TILED_FORCE * index_at(slot, k, wide));
}

HOOKE_INLINE const void *sum(ptrdiff_t count, const uint16_t *restrict degree, const void *slot,
                             const double *restrict force, double *const f[3], const int wide) {
  double *restrict x = f[0], *restrict y = f[1], *restrict z = f[2];
  ptrdiff_t k = 0;
  for (ptrdiff_t p = 0; p < count; p++) {
    quad total = {0.0, 0.0, 0.0, 0.0};
    ptrdiff_t left = degree[p];
    for (; left >= 4; left -= 4, k += 4) {
      total += *force_at(force, slot, k, wide);
      total += *force_at(force, slot, k + 1, wide);
      total += *force_at(force, slot, k + 2, wide);
      total += *force_at(force, slot, k + 3, wide);
    }
    if (left & 2) {
      total += *force_at(force, slot, k, wide);
      total += *force_at(force, slot, k + 1, wide);
      k += 2;
    }
    if (left & 1) total += *force_at(force, slot, k++, wide);
    x[p] = total[0];
    y[p] = total[1];
    z[p] = total[2];
  }
  return wide ? (const void *)((const uint32_t *)slot + k) : (const void *)((const uint16_t *)slot + k);
}

static const void *sum_narrow(ptrdiff_t count, const uint16_t *degree, const void *slot, const double *force,
                              double *const f[3]) {
  return sum(count, degree, slot, force, f, 0);
}

static const void *sum_wide(ptrdiff_t count, const uint16_t *degree, const void *slot, const double *force,
                            double *const f[3]) {
  return sum(count, degree, slot, force, f, 1);
}

/* ---- rows ---- */

/* Stored as it is loaded: several stores would have to end before one load of them. */
static void row_of(ptrdiff_t p, const double *const q[3], const double *const v[3], double *row) {
  *(quad *)row = (quad){q[0][p], q[1][p], q[2][p], v ? v[2][p] : 0.0};
  if (v) *(couple *)(row + 4) = (couple){v[0][p], v[1][p]};
}

/* Four rows from four numbers of each component; zeros for z and w if they are NULL. */
HOOKE_INLINE void turn_four(const double *x, const double *y, const double *z, const double *w, double *row) {
  const quad four_x = *(const loose_quad *)x, four_y = *(const loose_quad *)y;
  quad four_z = {0.0, 0.0, 0.0, 0.0}, four_w = {0.0, 0.0, 0.0, 0.0};
  if (z) four_z = *(const loose_quad *)z;
  if (w) four_w = *(const loose_quad *)w;
  const quad xy02 = PICK(four_x, four_y, 0, 4, 2, 6), xy13 = PICK(four_x, four_y, 1, 5, 3, 7),
             zw02 = PICK(four_z, four_w, 0, 4, 2, 6), zw13 = PICK(four_z, four_w, 1, 5, 3, 7);
  *(quad *)row = PICK(xy02, zw02, 0, 1, 4, 5);
  *(quad *)(row + HOOKE_TILED_ROW) = PICK(xy13, zw13, 0, 1, 4, 5);
  *(quad *)(row + (ptrdiff_t)2 * HOOKE_TILED_ROW) = PICK(xy02, zw02, 2, 3, 6, 7);
  *(quad *)(row + (ptrdiff_t)3 * HOOKE_TILED_ROW) = PICK(xy13, zw13, 2, 3, 6, 7);
}

static void copy_rows(ptrdiff_t count, const int32_t *order, const double *const q[3],
                      const double *const v[3], double *rows) {
  ptrdiff_t p = 0;
  for (; HOOKE_WIDTH > 2 && p + 4 <= count && order == NULL; p += 4) {
    double *row = rows + HOOKE_TILED_ROW * p;
    turn_four(q[0] + p, q[1] + p, q[2] + p, v ? v[2] + p : NULL, row);
    if (v) turn_four(v[0] + p, v[1] + p, NULL, NULL, row + 4);
  }
  for (; p < count; p++)
    row_of(order ? order[p] : p, q, v, rows + HOOKE_TILED_ROW * p);
}

/* ---- the set ---- */

#define NAME(shape) fill_##shape
#define FILL(shape)                                                                                          \
  static int64_t NAME(shape)(const struct hk_tiled_springs *springs, ptrdiff_t count, const double *lower,   \
                             const double *upper, double *on_lower, double *on_upper) {                      \
    return fill(springs, count, lower, upper, on_lower, on_upper, (shape)&HOOKE_TILED_DAMPED,                \
                (shape)&HOOKE_TILED_PULL_ONLY, (shape)&HOOKE_TILED_WIDE, (shape)&HOOKE_TILED_MIXED);         \
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

const struct hk_tiled_loops HOOKE_TILED_LOOPS = {
    .fill = {EVERY(ENTRY)}, .sum = {sum_narrow, sum_wide}, .rows = copy_rows};
