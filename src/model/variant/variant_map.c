/* Map from the particles of a system to those of a variant, and positions at equal material coordinates. */
#include "model/variant/variant.h"

#include "core/status.h"

#include "core/memory.h"

#include <math.h>
#include <string.h>

void hk_variant_map_release(struct hk_variant_map *map) {
  hk_free(map->to);
  hk_free(map->part);
  memset(map, 0, sizeof *map);
}

int32_t hk_variant_cells(const struct hk_part_record *part, double scale, int64_t cells[3], int64_t made[3]) {
  const int32_t axes = part->grid ? part->grid->cells(part->options, cells) : 0;
  for (int32_t a = 0; a < axes; a++)
    made[a] = (int64_t)fmax(1.0, round((double)cells[a] * scale));
  return axes;
}

/* Part of a particle; -1 for none. */
static int64_t part_of(const hooke_system *system, int64_t particle) {
  int64_t low = 0, high = system->part_count - 1;
  while (low < high) {
    const int64_t middle = low + (high - low + 1) / 2;
    if (system->part[middle].first <= particle)
      low = middle;
    else
      high = middle - 1;
  }
  if (high < 0) return -1;
  const struct hk_part_record *part = &system->part[low];
  return particle >= part->first && particle < part->first + part->count ? low : -1;
}

int64_t hk_variant_nearest(const struct hk_variant_part *part, int64_t offset) {
  int64_t nearest = 0, stride = 1;
  for (int32_t a = 0; a < part->axes; a++) {
    const int64_t index = offset % (part->cells[a] + 1);
    nearest += (2 * index * part->made[a] + part->cells[a]) / (2 * part->cells[a]) * stride;
    offset /= part->cells[a] + 1;
    stride *= part->made[a] + 1;
  }
  return nearest;
}

int32_t hk_variant_corners(const struct hk_variant_part *part, int64_t offset, int64_t corner[8],
                           double weight[8]) {
  int32_t count = 1;
  int64_t stride = 1;
  corner[0] = 0;
  weight[0] = 1.0;
  for (int32_t a = 0; a < part->axes; a++) {
    const int64_t index = offset % (part->cells[a] + 1);
    /* integer arithmetic: coinciding grid points coincide exactly */
    const int64_t low = index * part->made[a] / part->cells[a];
    const double fraction = (double)(index * part->made[a] % part->cells[a]) / (double)part->cells[a];
    const int32_t before = count;
    for (int32_t k = 0; k < before; k++) {
      corner[k] += low * stride;
      if (fraction == 0.0) continue;
      corner[count] = corner[k] + stride;
      weight[count++] = weight[k] * fraction;
      weight[k] *= 1.0 - fraction;
    }
    offset /= part->cells[a] + 1;
    stride *= part->made[a] + 1;
  }
  return count;
}

int32_t hk_variant_is_same(const struct hk_variant_map *map, int64_t particle) {
  const int64_t of = part_of(map->from, particle);
  return map->to[particle] >= 0 && (of < 0 || map->part[of].axes == 0);
}

void hk_variant_place(const struct hk_variant_map *map, int64_t particle, const double *q,
                      double position[3]) {
  if (map->to[particle] < 0) {
    position[0] = position[1] = position[2] = NAN;
    return;
  }
  if (hk_variant_is_same(map, particle)) {
    memcpy(position, q + 3 * map->to[particle], 3 * sizeof(double));
    return;
  }
  const int64_t of = part_of(map->from, particle);
  int64_t corner[8];
  double weight[8];
  const int32_t count =
      hk_variant_corners(&map->part[of], particle - map->from->part[of].first, corner, weight);
  position[0] = position[1] = position[2] = 0.0;
  for (int32_t k = 0; k < count; k++) {
    const double *at = q + 3 * (map->part[of].first + corner[k]);
    for (int a = 0; a < 3; a++)
      position[a] += weight[k] * at[a];
  }
}

int32_t hk_variant_require_numbers(const struct hk_variant_maker *maker, const char *what) {
  for (int64_t p = 0; p < maker->from->particle_count; p++) {
    if (maker->map->to[p] != p)
      return hk_fail(HOOKE_UNSUITED, NULL, "%s knows particles by their numbers, which would change", what);
  }
  return HOOKE_OK;
}
