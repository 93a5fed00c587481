/* Compiled once per instruction set, with HOOKE_ISA naming it. Forces of a block of triples go into a buffer
 * first, and are then added in three passes, which for every particle is the order of the triples. */
#include "kernel/bending_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/spring/spring_body.h"

#include <stddef.h>

enum { BLOCK = 256 };

HOOKE_INLINE void fill_block(double *restrict b, const double *restrict x, ptrdiff_t offset, double factor,
                             double shared, const double *restrict own, ptrdiff_t count, const int mixed) {
  for (ptrdiff_t k = 0; k < count; k++) {
    const double c = factor * (mixed ? own[k] : shared);
    b[k] = c * ((x[k] - 2.0 * x[k + offset]) + x[k + 2 * offset]);
  }
}

HOOKE_INLINE void add(double *restrict f, double weight, const double *restrict b, ptrdiff_t count) {
  for (ptrdiff_t k = 0; k < count; k++)
    f[k] += weight * b[k];
}

/* A particle is the third of an earlier triple, the middle of a later one, and the first of the last. */
HOOKE_INLINE void offset_loop(const struct hk_bending_run *run, const double factor, const double *const x[3],
                              double *const f[3], const int mixed) {
  double b[BLOCK];
  const ptrdiff_t offset = run->offset;
  for (int64_t done = 0; done < run->count; done += BLOCK) {
    const ptrdiff_t count = run->count - done < BLOCK ? run->count - done : BLOCK;
    const ptrdiff_t at = run->start + done;
    const double *own = mixed ? run->coefficients + done : NULL;
    for (int a = 0; a < 3; a++) {
      fill_block(b, x[a] + at, offset, factor, run->coefficient, own, count, mixed);
      add(f[a] + at + 2 * offset, -1.0, b, count);
      add(f[a] + at + offset, 2.0, b, count);
      add(f[a] + at, -1.0, b, count);
    }
  }
}

static void indexed_loop(const struct hk_bending_run *run, double factor, const double *const x[3],
                         double *const f[3], int mixed) {
  for (int64_t k = 0; k < run->count; k++) {
    const ptrdiff_t first = run->particle[0][k], middle = run->particle[1][k], last = run->particle[2][k];
    const double c = factor * (mixed ? run->coefficients[k] : run->coefficient);
    for (int a = 0; a < 3; a++) {
      const double force = c * ((x[a][first] - 2.0 * x[a][middle]) + x[a][last]);
      f[a][first] -= force;
      f[a][middle] += 2.0 * force;
      f[a][last] -= force;
    }
  }
}

void HOOKE_BENDING_LOOP(const struct hk_bending_run *run, double factor, const double *const x[3],
                        double *const f[3]) {
  const int mixed = (run->shape & HOOKE_BENDING_MIXED) != 0;
  if (run->shape & HOOKE_BENDING_INDEXED)
    indexed_loop(run, factor, x, f, mixed);
  else if (mixed)
    offset_loop(run, factor, x, f, 1);
  else
    offset_loop(run, factor, x, f, 0);
}
