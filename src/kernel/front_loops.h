/* Dense parts of a sparse Cholesky factor, by columns. A panel has `columns` columns of `rows` numbers, rows >= columns: the
 * factor's columns from their diagonal on, which holds inverses. Every number is found from the same numbers in the same
 * order whatever the instruction set. */
#ifndef HOOKE_KERNEL_FRONT_LOOPS_H
#define HOOKE_KERNEL_FRONT_LOOPS_H

#include <stddef.h>
#include <stdint.h>

/* Factorises a panel in place; what is above the diagonal is neither read nor kept. 0 where a pivot is not positive or not
 * finite. */
int32_t hooke_front_factorise(ptrdiff_t rows, ptrdiff_t columns, double *panel);

/* The lower triangle of rest (n x n, n = rows - columns) -= L L^T with L the panel's last n rows. */
void hooke_front_subtract(ptrdiff_t rows, ptrdiff_t columns, const double *panel, double *rest);

/* x (rows numbers): solves with the triangle, and takes what follows of it off the numbers below; the same transposed,
 * where the numbers below are known. */
void hooke_front_forward(ptrdiff_t rows, ptrdiff_t columns, const double *panel, double *x);
void hooke_front_backward(ptrdiff_t rows, ptrdiff_t columns, const double *panel, double *x);

/* The loops of one instruction set, under the names above. */
struct hooke_front_set {
  int32_t (*front_factorise)(ptrdiff_t, ptrdiff_t, double *);
  void (*front_subtract)(ptrdiff_t, ptrdiff_t, const double *, double *);
  void (*front_forward)(ptrdiff_t, ptrdiff_t, const double *, double *);
  void (*front_backward)(ptrdiff_t, ptrdiff_t, const double *, double *);
};

#endif
