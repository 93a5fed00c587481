/* Creating a diagnosis. */
#include "measure/why/why.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "integrate/loop/run_loop.h"
#include "measure/counted_work/work.h"
#include "measure/spectrum/linearised.h"
#include "model/callbacks.h"
#include "model/size_limit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Fraction of its time after which no work is started. */
static const double PUNCTUAL = 0.85;

static const double LEAST_SECONDS = 2.0, LEAST_BYTES = 16e6, SHARE_OF_MEMORY = 0.4;

/* Counted work of an evaluation with a callback [s]: a script takes about so long, and nobody knows,
 * unless its force is of a shared library. */
static const double CALLBACK = 5e-5;

static const struct hk_option_row why_rows[] = {
    HOOKE_OPTION("budget", HOOKE_OPTION_POSITIVE("s"), NULL,
                 "wall time that the explanation may take; if not given, as much counted work as the run "
                 "took, or 2 s if that is more, which is the same however busy the machine is"),
};

static const struct hk_option_table why_table = {"why", HOOKE_OPTION_ROWS(why_rows)};

static int ended_early(const hooke_integrator *run) {
  return run->outcome == HOOKE_DIVERGED || run->outcome == HOOKE_SOLVER_FAILED ||
         run->outcome == HOOKE_STEP_LIMIT;
}

/* ---- limits on time and memory ---- */

const hooke_state *hk_inquiry_last(const struct hk_inquiry *inquiry) {
  return inquiry->last ? inquiry->last : hk_recent_state(&inquiry->run->recent, 0, NULL);
}

/* Appends to a list of skipped work. */
static void leave_out(char *list, size_t size, const char *what) {
  if (strstr(list, what) == NULL) hk_append(list, size, "%s%s", list[0] ? ", " : "", what);
}

int32_t hk_inquiry_has_memory(struct hk_inquiry *inquiry, double bytes, const char *what) {
  if (bytes <= inquiry->memory_limit - inquiry->memory_used) return 1;
  leave_out(inquiry->no_space, sizeof inquiry->no_space, what);
  return 0;
}

double hk_why_work_of(const hooke_integrator *run) {
  const double callback = hk_system_calls_back(run->system) && !hk_force_from(run->system) ? CALLBACK : 0.0;
  return hk_work_of(run) + callback * (double)run->count.force_evaluations;
}

void hk_inquiry_spend(struct hk_inquiry *inquiry, const hooke_integrator *run, double *before) {
  const double now = hk_why_work_of(run);
  hk_budget_spend(&inquiry->budget, now - *before);
  *before = now;
}

void hk_inquiry_end_part(struct hk_inquiry *inquiry, const char *what) {
  if (hk_budget_take_back(&inquiry->budget)) leave_out(inquiry->no_time, sizeof inquiry->no_time, what);
}

static void tell_left_out(struct hk_inquiry *inquiry) {
  char *text = inquiry->why->left_out;
  const size_t size = sizeof inquiry->why->left_out;
  if (inquiry->no_time[0])
    hk_print(text, size, "not known, since time was short (%.3g s%s): %s",
             (inquiry->budget.end - inquiry->budget.begun) / PUNCTUAL,
             inquiry->budget.counted ? " of counted work" : "", inquiry->no_time);
  if (inquiry->no_space[0])
    hk_append(text, size, "%snot known, since memory was short (%.3g MB): %s", text[0] ? "; " : "",
              1e-6 * inquiry->memory_limit, inquiry->no_space);
}

/* Nearly half of the memory of the run, as memory has gaps: its current memory, or that of building the
 * scene. */
static double usual_space(const hooke_integrator *run) {
  const hooke_system *system = run->system;
  const double built = hk_system_needed_bytes(system, (struct hk_more){0});
  const double held =
      (double)(hooke_system_count(system, "memory") + hooke_integrator_count(run, "memory_bytes")) +
      2.0 * (double)run->size * sizeof(double);
  return fmax(LEAST_BYTES, SHARE_OF_MEMORY * fmax(built, held));
}

static void begin_inquiry(struct hk_inquiry *inquiry) {
  const hooke_system *system = inquiry->system;
  enum { SHAPES = 16 }; /* numbers a coordinate, of a limit with its modes */
  inquiry->memory_limit = usual_space(inquiry->run);
  const double spectrum = hk_linearised_bytes(system) + SHAPES * (double)inquiry->run->size * sizeof(double);
  inquiry->large = spectrum > inquiry->memory_limit;
  inquiry->violation.bound = NAN;
}

