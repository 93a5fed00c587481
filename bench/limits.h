/* What the machine can do at most, measured: what a step is held against. */
#ifndef BENCH_LIMITS_H
#define BENCH_LIMITS_H

#include <stdint.h>

struct limits {
  double
      bandwidth; /* of a triad a = b + s c over arrays far larger than any cache, 24 bytes an element [B/s] */
  double root;   /* one square root and one division, of independent numbers [s] */
  double arithmetic; /* one addition or multiplication of independent numbers, not fused [s] */
};

/* Of `threads` threads together, each with arrays of its own: the best of several turns, in double precision
 * with the vectors that the compiler takes for this machine. 1, or 0 without memory or threads. The triad is
 * McCalpin's (1995). */
int limits_measure(int32_t threads, struct limits *limits);

#endif
