/* Making a comparison, and reading it. */
#include "measure/comparison.h"

#include "core/memory.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "measure/node_blocks.h"

#include <math.h>
#include <string.h>

int32_t hooke_comparison_create(const hooke_system *system, const hooke_options *options,
                                hooke_comparison **out) {
  int32_t status = hooke_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  if (!hooke_method_is_built("cvode-adams")) {
    return hooke_fail(HOOKE_NOT_BUILT, NULL,
                      "a comparison needs SUNDIALS for its reference, which this build is without");
  }
  hooke_comparison *c = hooke_new(1, sizeof *c);
  if (c == NULL) return HOOKE_NO_MEMORY;
  c->system = system;
  status = hooke_options_copy(options, &c->options);
  if (status == HOOKE_OK)
    *out = c;
  else
    hooke_comparison_destroy(c);
  return status;
}

static void release_room(hooke_comparison *c) {
  for (int64_t k = 0; k < c->row_count; k++) {
    hooke_free(c->row[k].error_at);
    hooke_free(c->row[k].drift_at);
    c->row[k].error_at = c->row[k].drift_at = NULL;
  }
  hooke_free(c->time);
  hooke_free(c->energy);
  hooke_free(c->position);
  hooke_free(c->free);
  c->time = c->energy = c->position = NULL;
  c->free = NULL;
  c->reference = NULL;
}

void hooke_comparison_destroy(hooke_comparison *c) {
  if (c == NULL) return;
  release_room(c);
  for (int64_t k = 0; k < c->row_count; k++)
    hooke_free(c->row[k].method);
  hooke_options_destroy(c->options);
  hooke_free(c->row);
  hooke_free(c);
}

int32_t hooke_comparison_add(hooke_comparison *c, const char *method) {
  if (c->reference) {
    return hooke_fail(HOOKE_BAD_CALL, NULL,
                      "the comparison is under way; add methods before it is run or written");
  }
  if (hooke_method_is_adaptive(method) < 0) {
    return hooke_fail(HOOKE_BAD_VALUE, "method", "there is no method \"%s\"", method);
  }
  if (!hooke_method_is_built(method)) {
    return hooke_fail(HOOKE_NOT_BUILT, "method", "this build is without %s", method);
  }
  if (c->row_count == c->row_capacity) {
    const int64_t capacity = 2 * c->row_capacity + 4;
    const int32_t status = hooke_grow((void **)&c->row, c->row_count, capacity, sizeof *c->row);
    if (status != HOOKE_OK) return status;
    c->row_capacity = capacity;
  }
  char *name = hooke_copy_text(method);
  if (name == NULL) return HOOKE_NO_MEMORY;
  c->row[c->row_count++] = (struct hooke_comparison_row){.method = name};
  return HOOKE_OK;
}

void hooke_comparison_on_progress(hooke_comparison *comparison, hooke_progress *progress, void *ctx) {
  comparison->progress = progress;
  comparison->progress_ctx = ctx;
}

void hooke_comparison_on_frame(hooke_comparison *comparison, hooke_comparison_frame *observer, void *ctx) {
  comparison->on_frame = observer;
  comparison->on_frame_ctx = ctx;
}

/* ---- preparing ---- */

/* Where damping is faster than the fastest oscillation, fast motion dies out and an implicit method strides
 * over it; where it is not, every method has to follow the oscillation, and Adams does so at the lower cost.
 */
static int32_t choose_reference(hooke_comparison *c, const double *q) {
  struct hooke_node_blocks blocks;
  const int32_t status = hooke_node_blocks_create(c->system, q, &blocks);
  c->reference = "cvode-adams";
  if (status == HOOKE_NOT_BUILT) return HOOKE_OK;
  if (status != HOOKE_OK) return status;
  if (hooke_node_blocks_damping_rate(&blocks) > 2.0 * hooke_node_blocks_frequency(&blocks))
    c->reference = "cvode-bdf";
  hooke_node_blocks_release(&blocks);
  return HOOKE_OK;
}

static int32_t find_free_particles(hooke_comparison *c) {
  c->free_count = 0;
  c->free = hooke_new(hooke_system_free_count(c->system), sizeof *c->free);
  if (c->free == NULL) return HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < c->system->particle_count; p++) {
    if (!c->system->held[p]) c->free[c->free_count++] = p;
  }
  return HOOKE_OK;
}

