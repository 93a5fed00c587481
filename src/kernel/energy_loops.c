/* Compiled once per instruction set, with HOOKE_ISA naming it. Rows of consecutive particles are read in one
 * stream, those of any others one by one. */
#include "kernel/energy_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/spring/spring_body.h"

HOOKE_INLINE void find_lengths(const struct hk_some_springs s, const double *q, double *length,
                               const int consecutive) {
  const double *const first = q + 3 * (ptrdiff_t)s.head[0], *const second = q + 3 * (ptrdiff_t)s.tail[0];
  HOOKE_VECTORISE
  for (ptrdiff_t k = 0; k < s.count; k++) {
    const double *x = consecutive ? first + 3 * k : q + 3 * (ptrdiff_t)s.head[k];
    const double *y = consecutive ? second + 3 * k : q + 3 * (ptrdiff_t)s.tail[k];
    length[k] = hk_spring_length(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
  }
}

static void some_lengths(const struct hk_some_springs *springs, const double *q, double *length) {
  if (springs->consecutive)
    find_lengths(*springs, q, length, 1);
  else
    find_lengths(*springs, q, length, 0);
}

static void some_energies(const struct hk_some_springs *springs, const double *q, double *length,
                          double *energy) {
  const double *const kappa = springs->kappa, *const rest_length = springs->rest_length;
  some_lengths(springs, q, length);
  HOOKE_VECTORISE
  for (ptrdiff_t k = 0; k < springs->count; k++) {
    const double stretch = length[k] - rest_length[k];
    energy[k] = 0.5 * (kappa[k] * stretch) * stretch;
  }
}

HOOKE_INLINE void find_heats(const struct hk_some_springs s, const double *q, const double *v, double *heat,
                             const int consecutive) {
  const ptrdiff_t first = s.head[0], second = s.tail[0];
  HOOKE_VECTORISE
  for (ptrdiff_t k = 0; k < s.count; k++) {
    const ptrdiff_t i = 3 * (consecutive ? first + k : s.head[k]),
                    j = 3 * (consecutive ? second + k : s.tail[k]);
    const double d[3] = {q[i] - q[j], q[i + 1] - q[j + 1], q[i + 2] - q[j + 2]};
    const double u[3] = {v[i] - v[j], v[i + 1] - v[j + 1], v[i + 2] - v[j + 2]};
    const double ir = hk_spring_inverse_length(hk_spring_length(d[0], d[1], d[2]));
    const double rate = ((u[0] * d[0] + u[1] * d[1]) + u[2] * d[2]) * ir;
    heat[k] = (s.gamma[k] * rate) * rate;
  }
}

static void some_heats(const struct hk_some_springs *springs, const double *q, const double *v,
                       double *heat) {
  if (springs->consecutive)
    find_heats(*springs, q, v, heat, 1);
  else
    find_heats(*springs, q, v, heat, 0);
}

const struct hk_energy_set HOOKE_ENERGY_SET = {some_lengths, some_energies, some_heats};
