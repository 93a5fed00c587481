#include "random.h"

uint64_t random_bits(struct random_source *source) {
  uint64_t z = (source->state += UINT64_C(0x9e3779b97f4a7c15));
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

double random_between(struct random_source *source, double low, double high) {
  return low + (high - low) * ((double)(random_bits(source) >> 11) * 0x1p-53);
}

int64_t random_whole(struct random_source *source, int64_t low, int64_t high) {
  return low + (int64_t)(random_bits(source) % (uint64_t)(high - low + 1));
}
