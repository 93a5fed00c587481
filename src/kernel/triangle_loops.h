/* Solutions with a sparse lower triangular matrix L of 3x3 blocks, stored by columns of blocks. Every number
 * is computed from the same numbers in the same order in every instruction set. */
#pragma once

#include <stdint.h>

/* Padding after arrays that is read without effect. */
enum { HOOKE_TRIANGLE_SPARE = 1 };

struct hk_triangle {
  int64_t count;  /* of columns of blocks */
  int64_t *begin; /* count + 1: of the blocks of a column that are below the diagonal */
  int32_t *row;   /* by block: its first row of numbers, a multiple of 3 */
  double *block;  /* 9 each, by columns, plus HOOKE_TRIANGLE_SPARE */
  double *corner; /* 6 for each column, the block on the diagonal: 1/11, 21, 31, 1/22, 32, 1/33 */
};

/* x = L^-1 x and x = L^-T x; 3 count numbers plus HOOKE_TRIANGLE_SPARE. */
void hk_triangle_forward(const struct hk_triangle *l, double *x);
void hk_triangle_backward(const struct hk_triangle *l, double *x);

/* The loops of one instruction set, under the names above. */
struct hk_triangle_set {
  void (*triangle_forward)(const struct hk_triangle *, double *);
  void (*triangle_backward)(const struct hk_triangle *, double *);
};
