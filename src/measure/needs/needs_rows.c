/* The table: the full scene, with its method and its step, and one run for every ingredient. */
#include "measure/needs/needs.h"

#include "core/print.h"
#include "core/status.h"
#include "measure/recommend/pick.h"
#include "model/force/spring.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Fractions of the largest force in the scene below which springs may be idle, the largest first. */
static const double idle_shares[] = {1e-2, 1e-3, 1e-4, 1e-6};
enum { IDLE_SHARES = sizeof idle_shares / sizeof idle_shares[0] };

static const double HALF = 0.5, FINER = 1.5; /* of the cells of a part; of a row, to the next one */
static const double COARSER = 1.2;           /* of cells that are kept to those that fail: no closer */
static const double LEAST_JUDGED = 0.05;     /* of the duration: less is not significant */

/* ---- the full scene ---- */

int32_t hk_needs_tell_pick(double done, const char *what, void *ctx) {
  (void)what;
  return hk_needs_tell(ctx, done);
}

static int32_t refuse_pick(const struct hk_pick *pick) {
  if (pick->best.method == NULL)
    return hk_fail(HOOKE_UNSUITED, "method", "no method has a step that is stable here");
  const char *m = hk_wants_unit(pick->wants, pick->system);
  return hk_fail(HOOKE_BAD_VALUE, "want", "%g%s is not reached: the closest run, %s at %g, is %g%s off",
                 pick->want, m, pick->best.method, pick->best.value, pick->best.error, m);
}

/* Without a method in the options of the run, chooses as 'run --want' would. */
static int32_t pick_method(struct hk_needs *needs) {
  struct hk_pick pick;
  if (hooke_options_is_set(needs->m->run, "method")) return HOOKE_OK;
  hk_stage_begin(&needs->stage, "picking a method", 0.1);
  int32_t status =
      hk_pick_run(&pick, needs->m->system, needs->m->run, &needs->wants, HOOKE_NEEDS_STEP_SHARE * needs->want,
                  INFINITY, 0, NULL, hk_needs_tell_pick, needs);
  if (status == HOOKE_OK && !pick.met) status = refuse_pick(&pick);
  if (status == HOOKE_OK) status = hk_trial_set_value(needs->m->run, pick.best.method, pick.best.value);
  needs->method_picked = status == HOOKE_OK;
  hk_pick_release(&pick);
  return status == HOOKE_NOT_BUILT ? HOOKE_OK : status; /* then the default of the option */
}

static int32_t refuse_full(const struct hk_needs *needs) {
  return hk_fail(
      HOOKE_BAD_VALUE, "want",
      "%s, %g%s: no step that was tried holds the full scene by %s to a tenth of it over a time worth "
      "judging; take a larger want, a shorter duration or another method",
      "the want", needs->want, hk_wants_unit(&needs->wants, needs->m->system),
      hooke_options_text(needs->m->run, "method"));
}

static void say_how_it_moves(struct hk_needs *needs) {
  needs->moved = hk_needs_moved(needs, &needs->path);
  if (hk_needs_rests(needs)) {
    hk_print(needs->note, sizeof needs->note,
             "nothing moves: the watched positions stay within %.2g m of where they begin, under a "
             "thousandth of what is wanted; whether a motion needs what changes nothing here cannot be told",
             needs->moved);
  } else if (needs->moved <= needs->want && !needs->wants.list) {
    hk_print(needs->note, sizeof needs->note,
             "the watched positions move by %.2g m in all, less than is wanted, so that a scene which "
             "stands still would do; take a smaller want to learn what moves them",
             needs->moved);
  }
}

int32_t hk_needs_run_full(struct hk_needs *needs) {
  if (needs->path.position) return HOOKE_OK;
  int32_t status = pick_method(needs);
  const struct hk_needs_trial trial = {needs->m->system, NULL};
  hk_stage_begin(&needs->stage, "the full scene", 0.2);
  if (status == HOOKE_OK) status = hk_needs_measure(needs, &trial, &needs->full, &needs->path);
  const struct hk_needs_path *path = &needs->path;
  if (status == HOOKE_OK && path->position)
    status = hk_wants_require_values(&needs->wants, &path->values, path->recorded, path->recorded);
  struct hk_needs_cost *full = &needs->full;
  if (status == HOOKE_OK && full->wall_seconds < HOOKE_NEEDS_SHORT)
    status = hk_needs_find_times(needs, 1, &trial, &full, HOOKE_NEEDS_SHORT);
  const double frames = (double)needs->frame_count,
               least = needs->wants.whole ? frames : 1.0 + LEAST_JUDGED * frames;
  if (status == HOOKE_OK && (!needs->path.position || (double)needs->judged < least))
    status = refuse_full(needs);
  if (status == HOOKE_OK) say_how_it_moves(needs);
  if (status == HOOKE_OK) return status;
  hk_needs_path_release(&needs->path);
  for (int k = 0; k < 2; k++)
    hk_needs_path_release(&needs->by_step[k]);
  needs->judged = needs->frame_count;
  return status;
}

/* ---- rows ---- */

