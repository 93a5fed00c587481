/* Compiled once per instruction set, with HOOKE_ISA naming it. Columns are taken WIDTH at a time off GROUP others. */
#include "kernel/front_loops.h"

#include "kernel/instruction_set.h"

#include <math.h>

enum { WIDTH = 8, GROUP = 4, PARTS = 32, LANES = 8, AHEAD = 3 };

typedef double lanes __attribute__((vector_size(8 * LANES), aligned(8), may_alias));

#define INLINE static inline __attribute__((always_inline))

/* to[c][i] -= l[0][i] m[c][0], then l[1][i] m[c][1], and so on; columns `height` apart. */
INLINE void take_off(const ptrdiff_t count, const ptrdiff_t height, const double *restrict l,
                     double m[GROUP][WIDTH], const ptrdiff_t to_height, double *restrict to, const int width,
                     const int group) {
  HOOKE_VECTORISE
  for (ptrdiff_t i = 0; i < count; i++) {
    for (int c = 0; c < group; c++) {
      double value = to[c * to_height + i];
      for (int p = 0; p < width; p++)
        value -= l[p * height + i] * m[c][p];
      to[c * to_height + i] = value;
    }
  }
}

/* Columns first .. last - 1 of `to` from row `first` on -= l times its rows of the same number. */
static void take_off_columns(ptrdiff_t rows, ptrdiff_t first, ptrdiff_t last, ptrdiff_t height,
                             const double *l, int width, ptrdiff_t to_height, double *to) {
  double m[GROUP][WIDTH];
  for (ptrdiff_t j = first; j < last;) {
    const int group = last - j >= GROUP ? GROUP : 1;
    for (int c = 0; c < group; c++) {
      for (int p = 0; p < width; p++)
        m[c][p] = l[p * height + j + c];
    }
    double *column = to + j * to_height + j;
    if (width == WIDTH && group == GROUP)
      take_off(rows - j, height, l + j, m, to_height, column, WIDTH, GROUP);
    else if (width == WIDTH)
      take_off(rows - j, height, l + j, m, to_height, column, WIDTH, 1);
    else
      take_off(rows - j, height, l + j, m, to_height, column, width, group);
    j += group;
  }
}

static int32_t front_factorise(ptrdiff_t rows, ptrdiff_t columns, double *panel) {
  for (ptrdiff_t b = 0; b < columns; b += WIDTH) {
    const int width = columns - b < WIDTH ? (int)(columns - b) : WIDTH;
    double *block = panel + b * rows;
    for (ptrdiff_t j = b; j < b + width; j++) {
      double *column = panel + j * rows, m[GROUP][WIDTH];
      for (ptrdiff_t p = b; p < j; p++)
        m[0][p - b] = panel[p * rows + j];
      take_off(rows - j, rows, block + j, m, 0, column + j, (int)(j - b), 1);
      if (!(column[j] > 0.0 && column[j] < INFINITY)) return 0;
      const double inverse = 1.0 / sqrt(column[j]);
      for (ptrdiff_t i = j + 1; i < rows; i++)
        column[i] *= inverse;
      column[j] = inverse;
    }
    take_off_columns(rows, b + width, columns, rows, block, width, rows, panel);
  }
  return 1;
}

static void front_subtract(ptrdiff_t rows, ptrdiff_t columns, const double *panel, double *rest) {
  const ptrdiff_t n = rows - columns;
  for (ptrdiff_t b = 0; b < columns; b += WIDTH) {
    const int width = columns - b < WIDTH ? (int)(columns - b) : WIDTH;
    take_off_columns(n, 0, n, rows, panel + b * rows + columns, width, n, rest);
  }
}

/* One column after the other, as they are in memory, which is what the time goes to. */
static void front_forward(ptrdiff_t rows, ptrdiff_t columns, const double *panel, double *x) {
  for (ptrdiff_t j = 0; j < columns; j++) {
    const double *column = panel + j * rows, value = x[j] * column[j];
    x[j] = value;
    HOOKE_VECTORISE
    for (ptrdiff_t i = j + 1; i < rows; i++)
      x[i] -= column[i] * value;
  }
}

/* In PARTS interleaved parts. Columns are wanted in falling order, which no machine foresees: a later one is fetched. */
INLINE double dot(ptrdiff_t count, const double *a, const double *b, ptrdiff_t ahead) {
  lanes part[PARTS / LANES] = {{0.0}};
  double tail[LANES] = {0.0};
  ptrdiff_t k = 0;
  for (; k + PARTS <= count; k += PARTS) {
    for (int p = 0; p < PARTS / LANES; p++) {
      __builtin_prefetch(a + k + LANES * p - ahead);
      part[p] += *(const lanes *)(a + k + LANES * p) * *(const lanes *)(b + k + LANES * p);
    }
  }
  for (int p = 0; k + LANES <= count; k += LANES, p++)
    part[p] += *(const lanes *)(a + k) * *(const lanes *)(b + k);
  for (int p = 0; k + p < count; p++)
    tail[p] = a[k + p] * b[k + p];
  const lanes sum = ((part[0] + part[1]) + (part[2] + part[3])) + *(const lanes *)tail;
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

static void front_backward(ptrdiff_t rows, ptrdiff_t columns, const double *panel, double *x) {
  for (ptrdiff_t j = columns - 1; j >= 0; j--) {
    const double *column = panel + j * rows;
    x[j] = (x[j] - dot(rows - j - 1, column + j + 1, x + j + 1, (j < AHEAD ? j : AHEAD) * rows)) * column[j];
  }
}

const struct hooke_front_set HOOKE_FRONT_SET = {front_factorise, front_subtract, front_forward,
                                                front_backward};
