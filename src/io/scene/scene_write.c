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
#include "core/table/option.h"
#include "io/file/text.h"
#include "model/callbacks.h"
#include "model/force/drive.h"
#include "model/force/scaling.h"
#include "model/part_record.h"
#include "model/state.h"
#include "model/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- values ---- */

/* An array of numbers, in rows of `columns` (0: flat). */
static void add_numbers(struct hk_text *text, const char *key, int64_t count, int32_t columns,
                        const double *value) {
  if (columns == 0) {
    hk_text_numbers(text, key, count, value);
    return;
  }
  hk_text_open(text, key, '[');
  for (int64_t first = 0; first < count; first += columns)
    hk_text_numbers(text, NULL, columns, value + first);
  hk_text_close(text, ']');
}

/* Words mixed with numbers, one or an array of them. */
static void add_list(struct hk_text *text, const struct hk_option_row *row, const char *words, int64_t count,
                     const double *number) {
  const int32_t single = strchr(words, ' ') == NULL;
  if (count == 0 && single) {
    hk_text_word(text, row->name, words);
    return;
  }
  hk_text_open(text, row->name, '[');
  int64_t length;
  for (const char *at; (at = hk_option_next_word(&words, &length));) {
    char word[32];
    snprintf(word, sizeof word, "%.*s", (int)length, at);
    hk_text_word(text, NULL, word);
  }
  for (int64_t k = 0; k < count; k++)
    hk_text_number(text, NULL, number[k]);
  hk_text_close(text, ']');
}

static void add_value(struct hk_text *text, const hooke_options *options, const char *name,
                      const struct hk_option_row *row) {
  const int64_t count = hooke_options_number_count(options, name);
  const double *number = hooke_options_numbers(options, name);
  const char *words = hooke_options_text(options, name);
  if (row->type == HOOKE_OPTION_FLAG) {
    hk_text_flag(text, row->name, number[0] != 0.0);
  } else if (row->type == HOOKE_OPTION_NUMBER) {
    hk_text_number(text, row->name, number[0]);
  } else if (row->type != HOOKE_OPTION_NUMBERS) {
    hk_text_word(text, row->name, words);
  } else if (words[0]) {
    add_list(text, row, words, count, number);
  } else if (count == 1 && row->min_count == 1 && row->max_count != 1) {
    hk_text_number(text, row->name, number[0]);
  } else {
    add_numbers(text, row->name, count, row->flat && count == row->columns ? 0 : row->columns, number);
  }
}

static void add_table(struct hk_text *text, const hooke_options *options, const struct hk_option_table *table,
                      const char *prefix, const char *left_out) {
  for (int32_t k = 0; k < table->row_count; k++) {
    const struct hk_option_row *row = &table->rows[k];
    char name[128];
    snprintf(name, sizeof name, "%s%s", prefix, row->name);
    if (!hooke_options_is_set(options, name) || hk_option_has_word(left_out, name, (int64_t)strlen(name)))
      continue;
    if (!hk_options_has_family(options, name)) {
      add_value(text, options, name, row);
      continue;
    }
    hk_text_open(text, row->name, '{');
    snprintf(name, sizeof name, "%s%s.", prefix, row->name);
    add_table(text, options, row->family, name, left_out);
    hk_text_close(text, '}');
  }
}

/* Every option that is set, under its key, except those of `left_out`, words (may be NULL). */
static void add_options(struct hk_text *text, const hooke_options *options, const char *left_out) {
  add_table(text, options, hk_options_table(options), "", left_out);
}

/* ---- numbers of particles ---- */

struct writer {
  const hooke_system *system;
  const double *start[2]; /* position and velocity of a start elsewhere; NULL: as given */
  struct hk_text json;
  int32_t open;    /* members of the list so far */
  int64_t alone;   /* particles of no part, whose numbers in the scene are below this */
  int64_t *number; /* by particle: a scene numbers those of parts after the others */
};

static int32_t find_numbers(struct writer *to) {
  const hooke_system *system = to->system;
  int64_t *number = to->number = hk_new(system->particle_count, sizeof *number);
  if (number == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < system->part_count; k++)
    memset(number + system->part[k].first, 0xFF, (size_t)system->part[k].count * sizeof *number); /* -1 */
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (number[p] == 0) number[p] = to->alone++;
  }
  int64_t next = to->alone;
  for (int64_t k = 0; k < system->part_count; k++) {
    for (int64_t p = 0; p < system->part[k].count; p++)
      number[system->part[k].first + p] = next++;
  }
  return HOOKE_OK;
}

