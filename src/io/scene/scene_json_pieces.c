/* Particles, parts, springs and drives of a scene. */
#include "io/scene/scene_json.h"

#include "core/memory.h"
#include "core/status.h"
#include "io/scene/mesh.h"
#include "io/scene/scene_file.h"
#include "model/particles.h"
#include "model/system.h"
#include "parts/part.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LIST_SIZE = 256 };

/* Reads the text of an optional key; `text` is unchanged without it. */
static int32_t read_text(const char *object, const char *key, const char **text) {
  const char *value = hk_json_get(object, key);
  if (value == NULL) return HOOKE_OK;
  int32_t status = hk_scene_require(value, '"', key, "a text");
  if (status == HOOKE_OK) *text = hk_json_text(value);
  return status;
}

typedef int32_t add_one(struct hk_scene_reader *reader, const char *object, const struct hk_scene_list *list);

static int32_t add_object(struct hk_scene_reader *reader, const char *object,
                          const struct hk_scene_list *list, add_one *add) {
  int32_t status = hk_scene_require(object, '{', NULL, "an object { ... }");
  if (status == HOOKE_OK) status = add(reader, object, list);
  return hk_scene_note(reader, status);
}

/* Calls `add` for every object of an array, which may be NULL. */
static int32_t for_each(struct hk_scene_reader *reader, const char *array, const char *key,
                        const struct hk_scene_list *list, add_one *add) {
  int64_t k = 0;
  reader->within[0] = '\0';
  int32_t status = array ? hk_scene_require(array, '[', key, "an array of objects [{ ... }, ...]") : HOOKE_OK;
  if (status != HOOKE_OK) return hk_scene_note(reader, status);
  for (const char *at = array ? hk_json_first(array) : NULL; at; at = hk_json_next(at), k++) {
    snprintf(reader->within, sizeof reader->within, "%s[%lld]", key, (long long)k);
    status = add_object(reader, at, list, add);
    if (status != HOOKE_OK) return status;
  }
  reader->within[0] = '\0';
  return HOOKE_OK;
}

/* ---- particles ---- */

static int32_t pin(hooke_system *system, const hooke_options *options) {
  int64_t count = hooke_options_number_count(options, "pinned");
  const double *numbers = hooke_options_numbers(options, "pinned");
  int64_t *particles = hk_new(count, sizeof *particles);
  if (particles == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count; k++)
    particles[k] = (int64_t)numbers[k];
  int32_t status = hooke_system_pin(system, count, particles);
  hk_free(particles);
  return status;
}

static int32_t add_particles(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                             const hooke_options *options) {
  (void)name, (void)count, (void)particles;
  const int64_t n = hooke_options_number_count(options, "position") / 3,
                velocities = hooke_options_number_count(options, "velocity") / 3;
  const double *velocity = hooke_options_numbers(options, "velocity");
  if (velocity && system->overdamped)
    return hk_fail(HOOKE_BAD_VALUE, "velocity",
                   "is not allowed; in an overdamped scene velocities are force over drag");
  if (velocity && velocities != n)
    return hk_fail(HOOKE_BAD_VALUE, "velocity", "%lld rows given; allowed: %lld, one for each position",
                   (long long)velocities, (long long)n);
  if (!hooke_options_is_set(options, "mass") && (system->has_gravity || !system->overdamped))
    return hk_fail(HOOKE_BAD_VALUE, "mass", "is required but missing; allowed: one or more numbers > 0 [kg]");
  const struct hk_system_mark mark = hk_system_mark(system);
  int32_t status = hooke_system_add_particles(system, n, hooke_options_numbers(options, "position"), velocity,
                                              hooke_options_number_count(options, "mass"),
                                              hooke_options_numbers(options, "mass"), NULL);
  if (status == HOOKE_OK) status = pin(system, options);
  if (status == HOOKE_OK) status = hk_set_gravity_factor(system, mark.particle_count, options);
  if (status != HOOKE_OK) hk_system_roll_back(system, mark);
  return status;
}

/* ---- parts ---- */

/* Reads the file of a mesh into its vertices and triangles, so that a system does not depend on files. */
static int32_t read_file(const struct hk_scene_reader *reader, hooke_options *options) {
  if (!hooke_options_is_set(options, "file")) return HOOKE_OK;
  const char *file = hooke_options_text(options, "file");
  char *path = NULL;
  int32_t status = hk_mesh_check_source(options);
  if (status == HOOKE_OK) status = hk_scene_reader_file(reader, file, &path);
  if (status == HOOKE_OK) status = hk_mesh_read_as(path, file, reader->scene->memory_limit, options);
  hk_free(path);
  if (status != HOOKE_BAD_VALUE && status != HOOKE_IO_FAILED) return status;
  if (hk_fail_where()[0]) return status;
  /* an unusable file that a scene names is a fault of the scene */
  return hk_fail(HOOKE_BAD_VALUE, "file", "%s", hooke_last_error());
}

