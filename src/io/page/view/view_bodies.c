/* Bodies, obstacles and groups of springs of a scene, for pages. */
#include "io/page/view/view.h"

#include "core/memory.h"
#include "io/trajectory/record.h"
#include "model/force/force.h"
#include "model/group.h"
#include "model/part_record.h"
#include "model/system.h"
#include "parts/surface.h"

#include <string.h>

/* ---- bodies ---- */

static void add_grid(struct hk_text *data, const struct hk_part_record *part) {
  int64_t cells[3] = {0, 0, 0};
  const int32_t axes = part->grid->cells(part->options, cells);
  for (int32_t k = 0; k < axes; k++)
    cells[k]++; /* particles */
  hk_text_wholes(data, "size", axes, cells);
}

static void add_triangles(struct hk_text *data, const struct hk_part_record *part) {
  struct hk_surface surface;
  const int32_t status = hk_surface_create(part->options, NULL, &surface);
  hk_text_open(data, "triangle", '[');
  for (int64_t k = 0; k < 3 * surface.triangle_count && status == HOOKE_OK; k++)
    hk_text_number(data, NULL, surface.triangle[k]);
  hk_text_close(data, ']');
  if (status == HOOKE_NO_MEMORY) data->status = status;
  hk_surface_release(&surface);
}

void hk_view_add_bodies(struct hk_text *data, const hooke_system *system) {
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

/* ---- obstacles ---- */

/* One that stays has one point. */
static void add_obstacle(struct hk_text *data, const struct hk_view *view, const hooke_system *system,
                         int64_t number) {
  const int64_t points = system->rest->obstacles.obstacle[number].moves ? view->frames : 1;
  double place[7];
  hk_text_open(data, "point", '[');
  for (int64_t k = 0; k < points; k++) {
    hooke_system_obstacle_place(system, number, view->record->time[view->frame[k]], place);
    for (int axis = 0; axis < 3; axis++)
      hk_text_number(data, NULL, place[axis]);
  }
  hk_text_close(data, ']');
  hk_text_numbers(data, "direction", 3, place + 3);
  hk_text_number(data, "radius", place[6]);
}

void hk_view_add_obstacles(struct hk_text *data, const struct hk_view *view, const hooke_system *system) {
  const char *shape;
  hk_text_open(data, "obstacles", '[');
  for (int64_t k = 0; (shape = hooke_system_obstacle_shape(system, k)) != NULL; k++) {
    hk_text_open(data, NULL, '{');
    hk_text_word(data, "shape", shape);
    add_obstacle(data, view, system, k);
    hk_text_close(data, '}');
  }
  hk_text_close(data, ']');
}

/* ---- springs ---- */

static void add_groups(struct hk_text *data, const hooke_system *system) {
  hk_text_open(data, "groups", '[');
  for (int64_t g = 0; g < hooke_system_group_count(system, "springs"); g++) {
    const struct hk_group *group = hk_system_group(system, &hk_force_springs, g);
    hk_text_open(data, NULL, '{');
    hk_text_word(data, "name", hooke_system_group_name(system, "springs", g));
    hk_text_number(data, "count", (double)hooke_system_group_size(system, "springs", g));
    hk_text_flag(data, "pull_only", group->pull_only);
    hk_text_close(data, '}');
  }
  hk_text_close(data, ']');
}

void hk_view_add_floats(struct hk_text *data, const char *key, const struct hk_view *view,
                        const double *all) {
  uint8_t *bytes = hk_new(4 * view->springs, 1);
  for (int64_t k = 0; k < 4 * view->springs && bytes; k++)
    bytes[k] = (uint8_t)(hk_view_float(all[k / 4 * view->spring_stride]) >> 8 * (k % 4) & 255);
  if (bytes == NULL) data->status = HOOKE_NO_MEMORY;
  hk_text_open(data, key, '"');
  hk_base64_add(data, bytes, bytes ? 4 * view->springs : 0);
  hk_text_close(data, '"');
  hk_free(bytes);
}

void hk_view_add_springs(struct hk_text *data, const struct hk_view *view, const hooke_system *system) {
  add_groups(data, system);
  if (hooke_system_count(system, "springs") != view->springs_there) return;
  double *stiffness = hk_new(view->springs_there, sizeof *stiffness);
  int32_t status = stiffness ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hooke_system_members(system, "springs", NULL, stiffness, NULL, NULL);
  if (status == HOOKE_OK) hk_view_add_floats(data, "stiffness", view, stiffness);
  if (status != HOOKE_OK && data->status == HOOKE_OK) data->status = status;
  hk_free(stiffness);
}
