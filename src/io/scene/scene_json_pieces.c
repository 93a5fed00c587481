/* Particles, parts, springs and drives of a scene. */
#include "io/scene/scene_json.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "io/scene/mesh.h"
#include "model/particles.h"

#include <stdio.h>
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

typedef int32_t add_one(struct hk_scene_reader *reader, const char *object, int64_t index,
                        hooke_options *options);

/* Calls `add` for every object of an array, with new options of `table` (NULL: none). */
static int32_t for_each(struct hk_scene_reader *reader, const char *array, const char *name,
                        const char *table, add_one *add) {
  reader->within[0] = '\0';
  int32_t status = hk_scene_require(array, '[', name, "an array of objects [{ ... }, ...]");
  if (status) return status;
  int64_t k = 0;
  for (const char *object = hk_json_first(array); object; object = hk_json_next(object), k++) {
    hooke_options *options = NULL;
    snprintf(reader->within, sizeof reader->within, "%s[%lld]", name, (long long)k);
    status = hk_scene_require(object, '{', NULL, "an object { ... }");
    if (status == HOOKE_OK && table) status = hooke_options_create(table, &options);
    if (status == HOOKE_OK) status = add(reader, object, k, options);
    hooke_options_destroy(options);
    status = hk_scene_note(reader, status);
    if (status) return status;
  }
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

static int32_t add_particles(struct hk_scene_reader *reader, const char *particles, hooke_options *options) {
  const hooke_system *system = reader->scene->system;
  const double none = 1.0; /* where masses do nothing, and none are given */
  const int32_t given = hk_json_get(particles, "mass") != NULL,
                idle = system->overdamped && !system->has_gravity;
  int32_t status = idle && !given ? hooke_options_set_numbers(options, "mass", 1, &none) : HOOKE_OK;
  if (status == HOOKE_OK) status = hk_scene_read_options(reader, particles, NULL, options);
  if (status) return status;
  int64_t n = hooke_options_number_count(options, "position") / 3;
  const double *velocity = hooke_options_numbers(options, "velocity");
  int64_t velocities = hooke_options_number_count(options, "velocity") / 3;
  if (velocity && system->overdamped)
    return hk_fail(HOOKE_BAD_VALUE, "velocity",
                   "is not allowed; in an overdamped scene velocities are force over drag");
  if (velocity && velocities != n)
    return hk_fail(HOOKE_BAD_VALUE, "velocity", "%lld rows given; allowed: %lld, one for each position",
                   (long long)velocities, (long long)n);
  status = hooke_system_add_particles(reader->scene->system, n, hooke_options_numbers(options, "position"),
                                      velocity, given ? hooke_options_number_count(options, "mass") : 0,
                                      hooke_options_numbers(options, "mass"), NULL);
  return status ? status : pin(reader->scene->system, options);
}

int32_t hk_scene_add_particles(struct hk_scene_reader *reader, const char *particles) {
  hooke_options *options = NULL;
  strcpy(reader->within, "particles");
  int32_t status = hk_scene_require(particles, '{', NULL, "an object { ... }");
  if (status == HOOKE_OK) status = hooke_options_create("particles", &options);
  if (status == HOOKE_OK) status = add_particles(reader, particles, options);
  hooke_options_destroy(options);
  return status;
}

/* ---- parts ---- */

static int32_t read_kind(const char *object, const char **kind) {
  char kinds[LIST_SIZE] = "";
  for (int64_t k = 0; hooke_part_kind(k, "name"); k++)
    hk_append(kinds, sizeof kinds, "%s%s", k ? ", " : "", hooke_part_kind(k, "name"));
  int32_t status = read_text(object, "kind", kind);
  if (status) return status;
  if (*kind == NULL) return hk_fail(HOOKE_BAD_VALUE, "kind", "is required but missing; allowed: %s", kinds);
  for (int64_t k = 0; hooke_part_kind(k, "name"); k++)
    if (strcmp(hooke_part_kind(k, "name"), *kind) == 0) return HOOKE_OK;
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(*kind, (int64_t)strlen(*kind), shown);
  return hk_fail(HOOKE_BAD_VALUE, "kind", "\"%s\" is not a kind of part; allowed: %s", shown, kinds);
}

/* Collects the names of all parts before the first is built; an unnamed part gets its kind and number. Errors
 * in a part are reported when it is built. */
static int32_t note_names(struct hk_scene_reader *reader, const char *parts) {
  int64_t k = 0;
  int32_t status = hk_part_names_create(hk_json_count(parts), &reader->parts);
  for (const char *object = hk_json_first(parts); object && status == HOOKE_OK;
       object = hk_json_next(object)) {
    const char *name = hk_json_text(hk_json_get(object, "name"));
    const char *kind = hk_json_text(hk_json_get(object, "kind"));
    char made[LIST_SIZE];
    snprintf(made, sizeof made, "%s%lld", kind ? kind : "", (long long)k);
    status = hk_part_names_set(&reader->parts, k++, name && name[0] ? name : made);
  }
  if (status == HOOKE_OK) hk_part_names_sort(&reader->parts);
  return status;
}

static int32_t check_name(const struct hk_scene_reader *reader, int64_t index) {
  const char *name = reader->parts.part[index].name;
  const struct hk_named_part *first = hk_part_names_find(&reader->parts, name);
  if (first->number == index) return HOOKE_OK;
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(name, (int64_t)strlen(name), shown);
  return hk_fail(HOOKE_BAD_VALUE, "name",
                 "\"%s\" is the name of part %lld already; allowed: a name of its own", shown,
                 (long long)first->number);
}

/* Reads the file of a mesh into its vertices and triangles, so that a system does not depend on files. */
static int32_t read_file(const struct hk_scene_reader *reader, hooke_options *options) {
  if (!hooke_options_is_set(options, "file")) return HOOKE_OK;
  const char *file = hooke_options_text(options, "file");
  char *path = NULL;
  int32_t status = hk_mesh_check_alone(options);
  if (status != HOOKE_OK) return status;
  status = hk_scene_reader_file(reader, file, &path);
  if (status == HOOKE_OK) status = hk_mesh_read_as(path, file, reader->scene->memory_limit, options);
  hk_free(path);
  if (status != HOOKE_BAD_VALUE && status != HOOKE_IO_FAILED) return status;
  if (hk_fail_place()[0]) return status;
  /* an unusable file that a scene names is a fault of the scene */
  return hk_fail(HOOKE_BAD_VALUE, "file", "%s", hooke_last_error());
}

static int32_t add_part(struct hk_scene_reader *reader, const char *object, int64_t index,
                        hooke_options *options) {
  const char *kind = NULL, *name = "";
  int32_t status = read_kind(object, &kind);
  if (status == HOOKE_OK) status = read_text(object, "name", &name);
  if (status == HOOKE_OK) status = check_name(reader, index);
  if (status == HOOKE_OK) status = hooke_options_create(kind, &options);
  if (status == HOOKE_OK) status = hk_scene_read_options(reader, object, "kind name", options);
  if (status == HOOKE_OK) status = read_file(reader, options);
  if (status == HOOKE_OK) {
    struct hk_named_part *part = &reader->parts.part[index];
    status = hooke_system_add_part(reader->scene->system, kind, name, options, &part->first, &part->count);
    if (status) hk_scene_place_number(status, hk_json_get(object, "pinned"), "pinned");
  }
  hooke_options_destroy(options);
  return status;
}

int32_t hk_scene_add_parts(struct hk_scene_reader *reader, const char *parts) {
  const int32_t status = note_names(reader, parts);
  return status == HOOKE_OK ? for_each(reader, parts, "parts", NULL, add_part) : status;
}

/* ---- springs and anchors ---- */

static int32_t add_triples(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                           const hooke_options *options) {
  return hooke_system_add_bending(system, name, count, particles,
                                  hooke_options_number_count(options, "coefficient"),
                                  hooke_options_numbers(options, "coefficient"));
}

/* Forces whose groups a scene lists, with each member given by its particles. */
static const struct group_kind {
  const char *key, *particles;
  int32_t columns; /* for a row of particles; 0: one */
  const char *allowed;
  int32_t (*add)(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                 const hooke_options *options);
} springs_kind = {"springs", "between", 2, "an array of pairs of particles", hooke_system_add_springs},
  bending_kind = {"bending", "triples", 3, "an array of triples of particles", add_triples},
  anchors_kind = {"anchors", "particles", 0, "an array of particles", hooke_system_add_anchors};

static int32_t read_group(struct hk_scene_reader *reader, const char *object, const struct group_kind *kind,
                          hooke_options *options) {
  const char *name = "";
  int64_t *particles = NULL, count = 0;
  char others[32];
  snprintf(others, sizeof others, "name %s", kind->particles);
  int32_t status = hk_scene_read_options(reader, object, others, options);
  if (status == HOOKE_OK) status = read_text(object, "name", &name);
  if (status) return status;
  const char *list = hk_json_get(object, kind->particles);
  if (list == NULL)
    return hk_fail(HOOKE_BAD_VALUE, kind->particles, "is required but missing; allowed: %s", kind->allowed);
  status = hk_scene_read_particles(reader, list, kind->columns, &particles, &count);
  if (status) return hk_fail_within(status, "%s", kind->particles);
  status = kind->add(reader->scene->system, name, kind->columns > 0 ? count / kind->columns : count,
                     particles, options);
  hk_free(particles);
  return status;
}

static int32_t add_springs(struct hk_scene_reader *reader, const char *object, int64_t index,
                           hooke_options *options) {
  (void)index;
  return read_group(reader, object, &springs_kind, options);
}

static int32_t add_bending(struct hk_scene_reader *reader, const char *object, int64_t index,
                           hooke_options *options) {
  (void)index;
  return read_group(reader, object, &bending_kind, options);
}

static int32_t add_anchors(struct hk_scene_reader *reader, const char *object, int64_t index,
                           hooke_options *options) {
  (void)index;
  return read_group(reader, object, &anchors_kind, options);
}

int32_t hk_scene_add_springs(struct hk_scene_reader *reader, const char *springs) {
  return for_each(reader, springs, springs_kind.key, springs_kind.key, add_springs);
}

int32_t hk_scene_add_bending(struct hk_scene_reader *reader, const char *bending) {
  return for_each(reader, bending, bending_kind.key, bending_kind.key, add_bending);
}

int32_t hk_scene_add_anchors(struct hk_scene_reader *reader, const char *anchors) {
  return for_each(reader, anchors, anchors_kind.key, anchors_kind.key, add_anchors);
}

/* ---- bodies ---- */

static int32_t list_part(const struct hk_scene_reader *reader, const char *value, int64_t **particles,
                         int64_t *count) {
  int32_t status = hk_scene_require(value, '"', "part", "a text");
  if (status != HOOKE_OK) return status;
  const struct hk_named_part *part = hk_part_names_find(&reader->parts, hk_json_text(value));
  if (part == NULL) {
    char shown[HOOKE_OPTION_SHOWN];
    hk_option_show(hk_json_text(value), (int64_t)strlen(hk_json_text(value)), shown);
    return hk_fail(HOOKE_BAD_VALUE, "part", "there is no part \"%s\"; allowed: the name of a part", shown);
  }
  *particles = hk_new(part->count, sizeof **particles);
  if (*particles == NULL) return HOOKE_NO_MEMORY;
  *count = part->count;
  for (int64_t k = 0; k < part->count; k++)
    (*particles)[k] = part->first + k;
  return HOOKE_OK;
}

static int32_t add_body(struct hk_scene_reader *reader, const char *object, int64_t index,
                        hooke_options *options) {
  (void)index;
  const char *list = hk_json_get(object, "particles"), *part = hk_json_get(object, "part");
  const char *name = "";
  int64_t *particles = NULL, count = 0;
  int32_t status = hk_scene_read_options(reader, object, "name particles part", options);
  if (status == HOOKE_OK) status = read_text(object, "name", &name);
  if (status == HOOKE_OK && (list == NULL) == (part == NULL))
    status =
        hk_fail(HOOKE_BAD_VALUE, part ? "part" : "particles", "%s; allowed: particles, or the name of a part",
                part ? "is given beside particles" : "is required but missing");
  if (status != HOOKE_OK) return status;
  if (part) {
    status = list_part(reader, part, &particles, &count);
  } else {
    status = hk_scene_read_particles(reader, list, 0, &particles, &count);
    if (status != HOOKE_OK) hk_fail_within(status, "particles");
  }
  if (status == HOOKE_OK)
    status = hooke_system_add_body(reader->scene->system, name, count, particles,
                                   hooke_options_number(options, "project") != 0.0);
  hk_free(particles);
  return status;
}

int32_t hk_scene_add_bodies(struct hk_scene_reader *reader, const char *bodies) {
  return for_each(reader, bodies, "bodies", "bodies", add_body);
}

/* ---- drives ---- */

/* Refuses the keys of another motion, and requires those of this one. */
static int32_t check_drive(const hooke_options *options) {
  static const struct {
    const char *motion, *key;
    int32_t required;
  } keys[] = {{"harmonic", "amplitude", 1},
              {"harmonic", "frequency", 1},
              {"harmonic", "phase", 0},
              {"table", "time", 1},
              {"table", "position", 1}};
  const char *motion = hooke_options_text(options, "motion");
  for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++) {
    int32_t set = hooke_options_is_set(options, keys[k].key);
    int32_t belongs = strcmp(motion, keys[k].motion) == 0;
    if (set && !belongs)
      return hk_fail(HOOKE_BAD_VALUE, keys[k].key, "belongs to motion \"%s\"; allowed with \"%s\": %s",
                     keys[k].motion, motion,
                     strcmp(motion, "table") == 0 ? "time, position" : "amplitude, frequency, phase");
    if (!set && belongs && keys[k].required)
      return hk_fail(HOOKE_BAD_VALUE, keys[k].key, "is required with motion \"%s\" but missing", motion);
  }
  return HOOKE_OK;
}