static int32_t add_part(struct hk_scene_reader *reader, const char *object,
                        const struct hk_scene_list *list) {
  (void)list;
  const char *kind = NULL, *name = "";
  hooke_options *options = NULL;
  int32_t status = read_text(object, "kind", &kind);
  const struct hk_option_table *table = status == HOOKE_OK ? hk_part_find(kind) : NULL;
  if (table == NULL) return HOOKE_BAD_VALUE;
  status = read_text(object, "name", &name);
  if (status == HOOKE_OK) status = hk_options_create(table, &options);
  if (status == HOOKE_OK) status = hk_scene_read_options(reader, object, "kind name", options);
  if (status == HOOKE_OK) status = read_file(reader, options);
  if (status == HOOKE_OK) {
    status = hooke_system_add_part(reader->scene->system, kind, name, options, NULL, NULL);
    if (status) hk_scene_place_number(status, hk_json_get(object, "pinned"), "pinned");
  }
  hooke_options_destroy(options);
  return status;
}

static int compare_parts(const void *a, const void *b) {
  const struct hk_part_record *one = *(const struct hk_part_record *const *)a,
                              *other = *(const struct hk_part_record *const *)b;
  const int order = strcmp(one->name, other->name);
  return order ? order : (one > other) - (one < other);
}

/* Sorts the parts by their names, each of which is its own. */
static int32_t sort_parts(struct hk_scene_reader *reader) {
  const hooke_system *system = reader->scene->system;
  char where[LIST_SIZE], shown[HOOKE_OPTION_SHOWN];
  reader->part = hk_new(system->part_count, sizeof *reader->part);
  if (reader->part == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < system->part_count; k++)
    reader->part[k] = &system->part[k];
  qsort(reader->part, (size_t)system->part_count, sizeof *reader->part, compare_parts);
  for (int64_t k = 1; k < system->part_count; k++) {
    const struct hk_part_record *first = reader->part[k - 1], *second = reader->part[k];
    if (strcmp(first->name, second->name) != 0) continue;
    snprintf(where, sizeof where, "parts[%lld].name", (long long)(second - system->part));
    hk_option_show(first->name, (int64_t)strlen(first->name), shown);
    return hk_fail(HOOKE_BAD_VALUE, where,
                   "\"%s\" is the name of part %lld already; allowed: a name of its own", shown,
                   (long long)(first - system->part));
  }
  return HOOKE_OK;
}

int32_t hk_scene_add_parts(struct hk_scene_reader *reader, const char *root) {
  const int32_t status = for_each(reader, hk_json_get(root, "parts"), "parts", NULL, add_part);
  return status == HOOKE_OK && reader->faults == 0 ? hk_scene_note(reader, sort_parts(reader)) : status;
}

/* ---- groups, bodies and drives ---- */

static int32_t list_part(const struct hk_scene_reader *reader, const char *value, int64_t **particles,
                         int64_t *count) {
  const struct hk_part_record *part;
  int32_t status = hk_scene_require(value, '"', "part", "a text");
  if (status == HOOKE_OK) status = hk_scene_require_part(reader, "part", hk_json_text(value), &part);
  if (status != HOOKE_OK) return status;
  *particles = hk_new(part->count, sizeof **particles);
  if (*particles == NULL) return HOOKE_NO_MEMORY;
  *count = part->count;
  for (int64_t k = 0; k < part->count; k++)
    (*particles)[k] = part->first + k;
  return HOOKE_OK;
}

static int32_t read_particles(struct hk_scene_reader *reader, const char *object,
                              const struct hk_scene_list *list, int64_t **particles, int64_t *count) {
  const char *value = hk_json_get(object, list->particles);
  const char *part = strstr(list->others, " part ") ? hk_json_get(object, "part") : NULL;
  if (value && part)
    return hk_fail(HOOKE_BAD_VALUE, "part", "is given beside particles; allowed: %s", list->allowed);
  if (part) return list_part(reader, part, particles, count);
  if (value == NULL && list->may_be_all) {
    *count = -1;
    return HOOKE_OK;
  }
  if (value == NULL)
    return hk_fail(HOOKE_BAD_VALUE, list->particles, "is required but missing; allowed: %s", list->allowed);
  const int32_t status = hk_scene_read_particles(reader, value, list, particles, count);
  return status == HOOKE_OK ? status : hk_fail_within(status, "%s", list->particles);
}

