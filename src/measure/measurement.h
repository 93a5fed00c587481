/* The common part of all measurements: options, progress, a run, and tables of results. Each kind adds an
 * object of its own. */
#pragma once

#include "core/table/column.h"
#include "core/table/option.h"
#include "hooke/measurement.h"
#include "measure/claims.h"

/* COMMAND begins as many as a diagnosis has advice. */
enum hk_label {
  HOOKE_LABEL_TITLE,
  HOOKE_LABEL_SCENE,
  HOOKE_LABEL_OUTPUT,
  HOOKE_LABEL_COMMAND,
  HOOKE_LABELS = HOOKE_LABEL_COMMAND + 4
};

struct hk_measurement_kind {
  const char *name;
  const struct hk_option_table *options;
  const char *made_by; /* function that creates it, "hooke_why_create()"; NULL: hooke_measurement_create() */
  int32_t needs_run;   /* 1: options of a run are required */
  int32_t takes_problems; /* 1: those of coordinates, too (model/generalized.h) */
  int32_t takes_state;    /* 1: it is taken at a state, by default the initial one, and may be repeated */
  const struct hk_table *tables; /* its own; end without a name */
  const struct hk_table *more;   /* of another kind, with whose object its own begins; NULL: none */
  /* Composes the claims of the results, after every run; NULL: it makes none, and has no such table. */
  void (*claim)(const hooke_measurement *measurement, struct hk_claims *claims);
  /* Creates measurement->object; destroy() follows in any case. */
  int32_t (*create)(hooke_measurement *measurement);
  int32_t (*run)(hooke_measurement *measurement, hooke_state *state);
  /* Writes its one kind of file, whatever the ending of `path`; NULL: the format is that of the ending. */
  int32_t (*write)(const hooke_measurement *measurement, const char *path);
  void (*destroy)(void *object); /* NULL is allowed */
};

struct hooke_measurement {
  const struct hk_measurement_kind *kind;
  const hooke_system *system;
  hooke_options *run, *options; /* copies; run is NULL if it was not given */
  hooke_progress *progress;
  void *progress_ctx;
  int32_t has_run, outcome;  /* last return value of hooke_measurement_run(), unless it failed */
  char *label[HOOKE_LABELS]; /* texts that files show; NULL: none */
  char *json;                /* last answer of hooke_measurement_json(); NULL: none */
  struct hk_claims claims;
  void *object;
};

/* Like hooke_measurement_create(), for a kind. kind->create() finds `object` in measurement->object: NULL
 * unless the kind is made from more than a system. The measurement owns it, and it is destroyed if this
 * fails. `system` may then be NULL. */
int32_t hk_measurement_create(const struct hk_measurement_kind *kind, void *object,
                              const hooke_system *system, const hooke_options *run,
                              const hooke_options *options, hooke_measurement **measurement);

/* HOOKE_BAD_CALL, with the name of the calling function, for a measurement of another kind. */
int32_t hk_measurement_require(const hooke_measurement *measurement, const struct hk_measurement_kind *kind,
                               const char *function);

/* For a kind that runs once, from the initial state: HOOKE_BAD_CALL if it has been run, HOOKE_BAD_VALUE for a
 * state. */
int32_t hk_measurement_require_fresh(const hooke_measurement *measurement, const hooke_state *state);

/* Calls the progress callback. HOOKE_STOPPED, with its message, if that asks to stop. */
int32_t hk_measurement_tell(const hooke_measurement *measurement, double done, const char *what);

/* What of a measurement is under way. */
struct hk_stage {
  const hooke_measurement *measurement;
  const char *what;
  double told, from, until; /* largest reported fraction of the whole; begin and end of this stage */
};
/* Begins the next stage, which ends at about the fraction `until` of the whole. */
void hk_stage_begin(struct hk_stage *stage, const char *what, double until);
/* Reports a fraction of a stage, which is the context: that of the whole never decreases. Likewise. */
int32_t hk_stage_tell(double fraction, void *stage);

/* Composes the claims again. HOOKE_NO_MEMORY */
int32_t hk_measurement_claim(hooke_measurement *measurement);

/* Table `k`, the claims after those of the kind; NULL past the last. Table of that name; NULL if there is
 * none. And the object whose table it is. */
const struct hk_table *hk_measurement_table_at(const struct hk_measurement_kind *kind, int64_t k);
const struct hk_table *hk_measurement_table(const struct hk_measurement_kind *kind, const char *name);
const void *hk_measured(const hooke_measurement *measurement, const struct hk_table *table);

/* The number of rows of a table, and a value of it as of hk_table_value(). */
int64_t hk_measured_rows(const hooke_measurement *measurement, const struct hk_table *table);
struct hk_value hk_measured_value(const hooke_measurement *measurement, const struct hk_table *table,
                                  const struct hk_column *column, int64_t row);
