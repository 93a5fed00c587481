/* Scenes: loading, and messages with the place in the file. */
#include "io/scene/scene.h"

#include "core/handle.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/status.h"
#include "io/file/atomic_file.h"
#include "io/file/inputs.h"
#include "io/scene/json.h"
#include "io/trajectory/record.h"
#include "io/scene/scene_file.h"
#include "model/system.h"
#include "model/callbacks.h"

#include <string.h>

enum { NAME_SHOWN = 200 };

/* Prefixes the name, and line and column of `at` (NULL: none). Long paths lose their beginning. */
static int32_t in_text(int32_t status, const hooke_scene *scene, const char *at) {
  const size_t length = strlen(scene->name), left = length > NAME_SHOWN ? length - NAME_SHOWN : 0;
  const char *dots = left > 0 ? "..." : "", *shown = scene->name + left;
  int64_t line, column;
  if (at == NULL) return hk_fail_before(status, "%s%s: ", dots, shown);
  hk_json_line(scene->text, at, &line, &column);
  return hk_fail_before(status, "%s%s:%lld:%lld: ", dots, shown, (long long)line, (long long)column);
}

int32_t hk_scene_place(int32_t status, const hooke_scene *scene, int32_t at_key) {
  const char *found = hk_json_find(scene->json, hk_fail_where(), at_key);
  return in_text(status, scene, scene->text + (found - scene->json));
}

static int32_t read_text(hooke_scene *scene, const char *folder) {
  const char *at;
  int32_t status = hk_scene_set(scene);
  if (status != HOOKE_OK) return in_text(status, scene, NULL);
  status = hk_json_open(scene->text, scene->length, &scene->json, &at);
  if (status == HOOKE_BAD_VALUE) return in_text(status, scene, at);
  return status == HOOKE_OK ? hk_scene_build(scene, folder) : status;
}

static hooke_scene *new_scene(const char *name, const hooke_options *limits) {
  hooke_scene *scene = hk_handle_new("hooke_scene", sizeof *scene);
  if (scene && (scene->name = hk_copy_text(name)) == NULL) {
    hk_handle_free(scene);
    return NULL;
  }
  if (scene && limits) {
    const char *set = hooke_options_text(limits, "set");
    if (set[0] && (scene->set = hk_copy_text(set)) == NULL) {
      hooke_scene_destroy(scene);
      return NULL;
    }
    if (hooke_options_is_set(limits, "memory"))
      scene->memory_limit = 1e9 * hooke_options_number(limits, "memory");
    scene->outside = hooke_options_number(limits, "outside") != 0.0;
  }
  return scene;
}

/* Passes the scene to the caller, or releases it. */
static int32_t finish(int32_t status, hooke_scene *made, hooke_scene **scene) {
  return HOOKE_HAND_OVER(status, made, scene, hooke_scene_destroy);
}

/* The scene of a trajectory, with the options of its run. */
static int32_t load_record(const char *path, const hooke_options *limits, hooke_scene **scene) {
  hooke_record *record = NULL;
  int32_t status = hooke_record_open(path, &record);
  if (status != HOOKE_OK) return status;
  const char *text = hooke_record_text(record, "scene");
  char *folder = hk_scene_folder(path);
  if (folder == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK && text[0] == '\0')
    status = hk_fail(HOOKE_BAD_VALUE, NULL, "%s: holds no scene: the run was not made from one", path);
  if (status == HOOKE_OK)
    status = hooke_scene_parse(text, (int64_t)strlen(text), path, folder, limits, scene);
  if (status == HOOKE_OK) status = hk_inputs_note((*scene)->system, path, 1);
  if (status == HOOKE_OK) {
    const int32_t called = hk_callbacks_find(hooke_record_text(record, "callbacks"));
    (*scene)->system->rest->called = called > 0 ? called : 0;
    for (int k = 0; k < HOOKE_FORCE_TEXTS; k++) { /* given over */
      (*scene)->system->rest->called_from[k] = record->text[HOOKE_RECORD_FORCE + k];
      record->text[HOOKE_RECORD_FORCE + k] = NULL;
    }
    hooke_options_destroy((*scene)->run);
    status = hooke_options_copy(hooke_record_options(record), &(*scene)->run);
  }
  if (status != HOOKE_OK) {
    hooke_scene_destroy(*scene);
    *scene = NULL;
  }
  hk_free(folder);
  hooke_record_close(record);
  return status;
}

