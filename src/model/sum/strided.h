/* Strided batches: sums the forces of a whole system in one pass over the particles.
 *
 * A batch consists of springs of one offset o > 0, at most one from each particle: spring l joins particles l
 * and l + o. A particle sees a batch as two items, the springs that end there and those that begin there. The
 * items of all batches are in one order in which the springs of every particle come in ascending number, so
 * that sums have the bits of the plain order. Triples of bending of one offset form batches likewise, in the
 * order of which those of every particle ascend. The pass goes over the particles once; see
 * kernel/spring/strided_loops.h. */
#pragma once

#include "kernel/spring/strided_loops.h"
#include "model/force/bending.h"
#include "model/force/spring.h"

enum { HOOKE_TILE = 256, HOOKE_MOST_ITEMS = 2 * HOOKE_MOST_STRIDED };

struct hk_strided_batch {
  int64_t offset, first, last;      /* lowest and highest lower end */
  int64_t reach;                    /* from the first particle of a spring or triple to its last */
  int32_t shape;                    /* HOOKE_RUN_*, never indexed; 0 of triples */
  uint8_t *present;                 /* a bit for each particle: a spring begins there */
  const struct hk_scaling *scaling; /* as of their runs */
  int64_t values;                   /* of the material */
};

/* `count` 0: springs form no batches, or too few springs for batches to pay; `bent` 0: nor do triples. */
struct hk_strided_batches {
  int32_t count, bent; /* batches of springs, and of triples after them */
  int64_t reach;       /* largest of a batch, in whole units */
  struct hk_strided_batch batch[HOOKE_MOST_STRIDED];
  struct hk_strided_material material[HOOKE_MOST_STRIDED];
  uint8_t item[HOOKE_MOST_ITEMS]; /* in the order of sums: 2 k the ends of batch k, 2 k + 1 its beginnings */
  uint8_t *batch_of;              /* of each spring; NULL if no run looks up its material */
  uint8_t *present;               /* springs that all batches around there have */
  int64_t memory;
};

static inline int64_t hk_whole_units(int64_t count) {
  return (count + HOOKE_STRIDED_UNIT - 1) / HOOKE_STRIDED_UNIT * HOOKE_STRIDED_UNIT;
}

/* HOOKE_NO_MEMORY. Individually stored material moves from the springs to the batches, where the runs then
 * look it up. */
int32_t hk_strided_batches_create(struct hk_springs *springs, const struct hk_bending *bending,
                                  int64_t particle_count, struct hk_strided_batches *strided);
void hk_strided_batches_release(struct hk_strided_batches *strided);

/* The step that moves the material, for existing batches. HOOKE_NO_MEMORY. */
int32_t hk_strided_batches_take_material(struct hk_springs *springs, int64_t particle_count,
                                         struct hk_strided_batches *strided);

/* Rings of one pass at a time by `workers` threads, for systems with batches; NULL without memory. */
struct hk_rings;
struct hk_rings *hk_rings_create(const struct hk_strided_batches *strided, int32_t workers);
void hk_rings_destroy(struct hk_rings *rings);
int64_t hk_rings_memory(const struct hk_rings *rings);

struct hk_motion;
struct hooke_system;

/* One pass over the stepped particles of `motion` at time t; returns the number of springs with a rest length
 * but no direction. */
int64_t hk_strided_batches_pass(const struct hooke_system *system, struct hk_motion *motion, double t,
                                const struct hk_move *move);
