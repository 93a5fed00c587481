/* Writes a system as a scene: objects made from options as these options, the rest one by one. */
#include "core/memory.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "hooke/scene.h"
#include "io/file/atomic_file.h"
#include "io/file/inputs.h"
#include "io/scene/scene.h"
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
  int64_t alone;   /* particles of no part */
  int64_t *number; /* by particle */
  uint8_t *in_part;
};

static void release(struct numbering *numbering) {
  hk_free(numbering->number);
  hk_free(numbering->in_part);
}

static int32_t find_numbers(const hooke_system *system, struct numbering *numbering) {
  numbering->number = hk_new(system->particle_count, sizeof *numbering->number);
  numbering->in_part = hk_new(system->particle_count, 1);
  if (!numbering->number || !numbering->in_part) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < system->part_count; k++)
    memset(numbering->in_part + system->part[k].first, 1, (size_t)system->part[k].count);
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (!numbering->in_part[p]) numbering->number[p] = numbering->alone++;
  }
  int64_t next = numbering->alone;
  for (int64_t k = 0; k < system->part_count; k++) {
    for (int64_t p = 0; p < system->part[k].count; p++)
      numbering->number[system->part[k].first + p] = next++;
  }
  return HOOKE_OK;
}

/* ---- particles ---- */

static void add_rows(struct hk_text *text, const char *key, const hooke_system *system,
                     const struct numbering *numbering, const double *value) {
  hk_text_open(text, key, '[');
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (!numbering->in_part[p]) hk_scene_add_numbers(text, NULL, 3, 0, value + 3 * p);
  }
  hk_text_close(text, ']');
}

static void add_masses(struct hk_text *text, const hooke_system *system, const struct numbering *numbering) {
  int64_t first = 0;
  int32_t same = 1;
  while (numbering->in_part[first])
    first++;
  for (int64_t p = first; p < system->particle_count; p++)
    same &= numbering->in_part[p] || memcmp(&system->mass[p], &system->mass[first], sizeof(double)) == 0;
  if (system->mass[first] == 0.0) return; /* not given */
  if (same) {
    hk_text_number(text, "mass", system->mass[first]);
    return;
  }
  hk_text_open(text, "mass", '[');
  for (int64_t p = first; p < system->particle_count; p++) {
    if (!numbering->in_part[p]) hk_text_number(text, NULL, system->mass[p]);
  }
  hk_text_close(text, ']');
}

static void add_particles(struct hk_text *text, const hooke_system *system,
                          const struct numbering *numbering) {
  int64_t moving = 0, pinned = 0;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (numbering->in_part[p]) continue;
    for (int a = 0; a < 3 && system->velocity; a++)
      moving += system->velocity[3 * p + a] != 0.0 || signbit(system->velocity[3 * p + a]);
    pinned += system->constrained[p] == HOOKE_IS_PINNED;
  }
  hk_text_open(text, "particles", '{');
  add_rows(text, "position", system, numbering, system->position);
  if (moving) add_rows(text, "velocity", system, numbering, system->velocity);
  add_masses(text, system, numbering);
  if (pinned) hk_text_open(text, "pinned", '[');
  for (int64_t p = 0; p < system->particle_count && pinned; p++) {
    if (!numbering->in_part[p] && system->constrained[p] == HOOKE_IS_PINNED)
      hk_text_number(text, NULL, (double)numbering->number[p]);
  }
  if (pinned) hk_text_close(text, ']');
  hk_text_close(text, '}');
}

/* ---- parts ---- */

/* Pins beyond those of the part's options are added to them, by number. */
static void add_pins(struct hk_text *text, const hooke_system *system, const struct hk_part_record *part) {
  hk_text_open(text, "pinned", '[');
  for (int64_t p = 0; p < part->count; p++) {
    if (system->constrained[part->first + p] == HOOKE_IS_PINNED) hk_text_number(text, NULL, (double)p);
  }
  hk_text_close(text, ']');
}

static void add_parts(struct hk_text *text, const hooke_system *system) {
  hk_text_open(text, "parts", '[');
  for (int64_t k = 0; k < system->part_count; k++) {
    const struct hk_part_record *part = &system->part[k];
    const int32_t as_given = hk_part_record_pinned(system, part) == part->pinned;
    hk_text_open(text, NULL, '{');
    hk_text_word(text, "kind", part->kind);
    hk_text_word(text, "name", part->name);
    hk_scene_add_options(text, part->options, as_given ? NULL : "pinned");
    if (!as_given) add_pins(text, system, part);
    hk_text_close(text, '}');
  }
  hk_text_close(text, ']');
}

/* ---- springs ---- */

enum material { KAPPA, GAMMA, REST_LENGTH };

static double material_of(const struct hk_spring *spring, enum material what) {
  return what == KAPPA ? spring->kappa : what == GAMMA ? spring->gamma : spring->rest_length;
}

