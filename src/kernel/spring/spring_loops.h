/* The loops that add spring forces, on raw arrays.
 *
 * Springs come in runs: consecutive springs that one loop can process. In a run of constant offset spring k
 * joins particles start + k and start + k + offset, so all loads are contiguous; in any other run the ends
 * are looked up. A run of one material reads no parameters. */
#pragma once

#include "kernel/altitude_loops.h"
#include "kernel/bending_loops.h"
#include "kernel/spring/damper_loops.h"
#include "kernel/spring/derivative_loops.h"
#include "kernel/spring/strided_loops.h"

#include <stddef.h>
#include <stdint.h>

/* Positions, velocities and forces with x, y and z apart, one array of n doubles each. Velocities are read by
 * damped runs only. */
struct hk_fields {
  const double *q[3];
  const double *v[3];
  double *f[3];
};

/* The shape of a run is a sum of these. */
enum {
  HOOKE_RUN_INDEXED = 1,   /* ends are looked up */
  HOOKE_RUN_DAMPED = 2,    /* some gamma is not zero */
  HOOKE_RUN_MIXED = 4,     /* kappa, gamma and rest length are arrays */
  HOOKE_RUN_PULL_ONLY = 8, /* no resistance to compression */
  HOOKE_RUN_SHAPES = 16
};

struct hk_curve;
struct hk_run;
struct hk_scaling;
struct hk_tiled_loops;
struct hk_energy_set;
struct hk_triangle_set;
struct hk_tangent_set;
struct hk_vector_set;

/* Adds the forces of a run; returns how short its springs are (spring_body.h). */
typedef int64_t hk_spring_loop(const struct hk_run *run, const struct hk_fields *fields);

struct hk_run {
  int64_t first, count; /* springs first .. first + count - 1, in spring order */
  int32_t shape;
  int32_t start, offset;                        /* constant offset */
  const int32_t *head, *tail;                   /* indexed: first and second ends, `count` long */
  double kappa, gamma, rest_length;             /* shared */
  const double *kappas, *gammas, *rest_lengths; /* mixed: `count` long */
  const int32_t *slot; /* NULL, or mixed: indices into those arrays, which then are those of all springs */
  /* mixed, kappas and gammas NULL: kappa and gamma are shared, or shared and divided by the rest length */
  int32_t strain;
  const uint8_t *batch; /* NULL, or mixed: strided batch of each spring, which has its material */
  const struct hk_strided_material *of_batches;
  const struct hk_curve *curve;         /* NULL: linear springs (model/force/curve.h) */
  const struct hk_scaling *scaling;     /* NULL, or by what the numbers above are multiplied at a time */
  double scale;                         /* factor on the tension of the curve */
  hk_spring_loop *loop, *undamped_loop; /* the second leaves damping out */
};

/* Pieces of a run that begin at multiples of this are added as the whole is, to the bit. */
enum { HOOKE_RUN_PIECE = 256 };

static inline ptrdiff_t hk_run_head(const struct hk_run *run, ptrdiff_t k) {
  return run->shape & HOOKE_RUN_INDEXED ? run->head[k] : run->start + k;
}

static inline ptrdiff_t hk_run_tail(const struct hk_run *run, ptrdiff_t k) {
  return run->shape & HOOKE_RUN_INDEXED ? run->tail[k] : run->start + k + run->offset;
}

static inline ptrdiff_t hk_run_lower(const struct hk_run *run, ptrdiff_t k) {
  const ptrdiff_t head = hk_run_head(run, k), tail = hk_run_tail(run, k);
  return head < tail ? head : tail;
}

static inline ptrdiff_t hk_run_upper(const struct hk_run *run, ptrdiff_t k) {
  return hk_run_head(run, k) + hk_run_tail(run, k) - hk_run_lower(run, k);
}

struct hk_material {
  double kappa, gamma, rest_length;
};

/* Inline where compilers would not: a call and its result in memory cost as much as the rest. */
static inline __attribute__((always_inline)) struct hk_material hk_run_material(const struct hk_run *run,
                                                                                ptrdiff_t k) {
  if (!(run->shape & HOOKE_RUN_MIXED)) return (struct hk_material){run->kappa, run->gamma, run->rest_length};
  if (run->batch) {
    const struct hk_strided_material *of = &run->of_batches[run->batch[k]];
    const ptrdiff_t low = hk_run_lower(run, k);
    return (struct hk_material){*hk_strided_number(of, low, HOOKE_STRIDED_KAPPA),
                                *hk_strided_number(of, low, HOOKE_STRIDED_GAMMA),
                                *hk_strided_number(of, low, HOOKE_STRIDED_REST)};
  }
  const ptrdiff_t at = run->slot ? run->slot[k] : k;
  const double length = run->rest_lengths[at];
  if (run->kappas) return (struct hk_material){run->kappas[at], run->gammas[at], length};
  if (run->strain) return (struct hk_material){run->kappa / length, run->gamma / length, length};
  return (struct hk_material){run->kappa, run->gamma, length};
}

/* The loops of one instruction set, by shape. Sets are named "avx512", "avx2", "baseline"; `set` counts from
 * the best one of this machine; NULL past the last. */
struct hk_spring_set {
  const char *name;
  hk_spring_loop *loop[HOOKE_RUN_SHAPES];
  hk_strided_loop *strided;
  hk_move_loop *move;
  hk_bending_loop *bending;
  const struct hk_tiled_loops *tiled;
  hk_damper_loop *dampers;
  hk_derivative_loop *derivative;
  hk_tetrahedron_loop *tetrahedra;
  const struct hk_vector_set *vector;
  const struct hk_tangent_set *tangent;
  const struct hk_energy_set *energy;
  const struct hk_triangle_set *triangle;
};
const struct hk_spring_set *hk_spring_set(int32_t set);

/* Name of the set used on this machine. */
const char *hk_kernel_instructions(void);
