/* Cost of each ingredient: compares the scene with and without it. */
#include "measure/cost/cost.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/table/option.h"
#include "integrate/integrator.h"
#include "measure/limit/limit_predict.h"
#include "model/group.h"
#include "model/variant/variant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double ACCURACY = 1e-3;    /* of limits, relative */
static const double MOST_SECONDS = 0.2; /* of timing, for one ingredient */
static const double TIMING_SHARE = 0.5; /* of the budget; the rest is for scenes and limits */
static const double SOME_STEP = 1e-3;   /* [s], by default */

static const struct hk_option_row cost_rows[] = {
    HOOKE_OPTION("predict", .type = HOOKE_OPTION_FLAG, "false", "leave out the timing"),
    HOOKE_OPTION("budget", HOOKE_OPTION_POSITIVE("s"), "2",
                 "time after which no further ingredient is looked at; "
                 "half of it is for the timing, at most 0.2 s an ingredient"),
    HOOKE_OPTION("groups", HOOKE_OPTION_WHOLE(0.0, 2147483647.0), "64",
                 "how many groups are looked at at most, the largest; each takes as long as the whole scene"),
};

static const struct hk_option_table cost_table = {"cost", HOOKE_OPTION_ROWS(cost_rows)};

/* ---- listing the ingredients ---- */

static void add_row(struct hk_cost *cost, const char *kind, int64_t group, int64_t size) {
  if (size > 0)
    cost->row[cost->row_count++] =
        (struct hk_cost_row){.kind = kind, .group = group, .size = size, .chosen = 1};
}

static void add_groups(struct hk_cost *cost) {
  const hooke_system *system = cost->m->system;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    add_row(cost, group->force->name, g, group->count);
  }
}