static int32_t add_member(struct hk_scene_reader *reader, const char *object,
                          const struct hk_scene_list *list) {
  const char *name = "";
  int64_t *particles = NULL, count = 0;
  hooke_options *options = NULL;
  int32_t status = hooke_options_create(list->key, &options);
  if (status == HOOKE_OK) status = hk_scene_read_options(reader, object, list->others, options);
  if (status == HOOKE_OK && strstr(list->others, " name ")) status = read_text(object, "name", &name);
  if (status == HOOKE_OK && list->particles)
    status = read_particles(reader, object, list, &particles, &count);
  if (status == HOOKE_OK)
    status = hooke_system_add_members(reader->scene->system, list->key, name, count, particles, options);
  hk_free(particles);
  hooke_options_destroy(options);
  return status;
}

int32_t hk_scene_add_list(struct hk_scene_reader *reader, const char *value,
                          const struct hk_scene_list *list) {
  if (list->particles) return for_each(reader, value, list->key, list, add_member);
  strcpy(reader->within, list->key);
  return value ? add_object(reader, value, list, add_member) : HOOKE_OK;
}

int32_t hooke_system_add_members(hooke_system *system, const char *key, const char *name, int64_t count,
                                 const int64_t *particles, const hooke_options *options) {
  const struct hk_scene_list *list = hk_scene_lists;
  while (list->key && strcmp(list->key, key) != 0)
    list++;
  if (list->key == NULL)
    return hk_option_unknown(NULL, "particles springs bending anchors bodies driven loads obstacles", "key",
                             "key", key);
  int32_t status = hk_options_require(options, hk_options_named(key), "options", key);
  if (status == HOOKE_OK) status = hk_options_check_required(options);
  if (status == HOOKE_OK && (count % list->columns != 0 || (count != 0 && !list->particles)))
    status = hk_fail(HOOKE_BAD_VALUE, "count", "%lld is not allowed for %s; allowed: %s", (long long)count,
                     key, list->particles ? list->allowed : "0");
  return status == HOOKE_OK ? list->add(system, name, count / list->columns, particles, options) : status;
}

static int32_t add_bending(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                           const hooke_options *options) {
  return hooke_system_add_bending(system, name, count, particles,
                                  hooke_options_number_count(options, "coefficient"),
                                  hooke_options_numbers(options, "coefficient"));
}

static int32_t add_body(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                        const hooke_options *options) {
  return hooke_system_add_body(system, name, count, particles,
                               hooke_options_number(options, "project") != 0.0);
}

static int32_t add_drive(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                         const hooke_options *options) {
  (void)name;
  if (strcmp(hooke_options_text(options, "motion"), "harmonic") == 0)
    return hooke_system_drive_harmonic(system, count, particles, hooke_options_numbers(options, "amplitude"),
                                       hooke_options_number(options, "frequency"),
                                       hooke_options_number(options, "phase"));
  int64_t samples = hooke_options_number_count(options, "time");
  int64_t rows = hooke_options_number_count(options, "position") / 3;
  if (rows != samples)
    return hk_fail(HOOKE_BAD_VALUE, "position", "%lld rows given; allowed: %lld, one for each time",
                   (long long)rows, (long long)samples);
  return hooke_system_drive_table(system, count, particles, samples, hooke_options_numbers(options, "time"),
                                  hooke_options_numbers(options, "position"));
}

static int32_t add_load(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                        const hooke_options *options) {
  (void)name;
  return hooke_system_add_loads(system, count, particles, options);
}

static int32_t add_obstacle(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                            const hooke_options *options) {
  (void)name;
  return hooke_system_add_obstacle(system, count, particles, options);
}

/* The keys of a member are those of its options and `others`, between blanks. */
const struct hk_scene_list hk_scene_lists[] = {
    {"particles", "", NULL, 1, NULL, NULL, add_particles, 0},
    {"springs", " name between ", "between", 2, "stiffness", "an array of pairs of particles",
     hooke_system_add_springs, 0},
    {"bending", " name triples ", "triples", 3, "coefficient", "an array of triples of particles",
     add_bending, 0},
    {"anchors", " name particles ", "particles", 1, "stiffness", "an array of particles",
     hooke_system_add_anchors, 0},
    {"bodies", " name particles part ", "particles", 1, NULL, "particles, or the name of a part", add_body,
     0},
    {"driven", " particles ", "particles", 1, NULL, "an array of particles", add_drive, 0},
    {"loads", " particles ", "particles", 1, "force", "an array of particles", add_load, 0},
    {"obstacles", " particles ", "particles", 1, NULL, "an array of particles", add_obstacle, 1},
    {NULL, NULL, NULL, 0, NULL, NULL, NULL, 0},
};