static int32_t replay(struct hk_inquiry *inquiry) {
  enum { NUMBERS = 4 + 1 + 2 }; /* a coordinate: blocks, positions one step ago, a state */
  const double bytes = (double)hooke_integrator_count(inquiry->run, "memory_bytes") +
                       NUMBERS * (double)inquiry->run->size * sizeof(double);
  if (!hk_inquiry_has_memory(inquiry, bytes, "the last steps again")) return HOOKE_OK;
  hk_budget_lend(&inquiry->budget, 0.4);
  int32_t status = hk_state_create_sized(hk_integrator_numbers(inquiry->run), 1, &inquiry->last);
  if (status == HOOKE_OK) status = hk_inquiry_replay(inquiry);
  hk_inquiry_end_part(inquiry, "the last steps again");
  return status;
}

/* For a large scene the cheapest check first; if it gives the cause, the others are skipped. */
static int32_t survey(struct hk_inquiry *inquiry) {
  struct hk_node_blocks blocks;
  const double bytes = 12.0 * (double)inquiry->system->particle_count * sizeof(double);
  if (!inquiry->large || inquiry->run->method->adaptive) return HOOKE_OK;
  if (!hk_inquiry_has_memory(inquiry, bytes, "whether the step is above the limit")) return HOOKE_OK;
  inquiry->memory_used += bytes;
  hk_budget_lend(&inquiry->budget, 0.8);
  int32_t status = hk_node_blocks_begin(inquiry->system, &blocks);
  blocks.budget = &inquiry->budget;
  if (status == HOOKE_OK) {
    status = hk_inquiry_survey(inquiry, &blocks);
    hk_node_blocks_release(&blocks);
  }
  if (inquiry->violation.found)
    hk_budget_take_back(&inquiry->budget);
  else
    hk_inquiry_end_part(inquiry, "whether the step is above the limit");
  inquiry->memory_used -= bytes;
  return status;
}

static void release_growing(struct hk_inquiry *inquiry) {
  if (inquiry->growing.x) inquiry->memory_used -= hk_growing_bytes(inquiry->system);
  hk_growing_release(&inquiry->growing);
}

static int32_t find_out(struct hk_inquiry *inquiry) {
  int32_t status = survey(inquiry);
  if (status == HOOKE_OK && !inquiry->violation.found && !inquiry->budget.stopped) status = replay(inquiry);
  release_growing(inquiry);
  if (status == HOOKE_OK && !inquiry->budget.stopped) status = hk_inquiry_judge(inquiry);
  if (status == HOOKE_OK && !inquiry->budget.stopped) status = hk_inquiry_advise(inquiry);
  if (!inquiry->budget.stopped) return status;
  return hk_fail(HOOKE_STOPPED, NULL, "the progress callback asked to stop");
}

static int32_t inquire(struct hk_inquiry *inquiry) {
  begin_inquiry(inquiry);
  inquiry->violation.q = hk_new(inquiry->run->size, sizeof(double));
  inquiry->memory_used = (double)inquiry->run->size * sizeof(double);
  const int32_t status = inquiry->violation.q ? find_out(inquiry) : HOOKE_NO_MEMORY;
  tell_left_out(inquiry);
  hk_growing_release(&inquiry->growing);
  hk_participation_release(&inquiry->violation.participation);
  hk_free(inquiry->violation.q);
  hooke_state_destroy(inquiry->last);
  hooke_measurement_destroy(inquiry->limit);
  return status;
}

/* ---- creating ---- */

static int32_t check(const hooke_integrator *run) {
  const int32_t status =
      hk_integrator_require_particles(run, NULL, "has no springs; its own message is all there is");
  if (status != HOOKE_OK) return status;
  if (!ended_early(run))
    return hk_fail(HOOKE_BAD_CALL, NULL,
                   "the last run of this integrator did not blow up: there is nothing to explain");
  if (run->recent.capacity == 0)
    return hk_fail(HOOKE_NO_MEMORY, NULL, "there was no memory for the last good state, to explain from");
  return HOOKE_OK;
}

static int32_t create(hooke_measurement *m) {
  ((struct hk_why *)m->object)->measurement = m;
  if (HOOKE_HAVE_LAPACK) return HOOKE_OK;
  return hk_fail(HOOKE_NOT_BUILT, NULL, "explanations need LAPACK, which this build is without");
}

static void forget(struct hk_why *why) {
  for (int64_t k = 0; k < why->advice_count; k++)
    hooke_options_destroy(why->advice[k].run);
  why->limiting.count = why->advice_count = 0;
  why->cause = NULL;
  why->sentence[0] = why->left_out[0] = why->method[0] = '\0';
  why->time = why->noticed = why->limit = why->particle = why->step = NAN;
}

static void drop_states(struct hk_why *why) {
  hooke_state_destroy(why->first);
  hooke_state_destroy(why->last);
  why->first = why->last = NULL;
}

static void destroy(void *object) {
  struct hk_why *why = object;
  if (why == NULL) return;
  forget(why);
  drop_states(why);
  hk_why_start_release(&why->start);
  hooke_integrator_destroy(why->own);
  hk_free(why);
}

