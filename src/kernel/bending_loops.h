/* The loops that add bending forces, on raw arrays. Triples (a, b, c) come in runs as springs do: in a run of
 * constant offset triple k joins particles start + k, start + k + offset and start + k + 2 offset, in any
 * other the particles are looked up. One triple, of each component, to the parenthesis:
 *   d = (x_a - 2 x_b) + x_c      F = (factor c) d      f_a -= F      f_b += 2 F      f_c -= F */
#pragma once

#include <stdint.h>

/* The shape of a run is a sum of these. */
enum {
  HOOKE_BENDING_INDEXED = 1, /* particles are looked up */
  HOOKE_BENDING_MIXED = 2,   /* coefficients are an array */
  HOOKE_BENDING_SHAPES = 4
};

struct hk_bending_run;

/* Adds `factor` times the forces at x to f; x, y and z apart. Forces are linear in x, so this is their
 * derivative too. */
typedef void hk_bending_loop(const struct hk_bending_run *run, double factor, const double *const x[3],
                             double *const f[3]);

struct hk_bending_run {
  int64_t first, count; /* triples first .. first + count - 1, in their order */
  int32_t shape;
  int32_t start, offset;      /* constant offset > 0 */
  const int32_t *particle[3]; /* indexed: a, b and c, `count` long */
  double coefficient;         /* shared [N/m] */
  const double *coefficients; /* mixed: `count` long */
  hk_bending_loop *loop;
};
