/* Measurements: creating, running, reading tables. */
#include "measure/measurement.h"

#include "core/handle.h"
#include "core/memory.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "model/callbacks.h"
#include "model/generalized.h"
#include "model/state.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

/* ---- creating ---- */

static int32_t check(const struct hk_measurement_kind *kind, const hooke_system *system,
                     const hooke_options *run, const hooke_options *options) {
  int32_t status = system ? hk_system_require_committed(system) : HOOKE_OK;
  if (status == HOOKE_OK && system) status = hk_callbacks_require(system);
  if (status == HOOKE_OK && system && !kind->takes_problems)
    status = hk_system_require_scene(system, kind->name, "");
  if (status == HOOKE_OK && (run || kind->needs_run)) status = hk_run_options_require(run, "run");
  if (status == HOOKE_OK && options)
    status = hk_options_require(options, kind->options, "options", kind->name);
  return status;
}

int32_t hk_measurement_create(const struct hk_measurement_kind *kind, void *object,
                              const hooke_system *system, const hooke_options *run,
                              const hooke_options *options, hooke_measurement **out) {
  int32_t status = check(kind, system, run, options);
  hooke_measurement *m = status == HOOKE_OK ? hk_handle_new("hooke_measurement", sizeof *m) : NULL;
  if (m == NULL) {
    kind->destroy(object);
    return status == HOOKE_OK ? HOOKE_NO_MEMORY : status;
  }
  m->kind = kind;
  m->object = object;
  m->system = system;
  if (run) status = hooke_options_copy(run, &m->run);
  if (status == HOOKE_OK)
    status =
        options ? hooke_options_copy(options, &m->options) : hk_options_create(kind->options, &m->options);
  if (status == HOOKE_OK) status = kind->create(m);
  return HOOKE_HAND_OVER(status, m, out, hooke_measurement_destroy);
}

void hooke_measurement_destroy(hooke_measurement *m) {
  if (m == NULL) return;
  m->kind->destroy(m->object);
  for (int k = 0; k < HOOKE_LABELS; k++)
    hk_free(m->label[k]);
  hk_free(m->json);
  hk_claims_release(&m->claims);
  hooke_options_destroy(m->run);
  hooke_options_destroy(m->options);
  hk_handle_free(m);
}

int32_t hk_measurement_require(const hooke_measurement *m, const struct hk_measurement_kind *kind,
                               const char *function) {
  if (m->kind == kind) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_CALL, NULL, "%s() needs a measurement of the kind \"%s\", this is a \"%s\"",
                 function, kind->name, m->kind->name);
}

int32_t hk_measurement_require_fresh(const hooke_measurement *m, const hooke_state *state) {
  if (m->has_run) return hk_fail(HOOKE_BAD_CALL, NULL, "the %s has been run; make a new one", m->kind->name);
  if (state == NULL) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "state", "a %s begins at the initial state; NULL is allowed",
                 m->kind->name);
}

const char *hooke_measurement_kind(const hooke_measurement *m) {
  return m->kind->name;
}

int32_t hooke_measurement_label(hooke_measurement *m, const char *what, const char *text) {
  static const char *const names[HOOKE_LABELS] = {"title",     "scene",     "output",   "command",
                                                  "command 1", "command 2", "command 3"};
  for (int k = 0; k < HOOKE_LABELS; k++) {
    if (strcmp(what, names[k]) != 0) continue;
    char *copy = text ? hk_copy_text(text) : NULL;
    if (text && copy == NULL) return HOOKE_NO_MEMORY;
    hk_free(m->label[k]);
    m->label[k] = copy;
    return HOOKE_OK;
  }
  return hk_fail(HOOKE_BAD_VALUE, "what",
                 "\"%s\" is not allowed; title, scene, output, command and command 1 to 3 are", what);
}

/* ---- running ---- */

void hooke_measurement_on_progress(hooke_measurement *m, hooke_progress *progress, void *ctx) {
  m->progress = progress;
  m->progress_ctx = ctx;
}

int32_t hk_measurement_tell(const hooke_measurement *m, double done, const char *what) {
  if (m->progress == NULL || m->progress(done, what, m->progress_ctx) == 0) return HOOKE_OK;
  return hk_fail(HOOKE_STOPPED, NULL, "the progress callback asked to stop");
}

void hk_stage_begin(struct hk_stage *stage, const char *what, double until) {
  *stage = (struct hk_stage){stage->measurement, what, stage->told, stage->until, until};
}

int32_t hk_stage_tell(double fraction, void *ctx) {
  struct hk_stage *stage = ctx;
  stage->told = fmax(stage->told, stage->from + fmin(1.0, fraction) * (stage->until - stage->from));
  return hk_measurement_tell(stage->measurement, stage->told, stage->what);
}

