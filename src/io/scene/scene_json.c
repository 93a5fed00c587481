/* The top level of a scene. */
#include "io/scene/scene_json.h"

#include "core/memory.h"
#include "core/status.h"
#include "integrate/method.h"

#include <string.h>

enum { METHODS_SIZE = 512, MOST_LISTS = 16 };

static const char other_keys[] =
    "hooke particles springs bending anchors parts bodies driven loads obstacles run names";

/* ---- pieces of a scene ---- */

static int32_t check_version(const char *root) {
  const char *version = hk_json_get(root, "hooke");
  if (version == NULL)
    return hk_fail(HOOKE_BAD_VALUE, "hooke",
                   "is required but missing; allowed: 1, the version of the format");
  if (hk_json_is_integer(version) && hk_json_integer(version) == 1) return HOOKE_OK;
  return hk_scene_refuse(version, "hooke", "1, the version of the format");
}

static int32_t read_top(struct hk_scene_reader *reader, const char *root) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_create("scene", &options);
  if (status == HOOKE_OK) status = hk_scene_read_options(reader, root, other_keys, options);
  if (status == HOOKE_OK) status = hooke_scene_options_apply(options, reader->scene->system);
  if (status == HOOKE_OK &&
      (reader->scene->title = hk_copy_text(hooke_options_text(options, "title"))) == NULL)
    status = HOOKE_NO_MEMORY;
  hooke_options_destroy(options);
  return status;
}

/* The table of a run accepts any text as method; an unknown one is refused here at once. */
static int32_t check_method(const hooke_options *run) {
  const char *method = hooke_options_text(run, "method");
  if (!hooke_options_is_set(run, "method") || hooke_method_is_adaptive(method) >= 0) return HOOKE_OK;
  char methods[METHODS_SIZE], shown[HOOKE_OPTION_SHOWN];
  hk_method_list(methods, sizeof methods);
  hk_option_show(method, (int64_t)strlen(method), shown);
  return hk_fail(HOOKE_BAD_VALUE, "method", "\"%s\" is not a method; allowed: %s", shown, methods);
}

static int32_t read_run(struct hk_scene_reader *reader, const char *run) {
  int32_t status = hooke_options_create("run", &reader->scene->run);
  if (status || run == NULL) return status;
  strcpy(reader->within, "run");
  status = hk_scene_require(run, '{', NULL, "an object { ... }");
  if (status == HOOKE_OK) status = hk_scene_read_options(reader, run, NULL, reader->scene->run);
  if (status == HOOKE_OK) status = check_method(reader->scene->run);
  return status;
}

/* The values of all lists, in one walk, as their texts may be long. */
static void find_lists(const char *root, const char *value[MOST_LISTS]) {
  for (const char *at = hk_json_first(root); at; at = hk_json_next(at))
    for (int k = 0; hk_scene_lists[k].key; k++)
      if (strcmp(hk_scene_lists[k].key, at + 1) == 0) value[k] = hk_json_member(at);
}

/* Particles first, then parts, so that the others can refer to them, which are read only if both are right.
 */
static int32_t add_pieces(struct hk_scene_reader *reader, const char *root) {
  const struct hk_scene_list *list = hk_scene_lists;
  const char *values[MOST_LISTS] = {NULL}, **value = values;
  find_lists(root, values);
  if (reader->faults > 0 && values[0] && !hk_json_get(values[0], "mass"))
    return HOOKE_OK; /* a right `dynamics` may do without */
  int32_t status = hk_scene_add_list(reader, *value++, list++);
  if (status == HOOKE_OK) status = hk_scene_add_parts(reader, root);
  if (status == HOOKE_OK && reader->faults == 0) status = hk_scene_add_names(reader);
  reader->within[0] = '\0';
  if (status != HOOKE_OK || reader->faults > 0) return status;
  if (hooke_system_particle_count(reader->scene->system) == 0)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "a scene without particles; allowed: particles, parts or both");
  for (; list->key && status == HOOKE_OK; list++)
    status = hk_scene_add_list(reader, *value++, list);
  return status;
}

static int32_t read_scene(struct hk_scene_reader *reader, const char *root) {
  reader->names = hk_json_get(root, "names");
  int32_t status = hk_scene_note(reader, check_version(root));
  if (status == HOOKE_OK) status = hk_scene_note(reader, read_top(reader, root));
  if (status == HOOKE_OK) status = hk_scene_note(reader, add_pieces(reader, root));
  if (status == HOOKE_OK) status = hk_scene_note(reader, read_run(reader, hk_json_get(root, "run")));
  return status == HOOKE_OK && reader->faults > 0 ? HOOKE_BAD_VALUE : status;
}

int32_t hk_scene_note(struct hk_scene_reader *reader, int32_t status) {
  if (status == HOOKE_OK || reader->in_value || reader->faults == HOOKE_SCENE_MOST_FAULTS) return status;
  const int32_t noted = reader->noted;
  if (!noted && reader->within[0]) hk_fail_within(status, "%s", reader->within);
  reader->noted = status != HOOKE_BAD_VALUE;
  if (reader->noted) return status;
  if (noted) return HOOKE_OK;
  hk_scene_place(status, reader->scene, reader->at_key);
  reader->at_key = 0;
  reader->fault[reader->faults] = hk_copy_text(hooke_last_error());
  if (reader->fault[reader->faults] == NULL) {
    reader->noted = 1;
    return HOOKE_NO_MEMORY;
  }
  reader->faults++;
  return reader->faults < HOOKE_SCENE_MOST_FAULTS ? HOOKE_OK : status;
}

static int32_t tell(int32_t status, const struct hk_scene_reader *reader) {
  if (status == HOOKE_BAD_VALUE) return hk_fail_lines(status, reader->faults, reader->fault);
  const int placeless = status == HOOKE_OK || (status == HOOKE_NO_MEMORY && hk_fail_where()[0] == '\0');
  return placeless ? status : hk_scene_place(status, reader->scene, reader->at_key);
}

int32_t hk_scene_build(hooke_scene *scene, const char *folder) {
  struct hk_scene_reader reader = {.scene = scene, .folder = folder};
  int32_t status = hooke_system_create(&scene->system);
  if (status == HOOKE_OK) status = hooke_system_limit_memory(scene->system, scene->memory_limit);
  if (status == HOOKE_OK) status = read_scene(&reader, hk_json_find(scene->json, "", 0));
  status = tell(status, &reader);
  for (int64_t k = 0; k < reader.faults; k++)
    hk_free(reader.fault[k]);
  hk_free(reader.part);
  return status;
}