static void add_others(struct hk_cost *cost) {
  const hooke_system *system = cost->m->system;
  add_row(cost, "damping", -1, hk_system_has_dampers(system));
  for (int32_t k = 0; hk_force_table(k); k++)
    if (hk_force_table(k)->copy)
      add_row(cost, hk_force_table(k)->name, -1, hk_force_is_present(system, hk_force_table(k)));
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
  const int64_t count = cost->row_count, most = (int64_t)hooke_options_number(cost->m->options, "groups");
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

/* Lists the ingredients, and selects those without group and as many groups as the options say. */
static int32_t list_rows(struct hk_cost *cost) {
  const hooke_system *system = cost->m->system;
  cost->row = hk_new(system->group_count + 1 + HOOKE_FORCES, sizeof *cost->row);
  if (cost->row == NULL) return HOOKE_NO_MEMORY;
  add_groups(cost);
  const int32_t status = leave_small_groups_out(cost);
  add_others(cost);
  for (int64_t k = 0; k < cost->row_count; k++)
    cost->chosen_count += cost->row[k].chosen;
  return status;
}

const char *hk_cost_row_name(const struct hk_cost *cost, const struct hk_cost_row *row) {
  return row->group < 0 ? row->kind : cost->m->system->group[row->group].name;
}

/* ---- creating ---- */

/* The options of the run with a method that can be timed; its duration is irrelevant. */
static int32_t choose_method(struct hk_cost *cost) {
  const char *method = hooke_options_text(cost->m->run, "method");
  int32_t status = HOOKE_OK;
  cost->run_step = hooke_options_number(cost->m->run, "step");
  if (hooke_method_is_adaptive(method) != 0 || !hooke_method_is_built(method) ||
      !hk_method_suits(method, cost->m->system))
    status = hooke_options_set_text(cost->m->run, "method", hk_method_of_euler(cost->m->system));
  if (status == HOOKE_OK) status = hooke_options_unset(cost->m->run, "duration");
  if (status == HOOKE_OK) status = hooke_options_unset(cost->m->run, "every");
  cost->method = hooke_options_text(cost->m->run, "method");
  return status;
}

/* Results. */
static void forget(struct hk_cost *cost) {
  cost->nanoseconds = cost->resolution = cost->memory = cost->limit = NAN;
  for (int64_t k = 0; k < cost->row_count; k++) {
    struct hk_cost_row *row = &cost->row[k];
    row->nanoseconds = row->resolution = row->memory = row->limit = NAN;
  }
}

static int32_t create(hooke_measurement *m) {
  int32_t status = m->run ? HOOKE_OK : hk_options_create(&hk_run_options, &m->run);
  struct hk_cost *cost = m->object = status == HOOKE_OK ? hk_new(1, sizeof *cost) : NULL;
  if (cost == NULL) return HOOKE_NO_MEMORY;
  cost->m = m;
  cost->step = NAN;
  status = choose_method(cost);
  if (status == HOOKE_OK) status = list_rows(cost);
  forget(cost);
  return status;
}

static void destroy(void *object) {
  struct hk_cost *cost = object;
  if (cost) hk_free(cost->row);
  hk_free(cost);
}

static int32_t tell(struct hk_cost *cost, double done, const char *what) {
  cost->told = done;
  return hk_measurement_tell(cost->m, done, what);
}

/* ---- the time of a step ---- */

/* A block is long against the clock's resolution and short against disturbances of the machine. Loading and
 * checking the state is not timed; a few steps a block are worth it. */
static const double BLOCK = 1e-3; /* [s] */
enum { FEWEST_STEPS = 4, MOST_STEPS = 1000, FEWEST_ROUNDS = 2, BLOCKS_OF_ROUND = 3 };

/* An integrator with a state, and the time of a step in its shortest blocks [ns]. */
struct timed {
  hooke_integrator *integrator;
  hooke_state *state;
  double best[2]; /* of two series; infinite before the first block */
};

/* timed_release() has to follow, after a failure too. */
static int32_t timed_create(const hooke_system *system, const hooke_options *run, struct timed *timed) {
  *timed = (struct timed){.best = {INFINITY, INFINITY}};
  const int32_t status = hooke_integrator_create(system, run, &timed->integrator);
  return status == HOOKE_OK ? hooke_state_create(system, &timed->state) : status;
}

static void timed_release(struct timed *timed) {
  hooke_integrator_destroy(timed->integrator);
  hooke_state_destroy(timed->state);
  memset(timed, 0, sizeof *timed);
}

/* One block; `nanoseconds` of a step, infinite if none was taken. A run that diverges has taken its steps
 * nevertheless. */
static int32_t run_block(struct timed *timed, const hooke_state *start, int64_t steps, double *nanoseconds) {
  hooke_integrator *it = timed->integrator;
  int32_t status = hooke_state_copy(start, timed->state);
  const double seconds = hooke_integrator_number(it, "wall_seconds");
  const int64_t before = hooke_integrator_count(it, "steps");
  if (status == HOOKE_OK) status = hooke_integrator_step(it, timed->state, steps);
  const int64_t taken = hooke_integrator_count(it, "steps") - before;
  *nanoseconds = taken > 0 ? 1e9 * (hooke_integrator_number(it, "wall_seconds") - seconds) / (double)taken
                           : (double)INFINITY;
  return status == HOOKE_DIVERGED || status == HOOKE_SOLVER_FAILED ? HOOKE_OK : status;
}

static int32_t time_block(struct timed *timed, int series, const hooke_state *start, int64_t steps) {
  double nanoseconds;
  const int32_t status = run_block(timed, start, steps, &nanoseconds);
  timed->best[series] = fmin(timed->best[series], nanoseconds);
  return status;
}

/* Runs blocks of `full`, `lean` and `full` again in turn, each from `start`, for about `seconds`, two rounds
 * at least. Both series of `full` are kept, whose difference measures the noise, and the first of `lean`.
 * Times stay infinite if the method can take no step. HOOKE_STOPPED by a callback; failures of the method are
 * not failures here. */
static int32_t timed_compare(struct timed *full, struct timed *lean, const hooke_state *start,
                             double seconds) {
  const double begun = hk_clock_seconds();
  double first;
  int32_t status = run_block(full, start, FEWEST_STEPS, &first);
  const double block = fmin(BLOCK, seconds / (BLOCKS_OF_ROUND * FEWEST_ROUNDS));
  const double wanted = ceil(block / (1e-9 * first));
  const int64_t steps = (int64_t)fmax(FEWEST_STEPS, fmin(MOST_STEPS, wanted));
  full->best[0] = full->best[1] = INFINITY;
  for (int64_t round = 0; status == HOOKE_OK; round++) {
    if (round >= FEWEST_ROUNDS && hk_clock_seconds() - begun > seconds) break;
    status = time_block(full, 0, start, steps);
    if (status == HOOKE_OK) status = time_block(lean, 0, start, steps);
    if (status == HOOKE_OK) status = time_block(full, 1, start, steps);
  }
  return status;
}

/* ---- measuring ---- */

/* Repeats the last progress report. */
static int32_t tell_limits(double done, const char *what, void *ctx) {
  const struct hk_cost *cost = ctx;
  (void)done, (void)what;
  return hk_measurement_tell(cost->m, cost->told, "limits");
}

/* NaN if this build, the method or these numbers have none, or time is up. */
static int32_t find_limit(struct hk_cost *cost, const hooke_system *system, const hooke_state *state,
                          double *limit) {
  const double *q = hooke_state_position((hooke_state *)state);
  *limit = NAN;
  const int32_t status =
      hk_limit_predict_within(system, q, NULL, cost->method, NULL, NULL, ACCURACY, 0.0, &cost->budget, limit);
  return status == HOOKE_NO_MEMORY || (status == HOOKE_STOPPED && cost->budget.stopped) ? status : HOOKE_OK;
}

/* Limit of the full scene, in the fraction of the budget that is not for timing. */
static int32_t find_first_limit(struct hk_cost *cost, const hooke_state *state) {
  hk_budget_lend(&cost->budget, 1.0 - TIMING_SHARE);
  const int32_t status = find_limit(cost, cost->m->system, state, &cost->limit);
  (void)hk_budget_take_back(&cost->budget);
  return status;
}

/* The step of the run, or a stable one if that is not: the cost of a step does not depend on its size, but
 * may depend on non-finite numbers. */
static int32_t choose_step(struct hk_cost *cost, const hooke_state *state) {
  const double *q = hooke_state_position((hooke_state *)state);
  double step = cost->run_step, safe = cost->limit;
  const int32_t status =
      isnan(safe) ? hooke_step_bound(cost->m->system, cost->method, q, &safe) : HOOKE_OK; /* one pass */
  if (status != HOOKE_OK) return status;
  if (safe > 0.0) step = fmin(step, safe); /* also if there is none */
  if (!isfinite(step)) step = SOME_STEP;
  cost->step = step;
  const int32_t set = hooke_options_set_number(cost->m->run, "step", step);
  return set == HOOKE_OK ? hooke_step_settle(cost->m->system, cost->m->run) : set;
}

static double memory_of(const hooke_system *system, const struct timed *timed) {
  const int64_t state = (2 * hooke_state_size(timed->state) + 1) * (int64_t)sizeof(double);
  return (double)(hooke_system_count(system, "memory") + state +
                  hooke_integrator_count(timed->integrator, "memory_bytes"));
}

static int32_t time_row(struct hk_cost *cost, struct timed *full, struct timed *lean,
                        const hooke_state *state, struct hk_cost_row *row) {
  if (hooke_options_number(cost->m->options, "predict") != 0.0) return HOOKE_OK;
  const double fraction =
      TIMING_SHARE * hooke_options_number(cost->m->options, "budget") / (double)cost->chosen_count;
  const int32_t status = timed_compare(full, lean, state, fmin(MOST_SECONDS, fraction));
  const double with = 0.5 * (full->best[0] + full->best[1]), without = lean->best[0];
  if (!isfinite(with) || !isfinite(without)) return status;
  row->nanoseconds = fmax(0.0, with - without);
  row->resolution = fabs(full->best[0] - full->best[1]);
  cost->nanoseconds = fmin(cost->nanoseconds, fmin(full->best[0], full->best[1]));
  cost->resolution = fmax(cost->resolution, row->resolution);
  return status;
}

/* The system without the ingredient of a row; NULL: the full one. */
static int32_t make_without(const struct hk_cost *cost, const struct hk_cost_row *row, hooke_system **made) {
  const struct hk_force_row *force = row ? hk_force_find(row->kind) : NULL; /* NULL: damping of all */
  struct hk_variant variant;
  struct hk_variant_map map;
  int32_t status = hk_variant_create(cost->m->system, &variant);
  if (status != HOOKE_OK) return status;
  if (row && row->group >= 0) variant.group[row->group] = 1;
  if (row && force && row->group < 0) variant.without[hk_force_number(force)] = 1;
  variant.damping = row && !force;
  status = hk_variant_make(cost->m->system, &variant, made, &map);
  if (status == HOOKE_OK) hk_variant_map_release(&map);
  hk_variant_release(&variant);
  return status;
}

static int32_t measure_row(struct hk_cost *cost, struct timed *full, const hooke_system *system,
                           const hooke_state *state, struct hk_cost_row *row) {
  const struct hk_force_row *force = hk_force_find(row->kind);
  const int32_t limits = force == NULL || force->elements;
  struct timed lean;
  int32_t status = timed_create(system, cost->m->run, &lean);
  if (status == HOOKE_OK) row->memory = fmax(0.0, cost->memory - memory_of(system, &lean));
  row->limit = cost->limit;
  if (status == HOOKE_OK && limits) status = find_limit(cost, system, state, &row->limit);
  if (status == HOOKE_OK) status = time_row(cost, full, &lean, state, row);
  timed_release(&lean);
  return status;
}

static int32_t find_row(struct hk_cost *cost, struct timed *full, const hooke_state *state,
                        struct hk_cost_row *row) {
  hooke_system *lean = NULL;
  int32_t status = make_without(cost, row, &lean);
  if (status == HOOKE_OK) status = measure_row(cost, full, lean, state, row);
  hooke_system_destroy(lean);
  return status;
}

/* Measures the selected rows, until the budget is spent: the rest stays unknown. */
static int32_t find_rows(struct hk_cost *cost, struct timed *full, const hooke_state *state, double begun) {
  const double budget = hooke_options_number(cost->m->options, "budget");
  int32_t status = HOOKE_OK;
  for (int64_t k = 0, done = 0; k < cost->row_count && status == HOOKE_OK; k++) {
    struct hk_cost_row *row = &cost->row[k];
    if (!row->chosen) continue;
    if (hk_clock_seconds() - begun > budget) break;
    status = tell(cost, (double)done++ / (double)cost->chosen_count, hk_cost_row_name(cost, row));
    if (status == HOOKE_OK) status = find_row(cost, full, state, row);
  }
  return status;
}

/* The full scene is rebuilt, too, so that both sides get their memory in the same way. */
static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_cost *cost = m->object;
  hooke_system *whole = NULL;
  struct timed full = {0};
  const double begun = hk_clock_seconds();
  forget(cost);
  cost->budget = hk_budget_of(hooke_options_number(cost->m->options, "budget"), tell_limits, cost);
  int32_t status = tell(cost, 0.0, "limits");
  if (status == HOOKE_OK) status = find_first_limit(cost, state);
  if (status == HOOKE_OK) status = choose_step(cost, state);
  if (status == HOOKE_OK) status = make_without(cost, NULL, &whole);
  if (status == HOOKE_OK) status = timed_create(whole, cost->m->run, &full);
  if (status == HOOKE_OK) cost->memory = memory_of(whole, &full);
  if (status == HOOKE_OK) status = find_rows(cost, &full, state, begun);
  timed_release(&full);
  hooke_system_destroy(whole);
  return status;
}

const struct hk_measurement_kind hk_cost_kind = {
    .name = "cost",
    .options = &cost_table,
    .takes_state = 1,
    .tables = hk_cost_tables,
    .claim = hk_cost_claim,
    .create = create,
    .run = run,
    .destroy = destroy,
};
