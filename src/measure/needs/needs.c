/* Needs: the object, the full system, and the table. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "measure/recommend/pick.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct hk_option_row needs_rows[] = {
    HOOKE_OPTION(
        "want", HOOKE_OPTION_WANT, NULL,
        "error that one can live with, the largest distance of any watched particle" HOOKE_WANT_FORMS,
        .required = 1),
    HOOKE_OPTION(
        "watch", .type = HOOKE_OPTION_TEXT, NULL,
        "what is looked at: a part, a group, or particle "
        "numbers or names such as 0,7-9,tip, or coordinates and lengths such as tip.y,group:max.length; "
        "all free particles if not given"),
    HOOKE_OPTION("keep", .type = HOOKE_OPTION_TEXT, NULL,
                 "names of groups and parts, separated by commas, that are neither left out nor changed"),
    HOOKE_OPTION("refine", .type = HOOKE_OPTION_FLAG, "false",
                 "the reverse question: each part at once, twice and "
                 "four times its resolution, and what the want asks for"),
};

static const struct hk_option_table needs_table = {"needs", HOOKE_OPTION_ROWS(needs_rows)};

const struct hk_needs_cost hk_needs_no_cost = {NAN, NAN, NAN, NAN, 0, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};

/* ---- creating ---- */

static int32_t read_times(struct hk_needs *needs) {
  const int32_t status = hk_step_times(needs->m->run, &needs->duration, &needs->every);
  if (status != HOOKE_OK) return status;
  needs->judged = needs->frame_count = hk_schedule_frames(needs->duration, needs->every);
  needs->path_time = hk_new(needs->frame_count, sizeof(double));
  if (needs->path_time == NULL) return HOOKE_NO_MEMORY;
  for (int64_t f = 0; f < needs->frame_count; f++)
    needs->path_time[f] = hk_needs_time(needs, f);
  return hk_step_unit(needs->duration, needs->every, &needs->unit);
}

/* Fills `watch` from the option. HOOKE_BAD_VALUE. */
static int32_t read_watch(struct hk_needs *needs) {
  const hooke_system *system = needs->m->system;
  const char *text = hooke_options_text(needs->m->options, "watch");
  uint8_t *mark = hk_new(system->particle_count, 1);
  if (mark == NULL) return HOOKE_NO_MEMORY;
  int32_t status = HOOKE_OK, all = text[0] == '\0';
  if (!all) {
    status = hk_watched_mark_particles(system, "watch", text, mark);
    const int32_t quantity = strchr(text, '.') || hk_watched_is_of_scene(text);
    all = status == HOOKE_BAD_VALUE && quantity && !needs->wants.list;
    if (all) status = hk_wants_of_each(&needs->wants, &needs->watched, text);
    needs->want = needs->wants.most;
  }
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (all) mark[p] = system->constrained[p] == 0;
    needs->watch_count += mark[p];
  }
  needs->watch = hk_new(needs->watch_count, sizeof *needs->watch);
  if (status == HOOKE_OK && needs->watch == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK && needs->watch_count == 0) {
    status =
        hk_fail(HOOKE_BAD_VALUE, "watch", "no particle of the scene is free, so there is nothing to watch");
  }
  int64_t at = 0;
  for (int64_t p = 0; p < system->particle_count && status == HOOKE_OK; p++) {
    if (mark[p]) needs->watch[at++] = p;
  }
  hk_free(mark);
  return status;
}

/* Marks the groups of that name, and those of the part of that name; 0 if there are none. */
static int32_t keep(struct hk_needs *needs, const char *name) {
  const hooke_system *system = needs->m->system;
  int32_t found = 0;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    if (strcmp(group->name, name) != 0 &&
        !(group->from_part && strcmp(system->part[group->part].name, name) == 0))
      continue;
    needs->kept[g] = 1;
    found = 1;
  }
  return found;
}

/* Fills `kept` from the option. HOOKE_BAD_VALUE. */
static int32_t read_keep(struct hk_needs *needs) {
  const char *at = hooke_options_text(needs->m->options, "keep");
  char name[HOOKE_NEEDS_NAME];
  needs->kept = hk_new(needs->m->system->group_count, sizeof *needs->kept);
  if (needs->kept == NULL) return HOOKE_NO_MEMORY;
  while (*at) {
    const size_t length = strcspn(at, ",");
    snprintf(name, sizeof name, "%.*s", (int)length, at);
    if (!keep(needs, name)) {
      char shown[HOOKE_OPTION_SHOWN];
      hk_option_show(name, (int64_t)strlen(name), shown);
      return hk_fail(HOOKE_BAD_VALUE, "keep", "\"%s\" is no group of the scene and no part with groups",
                     shown);
    }
    at += length + (at[length] == ',');
  }
  return HOOKE_OK;
}

static int32_t prepare(struct hk_needs *needs) {
  const struct hk_method *method;
  int32_t status = hk_options_check_required(needs->m->options);
  if (status != HOOKE_OK) return status;
  needs->watched.system = needs->m->system;
  status = hk_wants_read(&needs->wants, &needs->watched, needs->m->options);
  needs->want = needs->wants.most;
  if (status == HOOKE_OK) status = read_times(needs);
  if (status == HOOKE_OK) status = hk_method_take(hooke_options_text(needs->m->run, "method"), &method);
  if (status == HOOKE_OK) status = read_watch(needs);
  if (status == HOOKE_OK) status = read_keep(needs);
  if (status != HOOKE_OK) return status;
  needs->largest_force = hk_new(needs->m->system->springs->count, sizeof *needs->largest_force);
  return needs->largest_force ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static int32_t create(hooke_measurement *m) {
  struct hk_needs *needs = m->object = hk_new(1, sizeof *needs);
  if (needs == NULL) return HOOKE_NO_MEMORY;
  needs->m = needs->stage.measurement = m;
  hk_needs_forget(needs);
  return prepare(needs);
}

static void destroy(void *object) {
  struct hk_needs *needs = object;
  if (needs == NULL) return;
  hk_needs_forget(needs);
  hk_needs_path_release(&needs->path);
  hk_free(needs->row);
  hk_free(needs->part);
  hk_free(needs->watch);
  hk_free(needs->path_time);
  hk_watched_release(&needs->watched);
  hk_free(needs->kept);
  hk_free(needs->largest_force);
  hk_free(needs);
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_needs *needs = m->object;
  const int32_t status = hk_measurement_require_fresh(m, state);
  if (status != HOOKE_OK) return status;
  needs->spread = 1.0;
  return hooke_options_number(needs->m->options, "refine") != 0.0 ? hk_needs_refine(needs)
                                                                  : hk_needs_find(needs);
}

const struct hk_measurement_kind hk_needs_kind = {.name = "needs",
                                                  .options = &needs_table,
                                                  .needs_run = 1,
                                                  .tables = hk_needs_tables,
                                                  .claim = hk_needs_claim,
                                                  .create = create,
                                                  .run = run,
                                                  .destroy = destroy};
