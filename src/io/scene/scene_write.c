/* Writes a system as a scene: objects made from options as these options, the rest one by one. */
#include "core/memory.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "hooke/scene.h"
#include "io/file/atomic_file.h"
#include "io/file/inputs.h"
#include "io/scene/json.h"
#include "io/scene/scene.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_words.h"
#include "io/file/text.h"
#include "model/callbacks.h"
#include "model/force/drive.h"
#include "model/part_record.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

/* A scene numbers the particles of parts after the others. */
struct numbering {
  int64_t alone;   /* particles of no part, whose numbers are below this */
  int64_t *number; /* by particle */
};

static int32_t find_numbers(const hooke_system *system, struct numbering *numbering) {
  int64_t *number = numbering->number = hk_new(system->particle_count, sizeof *number);
  if (number == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < system->part_count; k++)
    memset(number + system->part[k].first, 0xFF, (size_t)system->part[k].count * sizeof *number); /* -1 */
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (number[p] == 0) number[p] = numbering->alone++;
  }
  int64_t next = numbering->alone;
  for (int64_t k = 0; k < system->part_count; k++) {
    for (int64_t p = 0; p < system->part[k].count; p++)
      number[system->part[k].first + p] = next++;
  }
  return HOOKE_OK;
}

/* One number if all are equal to the bit. */
static void add_shared(struct hk_text *text, const char *key, int64_t count, const double *value) {
  int64_t same = 1;
  while (same < count && memcmp(&value[same], &value[0], sizeof *value) == 0)
    same++;
  if (same == count)
    hk_text_number(text, key, value[0]);
  else
    hk_scene_add_numbers(text, key, count, 0, value);
}

/* ---- particles ---- */

/* The rows of particles of no part, each of `columns` numbers. */
static void take_alone(const hooke_system *system, const struct numbering *numbering, int32_t columns,
                       const double *value, double *rows) {
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (numbering->number[p] >= numbering->alone) continue;
    memcpy(rows, value + columns * p, (size_t)columns * sizeof *rows);
    rows += columns;
  }
}

static int32_t is_moving(int64_t count, const double *velocity) {
  for (int64_t k = 0; k < count; k++)
    if (velocity[k] != 0.0 || signbit(velocity[k])) return 1;
  return 0;
}

/* The pinned ones of `count` particles from `first` on that have one of `numbers` numbers from `from` on. */
static void add_pinned(struct hk_text *text, const hooke_system *system, const struct numbering *numbering,
                       int64_t first, int64_t count, int64_t from, int64_t numbers) {
  int32_t open = 0;
  for (int64_t p = first; p < first + count; p++) {
    const int64_t number = numbering->number[p] - from;
    if (number < 0 || number >= numbers || system->constrained[p] != HOOKE_IS_PINNED) continue;
    if (!open++) hk_text_open(text, "pinned", '[');
    hk_text_number(text, NULL, (double)number);
  }
  if (open) hk_text_close(text, ']');
}

static void add_particles(struct hk_text *text, const hooke_system *system,
                          const struct numbering *numbering) {
  const int64_t count = numbering->alone;
  double *rows = hk_new(3 * count, sizeof *rows);
  if (rows == NULL) {
    text->status = HOOKE_NO_MEMORY;
    return;
  }
  hk_text_open(text, "particles", '{');
  take_alone(system, numbering, 3, system->position, rows);
  hk_scene_add_numbers(text, "position", 3 * count, 3, rows);
  if (system->velocity) take_alone(system, numbering, 3, system->velocity, rows);
  if (system->velocity && is_moving(3 * count, rows))
    hk_scene_add_numbers(text, "velocity", 3 * count, 3, rows);
  take_alone(system, numbering, 1, system->mass, rows);
  if (rows[0] != 0.0) add_shared(text, "mass", count, rows); /* 0: not given */
  add_pinned(text, system, numbering, 0, system->particle_count, 0, count);
  hk_text_close(text, '}');
  hk_free(rows);
}

/* ---- parts ---- */

/* Pins beyond those of a part's options are added to them, by number. */
static void add_parts(struct hk_text *text, const hooke_system *system, const struct numbering *numbering) {
  hk_text_open(text, "parts", '[');
  for (int64_t k = 0; k < system->part_count; k++) {
    const struct hk_part_record *part = &system->part[k];
    const int32_t as_given = hk_part_record_pinned(system, part) == part->pinned;
    hk_text_open(text, NULL, '{');
    hk_text_word(text, "kind", part->kind);
    hk_text_word(text, "name", part->name);
    hk_scene_add_options(text, part->options, as_given ? NULL : "pinned");
    if (!as_given)
      add_pinned(text, system, numbering, part->first, part->count, numbering->number[part->first],
                 part->count);
    hk_text_close(text, '}');
  }
  hk_text_close(text, ']');
}

/* ---- lists ---- */

