/* Compiled once per instruction set, with HOOKE_ISA naming it. Three numbers of a block are loaded with one
 * more, which is not used. */
#include "kernel/triangle_loops.h"

#include "kernel/instruction_set.h"

typedef double four __attribute__((vector_size(32), aligned(8), may_alias));

#define INLINE static inline __attribute__((always_inline))

static void triangle_forward(const struct hk_triangle *l, double *x) {
  for (int64_t k = 0; k < l->count; k++) {
    const double *c = l->corner + 6 * k;
    double *own = x + 3 * k;
    own[0] = own[0] * c[0];
    own[1] = (own[1] - c[1] * own[0]) * c[3];
    own[2] = ((own[2] - c[2] * own[0]) - c[4] * own[1]) * c[5];
    const double a = own[0], b = own[1], d = own[2];
    for (int64_t e = l->begin[k]; e < l->begin[k + 1]; e++) {
      const double *block = l->block + 9 * e;
      double *to = x + l->row[e];
      for (int r = 0; r < 3; r++)
        to[r] -= (block[r] * a + block[3 + r] * b) + block[6 + r] * d;
    }
  }
}

struct sums {
  four of[3];
};

INLINE void add_block(const struct hk_triangle *l, int64_t e, const double *x, struct sums *sums) {
  const double *block = l->block + 9 * e;
  const four y = *(const four *)(x + l->row[e]);
  for (ptrdiff_t c = 0; c < 3; c++)
    sums->of[c] += *(const four *)(block + 3 * c) * y;
}

INLINE double total(const struct sums *a, const struct sums *b, int c) {
  const four sum = a->of[c] + b->of[c];
  return (sum[0] + sum[1]) + sum[2];
}

/* Descending in memory all the way, which processors prefetch. */
static void triangle_backward(const struct hk_triangle *l, double *x) {
  for (int64_t k = l->count - 1; k >= 0; k--) {
    struct sums one = {{{0.0}}}, other = {{{0.0}}};
    int64_t e = l->begin[k + 1] - 1;
    for (; e > l->begin[k]; e -= 2) {
      add_block(l, e, x, &one);
      add_block(l, e - 1, x, &other);
    }
    if (e == l->begin[k]) add_block(l, e, x, &one);
    const double *c = l->corner + 6 * k;
    double *own = x + 3 * k;
    own[2] = (own[2] - total(&one, &other, 2)) * c[5];
    own[1] = ((own[1] - total(&one, &other, 1)) - c[4] * own[2]) * c[3];
    own[0] = (((own[0] - total(&one, &other, 0)) - c[1] * own[1]) - c[2] * own[2]) * c[0];
  }
}

const struct hk_triangle_set HOOKE_TRIANGLE_SET = {triangle_forward, triangle_backward};
