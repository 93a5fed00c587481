/* Limits of the machine, measured, to compare steps with. */
#pragma once

#include <stdint.h>

struct limits {
  double
      bandwidth; /* of a triad a = b + s c over arrays far larger than any cache, 24 bytes an element [B/s] */
  double root;   /* one square root and one division, of independent numbers [s] */
  double arithmetic; /* one addition or multiplication of independent numbers, not fused [s] */
};

/* For `threads` threads together, each with its own arrays: the best of several turns, in double precision
 * with the vectors that the compiler uses for this machine. Returns 1, or 0 without memory or threads. The
 * triad is McCalpin's (1995). */
int limits_measure(int32_t threads, struct limits *limits);
