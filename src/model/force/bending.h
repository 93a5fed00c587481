/* Bending: triples, and the runs that commit sorts their groups into. */
#pragma once

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

/* For builders, as hk_system_add_springs(). */
int32_t hk_system_add_bending(hooke_system *system, const struct hk_addition *added,
                              int64_t coefficient_count, const double *coefficient);