/* One number if all springs of the group have the same. */
static void add_material(struct hk_text *text, const char *key, const struct hk_springs *springs,
                         int64_t first, int64_t count, enum material what) {
  double one = NAN;
  for (int32_t pass = 0; pass < 2; pass++) {
    int32_t same = 1;
    if (pass == 1) hk_text_open(text, key, '[');
    for (int64_t r = 0; r < springs->run_count; r++) {
      const struct hk_run *run = &springs->run[r];
      if (run->first < first || run->first >= first + count) continue;
      for (int64_t k = 0; k < run->count; k++) {
        const struct hk_spring spring = hk_run_spring(run, k);
        const double value = material_of(&spring, what);
        if (run->first == first && k == 0) one = value;
        same &= memcmp(&value, &one, sizeof value) == 0;
        if (pass == 1) hk_text_number(text, NULL, value);
      }
    }
    if (pass == 0 && same) {
      hk_text_number(text, key, one);
      return;
    }
  }
  hk_text_close(text, ']');
}

static void add_pairs(struct hk_text *text, const struct hk_springs *springs,
                      const struct numbering *numbering, int64_t first, int64_t count, int32_t *pull_only) {
  hk_text_open(text, "between", '[');
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    if (run->first < first || run->first >= first + count) continue;
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring spring = hk_run_spring(run, k);
      const double pair[2] = {(double)numbering->number[spring.head], (double)numbering->number[spring.tail]};
      hk_scene_add_numbers(text, NULL, 2, 0, pair);
      *pull_only = spring.pull_only;
    }
  }
  hk_text_close(text, ']');
}

static void add_springs(struct hk_text *text, const hooke_system *system, const struct numbering *numbering) {
  const struct hk_springs *springs = system->springs;
  int64_t first = 0;
  for (int64_t g = 0; g < hk_system_groups_of(system, &hk_force_springs); first += system->group[g++].count) {
    const struct hk_group *group = &system->group[g];
    int32_t pull_only = 0;
    if (group->from_part) continue;
    hk_text_open(text, NULL, '{');
    if (group->name[0]) hk_text_word(text, "name", group->name);
    add_pairs(text, springs, numbering, first, group->count, &pull_only);
    if (group->count == 0) { /* all its springs were dropped */
      hk_text_number(text, "stiffness", 0.0);
    } else if (group->options) {
      hk_scene_add_options(text, group->options, NULL);
    } else {
      hk_text_word(text, "law", "length");
      add_material(text, "stiffness", springs, first, group->count, KAPPA);
      add_material(text, "damping", springs, first, group->count, GAMMA);
      add_material(text, "rest_length", springs, first, group->count, REST_LENGTH);
      if (pull_only) hk_text_flag(text, "compression", 0);
    }
    hk_text_close(text, '}');
  }
}

static int32_t has_groups(const hooke_system *system, const struct hk_force_row *force) {
  int32_t groups = 0;
  for (int64_t g = 0; g < hk_system_groups_of(system, force); g++)
    groups |= !hk_system_group(system, force, g)->from_part;
  return groups;
}

/* ---- bending and anchors ---- */

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

static void add_triples(struct hk_text *text, const struct hk_group *group, const struct numbering *numbering,
                        const int64_t *particle, const double *coefficient) {
  hk_text_open(text, NULL, '{');
  if (group->name[0]) hk_text_word(text, "name", group->name);
  hk_text_open(text, "triples", '[');
  for (int64_t k = 0; k < group->count; k++) {
    double triple[3];
    for (int e = 0; e < 3; e++)
      triple[e] = (double)numbering->number[particle[3 * k + e]];
    hk_scene_add_numbers(text, NULL, 3, 0, triple);
  }
  hk_text_close(text, ']');
  if (group->count == 0) /* all its members were dropped */
    hk_text_number(text, "coefficient", 0.0);
  else
    add_shared(text, "coefficient", group->count, coefficient);
  hk_text_close(text, '}');
}

static void add_bending(struct hk_text *text, const hooke_system *system, const struct numbering *numbering) {
  const int64_t count = hooke_system_count(system, "bending");
  int64_t *particle = hk_new(3 * count, sizeof *particle), first = 0;
  double *coefficient = hk_new(count, sizeof *coefficient);
  if (!particle || !coefficient ||
      hooke_system_members(system, "bending", particle, coefficient, NULL, NULL) != HOOKE_OK)
    text->status = HOOKE_NO_MEMORY;
  hk_text_open(text, "bending", '[');
  for (int64_t g = 0; text->status == HOOKE_OK && g < hk_system_groups_of(system, &hk_force_bending); g++) {
    const struct hk_group *group = hk_system_group(system, &hk_force_bending, g);
    if (!group->from_part) add_triples(text, group, numbering, particle + 3 * first, coefficient + first);
    first += group->count;
  }
  hk_text_close(text, ']');
  hk_free(coefficient);
  hk_free(particle);
}

/* All members of a system, and the first of a group among them. */
struct anchors {
  int64_t first, *particle;
  double *point, *stiffness, *damping, *rest_length;
};