static int32_t run_at(hooke_measurement *m, hooke_state *state) {
  hooke_state *start = NULL;
  int32_t outcome = state ? HOOKE_OK : hooke_state_create(m->system, &start);
  if (outcome == HOOKE_OK && state) outcome = hk_state_check_system(state, m->system);
  if (outcome == HOOKE_OK) outcome = m->kind->run(m, state ? state : start);
  hooke_state_destroy(start);
  return outcome;
}

int32_t hk_measurement_claim(hooke_measurement *m) {
  hk_claims_release(&m->claims);
  if (m->kind->claim) m->kind->claim(m, &m->claims);
  return m->claims.status;
}

int32_t hooke_measurement_run(hooke_measurement *m, hooke_state *state) {
  /* one that runs once has its results where only the memory for claims was short */
  const int32_t is_there = m->claims.status != HOOKE_OK && state == NULL && !m->kind->takes_state;
  hk_claims_release(&m->claims);
  const int32_t outcome = is_there               ? m->outcome
                          : m->kind->takes_state ? run_at(m, state)
                                                 : m->kind->run(m, state);
  if (outcome < 0 && !is_there) return outcome; /* one with results all the same has composed what they say */
  m->has_run = 1;
  m->outcome = outcome;
  const int32_t status = hk_measurement_claim(m);
  return status == HOOKE_OK ? outcome : status;
}

/* ---- tables ---- */

const struct hk_table *hk_measurement_table_at(const struct hk_measurement_kind *kind, int64_t k) {
  const struct hk_table *const lists[] = {kind->tables, kind->more, kind->claim ? &hk_claims_table : NULL};
  if (k < 0) return NULL;
  for (int list = 0; list < 2; list++)
    for (const struct hk_table *table = lists[list]; table && table->name; table++)
      if (k-- == 0) return table;
  return k == 0 ? lists[2] : NULL;
}

const struct hk_table *hk_measurement_table(const struct hk_measurement_kind *kind, const char *name) {
  const struct hk_table *table;
  for (int64_t k = 0; (table = hk_measurement_table_at(kind, k)) != NULL; k++)
    if (strcmp(table->name, name) == 0) return table;
  return NULL;
}

const void *hk_measured(const hooke_measurement *m, const struct hk_table *table) {
  return table == &hk_claims_table ? (const void *)&m->claims : m->object;
}

int64_t hooke_measurement_row_count(const hooke_measurement *m, const char *table) {
  const struct hk_table *t = hk_measurement_table(m->kind, table);
  return t ? hk_measured_rows(m, t) : -1;
}

int64_t hooke_measurement_find(const hooke_measurement *m, const char *table, const char *column,
                               const char *text) {
  const int64_t count = hooke_measurement_row_count(m, table);
  for (int64_t row = 0; row < count; row++) {
    const char *own = hooke_measurement_text(m, table, row, column);
    if (own && strcmp(own, text) == 0) return row;
  }
  return -1;
}

int64_t hk_measured_rows(const hooke_measurement *m, const struct hk_table *table) {
  return hk_table_count(table, hk_measured(m, table));
}

struct hk_value hk_measured_value(const hooke_measurement *m, const struct hk_table *table,
                                  const struct hk_column *column, int64_t row) {
  return hk_table_value(table, column, hk_measured(m, table), row);
}

static struct hk_value value_of(const hooke_measurement *m, const char *table, int64_t row,
                                const char *column) {
  const struct hk_table *t = hk_measurement_table(m->kind, table);
  return hk_measured_value(m, t, t ? hk_table_find(t, column) : NULL, row);
}

const char *hooke_measurement_unit(const hooke_measurement *m, const char *table, const char *column) {
  const struct hk_table *t = hk_measurement_table(m->kind, table);
  const struct hk_column *c = t ? hk_table_find(t, column) : NULL;
  if (c == NULL) return NULL;
  return m->system && m->system->generalized && strcmp(c->unit, "m") == 0 ? "" : c->unit;
}

double hooke_measurement_number(const hooke_measurement *m, const char *table, int64_t row,
                                const char *column) {
  return value_of(m, table, row, column).number;
}

const char *hooke_measurement_text(const hooke_measurement *m, const char *table, int64_t row,
                                   const char *column) {
  return value_of(m, table, row, column).text;
}

const double *hooke_measurement_series(const hooke_measurement *m, const char *table, int64_t row,
                                       const char *column, int64_t *count) {
  const struct hk_series series = value_of(m, table, row, column).series;
  if (count) *count = series.value ? series.count : 0;
  return series.value;
}
