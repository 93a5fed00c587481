/* Leaves out together the ingredients that are not needed. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/utf8.h"
#include "measure/recommend/pick.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double CLEARLY_LESS = 0.8;    /* of the work: less is not worth telling */
static const double TURNS_TAKE = 0.1;      /* [s]: time for repeating two runs in turns */
static const double WORTH_SPLITTING = 0.5; /* of the work, left over if a part is written spring by spring */

void hk_needs_release(struct hk_needs_lean *candidate) {
  hk_variant_release(&candidate->variant);
  hk_variant_map_release(&candidate->map);
  hk_needs_path_release(&candidate->path);
  hooke_system_destroy(candidate->system);
  memset(candidate, 0, sizeof *candidate);
}

int32_t hk_needs_try_lean(struct hk_needs *needs, struct hk_needs_lean *candidate) {
  candidate->error = NAN;
  int32_t status =
      hk_variant_make(needs->m->system, &candidate->variant, &candidate->system, &candidate->map);
  if (status == HOOKE_BAD_VALUE || status == HOOKE_UNSUITED) return HOOKE_OK; /* mutually exclusive */
  if (status != HOOKE_OK) return status;
  const struct hk_needs_trial trial = {candidate->system, &candidate->map};
  double displaced = 0.0;
  status = hk_needs_fit(needs, &trial, &candidate->cost, &candidate->path, &candidate->error);
  if (status == HOOKE_OK && !isnan(candidate->error))
    status = hk_needs_compare(needs, &trial, &candidate->cost, 1, &displaced);
  if (!(displaced <= needs->want)) candidate->error = NAN, hk_needs_path_release(&candidate->path);
  return status;
}

int32_t hk_needs_take(struct hk_needs *needs, struct hk_needs_lean *candidate) {
  hk_needs_release(&needs->lean);
  hooke_options_destroy(needs->lean_run);
  needs->lean = *candidate;
  needs->lean_note[0] = '\0';
  memset(candidate, 0, sizeof *candidate);
  const int32_t status = hooke_options_copy(needs->m->run, &needs->lean_run);
  return status == HOOKE_OK ? hk_needs_set_step(&needs->lean.cost, needs->lean_run) : status;
}

double hk_needs_work(const struct hk_needs_cost *cost) {
  return cost->force_evaluations * (cost->springs + cost->particles);
}

/* 0 if leaving it out makes no run cheaper: springs that only pull cost one more comparison, and single
 * springs that are left out break up runs of others, whose ends are then looked up. */
static int32_t may_save(const struct hk_needs *needs, const struct hk_needs_row *row) {
  if (strcmp(row->kind, "compression") == 0) return 0;
  return strcmp(row->kind, "idle") != 0 || row->cost.indexed <= needs->full.indexed;
}

static int32_t is_split(const struct hk_needs *needs, const struct hk_variant *variant) {
  return hk_variant_next_split(needs->m->system, variant, 0) >= 0;
}

/* Whole parts come first, then bodies: all that is inside drops out with them. Variants that the options of a
 * part cannot express come last: the part may have lost more by then. */
static int32_t rank(const struct hk_needs *needs, const struct hk_needs_row *row) {
  if (strcmp(row->kind, "part") == 0) return 0;
  if (strcmp(row->kind, "rigid") == 0) return 1;
  return is_split(needs, &row->variant) ? 3 : 2;
}

static int32_t comes_before(const struct hk_needs *needs, const struct hk_needs_row *a,
                            const struct hk_needs_row *b) {
  const int32_t one = rank(needs, a), other = rank(needs, b);
  if (one != other) return one < other;
  if (a->error != b->error) return a->error < b->error;
  return a->cost.particles + a->cost.springs < b->cost.particles + b->cost.springs;
}

/* The unneeded row of the first rank with the smallest change, of equal ones that which leaves the least,
 * that is not yet left out or tried; -1 if there is none. */
static int64_t next_row(const struct hk_needs *needs, const uint8_t *tried) {
  int64_t found = -1;
  for (int64_t k = 0; k < needs->row_count; k++) {
    const struct hk_needs_row *row = &needs->row[k];
    if (tried[k] || !row->measured || row->needed != 0.0 || !may_save(needs, row)) continue;
    if (hk_variant_covers(needs->m->system, &needs->lean.variant, &row->variant)) continue;
    if (found < 0 || comes_before(needs, row, &needs->row[found])) found = k;
  }
  return found;
}

