/* The moves of move_loops.h on one vector of particles, to the parenthesis. */
#pragma once

#include "kernel/move_loops.h"
#include "kernel/vector_unit.h"

/* Kinds of moves are told apart at compile time: `kind` is a constant. Axis a of the vector at particle p has
 * its numbers at q and v. */

/* Of particles: inverse masses, and factors of gravity in memory, NULL at compile time without any. */
struct hk_masses {
  hk_vector w;
  const double *gravity_factor;
};

HOOKE_INLINE hk_vector hk_acceleration(const struct hk_move *move, int a, struct hk_masses m, hk_vector f) {
  hk_vector acceleration = m.w * f;
  if (m.gravity_factor)
    acceleration = acceleration + hk_load(m.gravity_factor) * move->gravity[a];
  else if (move->heavy)
    acceleration = acceleration + move->gravity[a];
  return acceleration;
}

HOOKE_INLINE hk_vector hk_braked(const struct hk_move *move, int a, struct hk_masses m, hk_vector f,
                                 hk_vector v) {
  if (move->drag > 0.0) f = f - move->drag * v;
  return hk_acceleration(move, a, m, f);
}

/* A kick with the drag at the new velocity. */
HOOKE_INLINE hk_vector hk_kicked(const struct hk_move *move, int a, struct hk_masses m, hk_vector f,
                                 hk_vector v) {
  hk_vector next = v + move->kick * hk_acceleration(move, a, m, f);
  if (move->drag > 0.0) next = next / (1.0 + (move->kick * move->drag) * m.w);
  return next;
}

/* X moves on at `rate`; `at` is the place of the vector in the arrays of stages. */
HOOKE_INLINE void hk_move_stage(const struct hk_move *move, const int kind, ptrdiff_t at, hk_vector rate,
                                double *x) {
  double *start = move->start + at, *sum = move->sum + at;
  const hk_vector from = hk_load(kind == HOOKE_FIRST_STAGE ? x : start);
  if (kind == HOOKE_LAST_STAGE) {
    hk_store(x, from + move->kick * (hk_load(sum) + rate));
    return;
  }
  hk_vector sum_of_rates = rate;
  if (kind == HOOKE_MIDDLE_STAGE) sum_of_rates = hk_load(sum) + 2.0 * rate;
  if (kind == HOOKE_FIRST_STAGE) hk_store(start, from);
  hk_store(sum, sum_of_rates);
  hk_store(x, from + move->kick * rate);
}

HOOKE_INLINE void hk_move_verlet(const struct hk_move *move, const int kind, ptrdiff_t p, int a,
                                 struct hk_masses m, hk_vector f, double *q, double *v) {
  const ptrdiff_t at = a * move->stride + p;
  if (kind == HOOKE_PREDICT) {
    const hk_vector before = hk_load(v), kick = move->kick * hk_braked(move, a, m, f, before),
                    u = before + kick;
    hk_store(move->half + at, u);
    hk_store(q, hk_load(q) + move->drift * u);
    hk_store(v, u + kick);
  } else if (kind == HOOKE_CORRECT) {
    hk_store(v, hk_kicked(move, a, m, f, hk_load(move->half + at)));
  } else if (kind == HOOKE_KICK) {
    hk_store(move->f + at, f);
    hk_store(v, hk_kicked(move, a, m, f, hk_load(v)));
  } else {
    const hk_vector whole = hk_kicked(move, a, m, f, hk_load(v)),
                    u = whole + move->kick * hk_braked(move, a, m, f, whole);
    hk_store(q, hk_load(q) + move->drift * u);
    hk_store(v, u);
  }
}

HOOKE_INLINE void hk_move_axis(const struct hk_move *move, const int kind, ptrdiff_t p, int a,
                               struct hk_masses m, hk_vector f, double *q, double *v) {
  if (kind >= HOOKE_FIRST_STAGE) {
    const ptrdiff_t at = a * move->stride + p;
    const hk_vector u = hk_load(v);
    hk_move_stage(move, kind, at, u, q);
    hk_move_stage(move, kind, at + 3 * move->stride, hk_braked(move, a, m, f, u), v);
  } else if (kind >= HOOKE_PREDICT) {
    hk_move_verlet(move, kind, p, a, m, f, q, v);
  } else if (kind >= HOOKE_KICK_THEN_DRIFT) {
    const hk_vector x = hk_load(q), u = hk_load(v), next = u + move->kick * hk_braked(move, a, m, f, u);
    hk_store(v, next);
    hk_store(q, x + move->drift * (kind == HOOKE_KICK_THEN_DRIFT ? next : u));
  } else {
    hk_store(move->f + a * move->stride + p, f);
  }
}

/* `w`, factors of gravity, `q` and `v` at particle p. */
HOOKE_INLINE void hk_move_vector(const struct hk_move *move, const int kind, ptrdiff_t p, const double *w,
                                 const double *gravity_factor, double *q, double *v, ptrdiff_t stride,
                                 const hk_vector f[3]) {
  const struct hk_masses m = {hk_load(w), gravity_factor};
  for (int a = 0; a < 3; a++)
    hk_move_axis(move, kind, p, a, m, f[a], q + a * stride, v + a * stride);
}
