#include "hash.h"

#include <string.h>

uint64_t hash_doubles(int64_t count, const double *values, uint64_t hash) {
  const unsigned char *bytes = (const unsigned char *)values;
  for (int64_t k = 0; k < count * (int64_t)sizeof(double); k++) {
    hash = (hash ^ bytes[k]) * UINT64_C(0x100000001b3);
  }
  return hash;
}

int64_t first_difference(int64_t count, const double *a, const double *b) {
  for (int64_t k = 0; k < count; k++) {
    if (memcmp(a + k, b + k, sizeof *a) != 0) return k;
  }
  return -1;
}
