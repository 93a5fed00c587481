#pragma once

#include <stdint.h>

static inline uint64_t bench_draw(uint64_t *state) {
  uint64_t z = (*state += 0x9E3779B97F4A7C15u); /* splitmix64 */
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/* Uniform in [0, 1). */
static inline double bench_draw_unit(uint64_t *state) {
  return (double)(bench_draw(state) >> 11) * 0x1p-53;
}