static int32_t drive(hooke_system *system, const hooke_options *options, int64_t count,
                     const int64_t *particles) {
  if (strcmp(hooke_options_text(options, "motion"), "harmonic") == 0) {
    double phase = hooke_options_is_set(options, "phase") ? hooke_options_number(options, "phase") : 0;
    return hooke_system_drive_harmonic(system, count, particles, hooke_options_numbers(options, "amplitude"),
                                       hooke_options_number(options, "frequency"), phase);
  }
  int64_t samples = hooke_options_number_count(options, "time");
  int64_t rows = hooke_options_number_count(options, "position") / 3;
  if (rows != samples)
    return hk_fail(HOOKE_BAD_VALUE, "position", "%lld rows given; allowed: %lld, one for each time",
                   (long long)rows, (long long)samples);
  return hooke_system_drive_table(system, count, particles, samples, hooke_options_numbers(options, "time"),
                                  hooke_options_numbers(options, "position"));
}

static int32_t add_driven(struct hk_scene_reader *reader, const char *object, int64_t index,
                          hooke_options *options) {
  (void)index;
  int64_t *particles = NULL, count = 0;
  int32_t status = hk_scene_read_options(reader, object, "particles", options);
  if (status == HOOKE_OK) status = check_drive(options);
  if (status) return status;
  const char *list = hk_json_get(object, "particles");
  if (list == NULL)
    return hk_fail(HOOKE_BAD_VALUE, "particles", "is required but missing; allowed: an array of particles");
  status = hk_scene_read_particles(reader, list, 0, &particles, &count);
  if (status) return hk_fail_within(status, "particles");
  status = drive(reader->scene->system, options, count, particles);
  hk_free(particles);
  return status;
}

int32_t hk_scene_add_driven(struct hk_scene_reader *reader, const char *driven) {
  return for_each(reader, driven, "driven", "driven", add_driven);
}
