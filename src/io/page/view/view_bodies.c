#include "io/page/view/view_bodies.h"

#include "core/memory.h"
#include "model/system.h"
#include "parts/surface.h"

#include <math.h>
#include <string.h>

static const double SAME = 1e-9; /* relative, as rest lengths of rounded positions differ */

/* ---- bodies ---- */

static void add_grid(struct hk_text *data, const struct hk_part_record *part) {
  int64_t cells[3] = {0, 0, 0};
  const int32_t axes = part->grid->cells(part->options, cells);
  hk_text_open(data, "size", '[');
  for (int32_t k = 0; k < axes; k++)
    hk_text_number(data, NULL, (double)(cells[k] + 1));
  hk_text_close(data, ']');
}

static void add_triangles(struct hk_text *data, const struct hk_part_record *part) {
  struct hk_surface surface;
  struct hk_surface_fault fault;
  const int32_t status = hk_surface_create(part->options, &surface, &fault);
  hk_text_open(data, "triangle", '[');
  for (int64_t k = 0; k < 3 * surface.triangle_count && status == HOOKE_OK; k++)
    hk_text_number(data, NULL, surface.triangle[k]);
  hk_text_close(data, ']');
  if (status == HOOKE_NO_MEMORY) data->status = status;
  hk_surface_release(&surface);
}

static void add_bodies(struct hk_text *data, const hooke_system *system) {
  hk_text_open(data, "bodies", '[');
  for (int64_t k = 0; k < system->part_count; k++) {
    const struct hk_part_record *part = &system->part[k];
    hk_text_open(data, NULL, '{');
    hk_text_word(data, "kind", part->kind);
    hk_text_number(data, "first", (double)part->first);
    hk_text_number(data, "count", (double)part->count);
    if (part->grid) add_grid(data, part);
    if (strcmp(part->kind, "mesh") == 0) add_triangles(data, part);
    hk_text_close(data, '}');
  }
  hk_text_close(data, ']');
}

/* ---- groups ---- */

/* The value that all of them have; NaN if they differ. */
static double common(int64_t count, const double *value) {
  for (int64_t k = 1; k < count; k++) {
    if (!(fabs(value[k] - value[0]) <= SAME * fabs(value[0]))) return NAN;
  }
  return count > 0 ? value[0] : NAN;
}

static void add_groups(struct hk_text *data, const hooke_system *system, const double *stiffness,
                       const double *rest_length) {
  int64_t first = 0;
  hk_text_open(data, "groups", '[');
  for (int64_t g = 0; g < hooke_system_group_count(system, "springs"); g++) {
    const int64_t count = hooke_system_group_size(system, "springs", g);
    hk_text_open(data, NULL, '{');
    hk_text_word(data, "name", hooke_system_group_name(system, "springs", g));
    hk_text_number(data, "count", (double)count);
    hk_text_number(data, "stiffness", common(count, stiffness + first));
    hk_text_number(data, "rest_length", common(count, rest_length + first));
    hk_text_close(data, '}');
    first += count;
  }
  hk_text_close(data, ']');
}

void hk_view_bodies_add(struct hk_text *data, const hooke_system *system) {
  const int64_t count = hooke_system_count(system, "springs");
  double *stiffness = hk_new(2 * count, sizeof *stiffness);
  int32_t status = stiffness ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK)
    status = hooke_system_members(system, "springs", NULL, stiffness, NULL, stiffness + count);
  if (status == HOOKE_OK) {
    add_bodies(data, system);
    add_groups(data, system, stiffness, stiffness + count);
  } else if (data->status == HOOKE_OK) {
    data->status = status;
  }
  hk_free(stiffness);
}
