/* The top level of a scene. */
#include "io/scene/scene_json.h"

#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/status.h"
#include "integrate/method.h"

#if HOOKE_HAVE_JANSSON

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>

enum { METHODS_SIZE = 512 };

static const char other_keys[] = "hooke particles springs bending anchors parts bodies driven run";

/* ---- syntax ---- */

static const char *advice(enum json_error_code code) {
  switch (code) {
  case json_error_duplicate_key:
    return "allowed: each key once";
  case json_error_premature_end_of_input:
    return "the text ends too early; allowed: one whole JSON object";
  case json_error_end_of_input_expected:
    return "allowed: one JSON object and nothing after it";
  case json_error_null_character:
  case json_error_null_byte_in_key:
    return "allowed: texts without the character \\u0000";
  default:
    return "allowed: JSON (RFC 8259), without comments and trailing commas";
  }
}

/* jansson reports missing memory in three ways: by a code, by no text, or by refusing a valid token (all
 * tokens are valid once checked). */
static int ran_out_of_memory(const json_error_t *error) {
  return json_error_code(error) == json_error_out_of_memory || error->text[0] == '\0' ||
         strstr(error->text, "string or '}' expected near '\"") || strstr(error->text, "invalid token");
}

static int32_t no_memory(void) {
  return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for the scene");
}

static int32_t syntax_error(const json_error_t *error, const char *name) {
  enum json_error_code code = json_error_code(error);
  if (ran_out_of_memory(error)) return no_memory();
  char text[JSON_ERROR_TEXT_LENGTH];
  int null_character = code == json_error_null_character || code == json_error_null_byte_in_key;
  snprintf(text, sizeof text, "%s", null_character ? "the character \\u0000 in a text" : error->text);
  for (char *c = text; *c; c++)
    if ((unsigned char)*c < 32 || *c == 127) *c = '?';
  hk_fail(HOOKE_BAD_VALUE, NULL, "%s; %s", text, advice(code));
  return hk_scene_place_line(HOOKE_BAD_VALUE, name, error->line > 0 ? error->line : 1, error->column);
}

struct source {
  const char *next;
  int64_t left;
  int32_t starved; /* an allocation failed */
};

/* jansson silently truncates words and numbers for which it has no memory. Only `errno` shows it, and only
 * until the next number; so the text is fed byte by byte. */
static size_t give_byte(void *buffer, size_t size, void *ctx) {
  struct source *source = ctx;
  source->starved |= errno == ENOMEM;
  if (size == 0 || source->left == 0) return 0;
  *(char *)buffer = *source->next++;
  source->left--;
  return 1;
}

/* NULL, with the failure in `status`, on error. */
static json_t *load(const char *text, int64_t length, const char *name, int32_t *status) {
  struct source source = {.next = text, .left = length};
  const int kept = errno;
  json_error_t error;
  errno = 0;
  json_t *root = json_load_callback(give_byte, &source, JSON_REJECT_DUPLICATES, &error);
  source.starved |= errno == ENOMEM;
  errno = kept;
  *status = HOOKE_OK;
  if (source.starved) {
    json_decref(root);
    root = NULL;
    *status = no_memory();
  } else if (root == NULL) {
    *status = syntax_error(&error, name);
  }
  return root;
}

/* ---- pieces of a scene ---- */

static int32_t check_version(const json_t *root) {
  const json_t *version = json_object_get(root, "hooke");
  if (version == NULL)
    return hk_fail(HOOKE_BAD_VALUE, "hooke",
                   "is required but missing; allowed: 1, the version of the format");
  if (!json_is_integer(version)) return hk_scene_refuse(version, "hooke", "1, the version of the format");
  if (json_integer_value(version) == 1) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "hooke", "%lld is not a known version of the format; allowed: 1",
                 (long long)json_integer_value(version));
}

