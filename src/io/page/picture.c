#include "io/page/picture.h"

#include "core/memory.h"

#include <math.h>

static const double DIGITS = 6.0; /* relative to the extent */

int32_t hk_picture_create(const hooke_system *system, struct hk_picture *picture) {
  *picture = (struct hk_picture){.system = system};
  picture->spring_count = hooke_system_count(system, "springs");
  picture->ends = hk_new(2 * picture->spring_count, sizeof *picture->ends);
  picture->drawn = hk_new(picture->spring_count, 1);
  picture->shut = hk_new(picture->spring_count, 1);
  picture->slot = hk_new(hooke_system_particle_count(system), sizeof *picture->slot);
  picture->list = hk_new(hooke_system_particle_count(system), sizeof *picture->list);
  if (!picture->ends || !picture->drawn || !picture->shut || !picture->slot || !picture->list)
    return HOOKE_NO_MEMORY;
  return hooke_system_members(system, "springs", picture->ends, NULL, NULL, NULL);
}

void hk_picture_release(struct hk_picture *picture) {
  hk_free(picture->ends);
  hk_free(picture->drawn);
  hk_free(picture->shut);
  hk_free(picture->slot);
  hk_free(picture->list);
}

void hk_picture_take(struct hk_picture *picture, int64_t spring) {
  picture->drawn_count += !picture->drawn[spring];
  picture->drawn[spring] = 1;
}

/* Draws the open springs from `first` up to `end` if all of them fit; returns whether they do. */
static int32_t take_family(struct hk_picture *picture, int64_t first, int64_t end, int64_t most) {
  int64_t open = 0;
  for (int64_t k = first; k < end; k++)
    open += !picture->drawn[k] && !picture->shut[k];
  if (picture->drawn_count + open > most) return 0;
  for (int64_t k = first; k < end; k++) {
    if (!picture->shut[k]) hk_picture_take(picture, k);
  }
  return open > 0;
}

int32_t hk_picture_take_families(struct hk_picture *picture, int64_t most) {
  const int64_t groups = hooke_system_group_count(picture->system, "springs");
  int64_t first = 0;
  int32_t taken = 0;
  for (int64_t g = 0; g < groups; g++) {
    const int64_t end = first + hooke_system_group_size(picture->system, "springs", g);
    taken |= take_family(picture, first, end, most);
    first = end;
  }
  return take_family(picture, first, picture->spring_count, most) || taken;
}

void hk_picture_show_evenly(struct hk_picture *picture) {
  const int64_t count = hooke_system_particle_count(picture->system);
  for (int64_t k = 0; k < count; k += 1 + count / HOOKE_PICTURE_DOTS)
    hk_picture_show(picture, k);
}

void hk_picture_show(struct hk_picture *picture, int64_t particle) {
  if (picture->slot[particle] > 0) return;
  picture->list[picture->shown_count] = particle;
  picture->slot[particle] = ++picture->shown_count;
}

static void add_springs(struct hk_text *data, struct hk_picture *picture) {
  int64_t open = 0;
  hk_text_open(data, "spring", '[');
  for (int64_t k = 0; k < picture->spring_count; k++) {
    open += !picture->shut[k];
    if (picture->drawn[k]) hk_text_number(data, NULL, (double)k);
  }
  hk_text_close(data, ']');
  hk_text_number(data, "springs", (double)open);
  hk_text_open(data, "ends", '[');
  for (int64_t k = 0; k < 2 * picture->spring_count; k++) {
    if (!picture->drawn[k / 2]) continue;
    hk_picture_show(picture, picture->ends[k]);
    hk_text_number(data, NULL, (double)(picture->slot[picture->ends[k]] - 1));
  }
  hk_text_close(data, ']');
}

void hk_picture_add(struct hk_text *data, struct hk_picture *picture) {
  const double *weight = hooke_system_inverse_mass(picture->system);
  add_springs(data, picture);
  hk_text_number(data, "particles", (double)hooke_system_particle_count(picture->system));
  hk_text_wholes(data, "particle", picture->shown_count, picture->list);
  hk_text_open(data, "held", '[');
  for (int64_t k = 0; k < picture->shown_count; k++)
    hk_text_number(data, NULL, weight[picture->list[k]] == 0.0);
  hk_text_close(data, ']');
}

/* A number that is short as text. */
static void add_rounded(struct hk_text *data, double value, double scale) {
  const double rounded = rint(value * scale) / scale;
  hk_text_number(data, NULL, isfinite(rounded) ? rounded + 0.0 : value);
}

static double at(const double *vectors, const int64_t *list, int64_t k, int64_t axis) {
  return vectors[3 * (list ? list[k] : k) + axis];
}

double hk_picture_extent(const double *vectors, const int64_t *list, int64_t count) {
  double extent = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    double low = INFINITY, high = -INFINITY;
    for (int64_t k = 0; k < count; k++) {
      low = fmin(low, at(vectors, list, k, axis));
      high = fmax(high, at(vectors, list, k, axis));
    }
    extent = fmax(extent, high - low);
  }
  return extent;
}

void hk_picture_add_vectors(struct hk_text *data, const char *key, const double *vectors, const int64_t *list,
                            int64_t count) {
  const double extent = vectors ? hk_picture_extent(vectors, list, count) : 0.0;
  const double scale = extent > 0.0 ? pow(10.0, DIGITS - ceil(log10(extent))) : INFINITY;
  hk_text_open(data, key, '[');
  for (int64_t k = 0; k < 3 * count && vectors; k++)
    add_rounded(data, at(vectors, list, k / 3, k % 3), scale);
  hk_text_close(data, ']');
}
