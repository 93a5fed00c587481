#include "parts/weld.h"

#include "core/memory.h"

#include <math.h>
#include <string.h>

/* Kept points, hashed by the cube that contains them, of side `distance`; for distance 0, by the point
 * itself. */
struct cubes {
  double distance;
  int64_t mask;
  int32_t *newest, *older; /* 1 + number of a kept point, 0 for none */
};

static void cube_of(const struct cubes *cubes, const double *point, double cube[3]) {
  for (int i = 0; i < 3; i++)
    cube[i] = cubes->distance > 0.0 ? floor(point[i] / cubes->distance) : point[i] + 0.0; /* no -0 */
}

static int64_t bucket_of(const struct cubes *cubes, const double cube[3]) {
  uint64_t hash = 0;
  for (int i = 0; i < 3; i++) {
    uint64_t bits;
    const double plain = cube[i] + 0.0;
    memcpy(&bits, &plain, sizeof bits);
    hash = (hash ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
    hash ^= hash >> 32;
  }
  return (int64_t)(hash & (uint64_t)cubes->mask);
}

static int is_near(const double *a, const double *b, double distance) {
  const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  if (distance == 0.0) return d[0] == 0.0 && d[1] == 0.0 && d[2] == 0.0;
  return sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]) <= distance;
}

/* The lowest kept point of one cube that is near, or `best` if that is lower; -1 for none. */
static int32_t look_in(const struct cubes *cubes, const double cube[3], const double *position,
                       const double *point, int32_t best) {
  for (int32_t k = cubes->newest[bucket_of(cubes, cube)]; k > 0; k = cubes->older[k - 1]) {
    if (is_near(position + 3 * (int64_t)(k - 1), point, cubes->distance) && (best < 0 || k - 1 < best))
      best = k - 1;
  }
  return best;
}

static int32_t find(const struct cubes *cubes, const double cube[3], const double *position,
                    const double *point) {
  if (cubes->distance == 0.0) return look_in(cubes, cube, position, point, -1);
  int32_t best = -1;
  for (int n = 0; n < 27; n++) {
    const int way[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    const double other[3] = {cube[0] + way[0], cube[1] + way[1], cube[2] + way[2]};
    best = look_in(cubes, other, position, point, best);
  }
  return best;
}

int32_t hk_weld(int64_t count, double distance, double *position, int32_t *became, int32_t *first,
                int64_t *kept) {
  struct cubes cubes = {.distance = distance, .mask = 1};
  while (cubes.mask < 2 * count)
    cubes.mask *= 2;
  cubes.newest = hk_new(cubes.mask, sizeof(int32_t));
  cubes.older = hk_new(count, sizeof(int32_t));
  cubes.mask--;
  int64_t added = 0;
  for (int64_t p = 0; p < count && cubes.newest && cubes.older; p++) {
    const double point[3] = {position[3 * p], position[3 * p + 1], position[3 * p + 2]};
    double cube[3];
    cube_of(&cubes, point, cube);
    became[p] = find(&cubes, cube, position, point);
    if (became[p] >= 0) continue;
    const int64_t bucket = bucket_of(&cubes, cube);
    cubes.older[added] = cubes.newest[bucket];
    became[p] = (int32_t)added++;
    cubes.newest[bucket] = (int32_t)added;
    memcpy(position + 3 * (added - 1), point, sizeof point);
    first[added - 1] = (int32_t)p;
  }
  const int32_t status = cubes.newest && cubes.older ? HOOKE_OK : HOOKE_NO_MEMORY;
  hk_free(cubes.newest);
  hk_free(cubes.older);
  *kept = added;
  return status;
}