/* A failure that concerns this variant alone becomes a note. */
static int32_t note_failure(struct hk_needs_row *row, int32_t status) {
  if (status != HOOKE_BAD_VALUE && status != HOOKE_UNSUITED) return status;
  snprintf(row->note, sizeof row->note, "%s", hooke_last_error());
  return HOOKE_OK;
}

/* The error of the step beyond its share counts against it. */
static void judge(const struct hk_needs *needs, const struct hk_needs_path *path, struct hk_needs_row *row) {
  const double beyond = fmax(0.0, row->cost.step_error - HOOKE_NEEDS_STEP_SHARE * needs->want);
  row->error = hk_needs_distance(needs, &needs->path, path);
  row->needed = !(row->error + beyond <= needs->want);
  if (row->needed == 0.0 && hk_needs_rests(needs)) row->needed = NAN;
  if (beyond > 0.0)
    hk_print(row->note, sizeof row->note, "its time step may put it off by %.2g%s", row->cost.step_error,
             hk_wants_unit(&needs->wants, needs->m->system));
  if (isnan(row->error)) hk_print(row->note, sizeof row->note, "it is without what is wanted");
}

/* What only the exact start does without is needed. */
static int32_t judge_displaced(struct hk_needs *needs, const struct hk_needs_trial *trial,
                               struct hk_needs_row *row) {
  double error;
  if (row->needed != 0.0) return HOOKE_OK;
  const int32_t status = hk_needs_compare(needs, trial, &row->cost, 1, &error);
  if (status != HOOKE_OK || error <= needs->want) return status;
  row->needed = 1;
  if (isfinite(error)) row->error = error;
  snprintf(row->note, sizeof row->note, "%s",
           "from a start displaced by a hundredth of the want: the exact one does not excite what it holds");
  return HOOKE_OK;
}

/* Runs one variant: its cost and its error against the full system; NaN with a note if it has none. */
static int32_t run_row(struct hk_needs *needs, struct hk_needs_row *row) {
  hooke_system *made = NULL;
  struct hk_variant_map map;
  struct hk_needs_path fine = {0};
  row->error = NAN;
  row->note[0] = '\0';
  int32_t status = hk_variant_make(needs->m->system, &row->variant, &made, &map);
  if (status != HOOKE_OK) return note_failure(row, status);
  const struct hk_needs_trial trial = {made, &map};
  status = hk_needs_measure(needs, &trial, &row->cost, &fine);
  if (status == HOOKE_OK && fine.position)
    judge(needs, &fine, row);
  else if (status == HOOKE_OK)
    snprintf(row->note, sizeof row->note, "does not run to its end with any step that was tried");
  if (status == HOOKE_OK && fine.position) status = judge_displaced(needs, &trial, row);
  hk_needs_path_release(&fine);
  hk_variant_map_release(&map);
  hooke_system_destroy(made);
  row->measured = status == HOOKE_OK;
  if (!row->measured) row->cost = hk_needs_no_cost;
  return status == HOOKE_UNSUITED ? note_failure(row, status) : status; /* the method may not know bodies */
}

/* Selects the springs whose force never exceeds `force` [N]; returns their number. */
static int64_t mark_idle(const struct hk_needs *needs, double force, struct hk_needs_row *row) {
  const hooke_system *system = needs->m->system;
  int64_t count = 0, s = 0;
  for (int64_t g = 0; g < hk_system_groups_of(system, &hk_force_springs); g++)
    for (const int64_t end = s + system->group[g].count; s < end; s++)
      count += row->variant.spring[s] = !needs->kept[g] && needs->largest_force[s] <= force;
  return count;
}

/* 1 if the springs are those of one group, which has a row of its own, or all springs. */
static int32_t is_known(const struct hk_needs *needs, const struct hk_needs_row *row, int64_t count) {
  const hooke_system *system = needs->m->system;
  int64_t first = 0;
  for (int64_t g = 0; g < hk_system_groups_of(system, &hk_force_springs); first += system->group[g++].count) {
    if (system->group[g].count == count && row->variant.spring[first] &&
        memchr(row->variant.spring + first, 0, (size_t)count) == NULL) {
      return 1;
    }
  }
  return count == system->springs->count;
}

/* The largest threshold that the want allows; the row is removed if none has springs. */
static int32_t run_idle(struct hk_needs *needs, struct hk_needs_row *row) {
  double most = 0.0;
  int64_t tried = 0;
  for (int64_t s = 0; s < needs->m->system->springs->count; s++)
    most = fmax(most, needs->largest_force[s]);
  for (int k = 0; k < IDLE_SHARES; k++) {
    const int64_t count = mark_idle(needs, idle_shares[k] * most, row);
    if (count == 0 || count == tried || is_known(needs, row, count)) continue;
    tried = count;
    hk_print(row->without, HOOKE_NEEDS_NAME, "%lld %s %.3g N", (long long)count,
             count == 1 ? "spring that never passes" : "springs that never pass", idle_shares[k] * most);
    const int32_t status = run_row(needs, row);
    if (status != HOOKE_OK || row->needed == 0.0) return status;
  }
  return HOOKE_OK;
}