/* Particles by their numbers in the scene; those of a member are a row. */
static void add_numbered(struct hk_text *text, const struct hk_scene_list *list, int64_t count,
                         const int64_t *wide, const int32_t *narrow, const struct numbering *numbering) {
  const int64_t columns = list->columns;
  hk_text_open(text, list->particles, '[');
  for (int64_t k = 0; k < count; k++) {
    if (columns && k % columns == 0) hk_text_open(text, NULL, '[');
    hk_text_number(text, NULL, (double)numbering->number[wide ? wide[k] : narrow[k]]);
    if (columns && k % columns == columns - 1) hk_text_close(text, ']');
  }
  hk_text_close(text, ']');
}

/* All members of a force; `first` is the first one of a group. */
struct members {
  int64_t first, count, *particle;
  double *value[3], *point; /* points of anchors */
};

static int32_t find_members(const hooke_system *system, const struct hk_scene_list *list,
                            struct members *all) {
  const int64_t count = all->count = hooke_system_count(system, list->key);
  all->particle = hk_new((list->columns > 0 ? list->columns : 1) * count, sizeof *all->particle);
  double *numbers = all->point = hk_new(6 * count, sizeof *numbers);
  if (!all->particle || !numbers) return HOOKE_NO_MEMORY;
  for (int k = 0; k < 3; k++)
    all->value[k] = numbers + (3 + k) * count;
  if (hk_force_find(list->key) == &hk_force_anchor) hooke_system_anchor_points(system, all->point);
  return hooke_system_members(system, list->key, all->particle, all->value[0], all->value[1], all->value[2]);
}

static void add_group(struct hk_text *text, const struct hk_scene_list *list, const struct hk_group *group,
                      const struct numbering *numbering, const struct members *all) {
  const int64_t first = all->first, width = list->columns > 0 ? list->columns : 1;
  hk_text_open(text, NULL, '{');
  if (group->name[0]) hk_text_word(text, "name", group->name);
  add_numbered(text, list, group->count * width, all->particle + first * width, NULL, numbering);
  if (group->count == 0) { /* all its members were dropped */
    hk_text_number(text, list->values[0], 0.0);
  } else if (group->options) {
    hk_scene_add_options(text, group->options, NULL);
  } else {
    if (group->force == &hk_force_springs) hk_text_word(text, "law", "length");
    if (group->force == &hk_force_anchor)
      hk_scene_add_numbers(text, "points", 3 * group->count, 3, all->point + 3 * first);
    for (int k = 0; k < 3 && list->values[k]; k++)
      add_shared(text, list->values[k], group->count, all->value[k] + first);
    if (group->pull_only) hk_text_flag(text, "compression", 0);
  }
  hk_text_close(text, '}');
}

static int32_t has_groups(const hooke_system *system, const struct hk_force_row *force) {
  int32_t groups = 0;
  for (int64_t g = 0; g < hk_system_groups_of(system, force); g++)
    groups |= !hk_system_group(system, force, g)->from_part;
  return groups;
}

static void add_groups(struct hk_text *text, const hooke_system *system, const struct hk_scene_list *list,
                       const struct numbering *numbering) {
  const struct hk_force_row *force = hk_force_find(list->key);
  struct members all = {0};
  if (!has_groups(system, force)) return;
  const int32_t status = find_members(system, list, &all);
  if (status != HOOKE_OK) text->status = status;
  hk_text_open(text, list->key, '[');
  for (int64_t g = 0; status == HOOKE_OK && g < hk_system_groups_of(system, force); g++) {
    const struct hk_group *group = hk_system_group(system, force, g);
    if (!group->from_part) add_group(text, list, group, numbering, &all);
    all.first += group->count;
  }
  hk_text_close(text, ']');
  hk_free(all.particle);
  hk_free(all.point);
}

static void add_bodies(struct hk_text *text, const hooke_system *system, const struct hk_scene_list *list,
                       const struct numbering *numbering) {
  int32_t open = 0;
  for (int64_t k = 0; k < system->bodies->count; k++) {
    const struct hk_body *body = &system->bodies->body[k];
    if (body->part >= 0) continue; /* its part says so */
    if (!open++) hk_text_open(text, list->key, '[');
    hk_text_open(text, NULL, '{');
    if (body->name[0]) hk_text_word(text, "name", body->name);
    add_numbered(text, list, body->count, NULL, body->particle, numbering);
    hk_text_close(text, '}');
  }
  if (open) hk_text_close(text, ']');
}

static void add_drives(struct hk_text *text, const hooke_system *system, const struct hk_scene_list *list,
                       const struct numbering *numbering) {
  if (system->drive_count == 0) return;
  hk_text_open(text, list->key, '[');
  for (int64_t k = 0; k < system->drive_count; k++) {
    const struct hk_drive_group *drive = &system->drive[k];
    hk_text_open(text, NULL, '{');
    add_numbered(text, list, drive->count, NULL, drive->particle, numbering);
    hk_text_word(text, "motion", drive->kind == HOOKE_DRIVE_TABLE ? "table" : "harmonic");
    if (drive->kind == HOOKE_DRIVE_TABLE) {
      hk_scene_add_numbers(text, "time", drive->samples, 0, drive->time);
      hk_scene_add_numbers(text, "position", 3 * drive->samples, 3, drive->displacement);
    } else {
      hk_scene_add_numbers(text, "amplitude", 3, 0, drive->amplitude);
      hk_text_number(text, "frequency", drive->frequency);
      hk_text_number(text, "phase", drive->phase);
    }
    hk_text_close(text, '}');
  }
  hk_text_close(text, ']');
}

