/* What needs say of their results. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "measure/limit/contact.h"
#include "model/particles.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELLS_SIZE = 64 };

/* After an error. */
static const char *unit_of(const struct hk_needs *needs) {
  return hk_wants_unit(&needs->wants, needs->m->system);
}

static int32_t judges_all(const struct hk_needs *needs) {
  return hk_needs_judged_until(needs) >= needs->duration * (1.0 - 1e-9);
}

static enum hk_claim_of of_judged(const struct hk_needs *needs) {
  return judges_all(needs) ? HOOKE_OF_WHOLE : HOOKE_OF_PART;
}

/* ---- the lean scene ---- */

/* Names of the rows that are left out, or of those that were not looked at, with commas, and their number;
 * NULL without memory, which the claims then lack. */
static char *list_rows(const struct hk_needs *needs, int32_t left_out, struct hk_claims *claims,
                       int64_t *count) {
  const int64_t known = hk_needs_known_rows(needs), first = left_out ? 0 : known,
                end = left_out ? known : needs->row_count;
  char *names = hk_new(1 + (end - first) * (HOOKE_NEEDS_NAME + 2), 1), *at = names;
  *count = 0;
  if (names == NULL) claims->status = HOOKE_NO_MEMORY;
  for (int64_t row = first; row < end && names; row++) {
    if (left_out && !needs->row[row].left_out) continue;
    at += snprintf(at, HOOKE_NEEDS_NAME + 2, "%s%s", (*count)++ ? ", " : "", needs->row[row].without);
  }
  return names;
}

static int32_t has_unknown(const struct hk_needs *needs) {
  for (int64_t row = 0; row < hk_needs_known_rows(needs); row++)
    if (isnan(needs->row[row].needed)) return 1;
  return 0;
}

static const double LEAST_GAIN = 1.1; /* in step: less is in the table alone */

/* "soft 200 times softer" */
static void print_degree(const struct hk_needs_degree *degree, double factor, char *text, size_t size) {
  static const char *const words[][2] = {[HOOKE_NEEDS_SINGLE] = {"softer", "stiffer"},
                                         [HOOKE_NEEDS_STIFFNESS] = {"softer", "stiffer"},
                                         [HOOKE_NEEDS_DAMPING] = {"less damped", "more damped"},
                                         [HOOKE_NEEDS_MASS] = {"lighter", "heavier"},
                                         [HOOKE_NEEDS_DRAG] = {"weaker", "stronger"}};
  const char *before = degree->property == HOOKE_NEEDS_MASS ? "particle " : "";
  if (factor == 0.0)
    hk_append(text, size, "%s%s", degree->property == HOOKE_NEEDS_DRAG ? "" : degree->name,
              degree->property == HOOKE_NEEDS_DRAG ? "drag left out" : " undamped");
  else
    hk_append(text, size, "%s%s %.3g times %s", before, degree->name, factor > 1.0 ? factor : 1.0 / factor,
              words[degree->property][factor > 1.0]);
}

/* Both within the wanted error, each at its cheapest. */
static void tell_saving(const struct hk_needs *needs, struct hk_claims *claims) {
  const double lean = needs->lean.cost.wall_seconds, full = needs->cheapest.wall_seconds;
  const int less = lean <= full;
  hk_claim(
      claims, "saving", of_judged(needs), "clock",
      "within the wanted error it takes %.3g s of wall time by %s, where the full scene takes %.3g s (%.1f times "
      "%s)",
      lean, hooke_options_text(needs->m->run, "method"), full, less ? full / lean : lean / full,
      less ? "less" : "more");
  if (needs->other_method)
    hk_claim(claims, "other-method", HOOKE_OF_WHOLE, "clock", "%s would bring the full scene there in %.3g s",
             needs->other_method, needs->other_seconds);
}

static void tell_left_out(const struct hk_needs *needs, struct hk_claims *claims, int64_t count,
                          const char *names) {
  char where[48] = "", springs[64] = "";
  if (!judges_all(needs)) hk_print(where, sizeof where, " up to t = %.6g s", hk_needs_judged_until(needs));
  if (needs->lean.cost.springs != needs->full.springs)
    hk_print(springs, sizeof springs, ", with %.0f springs instead of %.0f", needs->lean.cost.springs,
             needs->full.springs);
  hk_claim(claims, "lean", of_judged(needs), "runs",
           "%s can be left out%s: %s; the scene is then at most %.3g%s off%s%s",
           count == 1 ? "one ingredient" : "these ingredients", count == 1 ? "" : " together", names,
           needs->lean.error, unit_of(needs), where, springs);
  tell_saving(needs, claims);
}

static void tell_changes(const struct hk_needs *needs, struct hk_claims *claims, int64_t left_out) {
  char what[640] = "";
  const int64_t first = hk_needs_next_changed(needs, 0);
  for (int64_t k = first; k < needs->degree_count; k = hk_needs_next_changed(needs, k + 1)) {
    if (k > first) hk_append(what, sizeof what, ", ");
    print_degree(&needs->degree[k], needs->degree[k].lean_factor, what, sizeof what);
  }
  if (first == needs->degree_count) return;
  if (left_out > 0) {
    hk_claim(claims, "softened", of_judged(needs), "runs", "and it has %s", what);
    return;
  }
  hk_claim(claims, "lean", of_judged(needs), "runs", "with %s the scene is at most %.3g%s off", what,
           needs->lean.error, unit_of(needs));
  tell_saving(needs, claims);
}