/* The schedule that all rows share: the one of a fixed-step method if the options have a step. */
static int32_t read_schedule(hooke_comparison *c) {
  struct hooke_schedule schedule;
  int has_fixed = 0;
  for (int64_t k = 0; k < c->row_count; k++)
    has_fixed |= !hooke_method_is_adaptive(c->row[k].method);
  const struct hooke_method *method = hooke_method_find(has_fixed ? "forward-euler" : "cvode-adams");
  const int32_t status = hooke_schedule_read(method, c->options, &schedule);
  if (status != HOOKE_OK) return status;
  if (schedule.frames == 0) {
    return hooke_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
  }
  c->frame_count = schedule.frames;
  c->duration = schedule.duration;
  return HOOKE_OK;
}

static int32_t make_room(hooke_comparison *c) {
  c->time = hooke_new(c->frame_count, sizeof(double));
  c->energy = hooke_new(c->frame_count, sizeof(double));
  c->position = hooke_new(c->frame_count, 3 * sizeof(double) * (size_t)(c->system->particle_count + 1));
  if (c->time == NULL || c->energy == NULL || c->position == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < c->row_count; k++) {
    c->row[k].error_at = hooke_new(c->frame_count, sizeof(double));
    c->row[k].drift_at = hooke_new(c->frame_count, sizeof(double));
    if (c->row[k].error_at == NULL || c->row[k].drift_at == NULL) return HOOKE_NO_MEMORY;
  }
  return HOOKE_OK;
}

static int32_t add_all_methods(hooke_comparison *c) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < hooke_method_count() && status == HOOKE_OK; k++) {
    if (hooke_method_is_built(hooke_method_name(k))) status = hooke_comparison_add(c, hooke_method_name(k));
  }
  return status;
}

int32_t hooke_comparison_prepare(hooke_comparison *c) {
  if (c->reference) return HOOKE_OK;
  int32_t status = c->row_count == 0 ? add_all_methods(c) : HOOKE_OK;
  hooke_state *state = NULL;
  if (status == HOOKE_OK) status = read_schedule(c);
  if (status == HOOKE_OK) status = hooke_state_create(c->system, &state);
  if (status == HOOKE_OK) status = find_free_particles(c);
  if (status == HOOKE_OK) status = make_room(c);
  if (status == HOOKE_OK) status = choose_reference(c, hooke_state_position(state));
  hooke_state_destroy(state);
  if (status != HOOKE_OK) release_room(c);
  return status;
}

/* ---- reading ---- */

int64_t hooke_comparison_row_count(const hooke_comparison *comparison) {
  return comparison->row_count;
}

static const struct hooke_comparison_row *row_at(const hooke_comparison *c, int64_t row) {
  return row >= 0 && row < c->row_count ? &c->row[row] : NULL;
}

const char *hooke_comparison_text(const hooke_comparison *c, int64_t row, const char *what) {
  const struct hooke_comparison_row *r = row_at(c, row);
  if (r == NULL) return NULL;
  if (strcmp(what, "method") == 0) return r->method;
  return strcmp(what, "status") == 0 ? (r->status ? r->status : "not run") : NULL;
}

double hooke_comparison_number(const hooke_comparison *c, int64_t row, const char *what) {
  const struct hooke_comparison_row *r = row_at(c, row);
  if (r == NULL || r->status == NULL) return NAN;
  const struct {
    const char *name;
    double value;
  } numbers[] = {
      {"step", r->step},
      {"rtol", r->rtol},
      {"atol", r->atol},
      {"error", r->error},
      {"error_max", r->error_max},
      {"error_final", r->error_final},
      {"energy_drift", r->energy_drift},
      {"force_evaluations", r->force_evaluations},
      {"steps", r->steps},
      {"wall_seconds", r->wall_seconds},
  };
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
    if (strcmp(numbers[k].name, what) == 0) return numbers[k].value;
  }
  return NAN;
}

const char *hooke_comparison_reference(const hooke_comparison *comparison) {
  return comparison->reference ? comparison->reference : "";
}

int64_t hooke_comparison_frame_count(const hooke_comparison *comparison) {
  return comparison->frame_count;
}

const double *hooke_comparison_series(const hooke_comparison *c, int64_t row, const char *what) {
  const struct hooke_comparison_row *r = row_at(c, row);
  if (strcmp(what, "time") == 0) return c->time;
  if (r == NULL) return NULL;
  if (strcmp(what, "error") == 0) return r->error_at;
  return strcmp(what, "energy_drift") == 0 ? r->drift_at : NULL;
}