/* One number if all are equal to the bit, and 0 for none. */
static void add_shared(struct hk_text *text, const char *key, int64_t count, const double *value) {
  int64_t same = 1;
  while (same < count && memcmp(&value[same], &value[0], sizeof *value) == 0)
    same++;
  if (count <= same)
    hk_text_number(text, key, count > 0 ? value[0] : 0.0);
  else
    add_numbers(text, key, count, 0, value);
}

static void add_factors(struct hk_text *text, int64_t count, const double *factor) {
  int64_t ones = 0;
  while (ones < count && factor[ones] == 1.0)
    ones++;
  if (ones < count) add_shared(text, "gravity_factor", count, factor);
}

/* ---- particles ---- */

/* The rows of particles of no part, each of `columns` numbers. */
static void take_alone(const struct writer *to, int32_t columns, const double *value, double *rows) {
  for (int64_t p = 0; p < to->system->particle_count; p++) {
    if (to->number[p] >= to->alone) continue;
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
static void add_pinned(struct writer *to, int64_t first, int64_t count, int64_t from, int64_t numbers) {
  int32_t open = 0;
  for (int64_t p = first; p < first + count; p++) {
    const int64_t number = to->number[p] - from;
    if (number < 0 || number >= numbers || to->system->constrained[p] != HOOKE_IS_PINNED) continue;
    if (!open++) hk_text_open(&to->json, "pinned", '[');
    hk_text_number(&to->json, NULL, (double)number);
  }
  if (open) hk_text_close(&to->json, ']');
}

static void add_particles(struct writer *to) {
  const hooke_system *system = to->system;
  const int64_t count = to->alone;
  struct hk_text *text = &to->json;
  double *rows = hk_new(3 * count, sizeof *rows);
  if (rows == NULL) {
    text->status = HOOKE_NO_MEMORY;
    return;
  }
  hk_text_open(text, "particles", '{');
  take_alone(to, 3, hk_undeformed_position(system), rows);
  add_numbers(text, "position", 3 * count, 3, rows);
  const int32_t starts = to->start[0] != NULL; /* which has the velocities */
  if (system->velocity) take_alone(to, 3, system->velocity, rows);
  if (!starts && system->velocity && is_moving(3 * count, rows))
    add_numbers(text, "velocity", 3 * count, 3, rows);
  take_alone(to, 1, system->mass, rows);
  if (rows[0] != 0.0) add_shared(text, "mass", count, rows); /* 0: not given */
  if (system->gravity_factor) take_alone(to, 1, system->gravity_factor, rows);
  if (system->gravity_factor) add_factors(text, count, rows);
  add_pinned(to, 0, system->particle_count, 0, count);
  hk_text_close(text, '}');
  hk_free(rows);
}

/* ---- parts ---- */

/* Pins beyond those of a part's options are added to them, by number. */
static void add_parts(struct writer *to) {
  struct hk_text *text = &to->json;
  hk_text_open(text, "parts", '[');
  for (int64_t k = 0; k < to->system->part_count; k++) {
    const struct hk_part_record *part = &to->system->part[k];
    const int32_t as_given = hk_part_record_pinned(to->system, part) == part->pinned;
    hk_text_open(text, NULL, '{');
    hk_text_word(text, "kind", part->kind);
    hk_text_word(text, "name", part->name);
    add_options(text, part->options, as_given ? "gravity_factor" : "pinned gravity_factor");
    if (to->system->gravity_factor) add_factors(text, part->count, to->system->gravity_factor + part->first);
    if (!as_given) add_pinned(to, part->first, part->count, to->number[part->first], part->count);
    hk_text_close(text, '}');
  }
  hk_text_close(text, ']');
}

static void add_names(struct writer *to) {
  const struct hk_system_rest *rest = to->system->rest;
  hk_text_open(&to->json, "names", '{');
  for (int64_t k = 0; k < rest->name_count; k++)
    hk_text_number(&to->json, rest->name[k].text, (double)to->number[rest->name[k].particle]);
  hk_text_close(&to->json, '}');
}

/* ---- lists ---- */

/* Opens a member, and the list before the first one, with its name and its particles by their numbers in the
 * scene. */
static void open_member(struct writer *to, const struct hk_scene_list *list, const char *name, int64_t count,
                        int32_t *const *particle) {
  struct hk_text *text = &to->json;
  if (!to->open++) hk_text_open(text, list->key, '[');
  hk_text_open(text, NULL, '{');
  if (name && name[0]) hk_text_word(text, "name", name);
  if (count < 0) return;
  hk_text_open(text, list->particles, '[');
  for (int64_t k = 0; k < count; k++) {
    if (list->columns > 1) hk_text_open(text, NULL, '[');
    for (int32_t e = 0; e < list->columns; e++)
      hk_text_number(text, NULL, (double)to->number[particle[e][k]]);
    if (list->columns > 1) hk_text_close(text, ']');
  }
  hk_text_close(text, ']');
}

static void add_curve(struct hk_text *text, const struct hk_curve *curve) {
  hk_text_open(text, "curve", '{');
  if (curve->samples > 0)
    add_numbers(text, curve->strain ? "strain" : "elongation", curve->samples, 0, curve->at);
  add_numbers(text, curve->samples > 0 ? "force" : "coefficients", curve->samples > 0 ? curve->samples : 3, 0,
              curve->force);
  if (curve->falls) hk_text_flag(text, "falling", 1);
  hk_text_close(text, '}');
}

static void add_course(struct hk_text *text, const struct hk_course *course, const char *amplitude,
                       const char *values) {
  const int32_t columns = course->width > 1 ? course->width : 0;
  hk_text_word(text, "motion", course->samples > 0 ? "table" : "harmonic");
  if (course->samples > 0) {
    add_numbers(text, "time", course->samples, 0, course->time);
    add_numbers(text, values, course->width * course->samples, columns, course->value);
  } else {
    if (course->width == 1) {
      hk_text_number(text, "mean", course->mean[0]);
      hk_text_number(text, amplitude, course->amplitude[0]);
    } else {
      add_numbers(text, amplitude, course->width, 0, course->amplitude);
    }
    hk_text_number(text, "frequency", course->frequency);
    hk_text_number(text, "phase", course->phase);
  }
}

/* The stiffness that over l0 is kappa, to the bit: within a unit in the last place of their product. */
static double stiffness_of(double kappa, double l0) {
  const double whole = kappa * l0, less = nextafter(whole, 0.0);
  return whole / l0 == kappa ? whole : less / l0 == kappa ? less : nextafter(whole, (double)INFINITY);
}

/* Springs that follow time, which does not leave the law open. */
static void add_scaling(struct hk_text *text, const struct hk_group *group) {
  const struct hk_course *const course[] = {&group->scaling->rest, &group->scaling->stiffness};
  for (int k = 0; k < 2; k++) {
    hk_text_open(text, k == 0 ? "rest_scale" : "stiffness_scale", '{');
    add_course(text, course[k], "amplitude", "value");
    hk_text_close(text, '}');
  }
}

/* Numbers of the strain law, of which a quotient has the bits again. */
static void multiply_by_lengths(struct hk_group *all) {
  for (int k = HOOKE_KAPPA; k <= HOOKE_GAMMA; k++)
    for (int64_t i = 0; i < all->count; i++)
      all->number[k][i] = stiffness_of(all->number[k][i], all->number[HOOKE_REST_LENGTH][i]);
}

/* The numbers of members, whatever law they were given by; a curve has its own. */
static void add_columns(struct hk_text *text, const struct hk_scene_list *list, int32_t strain,
                        const struct hk_group *group) {
  const int32_t *width = group->force->width;
  if (group->force->kind & HOOKE_LOOPED) hk_text_word(text, "law", strain ? "strain" : "length");
  if (group->curve)
    add_curve(text, group->curve);
  else
    add_shared(text, list->strength, group->count, group->number[HOOKE_KAPPA]);
  for (int k = HOOKE_KAPPA + 1; k < HOOKE_GROUP_NUMBERS && group->count > 0; k++) {
    if (width[k] == 1) add_shared(text, hk_group_names[k], group->count, group->number[k]);
    if (width[k] > 1)
      add_numbers(text, hk_group_names[k], width[k] * group->count, width[k], group->number[k]);
  }
  if (group->pull_only) hk_text_flag(text, "compression", 0);
}

/* Members from number `first` on of their force. */
static void add_group(struct writer *to, const struct hk_scene_list *list, const struct hk_group *group,
                      int64_t first) {
  struct hk_group all = {.force = group->force, .count = group->count, .pull_only = group->pull_only};
  if (hk_group_allocate(&all, NULL) == HOOKE_OK) {
    all.curve = group->curve;
    if (all.count > 0) all.force->recall(to->system, first, &all);
    open_member(to, list, group->name, all.count, all.particle);
    if (group->options) {
      add_options(&to->json, group->options, NULL);
    } else {
      const int32_t strain =
          (group->scaling && group->scaling->strain) || (group->curve && group->curve->strain);
      if (group->scaling) add_scaling(&to->json, group);
      if (strain) multiply_by_lengths(&all);
      add_columns(&to->json, list, strain, &all);
    }
    hk_text_close(&to->json, '}');
  } else {
    to->json.status = HOOKE_NO_MEMORY;
  }
  all.curve = NULL; /* it is the group's */
  hk_group_release(&all);
}

static void add_groups(struct writer *to, const struct hk_scene_list *list) {
  const struct hk_force_row *force = hk_force_find(list->key);
  const struct hk_group *group;
  int64_t first = 0;
  for (int64_t g = 0; (group = hk_system_group(to->system, force, g)) != NULL; g++) {
    if (!group->from_part) add_group(to, list, group, first);
    first += group->count;
  }
}

static void add_bodies(struct writer *to, const struct hk_scene_list *list) {
  for (int64_t k = 0; k < to->system->bodies->count; k++) {
    const struct hk_body *body = &to->system->bodies->body[k];
    if (body->part >= 0) continue; /* its part says so */
    open_member(to, list, body->name, body->count, &body->particle);
    hk_text_close(&to->json, '}');
  }
}

static void add_drives(struct writer *to, const struct hk_scene_list *list) {
  struct hk_text *text = &to->json;
  for (int64_t k = 0; k < to->system->drive_count; k++) {
    const struct hk_drive_group *drive = &to->system->drive[k];
    open_member(to, list, NULL, drive->count, &drive->particle);
    add_course(text, &drive->course, "amplitude", "position");
    hk_text_close(text, '}');
  }
}

static void add_obstacles(struct writer *to, const struct hk_scene_list *list) {
  for (int64_t k = 0; k < to->system->rest->obstacles.count; k++) {
    const struct hk_obstacle *obstacle = &to->system->rest->obstacles.obstacle[k];
    open_member(to, list, NULL, obstacle->count, &obstacle->particle);
    add_options(&to->json, obstacle->options, NULL);
    hk_text_close(&to->json, '}');
  }
}

static void add_lists(struct writer *to) {
  for (const struct hk_scene_list *list = hk_scene_lists; list->key; list++) {
    to->open = 0;
    if (list->strength)
      add_groups(to, list);
    else if (strcmp(list->key, "bodies") == 0)
      add_bodies(to, list);
    else if (strcmp(list->key, "driven") == 0)
      add_drives(to, list);
    else if (strcmp(list->key, "obstacles") == 0)
      add_obstacles(to, list);
    if (to->open) hk_text_close(&to->json, ']');
  }
}

/* Rows of all particles, of 1 or 3 numbers, by their numbers in the scene. */
static void add_rows(struct writer *to, const char *key, int32_t columns, const double *value) {
  const int64_t n = to->system->particle_count;
  double *rows = hk_new(columns * n, sizeof *rows);
  if (rows == NULL) to->json.status = HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < n && rows; p++)
    memcpy(rows + columns * to->number[p], value + columns * p, (size_t)columns * sizeof *rows);
  if (rows) add_numbers(&to->json, key, columns * n, columns > 1 ? columns : 0, rows);
  hk_free(rows);
}

/* One number, or one of each particle. */
static void add_each(struct writer *to, const char *key, const struct hk_each *each) {
  if (each->value)
    add_rows(to, key, 1, each->value);
  else if (each->most != 0.0)
    hk_text_number(&to->json, key, each->most);
}

static void add_start(struct writer *to) {
  if (to->start[0] == NULL) return;
  hk_text_open(&to->json, "start", '{');
  add_rows(to, "position", 3, to->start[0]);
  if (to->start[1] && is_moving(3 * to->system->particle_count, to->start[1]))
    add_rows(to, "velocity", 3, to->start[1]);
  hk_text_close(&to->json, '}');
}

static void add_medium(struct writer *to) {
  const struct hk_medium *medium = to->system->medium;
  add_each(to, "drag", &medium->drag);
  add_each(to, "quadratic_drag", &medium->quadratic_drag);
  if (!medium->blows) return;
  if (medium->wind.samples == 0) {
    add_numbers(&to->json, "wind", 3, 0, medium->wind.mean);
    return;
  }
  hk_text_open(&to->json, "wind", '{');
  add_numbers(&to->json, "time", medium->wind.samples, 0, medium->wind.time);
  add_numbers(&to->json, "velocity", 3 * medium->wind.samples, 3, medium->wind.value);
  hk_text_close(&to->json, '}');
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

static void add_scene(struct writer *to, const char *title, const hooke_options *run) {
  const hooke_system *system = to->system;
  struct hk_text *text = &to->json;
  hk_text_open(text, NULL, '{');
  hk_text_number(text, "hooke", 1.0);
  if (title && title[0]) hk_text_word(text, "title", title);
  if (system->overdamped) hk_text_word(text, "dynamics", hooke_system_dynamics(system));
  if (system->has_gravity) add_numbers(text, "gravity", 3, 0, system->gravity);
  add_medium(to);
  if (to->alone > 0) add_particles(to);
  if (system->part_count > 0) add_parts(to);
  if (system->rest->name_count > 0) add_names(to);
  add_lists(to);
  add_start(to);
  if (run) {
    hk_text_open(text, "run", '{');
    add_options(text, run, NULL);
    hk_text_close(text, '}');
  }
  hk_text_close(text, '}');
}

/* `state`: where it starts; NULL: as the system does. */
static int32_t compose(const hooke_system *system, const hooke_state *state, const char *title,
                       const hooke_options *run, struct hk_text *laid) {
  struct writer to = {.system = system};
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK && state) status = hk_state_check_system(state, system);
  if (state) {
    to.start[0] = state->q, to.start[1] = state->v;
  } else if (system->rest->start.undeformed) {
    to.start[0] = system->position, to.start[1] = system->velocity;
  }
  if (status == HOOKE_OK && run) status = hk_run_options_require(run, "run");
  if (status == HOOKE_OK) status = check_words(system);
  if (status == HOOKE_OK) status = find_numbers(&to);
  if (status == HOOKE_OK) {
    add_scene(&to, title, run);
    hk_text_lay_out(&to.json, laid);
    status = laid->status;
  }
  hk_free(to.number);
  hk_text_release(&to.json);
  return status;
}

int32_t hooke_scene_write(const char *path, const hooke_system *system, const char *title,
                          const hooke_options *run) {
  struct hk_text laid = {.bytes = NULL};
  int32_t status = hk_inputs_refuse_save(system, path);
  if (status == HOOKE_OK) status = compose(system, NULL, title, run, &laid);
  if (status == HOOKE_OK) status = hk_file_write(path, laid.bytes, laid.length);
  hk_text_release(&laid);
  return status;
}

int32_t hooke_scene_of_system(const hooke_system *system, const char *title, const hooke_options *run,
                              const char *name, const char *folder, hooke_scene **scene) {
  return hooke_scene_of_state(system, NULL, title, run, name, folder, scene);
}

int32_t hooke_scene_of_state(const hooke_system *system, const hooke_state *state, const char *title,
                             const hooke_options *run, const char *name, const char *folder,
                             hooke_scene **scene) {
  struct hk_text laid = {.bytes = NULL};
  *scene = NULL;
  int32_t status = compose(system, state, title, run, &laid);
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
  status = compose(system, NULL, hk_json_text(hk_json_get(hk_json_find(json, "", 0), "title")), run, &laid);
  hk_free(json);
  hk_text_add(&laid, "", 1);
  if (status == HOOKE_OK) status = laid.status;
  if (status == HOOKE_OK)
    *whole = laid.bytes;
  else
    hk_text_release(&laid);
  return status == HOOKE_UNSUITED ? HOOKE_OK : status;
}