static int32_t add_row(struct hk_needs *needs, struct hk_needs_row *row) {
  struct hk_needs_lean candidate = {.system = NULL};
  int32_t status = hk_variant_create(needs->m->system, &candidate.variant);
  if (status == HOOKE_OK) {
    hk_variant_join(needs->m->system, &candidate.variant, &needs->lean.variant);
    hk_variant_join(needs->m->system, &candidate.variant, &row->variant);
    status = hk_needs_try_lean(needs, &candidate);
  }
  const double fraction = status == HOOKE_OK && is_split(needs, &candidate.variant) ? WORTH_SPLITTING : 1.0;
  if (status == HOOKE_OK && candidate.error <= needs->want &&
      hk_needs_work(&candidate.cost) <= fraction * hk_needs_work(&needs->lean.cost)) {
    row->left_out = 1;
    status = hk_needs_take(needs, &candidate);
  }
  hk_needs_release(&candidate);
  int32_t finer = 0;
  if (status == HOOKE_OK && !row->left_out) status = hk_needs_run_finer(needs, row, &finer);
  return finer && status == HOOKE_OK ? add_row(needs, row) : status;
}

static int32_t begin_with_everything(struct hk_needs *needs) {
  struct hk_needs_lean candidate = {.system = NULL};
  int32_t status = hk_variant_create(needs->m->system, &candidate.variant);
  if (status == HOOKE_OK) status = hk_needs_try_lean(needs, &candidate);
  if (status == HOOKE_OK) {
    needs->cheapest = candidate.cost;
    needs->cheapest_error = candidate.error;
    status = hk_needs_take(needs, &candidate);
  }
  if (status == HOOKE_OK && isnan(needs->cheapest_error))
    hk_print(
        needs->lean_note, sizeof needs->lean_note,
        "no run of the full scene by %s is recommended: none that was tried is within the want, clear of its "
        "stability limit and without a rise of energy",
        hooke_options_text(needs->m->run, "method"));
  hk_needs_release(&candidate);
  return status;
}

/* Skips rows that another row already covers. */
static void tidy_up(struct hk_needs *needs) {
  for (int64_t k = 0; k < needs->row_count; k++) {
    struct hk_needs_row *row = &needs->row[k];
    for (int64_t other = 0; other < needs->row_count && row->left_out; other++) {
      row->left_out = other == k || !needs->row[other].left_out ||
                      !hk_variant_covers(needs->m->system, &needs->row[other].variant, &row->variant);
    }
  }
}

/* Reason why a row that is not needed stays in the lean system, if it has no other note. */
static void say_why_it_stays(const struct hk_needs *needs, struct hk_needs_row *row) {
  if (row->needed != 0.0 || row->left_out || row->note[0]) return;
  if (hk_variant_covers(needs->m->system, &needs->lean.variant, &row->variant)) return;
  snprintf(row->note, sizeof row->note, "%s",
           !may_save(needs, row)            ? "saves nothing, so it stays"
           : is_split(needs, &row->variant) ? "saves too little to write a part spring by spring"
                                            : "saves no work, or not together with the rest");
}

/* One name more of a list. */
static void append(char names[HOOKE_NEEDS_NAME], const char *name) {
  hk_append(names, HOOKE_NEEDS_NAME, "%s%s", names[0] ? ", " : "", name);
}

/* "100 steps of 0.02 s", or "100 steps" with error control. */
static void print_steps(const struct hk_needs_cost *cost, char text[64]) {
  if (isnan(cost->step))
    hk_print(text, 64, "%.0f steps", cost->steps);
  else
    hk_print(text, 64, "%.0f steps of %.3g s", cost->steps, cost->step);
}

/* Parts that are bodies in the lean scene, and the steps that this saves. */
static void note_bodies(struct hk_needs *needs) {
  char names[HOOKE_NEEDS_NAME] = "", lean[64], full[64];
  for (int64_t k = 0; k < needs->m->system->part_count; k++)
    if (needs->lean.variant.rigid[k] && !needs->lean.variant.part[k])
      append(names, needs->m->system->part[k].name);
  if (names[0] == '\0') return;
  print_steps(&needs->lean.cost, lean);
  print_steps(&needs->cheapest, full);
  hk_print(needs->lean_note, sizeof needs->lean_note, "%s: rigid (\"rigid\": true); %s instead of %s", names,
           lean, full);
  hk_utf8_make_plain(needs->lean_note);
}

