/* Options by the name of their table. */
#include "core/print.h"
#include "core/status.h"
#include "hooke/measurement.h"
#include "integrate/integrator.h"
#include "io/measurement/measurement_file.h"
#include "io/probes/probes.h"
#include "io/scene/scene_file.h"
#include "model/force/force.h"
#include "parts/part.h"

#include <string.h>

/* Table number `k` of all, and its name; NULL past the last. */
static const struct hk_option_table *table_at(int64_t k, const char **name) {
  const struct hk_option_table *table;
  *name = "run";
  if (k-- == 0) return &hk_run_options;
  *name = hk_probes_options.name;
  if (k-- == 0) return &hk_probes_options;
  for (int32_t i = 0; hk_force_table(i); i++) {
    *name = hk_force_table(i)->name;
    if (hk_force_table(i)->options && k-- == 0) return hk_force_table(i)->options;
  }
  for (int64_t i = 0; (table = hk_scene_table(i)); i++) {
    *name = table->name;
    if (k-- == 0) return table;
  }
  for (int64_t i = 0; (table = hk_part_table(i)); i++) {
    *name = table->name;
    if (k-- == 0) return table;
  }
  *name = hooke_measurement_table(NULL, k, "name");
  return *name ? hk_measurement_options(*name) : NULL;
}

const struct hk_option_table *hk_options_named(const char *name) {
  char names[512] = "";
  const struct hk_option_table *table;
  const char *found;
  for (int64_t k = 0; (table = table_at(k, &found)); k++) {
    if (strcmp(found, name) == 0) return table;
    hk_append(names, sizeof names, "%s%s", names[0] ? ", " : "", found);
  }
  hk_fail(HOOKE_BAD_VALUE, "name", "there are no options for \"%.64s\"; there are those for %s", name, names);
  return NULL;
}

int32_t hooke_options_create(const char *name, hooke_options **options) {
  const struct hk_option_table *table = hk_options_named(name);
  *options = NULL;
  return table ? hk_options_create(table, options) : HOOKE_BAD_VALUE;
}
