#include "io/scene/mesh.h"

#include "parts/surface.h"
#include "core/memory.h"
#include "core/table/option.h"
#include "core/memory_limit.h"
#include "core/status.h"
#include "io/scene/obj.h"
#include "io/scene/scene_file.h"

#include <string.h>

int32_t hk_mesh_check_source(const hooke_options *options) {
  static const char *const others[] = {"vertices", "triangles"};
  for (int k = 0; k < 2; k++) {
    if (hooke_options_is_set(options, others[k]))
      return hk_fail(HOOKE_BAD_VALUE, others[k],
                     "belongs to a mesh without a file; allowed: a file, or vertices and triangles");
  }
  return HOOKE_OK;
}

/* The checks of adding the part, made here where the line of a fault is known. */
static int32_t check_surface(const hooke_options *options, const struct hk_obj *obj, int64_t *line) {
  struct hk_surface_lines lines = {obj->vertex_line, obj->triangle_line, 0};
  struct hk_surface surface;
  const int32_t status = hk_surface_create(options, &lines, &surface);
  hk_surface_release(&surface);
  *line = lines.fault;
  return status;
}

static int32_t read_text(const char *text, int64_t length, hooke_options *options, int64_t *line) {
  struct hk_obj obj;
  int32_t status = hk_obj_parse(text, length, &obj, line);
  if (status == HOOKE_OK) {
    *line = 0;
    status = hooke_mesh_set(options, obj.vertex_count, obj.vertex, obj.triangle_count, obj.triangle);
  }
  if (status == HOOKE_OK) status = check_surface(options, &obj, line);
  hk_obj_release(&obj);
  return status;
}

/* If the mesh is faulty the options get none, and the message names the file. */
static int32_t finish(int32_t status, int64_t line, const char *name, hooke_options *options) {
  if (status == HOOKE_OK) return hooke_options_unset(options, "file");
  char shown[HOOKE_OPTION_SHOWN];
  hooke_options_unset(options, "vertices");
  hooke_options_unset(options, "triangles");
  if (status == HOOKE_NO_MEMORY) return status;
  hk_option_show(name, (int64_t)strlen(name), shown);
  return line > 0 ? hk_fail_before(status, "%s:%lld: ", shown, (long long)line)
                  : hk_fail_before(status, "%s: ", shown);
}

int32_t hk_mesh_parse(const char *text, int64_t length, const char *name, double memory_limit,
                      hooke_options *options) {
  int64_t line = 0;
  int32_t status = hk_memory_require(memory_limit, hk_obj_bytes(text, length), "the mesh");
  if (status == HOOKE_OK) status = read_text(text, length, options, &line);
  return finish(status, line, name, options);
}

int32_t hk_mesh_read_as(const char *path, const char *name, double memory_limit, hooke_options *options) {
  char *text = NULL;
  int64_t length = 0;
  int32_t status = hk_scene_read_file(path, NULL, &text, &length);
  status = status == HOOKE_OK ? hk_mesh_parse(text, length, name, memory_limit, options)
                              : finish(status, 0, name, options);
  hk_free(text);
  return status;
}

int32_t hooke_mesh_read(const char *path, hooke_options *options) {
  int32_t status = hk_options_require(options, hk_options_named("mesh"), "options", "mesh");
  if (status == HOOKE_OK) status = hk_mesh_check_source(options);
  return status != HOOKE_OK ? status : hk_mesh_read_as(path, path, 0.0, options);
}