/* Groups of parts that the lean scene cannot express as a part. */
static void note_splits(struct hk_needs *needs) {
  const hooke_system *system = needs->m->system;
  char names[HOOKE_NEEDS_NAME] = "";
  int64_t count = 0;
  for (int64_t g = -1; (g = hk_variant_next_split(system, &needs->lean.variant, g + 1)) >= 0; count++) {
    append(names, system->group[g].name);
  }
  if (count == 0) return;
  hk_append(needs->lean_note, sizeof needs->lean_note,
            "%s%s: written spring by spring, not as a part has it, since single springs of %s are left out",
            needs->lean_note[0] ? "; " : "", names, count == 1 ? "it" : "them");
  hk_utf8_make_plain(needs->lean_note);
}

/* So that savings by another method are not attributed to the omissions. */
static int32_t find_other_method(struct hk_needs *needs) {
  struct hk_pick pick;
  const double most = CLEARLY_LESS * needs->cheapest.work;
  const int32_t status = hk_pick_run(&pick, needs->m->system, needs->m->run, &needs->wants, needs->want, most,
                                     0, NULL, hk_needs_tell_pick, needs);
  if (status == HOOKE_OK && pick.met && pick.best.work < pick.fraction * most &&
      strcmp(pick.best.method, hooke_options_text(needs->m->run, "method")) != 0) {
    needs->other_method = pick.best.method;
    needs->other_seconds = pick.best.wall_seconds / pick.fraction;
  }
  hk_pick_release(&pick);
  return status == HOOKE_STOPPED || status == HOOKE_NO_MEMORY ? status : HOOKE_OK;
}

static int32_t is_changed(const struct hk_needs *needs) {
  int32_t some = hk_needs_next_changed(needs, 0) < needs->degree_count;
  for (int64_t k = 0; k < needs->row_count; k++)
    some |= needs->row[k].left_out;
  return some;
}

static int32_t find_lean(struct hk_needs *needs) {
  uint8_t *tried = hk_new(needs->row_count, 1);
  if (tried == NULL) return HOOKE_NO_MEMORY;
  hk_stage_begin(&needs->stage, "the lean scene", 1.0);
  int32_t status = begin_with_everything(needs);
  for (int64_t k; status == HOOKE_OK && (k = next_row(needs, tried)) >= 0;) {
    tried[k] = 1;
    status = add_row(needs, &needs->row[k]);
  }
  hk_free(tried);
  tidy_up(needs);
  if (status == HOOKE_OK) status = hk_needs_soften(needs);
  if (status != HOOKE_OK) return status;
  const struct hk_needs_trial timed[2] = {{needs->m->system, NULL}, {needs->lean.system, &needs->lean.map}};
  struct hk_needs_cost *const times[2] = {&needs->cheapest, &needs->lean.cost};
  note_bodies(needs);
  note_splits(needs);
  for (int64_t k = 0; k < needs->row_count; k++)
    say_why_it_stays(needs, &needs->row[k]);
  if (!isnan(needs->lean.error))
    status = hk_needs_find_times(needs, is_changed(needs) ? 2 : 1, timed, times, TURNS_TAKE);
  if (!is_changed(needs)) needs->lean.cost.wall_seconds = needs->cheapest.wall_seconds;
  if (is_changed(needs) && status == HOOKE_OK) status = find_other_method(needs);
  return status;
}

void hk_needs_forget(struct hk_needs *needs) {
  for (int64_t k = 0; k < needs->row_count; k++)
    hk_variant_release(&needs->row[k].variant);
  needs->row_count = 0;
  for (int k = 0; k < 2; k++)
    hk_needs_path_release(&needs->by_step[k]);
  hk_free(needs->degree);
  needs->degree = NULL;
  needs->degree_count = 0;
  needs->trial_work = 0.0;
  hk_needs_release(&needs->lean);
  hooke_options_destroy(needs->lean_run);
  needs->lean_run = NULL;
  needs->lean.error = needs->cheapest_error = needs->other_seconds = NAN;
  needs->lean_note[0] = '\0';
  needs->other_method = NULL;
}

int32_t hk_needs_find(struct hk_needs *needs) {
  int32_t status = hk_needs_list(needs);
  if (status == HOOKE_OK) status = hk_needs_run_full(needs);
  if (status == HOOKE_OK) status = hk_needs_run_rows(needs);
  if (status == HOOKE_OK) status = hk_needs_run_degrees(needs);
  if (status == HOOKE_OK) status = find_lean(needs);
  if (status == HOOKE_OK && needs->lean.path.position) hk_needs_find_each(needs);
  if (status < 0) hk_needs_forget(needs);
  return status;
}