/* The part of a row of resolution. */
static int64_t part_of(const struct hk_needs_row *row) {
  int64_t part = 0;
  while (row->variant.scale[part] == 1.0)
    part++;
  return part;
}

/* "all but 8 of 24 cells of rope" */
static void name_cells(const struct hk_needs *needs, struct hk_needs_row *row) {
  const int64_t part = part_of(row);
  const struct hk_part_record *record = &needs->m->system->part[part];
  int64_t cells[3], made[3];
  const double scale = row->variant.scale[part];
  const int32_t axes = hk_variant_cells(record, scale, cells, made);
  char has[64] = "", left[64] = "";
  for (int32_t a = 0; a < axes; a++) {
    hk_append(left, sizeof left, "%s%lld", a ? " x " : "", (long long)made[a]);
    hk_append(has, sizeof has, "%s%lld", a ? " x " : "", (long long)cells[a]);
  }
  if (scale == HALF)
    hk_print(row->without, sizeof row->without, "half the resolution of %s", record->name);
  else
    hk_print(row->without, sizeof row->without, "all but %s of %s cells of %s", left, has, record->name);
}

/* Where half the cells are not needed, the coarsest part that keeps the want, to a fifth of its cells. */
static int32_t run_resolution(struct hk_needs *needs, struct hk_needs_row *row) {
  const int64_t part = part_of(row);
  double *scale = &row->variant.scale[part], kept = *scale;
  int64_t cells[3], made[3], fails = 0;
  int32_t axis = 0, a = hk_variant_cells(&needs->m->system->part[part], kept, cells, made);
  while (--a > 0)
    if (cells[a] > cells[axis]) axis = a;
  int32_t status = run_row(needs, row);
  struct hk_needs_row held = *row;
  for (int64_t holds = made[axis]; status == HOOKE_OK && held.needed == 0.0;) {
    const int64_t next = (fails + holds) / 2;
    if (next <= fails || (double)holds <= COARSER * (double)fails) break;
    *scale = (double)next / (double)cells[axis];
    status = run_row(needs, row);
    if (status != HOOKE_OK || row->needed != 0.0) {
      fails = next;
      continue;
    }
    holds = next;
    kept = *scale;
    held = *row;
  }
  *row = held;
  *scale = kept;
  name_cells(needs, row);
  return status;
}

int32_t hk_needs_run_finer(struct hk_needs *needs, struct hk_needs_row *row, int32_t *finer) {
  *finer = strcmp(row->kind, "resolution") == 0 && row->variant.scale[part_of(row)] < HALF;
  if (!*finer) return HOOKE_OK;
  double *scale = &row->variant.scale[part_of(row)];
  *scale = fmin(HALF, FINER * *scale);
  name_cells(needs, row);
  return run_row(needs, row);
}

void hk_needs_drop_row(struct hk_needs *needs, int64_t row) {
  hk_variant_release(&needs->row[row].variant);
  memmove(&needs->row[row], &needs->row[row + 1], (size_t)(--needs->row_count - row) * sizeof *needs->row);
}

static int32_t is_idle(const struct hk_needs_row *row) {
  return strcmp(row->kind, "idle") == 0;
}

static int32_t run_piece(struct hk_needs *needs, int64_t number) {
  struct hk_needs_row *row = &needs->row[number];
  row->timed_alone = !needs->turn->serial;
  hk_needs_name(needs, row->without);
  if (strcmp(row->kind, "resolution") == 0) return run_resolution(needs, row);
  return is_idle(row) ? run_idle(needs, row) : run_row(needs, row);
}

static int32_t time_row(struct hk_needs *needs, struct hk_needs_row *row) {
  hooke_system *made = NULL;
  struct hk_variant_map map;
  if (!(row->cost.wall_seconds < HOOKE_NEEDS_SHORT)) return HOOKE_OK;
  int32_t status = hk_variant_make(needs->m->system, &row->variant, &made, &map);
  if (status != HOOKE_OK) return status;
  status = hk_needs_find_times(needs, 1, &(struct hk_needs_trial){made, &map},
                               &(struct hk_needs_cost *){&row->cost}, HOOKE_NEEDS_SHORT);
  row->timed_alone = 1;
  hk_variant_map_release(&map);
  hooke_system_destroy(made);
  return status;
}

int32_t hk_needs_run_rows(struct hk_needs *needs) {
  hk_stage_begin(&needs->stage, "what is left out", 0.5);
  int32_t status = needs->row_count > 0 ? hk_needs_prepare(needs, 1) : HOOKE_OK;
  if (status == HOOKE_OK) status = hk_needs_run_pieces(needs, 0, needs->row_count, run_piece, INFINITY, NULL);
  for (int64_t k = 0; k < needs->row_count && status == HOOKE_OK; k++) {
    struct hk_needs_row *row = &needs->row[k];
    if (is_idle(row) && !row->measured && !row->note[0])
      hk_needs_drop_row(needs, k--);
    else
      status = time_row(needs, row);
  }
  return status;
}