static void add_lists(struct hk_text *text, const hooke_system *system, const struct numbering *numbering) {
  for (const struct hk_scene_list *list = hk_scene_lists; list->key; list++) {
    if (list->values[0])
      add_groups(text, system, list, numbering);
    else if (strcmp(list->key, "bodies") == 0)
      add_bodies(text, system, list, numbering);
    else
      add_drives(text, system, list, numbering);
  }
}

/* Reports features that a scene cannot express. */
static int32_t check_words(const hooke_system *system) {
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    if (group->from_part || group->count == 0 || group->force->in_scenes) continue;
    return hk_fail(HOOKE_UNSUITED, NULL,
                   "a scene file has the force \"%s\" in its parts alone, and this system has %s of its own",
                   group->force->name, group->force->members);
  }
  if (hk_system_calls_back(system))
    return hk_fail(HOOKE_UNSUITED, NULL, "a scene file cannot hold callbacks, and this system has one");
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (!row->members && !row->in_scenes)
      return hk_fail(HOOKE_UNSUITED, NULL, "a scene file cannot hold the force \"%s\"", row->name);
  }
  return HOOKE_OK;
}

/* ---- the scene ---- */

static void add_scene(struct hk_text *text, const hooke_system *system, const char *title,
                      const hooke_options *run, const struct numbering *numbering) {
  hk_text_open(text, NULL, '{');
  hk_text_number(text, "hooke", 1.0);
  if (title && title[0]) hk_text_word(text, "title", title);
  if (system->overdamped) hk_text_word(text, "dynamics", hooke_system_dynamics(system));
  if (system->has_gravity) hk_scene_add_numbers(text, "gravity", 3, 0, system->gravity);
  if (system->drag != 0.0) hk_text_number(text, "drag", system->drag);
  if (numbering->alone > 0) add_particles(text, system, numbering);
  if (system->part_count > 0) add_parts(text, system, numbering);
  add_lists(text, system, numbering);
  if (run) {
    hk_text_open(text, "run", '{');
    hk_scene_add_options(text, run, NULL);
    hk_text_close(text, '}');
  }
  hk_text_close(text, '}');
}

static int32_t compose(const hooke_system *system, const char *title, const hooke_options *run,
                       struct hk_text *laid) {
  struct hk_text json = {.bytes = NULL};
  struct numbering numbering = {0};
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK && run) status = hk_run_options_require(run, "run");
  if (status == HOOKE_OK) status = check_words(system);
  if (status == HOOKE_OK) status = find_numbers(system, &numbering);
  if (status == HOOKE_OK) {
    add_scene(&json, system, title, run, &numbering);
    hk_text_lay_out(&json, laid);
    status = laid->status;
  }
  hk_free(numbering.number);
  hk_text_release(&json);
  return status;
}

int32_t hooke_scene_write(const char *path, const hooke_system *system, const char *title,
                          const hooke_options *run) {
  struct hk_text laid = {.bytes = NULL};
  int32_t status = hk_inputs_refuse_save(system, path);
  if (status == HOOKE_OK) status = compose(system, title, run, &laid);
  if (status == HOOKE_OK) status = hk_file_write(path, laid.bytes, laid.length);
  hk_text_release(&laid);
  return status;
}

int32_t hooke_scene_of_system(const hooke_system *system, const char *title, const hooke_options *run,
                              const char *name, const char *folder, hooke_scene **scene) {
  struct hk_text laid = {.bytes = NULL};
  *scene = NULL;
  int32_t status = compose(system, title, run, &laid);
  if (status == HOOKE_OK) status = hooke_scene_parse(laid.bytes, laid.length, name, folder, NULL, scene);
  hk_text_release(&laid);
  return status;
}

int32_t hk_scene_make_whole(const char *text, const hooke_system *system, const hooke_options *run,
                            char **whole) {
  struct hk_text laid = {.bytes = NULL};
  char *json = NULL;
  const char *at;
  *whole = NULL;
  if (text == NULL || system->rest->input_count == system->rest->has_scene) return HOOKE_OK;
  int32_t status = hk_json_open(text, (int64_t)strlen(text), &json, &at);
  if (status != HOOKE_OK) return status == HOOKE_BAD_VALUE ? HOOKE_OK : status; /* what is no scene is kept */
  status = compose(system, hk_json_text(hk_json_get(hk_json_find(json, "", 0), "title")), run, &laid);
  hk_free(json);
  hk_text_add(&laid, "", 1);
  if (status == HOOKE_OK) status = laid.status;
  if (status == HOOKE_OK)
    *whole = laid.bytes;
  else
    hk_text_release(&laid);
  return status == HOOKE_UNSUITED ? HOOKE_OK : status;
}