static void tell_lean(const struct hk_needs *needs, struct hk_claims *claims) {
  int64_t count;
  char *names = list_rows(needs, 1, claims, &count);
  if (count > 0)
    tell_left_out(needs, claims, count, names);
  else if (!needs->lean_note[0] && hk_needs_next_changed(needs, 0) == needs->degree_count)
    hk_claim(claims, "lean", has_unknown(needs) ? HOOKE_OF_UNKNOWN : of_judged(needs), "runs", "%s",
             has_unknown(needs) ? "nothing is left out: it cannot be told what is not needed"
                                : "all that would save something is needed: there is nothing to leave out");
  tell_changes(needs, claims, count);
  if (needs->lean_note[0])
    hk_claim(claims, count > 0 ? "changes" : "lean", of_judged(needs), "runs", "%s", needs->lean_note);
  hk_free(names);
}

/* ---- by degree ---- */

static void tell_degrees(const struct hk_needs *needs, struct hk_claims *claims) {
  int64_t untried = 0;
  for (int64_t k = 0; k < needs->degree_count; k++) {
    const struct hk_needs_degree *degree = &needs->degree[k];
    const double gain = degree->step_limit / needs->full.step_limit;
    char what[2 * HOOKE_NEEDS_NAME] = "", larger[48] = "nothing limits the step then";
    untried += !degree->tried;
    if (!degree->tried || !(gain > LEAST_GAIN)) continue;
    print_degree(degree, degree->factor, what, sizeof what);
    if (isfinite(gain)) hk_print(larger, sizeof larger, "a step %.3g times larger", gain);
    hk_claim(claims, "degree", of_judged(needs), "runs", "%s: %.2g%s of %.6g%s (tried), %s", what,
             degree->error, needs->wants.list ? "" : " m", needs->want, unit_of(needs), larger);
  }
  if (untried > 0)
    hk_claim(claims, "untried", HOOKE_OF_UNKNOWN, "runs",
             "how far %lld more numbers may be changed was not tried, which would take too long",
             (long long)untried);
}

/* Of work that was stopped. */
static void tell_unfinished(const struct hk_needs *needs, struct hk_claims *claims) {
  int64_t count;
  char *names = list_rows(needs, 0, claims, &count);
  hk_claim(claims, "lean", HOOKE_OF_UNKNOWN, "runs",
           "no lean scene was found before the work was stopped%s%s", count > 0 ? "; not looked at: " : "",
           names);
  hk_free(names);
}

/* ---- resolution ---- */

static void print_cells(const struct hk_needs_part *part, double factor, char text[CELLS_SIZE]) {
  text[0] = '\0';
  for (int axis = 0; axis < 3; axis++)
    if (part->cells[axis] >= 0)
      hk_append(text, CELLS_SIZE, "%s%.0f", text[0] ? " x " : "", hk_needs_cells(part, axis, factor));
}

static void tell_part(const struct hk_needs *needs, const struct hk_needs_part *part,
                      struct hk_claims *claims) {
  char has[CELLS_SIZE], wanted[CELLS_SIZE];
  print_cells(part, 1.0, has);
  print_cells(part, part->factor, wanted);
  const char *noun = strcmp(has, "1") == 0 ? "cell" : "cells";
  if (isfinite(part->factor) && !isnan(part->error))
    hk_claim(claims, "resolution", of_judged(needs), "Richardson",
             "%s has %s %s, which leaves %.3g%s; an error of at most %.6g%s asks for %s", part->name, has,
             noun, part->error, unit_of(needs), needs->want, unit_of(needs), wanted);
  else if (isfinite(part->factor))
    hk_claim(claims, "resolution", of_judged(needs), "Richardson",
             "%s has %s %s, which are enough for an error of at most %.6g%s: %s", part->name, has, noun,
             needs->want, unit_of(needs), part->note);
  else
    hk_claim(claims, "resolution", HOOKE_OF_UNKNOWN, "Richardson",
             "what resolution %s needs is not known%s%s", part->name, part->note[0] ? ": " : "", part->note);
}

/* ---- what it rests on ---- */

static void tell_full(const struct hk_needs *needs, struct hk_claims *claims) {
  const char *method = hooke_options_text(needs->m->run, "method"),
             *how = needs->method_picked ? ", picked," : "";
  if (isnan(needs->full.step_error))
    hk_claim(claims, "full", HOOKE_OF_UNKNOWN, "runs", "by %s%s the full scene was not run to its end",
             method, how);
  else
    hk_claim(claims, "full", of_judged(needs), "half-step",
             "by %s%s the time step puts the full scene off by at most %.2g%s", method, how,
             needs->full.step_error, unit_of(needs));
}

void hk_needs_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_needs *needs = measurement->object;
  const int ran = !isnan(needs->full.step_error),
            refine = hooke_options_number(needs->m->options, "refine") != 0.0;
  if (ran && needs->lean.system) tell_lean(needs, claims);
  if (ran && needs->lean.path.position)
    hk_wants_claim(&needs->wants, needs->found, of_judged(needs), "runs", " then", claims);
  if (ran) tell_degrees(needs, claims);
  for (int64_t part = 0; part < needs->part_count; part++)
    tell_part(needs, &needs->part[part], claims);
  if (!needs->lean.system && !refine) tell_unfinished(needs, claims);
  if (ran && needs->note[0]) hk_claim(claims, "note", HOOKE_OF_WHOLE, "runs", "%s", needs->note);
  if (ran && !judges_all(needs))
    hk_claim(
        claims, "judged", HOOKE_OF_PART, "half-step",
        "after %.6g s small differences grow so fast that no time step keeps its error below a tenth of what is "
        "wanted: changes are those up to %.6g s of %.6g s",
        hk_needs_judged_until(needs), hk_needs_judged_until(needs), needs->duration);
  tell_full(needs, claims);
  hk_claim_contacts(claims, needs->m->system, 0.0, needs->m->system->position);
}
