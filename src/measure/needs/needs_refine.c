/* The reverse: the resolution that a wanted error requires. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double LOWEST_ORDER = 0.25, HIGHEST_ORDER = 4.5; /* order range for extrapolating a change */
static const double RESOLVED = 2.0; /* a change below this many errors of the step is not significant */

/* The path of the system with one part at `scale`. */
static int32_t run_at(struct hk_needs *needs, int64_t part, double scale, struct hk_needs_path *path,
                      struct hk_needs_cost *cost, char *note) {
  struct hk_variant variant;
  struct hk_variant_map map;
  hooke_system *made = NULL;
  int32_t status = hk_variant_create(needs->m->system, &variant);
  if (status != HOOKE_OK) return status;
  variant.scale[part] = scale;
  status = hk_variant_make(needs->m->system, &variant, &made, &map);
  hk_variant_release(&variant);
  if (status == HOOKE_UNSUITED) {
    snprintf(note, HOOKE_NEEDS_NOTE, "%s", hooke_last_error());
    return HOOKE_OK;
  }
  if (status != HOOKE_OK) return status;
  const struct hk_needs_trial trial = {made, &map};
  status = hk_needs_measure(needs, &trial, cost, path);
  if (status == HOOKE_OK && path->position == NULL)
    hk_print(note, HOOKE_NEEDS_NOTE,
             "%g times finer, it does not run to its end with any step that was tried", scale);
  hk_variant_map_release(&map);
  hooke_system_destroy(made);
  return status;
}

/* Richardson (1911): with a change d between N and 2N of order p, the remainder at N is d 2^p / (2^p - 1). */
static void extrapolate(const struct hk_needs *needs, double step_error, struct hk_needs_part *part) {
  if (part->change <= RESOLVED * step_error || part->change_fine <= RESOLVED * step_error) {
    hk_print(part->note, sizeof part->note,
             "the changes are within the error of the step, %.3g%s: the "
             "resolution is fine enough, and its order cannot be seen",
             step_error, hk_wants_unit(&needs->wants, needs->m->system));
    if (part->change <= needs->want) part->factor = 1.0;
    return;
  }
  part->order = log2(part->change / part->change_fine);
  if (!(part->order >= LOWEST_ORDER && part->order <= HIGHEST_ORDER)) {
    hk_print(part->note, sizeof part->note,
             "the changes do not fall as a power of the resolution "
             "(order %.2g), so nothing can be said of a finer one",
             part->order);
    return;
  }
  const double growth = exp2(part->order);
  part->error = part->change * growth / (growth - 1.0);
  part->factor = pow(part->error / needs->want, 1.0 / part->order);
}

static int32_t refine_part(struct hk_needs *needs, int64_t k) {
  struct hk_needs_part *part = &needs->part[k];
  struct hk_needs_path twice = {0}, four = {0};
  struct hk_needs_cost cost_twice, cost_four;
  if (part->cells[0] < 0) return HOOKE_OK;
  hk_needs_name(needs, needs->m->system->part[k].name);
  int32_t status = run_at(needs, k, 2.0, &twice, &cost_twice, part->note);
  if (status == HOOKE_OK && twice.position) {
    part->change = hk_needs_distance(needs, &needs->path, &twice);
    status = run_at(needs, k, 4.0, &four, &cost_four, part->note);
  }
  if (status == HOOKE_OK && four.position) {
    part->change_fine = hk_needs_distance(needs, &twice, &four);
    /* the paths are those of half the step, with half its error */
    const double largest = fmax(needs->full.step_error, fmax(cost_twice.step_error, cost_four.step_error));
    extrapolate(needs, 0.5 * largest, part);
  }
  hk_needs_path_release(&twice);
  hk_needs_path_release(&four);
  return status;
}

int32_t hk_needs_refine(struct hk_needs *needs) {
  const hooke_system *system = needs->m->system;
  if (system->part_count == 0) {
    return hk_fail(HOOKE_BAD_VALUE, NULL, "the scene has no parts, so there is no resolution to change");
  }
  needs->part = hk_new(system->part_count, sizeof *needs->part);
  if (needs->part == NULL) return HOOKE_NO_MEMORY;
  needs->part_count = system->part_count;
  for (int64_t k = 0; k < system->part_count; k++) {
    struct hk_needs_part *part = &needs->part[k];
    *part = (struct hk_needs_part){.name = system->part[k].name,
                                   .change = NAN,
                                   .change_fine = NAN,
                                   .order = NAN,
                                   .error = NAN,
                                   .factor = NAN};
    int64_t made[3];
    const int32_t axes = hk_variant_cells(&system->part[k], 1.0, part->cells, made);
    for (int32_t a = axes; a < 3; a++)
      part->cells[a] = -1;
    if (axes == 0)
      snprintf(part->note, sizeof part->note, "a %s has no resolution to change", system->part[k].kind);
  }
  int32_t status = hk_needs_run_full(needs);
  hk_stage_begin(&needs->stage, "resolutions", 1.0);
  if (status == HOOKE_OK)
    status = hk_needs_run_pieces(needs, 0, needs->part_count, refine_part, INFINITY, NULL);
  if (status < 0) {
    hk_free(needs->part);
    needs->part = NULL;
    needs->part_count = 0;
  }
  return status;
}