int32_t hooke_scene_load(const char *path, const hooke_options *limits, hooke_scene **scene) {
  HOOKE_KEEP_ERRNO;
  *scene = NULL;
  const int32_t changed = limits && hooke_options_is_set(limits, "set");
  if (hk_record_is_one(path) && changed)
    return hk_fail(HOOKE_BAD_VALUE, "set", "%s is a trajectory, which keeps its scene; allowed: for a scene",
                   path);
  if (hk_record_is_one(path)) return load_record(path, limits, scene);
  hooke_scene *made = new_scene(path, limits);
  if (made == NULL) return HOOKE_NO_MEMORY;
  char *folder = hk_scene_folder(path);
  int32_t status = HOOKE_NO_MEMORY;
  if (folder) status = hk_scene_read_file(path, &made->memory_limit, &made->text, &made->length);
  status = status == HOOKE_OK ? read_text(made, folder) : in_text(status, made, NULL);
  hk_free(folder);
  if (status == HOOKE_OK) status = hk_inputs_note(made->system, path, 1);
  return finish(status, made, scene);
}

int32_t hooke_scene_parse(const char *text, int64_t length, const char *name, const char *folder,
                          const hooke_options *limits, hooke_scene **scene) {
  HOOKE_KEEP_ERRNO;
  if (scene) *scene = NULL;
  if (text == NULL || length < 0 || scene == NULL)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "no text or no scene given (length %lld)", (long long)length);
  if (name == NULL) name = "scene";
  hooke_scene *made = new_scene(name, limits);
  if (made == NULL) return HOOKE_NO_MEMORY;
  int32_t status = hk_scene_require_memory(made->memory_limit, length);
  if (status) return finish(in_text(status, made, NULL), made, scene);
  const char *end = memchr(text, '\0', (size_t)length); /* a NUL is refused, and nothing behind it is read */
  made->length = end ? end - text + 1 : length;
  made->text = hk_new(made->length + 1, 1);
  if (made->text == NULL) return finish(HOOKE_NO_MEMORY, made, scene);
  memcpy(made->text, text, (size_t)made->length);
  return finish(read_text(made, folder), made, scene);
}

int32_t hooke_scene_commit(hooke_scene *scene) {
  int32_t status = hooke_system_commit(scene->system);
  if (status == HOOKE_BAD_VALUE) return hk_scene_place(status, scene, 0);
  if (status != HOOKE_OK) return status;
  hk_free(scene->json); /* no fault remains whose line it finds */
  scene->json = NULL;
  return HOOKE_OK;
}

int32_t hooke_scene_check_output(const hooke_scene *scene, const char *path) {
  const int32_t status = hk_inputs_refuse(scene->system, path);
  return status == HOOKE_OK ? hk_atomic_file_check(path) : status;
}

void hooke_scene_destroy(hooke_scene *scene) {
  if (scene == NULL) return;
  hooke_system_destroy(scene->system);
  hooke_options_destroy(scene->run);
  hk_free(scene->title);
  hk_free(scene->text);
  hk_free(scene->json);
  hk_free(scene->set);
  hk_free(scene->name);
  hk_handle_free(scene);
}

hooke_system *hooke_scene_system(hooke_scene *scene) {
  return scene->system;
}

hooke_options *hooke_scene_run_options(hooke_scene *scene) {
  return scene->run;
}

const char *hooke_scene_text(const hooke_scene *scene, const char *what) {
  if (strcmp(what, "text") == 0) return scene->text;
  if (strcmp(what, "title") == 0) return scene->title ? scene->title : "";
  return NULL;
}
