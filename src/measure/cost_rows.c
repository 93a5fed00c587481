/* The rows of a cost: which there are, which of them are looked at, and reading them. */
#include "measure/cost.h"

#include "core/figure.h"
#include "core/memory.h"
#include "core/option.h"
#include "core/status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int32_t hooke_cost_row_is(const struct hooke_cost_row *row, const char *kind) {
  return strcmp(row->kind, kind) == 0;
}

/* ---- listing ---- */

/* A group's row and how much it holds. */
struct sized {
  int64_t row, size;
};

/* The largest first; of one size in the order of the rows. */
static int compare_sizes(const void *one, const void *two) {
  const struct sized *a = one, *b = two;
  if (a->size != b->size) return a->size < b->size ? 1 : -1;
  return (a->row > b->row) - (a->row < b->row);
}

static struct hooke_cost_row *add_row(hooke_cost *cost, const char *kind, int64_t group) {
  struct hooke_cost_row *row = &cost->row[cost->row_count++];
  *row = (struct hooke_cost_row){.kind = kind, .group = group};
  row->nanoseconds = row->resolution = row->memory = row->limit = NAN;
  return row;
}

static void add_group(hooke_cost *cost, const char *kind, int64_t group, int64_t size, struct sized *sized,
                      int64_t *count) {
  if (size == 0) return;
  sized[(*count)++] = (struct sized){cost->row_count, size};
  add_row(cost, kind, group);
}

static void add_other(hooke_cost *cost, int32_t is_there, const char *kind) {
  if (!is_there) return;
  add_row(cost, kind, -1)->chosen = 1;
  cost->chosen_count++;
}

/* Every group makes the scene again, so that the time for all of very many would grow with their square. */
static void list_groups(hooke_cost *cost, struct sized *sized) {
  const hooke_system *system = cost->system;
  const int64_t most = (int64_t)hooke_options_number(cost->options, "groups");
  int64_t count = 0;
  for (int64_t g = 0; g < system->group_count; g++)
    add_group(cost, "springs", g, system->group[g].count, sized, &count);
  for (int64_t g = 0; g < system->bending_group_count; g++)
    add_group(cost, "bending", g, system->bending_group[g].count, sized, &count);
  for (int64_t g = 0; g < system->altitude_group_count; g++)
    add_group(cost, "altitude", g, system->altitude_group[g].count, sized, &count);
  if (count > most) qsort(sized, (size_t)count, sizeof *sized, compare_sizes);
  cost->chosen_count = count < most ? count : most;
  for (int64_t k = 0; k < cost->chosen_count; k++)
    cost->row[sized[k].row].chosen = 1;
}

int32_t hooke_cost_list_rows(hooke_cost *cost) {
  enum { OTHERS = 4 };
  const hooke_system *system = cost->system;
  const int64_t groups = system->group_count + system->bending_group_count + system->altitude_group_count;
  struct sized *sized = hooke_new(groups + 1, sizeof *sized);
  cost->row = sized ? hooke_new(groups + OTHERS, sizeof *cost->row) : NULL;
  if (cost->row) {
    list_groups(cost, sized);
    add_other(cost, hooke_springs_are_damped(&system->springs) || system->altitudes.damped, "damping");
    add_other(cost, system->drag > 0.0, "drag");
    add_other(cost, system->force != NULL, "callback");
    add_other(cost, system->has_gravity, "gravity");
  }
  hooke_free(sized);
  return cost->row ? HOOKE_OK : HOOKE_NO_MEMORY;
}

/* ---- reading ---- */

const char *hooke_cost_method(const hooke_cost *cost) {
  return cost->method;
}

double hooke_cost_figure(const hooke_cost *cost, const char *what) {
  const struct hooke_figure figures[] = {{"step", cost->step},
                                         {"nanoseconds", cost->nanoseconds},
                                         {"resolution", cost->resolution},
                                         {"memory_bytes", cost->memory},
                                         {"step_limit", cost->limit}};
  return HOOKE_FIGURE(figures, what);
}

int64_t hooke_cost_row_count(const hooke_cost *cost) {
  return cost->row_count;
}

static const struct hooke_cost_row *row_at(const hooke_cost *cost, int64_t row) {
  return row >= 0 && row < cost->row_count ? &cost->row[row] : NULL;
}

const char *hooke_cost_text(const hooke_cost *cost, int64_t row, const char *what) {
  const struct hooke_cost_row *r = row_at(cost, row);
  if (r == NULL) return NULL;
  if (strcmp(what, "kind") == 0) return r->kind;
  if (strcmp(what, "name") != 0) return NULL;
  if (r->group < 0) return r->kind;
  if (hooke_cost_row_is(r, "altitude")) return hooke_system_altitude_group_name(cost->system, r->group);
  return hooke_cost_row_is(r, "bending") ? hooke_system_bending_group_name(cost->system, r->group)
                                         : hooke_system_group_name(cost->system, r->group);
}

double hooke_cost_number(const hooke_cost *cost, int64_t row, const char *what) {
  const struct hooke_cost_row *r = row_at(cost, row);
  if (r == NULL) return NAN;
  const int32_t grouped = r->group >= 0,
                sprung = grouped && !hooke_cost_row_is(r, "bending") && !hooke_cost_row_is(r, "altitude");
  const struct hooke_figure figures[] = {
      {"group", grouped ? (double)r->group : (double)NAN},
      {"springs", sprung ? (double)hooke_system_group_size(cost->system, r->group) : (double)NAN},
      {"nanoseconds", r->nanoseconds},
      {"resolution", r->resolution},
      {"memory_bytes", r->memory},
      {"step_limit_without", r->limit},
  };
  return HOOKE_FIGURE(figures, what);
}
