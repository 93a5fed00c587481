/* Reproducible random numbers: splitmix64 (Steele, Lea and Flood 2014). A generator is one 64-bit number,
 * initially the seed. */
#pragma once

#include <math.h>
#include <stdint.h>

static inline uint64_t hk_random_next(uint64_t *random) {
  uint64_t z = *random += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

/* Uniform in [-1, 1). */
static inline double hk_random_uniform(uint64_t *random) {
  return ldexp((double)(hk_random_next(random) >> 11), -52) - 1.0;
}

/* Normal with mean 0 and variance 1: the polar method (Marsaglia and Bray 1964). */
static inline double hk_random_normal(uint64_t *random) {
  double x, square;
  do {
    const double y = hk_random_uniform(random);
    x = hk_random_uniform(random);
    square = x * x + y * y;
  } while (square >= 1.0 || square == 0.0);
  return x * sqrt(-2.0 * log(square) / square);
}
