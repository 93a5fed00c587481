/* A seeded random generator (splitmix64) that gives the same numbers everywhere. */
#pragma once

#include <stdint.h>

struct random_source {
  uint64_t state;
};

uint64_t random_bits(struct random_source *source);

/* Uniform in [low, high). */
double random_between(struct random_source *source, double low, double high);

/* A uniform integer from low to high, both included. */
int64_t random_whole(struct random_source *source, int64_t low, int64_t high);
