/* Bending: triples, and the runs that commit sorts their groups into. */
#ifndef HOOKE_MODEL_FORCE_BENDING_H
#define HOOKE_MODEL_FORCE_BENDING_H

#include "hooke/system.h"
#include "kernel/bending_loops.h"
#include "model/sum/runs.h"

/* All triples of a committed system, in their order. */
struct hk_bending {
  int64_t count;
  int64_t run_count;
  struct hk_bending_run *run;
  struct hk_stored stored;
};

/* A triple, whatever run it is in: c/2 |x_0 - 2 x_1 + x_2|^2, c [N/m]. */
struct hk_triple {
  int64_t particle[3];
  double coefficient;
};

static inline struct hk_triple hk_run_triple(const struct hk_bending_run *run, int64_t k) {
  const int32_t indexed = run->shape & HOOKE_BENDING_INDEXED;
  struct hk_triple triple;
  for (int e = 0; e < 3; e++)
    triple.particle[e] = indexed ? run->particle[e][k] : run->start + k + e * (int64_t)run->offset;
  triple.coefficient = run->shape & HOOKE_BENDING_MIXED ? run->coefficients[k] : run->coefficient;
  return triple;
}

/* All triples in their order: for (struct hk_triples at = {bending}; hk_next_triple(&at, &triple);) */
struct hk_triples {
  const struct hk_bending *bending;
  int64_t run, k;
};

/* Starts at triple `number`. */
struct hk_triples hk_triples_from(const struct hk_bending *bending, int64_t number);

static inline int hk_next_triple(struct hk_triples *at, struct hk_triple *triple) {
  if (at->run == at->bending->run_count) return 0;
  const struct hk_bending_run *run = &at->bending->run[at->run];
  *triple = hk_run_triple(run, at->k);
  if (++at->k == run->count) {
    at->run++;
    at->k = 0;
  }
  return 1;
}

/* x_0 - 2 x_1 + x_2 of rows of x y z. */
static inline void hk_triple_bend(const struct hk_triple *triple, const double *x, double bend[3]) {
  for (int a = 0; a < 3; a++) {
    bend[a] = (x[3 * triple->particle[0] + a] - 2.0 * x[3 * triple->particle[1] + a]) +
              x[3 * triple->particle[2] + a];
  }
}

/* f += factor times the forces at x; x, y and z apart. */
void hk_bending_add(const struct hk_bending *bending, double factor, const double *const x[3],
                    double *const f[3]);

/* For builders, as hk_system_add_springs(). */
int32_t hk_system_add_bending(hooke_system *system, const struct hk_addition *added,
                              int64_t coefficient_count, const double *coefficient);

#endif
