/* The rows of a cost, and the selection of those to measure. */
#include "measure/cost/cost.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/force/force.h"
#include "model/group.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int32_t hk_cost_row_is(const struct hk_cost_row *row, const char *kind) {
  return strcmp(row->kind, kind) == 0;
}

/* ---- listing ---- */

static void add_row(struct hk_cost *cost, const char *kind, int64_t group, int64_t size) {
  if (size > 0)
    cost->row[cost->row_count++] =
        (struct hk_cost_row){.kind = kind, .group = group, .size = size, .chosen = 1};
}

static void add_groups(struct hk_cost *cost) {
  const hooke_system *system = cost->system;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    add_row(cost, group->force->name, g, group->count);
  }
}

static void add_others(struct hk_cost *cost) {
  const hooke_system *system = cost->system;
  add_row(cost, "damping", -1, hk_elements_are_damped(system));
  add_row(cost, "drag", -1, system->brake > 0.0);
  add_row(cost, "callback", -1, system->force != NULL);
  add_row(cost, "gravity", -1, system->has_gravity);
}

/* The largest first; those of one size in the order of the rows. */
static int compare_sizes(const void *one, const void *two) {
  const struct hk_cost_row *a = *(struct hk_cost_row *const *)one, *b = *(struct hk_cost_row *const *)two;
  if (a->size != b->size) return a->size < b->size ? 1 : -1;
  return (a > b) - (a < b);
}

/* Every group rebuilds the scene, so that the time for very many would grow with their square. The rows so
 * far are those of groups. */
static int32_t leave_small_groups_out(struct hk_cost *cost) {
  const int64_t count = cost->row_count, most = (int64_t)hooke_options_number(cost->options, "groups");
  if (count <= most) return HOOKE_OK;
  struct hk_cost_row **sorted = hk_new(count, sizeof *sorted);
  if (sorted == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count; k++)
    sorted[k] = &cost->row[k];
  qsort(sorted, (size_t)count, sizeof *sorted, compare_sizes);
  for (int64_t k = most; k < count; k++)
    sorted[k]->chosen = 0;
  hk_free(sorted);
  return HOOKE_OK;
}

int32_t hk_cost_list_rows(struct hk_cost *cost) {
  enum { OTHERS = 4 };
  const hooke_system *system = cost->system;
  cost->row = hk_new(system->group_count + OTHERS, sizeof *cost->row);
  if (cost->row == NULL) return HOOKE_NO_MEMORY;
  add_groups(cost);
  const int32_t status = leave_small_groups_out(cost);
  add_others(cost);
  for (int64_t k = 0; k < cost->row_count; k++)
    cost->chosen_count += cost->row[k].chosen;
  return status;
}

const char *hk_cost_row_name(const struct hk_cost *cost, const struct hk_cost_row *row) {
  return row->group < 0 ? row->kind : cost->system->group[row->group].name;
}

int64_t hk_cost_row_group(const struct hk_cost *cost, const struct hk_cost_row *row) {
  if (row->group < 0) return -1;
  return row->group - hk_system_first_group(cost->system, cost->system->group[row->group].force);
}
