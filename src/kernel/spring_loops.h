/* The loops that add spring forces, on raw arrays.
 *
 * Springs come in runs: consecutive springs that one loop can do. In a run of constant offset spring k joins
 * particles start + k and start + k + offset, so all loads are contiguous; in any other run the ends are
 * looked up. A run whose springs share one material reads no parameters. */
#ifndef HOOKE_KERNEL_SPRING_LOOPS_H
#define HOOKE_KERNEL_SPRING_LOOPS_H

#include <stdint.h>

/* Positions, velocities and forces with x, y and z apart, one array of n doubles each. Velocities are read by
 * damped runs only. */
struct hooke_fields {
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

struct hooke_run;

/* Adds the forces of a run; returns how many of its springs had a rest length but no direction. */
typedef int64_t hooke_spring_loop(const struct hooke_run *run, const struct hooke_fields *fields);

struct hooke_run {
  int64_t first, count; /* springs first .. first + count - 1, in spring order */
  int32_t shape;
  int32_t start, offset;                        /* constant offset */
  const int32_t *head, *tail;                   /* indexed: first and second ends, `count` long */
  double kappa, gamma, rest_length;             /* shared */
  const double *kappas, *gammas, *rest_lengths; /* mixed: `count` long */
  hooke_spring_loop *loop;
};

/* The loops of one instruction set, by shape. Sets are named "avx512", "avx2", "baseline"; `set` counts from
 * the best that this machine has; NULL past the last. */
struct hooke_spring_set {
  const char *name;
  hooke_spring_loop *const *loop;
};
const struct hooke_spring_set *hooke_spring_set(int32_t set);

/* Name of the set that is used on this machine. */
const char *hooke_kernel_instructions(void);

#endif