static void add_anchor_group(struct hk_text *text, const struct hk_group *group,
                             const struct numbering *numbering, const struct anchors *all) {
  const int64_t first = all->first, count = group->count;
  hk_text_open(text, NULL, '{');
  if (group->name[0]) hk_text_word(text, "name", group->name);
  hk_text_open(text, "particles", '[');
  for (int64_t k = first; k < first + count; k++)
    hk_text_number(text, NULL, (double)numbering->number[all->particle[k]]);
  hk_text_close(text, ']');
  if (count == 0) { /* all its members were dropped */
    hk_text_number(text, "stiffness", 0.0);
  } else {
    hk_scene_add_numbers(text, "points", 3 * count, 3, all->point + 3 * first);
    add_shared(text, "stiffness", count, all->stiffness + first);
    add_shared(text, "damping", count, all->damping + first);
    add_shared(text, "rest_length", count, all->rest_length + first);
  }
  hk_text_close(text, '}');
}

static void add_anchors(struct hk_text *text, const hooke_system *system, const struct numbering *numbering) {
  const int64_t count = hooke_system_count(system, "anchors");
  double *number = hk_new(6 * count, sizeof *number);
  struct anchors all = {0,
                        hk_new(count, sizeof *all.particle),
                        number,
                        number + 3 * count,
                        number + 4 * count,
                        number + 5 * count};
  if (number && all.particle) {
    hooke_system_members(system, "anchors", all.particle, all.stiffness, all.damping, all.rest_length);
    hooke_system_anchor_points(system, all.point);
    hk_text_open(text, "anchors", '[');
    for (int64_t g = 0; g < hk_system_groups_of(system, &hk_force_anchor); g++) {
      const struct hk_group *group = hk_system_group(system, &hk_force_anchor, g);
      add_anchor_group(text, group, numbering, &all);
      all.first += group->count;
    }
    hk_text_close(text, ']');
  } else {
    text->status = HOOKE_NO_MEMORY;
  }
  hk_free(number);
  hk_free(all.particle);
}

/* ---- bodies ---- */

static void add_bodies(struct hk_text *text, const hooke_system *system, const struct numbering *numbering) {
  int32_t open = 0;
  for (int64_t k = 0; k < system->bodies->count; k++) {
    const struct hk_body *body = &system->bodies->body[k];
    if (body->part >= 0) continue; /* its part says so */
    if (!open++) hk_text_open(text, "bodies", '[');
    hk_text_open(text, NULL, '{');
    if (body->name[0]) hk_text_word(text, "name", body->name);
    hk_text_open(text, "particles", '[');
    for (int64_t i = 0; i < body->count; i++)
      hk_text_number(text, NULL, (double)numbering->number[body->particle[i]]);
    hk_text_close(text, ']');
    hk_text_close(text, '}');
  }
  if (open) hk_text_close(text, ']');
}

/* ---- drives ---- */

static void add_drive(struct hk_text *text, const struct hk_drive_group *drive,
                      const struct numbering *numbering) {
  hk_text_open(text, NULL, '{');
  hk_text_open(text, "particles", '[');
  for (int64_t k = 0; k < drive->count; k++)
    hk_text_number(text, NULL, (double)numbering->number[drive->particle[k]]);
  hk_text_close(text, ']');
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

/* Reports features that a scene cannot express. */
static int32_t check_words(const hooke_system *system) {
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    if (group->from_part || group->count == 0 || group->force == &hk_force_springs ||
        group->force == &hk_force_bending || group->force == &hk_force_anchor)
      continue;
    return hk_fail(HOOKE_UNSUITED, NULL,
                   "a scene file has the force \"%s\" in its parts alone, and this system has %s of its own",
                   group->force->name, group->force->members);
  }
  if (hk_system_calls_back(system))
    return hk_fail(HOOKE_UNSUITED, NULL, "a scene file cannot hold callbacks, and this system has one");
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (!row->members && row != &hk_force_drag && row != &hk_force_weight && row != &hk_force_gravity)
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
  if (has_groups(system, &hk_force_springs)) {
    hk_text_open(text, "springs", '[');
    add_springs(text, system, numbering);
    hk_text_close(text, ']');
  }
  if (has_groups(system, &hk_force_bending)) add_bending(text, system, numbering);
  if (system->part_count > 0) add_parts(text, system);
  if (hk_system_groups_of(system, &hk_force_anchor) > 0) add_anchors(text, system, numbering);
  add_bodies(text, system, numbering);
  if (system->drive_count > 0) hk_text_open(text, "driven", '[');
  for (int64_t k = 0; k < system->drive_count; k++)
    add_drive(text, &system->drive[k], numbering);
  if (system->drive_count > 0) hk_text_close(text, ']');
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
  release(&numbering);
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
  char *title = NULL;
  int32_t names = 0;
  *whole = NULL;
  int32_t status = text ? hk_scene_names_files(text, &names, &title) : HOOKE_OK;
  if (status == HOOKE_OK && names) {
    status = compose(system, title, run, &laid);
    hk_text_add(&laid, "", 1);
    if (status == HOOKE_OK) status = laid.status;
  }
  hk_free(title);
  if (status == HOOKE_OK) {
    *whole = laid.bytes;
    return HOOKE_OK;
  }
  hk_text_release(&laid);
  return status == HOOKE_UNSUITED ? HOOKE_OK : status;
}