static int32_t read_top(struct hk_scene_reader *reader, const json_t *root) {
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

static int32_t read_run(struct hk_scene_reader *reader, const json_t *run) {
  int32_t status = hooke_options_create("run", &reader->scene->run);
  if (status || run == NULL) return status;
  strcpy(reader->within, "run");
  status = hk_scene_require_object(run, NULL);
  if (status == HOOKE_OK) status = hk_scene_read_some_options(reader, run, NULL, reader->scene->run);
  if (status == HOOKE_OK) status = check_method(reader->scene->run);
  return status;
}

typedef int32_t add_piece(struct hk_scene_reader *reader, const json_t *value);

static int32_t add(struct hk_scene_reader *reader, const json_t *root, const char *key, add_piece *piece) {
  const json_t *value = json_object_get(root, key);
  return value ? hk_scene_note(reader, piece(reader, value)) : HOOKE_OK;
}

/* Particles first, then parts, so that the others can refer to them, which are read only if both are right. */
static int32_t add_pieces(struct hk_scene_reader *reader, const json_t *root) {
  const json_t *particles = json_object_get(root, "particles");
  if (reader->faults > 0 && particles && !json_object_get(particles, "mass"))
    return HOOKE_OK; /* a right `dynamics` may do without */
  int32_t status = add(reader, root, "particles", hk_scene_add_particles);
  if (status == HOOKE_OK) status = add(reader, root, "parts", hk_scene_add_parts);
  reader->within[0] = '\0';
  if (status != HOOKE_OK || reader->faults > 0) return status;
  if (hooke_system_particle_count(reader->scene->system) == 0)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "a scene without particles; allowed: particles, parts or both");
  status = add(reader, root, "springs", hk_scene_add_springs);
  if (status == HOOKE_OK) status = add(reader, root, "bending", hk_scene_add_bending);
  if (status == HOOKE_OK) status = add(reader, root, "anchors", hk_scene_add_anchors);
  if (status == HOOKE_OK) status = add(reader, root, "bodies", hk_scene_add_bodies);
  return status == HOOKE_OK ? add(reader, root, "driven", hk_scene_add_driven) : status;
}

static int32_t read_scene(struct hk_scene_reader *reader, const json_t *root) {
  int32_t status = hk_scene_note(reader, check_version(root));
  if (status == HOOKE_OK) status = hk_scene_note(reader, read_top(reader, root));
  if (status == HOOKE_OK) status = hk_scene_note(reader, add_pieces(reader, root));
  if (status == HOOKE_OK) status = hk_scene_note(reader, read_run(reader, json_object_get(root, "run")));
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
    return no_memory();
  }
  reader->faults++;
  return reader->faults < HOOKE_SCENE_MOST_FAULTS ? HOOKE_OK : status;
}

static int32_t tell(int32_t status, const struct hk_scene_reader *reader) {
  if (status == HOOKE_BAD_VALUE) return hk_fail_lines(status, reader->faults, reader->fault);
  const int placeless = status == HOOKE_OK || (status == HOOKE_NO_MEMORY && hk_fail_place()[0] == '\0');
  return placeless ? status : hk_scene_place(status, reader->scene, reader->at_key);
}

int32_t hk_scene_build(hooke_scene *scene, const char *folder) {
  HOOKE_KEEP_ERRNO;
  int32_t status;
  json_t *root = load(scene->text, scene->length, scene->name, &status);
  if (root == NULL) return status;
  struct hk_scene_reader reader = {.scene = scene, .folder = folder};
  status = hooke_system_create(&scene->system);
  if (status == HOOKE_OK) status = hooke_system_limit_memory(scene->system, scene->memory_limit);
  if (status == HOOKE_OK) status = read_scene(&reader, root);
  status = tell(status, &reader);
  for (int64_t k = 0; k < reader.faults; k++)
    hk_free(reader.fault[k]);
  hk_part_names_release(&reader.parts);
  json_decref(root);
  return status;
}

/* ---- files ---- */

static int names_file(const json_t *value) {
  const char *key;
  json_t *member;
  size_t k;
  if (json_is_string(json_object_get(value, "file"))) return 1;
  json_object_foreach((json_t *)value, key, member) if (names_file(member)) return 1;
  json_array_foreach(value, k, member) if (names_file(member)) return 1;
  return 0;
}

int32_t hk_scene_names_files(const char *text, int32_t *names, char **title) {
  HOOKE_KEEP_ERRNO;
  int32_t status;
  *names = 0;
  *title = NULL;
  if (strstr(text, "\"file\"") == NULL) return HOOKE_OK; /* covers most scenes without parsing */
  json_t *root = load(text, (int64_t)strlen(text), "", &status);
  if (root == NULL) return status == HOOKE_NO_MEMORY ? status : HOOKE_OK;
  const char *found = json_string_value(json_object_get(root, "title"));
  *names = names_file(root);
  if (*names && (*title = hk_copy_text(found ? found : "")) == NULL) status = HOOKE_NO_MEMORY;
  json_decref(root);
  return status;
}

#else

int32_t hk_scene_build(hooke_scene *scene, const char *folder) {
  (void)scene;
  (void)folder;
  return hk_fail(HOOKE_NOT_BUILT, NULL, "scenes need a build with jansson");
}

int32_t hk_scene_names_files(const char *text, int32_t *names, char **title) {
  (void)text;
  *names = 0;
  *title = NULL;
  return HOOKE_OK;
}

#endif
