/* Energies of some springs, each by itself, at positions and velocities in rows of x y z: whoever sums them
 * has the order of the sum. Every number has the same bits whatever the instruction set. */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct hk_some_springs {
  ptrdiff_t count;
  int32_t consecutive;        /* 1: spring k joins particles head[0] + k and tail[0] + k */
  const int32_t *head, *tail; /* `count` each, and so are the others */
  const double *kappa, *gamma, *rest_length;
};

/* Lengths [m]. */
void hk_some_lengths(const struct hk_some_springs *springs, const double *q, double *length);
/* Lengths, and 1/2 kappa (r - l0)^2 [J], of springs that only pull, too. */
void hk_some_energies(const struct hk_some_springs *springs, const double *q, double *length, double *energy);
/* gamma (v.u)^2 [W] of springs that pull and push. */
void hk_some_heats(const struct hk_some_springs *springs, const double *q, const double *v, double *heat);

/* The loops of one instruction set, under the names above. */
struct hk_energy_set {
  void (*some_lengths)(const struct hk_some_springs *, const double *, double *);
  void (*some_energies)(const struct hk_some_springs *, const double *, double *, double *);
  void (*some_heats)(const struct hk_some_springs *, const double *, const double *, double *);
};
