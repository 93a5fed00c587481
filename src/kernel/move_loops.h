/* The moves of explicit methods: what is done with a particle once its forces are complete, by the pass that
 * summed them or by a loop of its own. They are compiled once for each instruction set. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* With k = `kick`, d = `drift`, a = w f + g, or w f without gravity, or w f + (phi g) with its factors, where
 * f has c v taken away before if there is drag:
 *   nothing
 *   keep              f is kept
 *   kick then drift   v += k a, q += d v(new)
 *   drift then kick   q += d v, v += k a
 *   predict           u = v + k a, q += d u, v = u + k a, with the velocity half-way u in `half`
 *   correct           v = u + k b                   b is the acceleration without drag; all divided by
 *   kick              v += k b, and f is kept       1 + k c w if there is drag
 *   kick drift kick   v += k b and the division, then kick then drift
 * and of Runge-Kutta methods whose stages begin at the start of the step, for x = q at the rate r = v and for
 * x = v at the rate r = a:
 *   first stage       start = x, sum = r, x = start + k r
 *   middle stage      sum += 2 r, x = start + k r
 *   last stage        x = start + k (sum + r) */
enum {
  HOOKE_MOVE_NOTHING,
  HOOKE_MOVE_KEEP,
  HOOKE_KICK_THEN_DRIFT,
  HOOKE_DRIFT_THEN_KICK,
  HOOKE_PREDICT,
  HOOKE_CORRECT,
  HOOKE_KICK,
  HOOKE_KICK_DRIFT_KICK,
  HOOKE_FIRST_STAGE,
  HOOKE_MIDDLE_STAGE,
  HOOKE_LAST_STAGE,
  HOOKE_MOVES
};

/* `stride` lies between the components of the arrays, which have room for whole units of particles
 * (HOOKE_STRIDED_UNIT), as those of q and v. */
struct hk_move {
  int32_t kind;
  int32_t heavy; /* there is gravity */
  double kick, drift, drag, gravity[3];
  const double *gravity_factor; /* phi, as many as w; NULL: none, as in passes that sum forces as well */
  ptrdiff_t stride;
  double *f, *half;    /* forces that are kept; u; 3 components each */
  double *start, *sum; /* of q and of v: 6 components each */
};

/* Q and v have one stride, and inverse masses w the numbers of q. */
struct hk_moved {
  const double *w;
  double *q, *v;
  ptrdiff_t stride;
};

/* Moves the particles `from` .. `from` + count - 1, and the rest of the last unit; f begins at the first. */
typedef void hk_move_loop(const struct hk_move *move, const struct hk_moved *moved, ptrdiff_t from,
                          ptrdiff_t count, const double *const f[3]);

/* 1 if drag is part of the move even where forces include all others: where it is divided by. */
static inline int32_t hk_move_brakes(int32_t kind) {
  return kind == HOOKE_CORRECT || kind == HOOKE_KICK || kind == HOOKE_KICK_DRIFT_KICK;
}
