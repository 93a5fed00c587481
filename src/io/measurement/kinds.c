/* The kinds of measurements by name, their tables, and the formats of their files. */
#include "core/status.h"
#include "io/file/atomic_file.h"
#include "io/file/inputs.h"
#include "io/measurement/measurement_file.h"
#include "io/page/view/view.h"
#include "io/verify/verify.h"
#include "measure/check/check.h"
#include "measure/cost/cost.h"
#include "measure/estimate/estimate.h"
#include "measure/limit/limit.h"
#include "measure/modes/modes.h"
#include "measure/needs/needs.h"
#include "measure/rest/rest.h"
#include "measure/study/study.h"
#include "measure/why/why.h"
#include "model/generalized.h"

#include <string.h>

static const struct hk_measurement_kind *const kinds[] = {
    &hk_study_kind,    &hk_limit_kind, &hk_needs_kind, &hk_cost_kind, &hk_why_kind,   &hk_verify_kind,
    &hk_estimate_kind, &hk_view_kind,  &hk_check_kind, &hk_rest_kind, &hk_modes_kind, NULL,
};
enum { KINDS = sizeof kinds / sizeof kinds[0] - 1 };

static const struct hk_measurement_kind *find(const char *name) {
  for (int k = 0; kinds[k]; k++) {
    if (strcmp(kinds[k]->name, name) == 0) return kinds[k];
  }
  return NULL;
}

int32_t hooke_measurement_create(const char *kind, const hooke_system *system, const hooke_options *run,
                                 const hooke_options *options, hooke_measurement **measurement) {
  const struct hk_measurement_kind *found = find(kind);
  if (found == NULL || found->made_by) {
    char names[160] = "";
    for (int k = 0; kinds[k]; k++) {
      if (!kinds[k]->made_by) strcat(strcat(names, names[0] ? ", " : ""), kinds[k]->name);
    }
    if (found) return hk_fail(HOOKE_BAD_VALUE, "kind", "a \"%s\" is made by %s", kind, found->made_by);
    return hk_fail(HOOKE_BAD_VALUE, "kind", "there is no kind \"%s\"; there are %s", kind, names);
  }
  return hk_measurement_create(found, NULL, system, run, options, measurement);
}

const struct hk_option_table *hk_measurement_options(const char *kind) {
  const struct hk_measurement_kind *k = find(kind);
  return k ? k->options : NULL;
}

const char *hooke_measurement_table(const char *kind, int64_t table, const char *what) {
  if (kind == NULL)
    return table >= 0 && table < KINDS && strcmp(what, "name") == 0 ? kinds[table]->name : NULL;
  const struct hk_measurement_kind *k = find(kind);
  const struct hk_table *t = k ? hk_measurement_table_at(k, table) : NULL;
  if (t == NULL) return NULL;
  if (strcmp(what, "name") == 0) return t->name;
  if (strcmp(what, "doc") == 0) return t->doc;
  return strcmp(what, "shape") == 0 ? (t->record ? "record" : "rows") : NULL;
}

const char *hooke_measurement_column(const char *kind, const char *table, int64_t column, const char *what) {
  static const char *const types[] = {"number", "count", "flag", "text", "series"};
  const struct hk_measurement_kind *k = find(kind);
  const struct hk_table *t = k ? hk_measurement_table(k, table) : NULL;
  if (t == NULL || column < 0 || column >= t->column_count) return NULL;
  const struct hk_column *c = &t->columns[column];
  if (strcmp(what, "name") == 0) return c->name;
  if (strcmp(what, "unit") == 0) return c->unit;
  if (strcmp(what, "doc") == 0) return c->doc;
  return strcmp(what, "type") == 0 ? types[c->type] : NULL;
}

/* ---- files ---- */

static const struct format {
  const char *ending;
  const char *of_scene; /* begins the refusal of problems of coordinates; NULL: it takes them */
  int32_t (*write)(const hooke_measurement *measurement, const char *path);
} formats[] = {{".csv", NULL, hk_measurement_write_csv},
               {".json", NULL, hk_measurement_write_json},
               {".h5", "an HDF5 file ", hk_measurement_write_h5},
               {".html", "a page ", hk_measurement_write_page}};

int32_t hooke_measurement_write(const hooke_measurement *measurement, const char *path) {
  if (!measurement->has_run)
    return hk_fail(HOOKE_BAD_CALL, NULL, "there is nothing to write before hooke_measurement_run()");
  const int32_t status = measurement->system ? hk_inputs_refuse(measurement->system, path) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  if (measurement->kind->write) return measurement->kind->write(measurement, path);
  for (size_t k = 0; k < sizeof formats / sizeof formats[0]; k++) {
    const struct format *format = &formats[k];
    if (!hk_file_ends_in(path, format->ending)) continue;
    const int32_t refused = measurement->system && format->of_scene
                                ? hk_system_require_scene(measurement->system, "path", format->of_scene)
                                : HOOKE_OK;
    return refused == HOOKE_OK ? format->write(measurement, path) : refused;
  }
  return hk_fail(HOOKE_BAD_VALUE, "path", "%s: allowed are names that end in .csv, .json, .h5 or .html",
                 path);
}