int32_t hooke_why_create(const hooke_integrator *run, const hooke_options *options, hooke_measurement **out) {
  const int32_t status = check(run);
  if (status != HOOKE_OK) return status;
  struct hk_why *why = hk_new(1, sizeof *why);
  if (why == NULL) return HOOKE_NO_MEMORY;
  why->integrator = run;
  why->system = run->system;
  forget(why);
  return hk_measurement_create(&hk_why_kind, why, run->system, run->options, options, out);
}

static int32_t copy_state(const hooke_integrator *run, const hooke_state *from, hooke_state **copy) {
  int32_t status = hk_run_check_state(run, from);
  if (status == HOOKE_OK) status = hk_state_create_sized(hk_integrator_numbers(run), 1, copy);
  return status == HOOKE_OK ? hooke_state_copy(from, *copy) : status;
}

int32_t hooke_why_create_kept(const hooke_system *system, const hooke_options *run, const hooke_state *first,
                              const hooke_state *last, const hooke_options *options,
                              hooke_measurement **out) {
  struct hk_why *why = hk_new(1, sizeof *why);
  if (why == NULL) return HOOKE_NO_MEMORY;
  forget(why);
  int32_t status = hooke_integrator_create(system, run, &why->own);
  if (status == HOOKE_OK) status = copy_state(why->own, first, &why->first);
  if (status == HOOKE_OK) status = copy_state(why->own, last, &why->last);
  if (status == HOOKE_OK) {
    why->integrator = why->own;
    why->system = system;
    return hk_measurement_create(&hk_why_kind, why, system, run, options, out);
  }
  destroy(why);
  return status;
}

/* ---- running ---- */

/* Continues from the last kept state until the run ends early. */
static int32_t run_on(struct hk_why *why) {
  hooke_state *state = NULL;
  int32_t status = copy_state(why->own, why->last, &state);
  if (status == HOOKE_OK) status = hk_integrator_run_on(why->own, why->first, state);
  hooke_state_destroy(state);
  if (!ended_early(why->own)) return status == HOOKE_OK ? check(why->own) : status;
  drop_states(why);
  return HOOKE_OK;
}

/* The caller's in wall time; else as much work as the run was. */
static struct hk_budget budget_of(const hooke_integrator *run, const hooke_measurement *m) {
  const double budget = hooke_options_number(m->options, "budget");
  if (!isnan(budget)) return hk_budget_of(PUNCTUAL * budget, m->progress, m->progress_ctx);
  return hk_budget_of_work(PUNCTUAL * fmax(LEAST_SECONDS, hk_why_work_of(run)), m->progress, m->progress_ctx);
}

static int32_t explain(struct hk_why *why, const hooke_measurement *m) {
  const hooke_integrator *run = why->integrator;
  const int32_t status = check(run);
  if (status != HOOKE_OK) return status;
  why->noticed = run->outcome == HOOKE_DIVERGED ? run->diverged_at : run->t;
  if (!run->method->adaptive) why->step = run->schedule.step;
  snprintf(why->method, sizeof why->method, "%s", run->method->name);
  hooke_system seen = *run->system;
  seen.explicit_damping = run->explicit_damping;
  struct hk_inquiry inquiry = {.run = run,
                               .system = &seen,
                               .why = why,
                               .bad_particle = -1,
                               .force = -1,
                               .flipped = -1,
                               .budget = budget_of(run, m)};
  return inquire(&inquiry);
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_why *why = m->object;
  int32_t status = hk_measurement_require_fresh(m, state);
  if (status != HOOKE_OK) return status;
  if (why->first) status = run_on(why);
  if (status == HOOKE_OK) status = explain(why, m);
  if (status == HOOKE_OK) status = hk_why_start_keep(why->integrator, &why->start);
  if (status != HOOKE_OK) forget(why); /* what was only begun is not known */
  return status;
}

const struct hk_measurement_kind hk_why_kind = {
    .name = "why",
    .options = &why_table,
    .made_by = "hooke_why_create()",
    .tables = hk_why_tables,
    .claim = hk_why_claim,
    .create = create,
    .run = run,
    .destroy = destroy,
};

int32_t hooke_why_advice_apply(const hooke_measurement *m, int64_t row, hooke_options *run) {
  int32_t status = hk_measurement_require(m, &hk_why_kind, "hooke_why_advice_apply");
  if (status != HOOKE_OK) return status;
  const struct hk_why *why = m->object;
  if (row < 0 || row >= why->advice_count) {
    return hk_fail(HOOKE_BAD_VALUE, "row", "there is no advice %lld; there are %lld", (long long)row,
                   (long long)why->advice_count);
  }
  status = hk_run_options_require(run, "run");
  const hooke_options *changes = why->advice[row].run;
  return status == HOOKE_OK && changes ? hk_options_set_from(run, changes) : status;
}
