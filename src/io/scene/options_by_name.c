/* Options by the name of their table. */
#include "core/print.h"
#include "core/status.h"
#include "hooke/measurement.h"
#include "integrate/integrator.h"
#include "io/measurement/measurement_file.h"
#include "io/scene/scene_file.h"
#include "model/force/force.h"
#include "parts/part.h"

#include <string.h>

/* A table and its name; NULL past the last of its source. */
struct named {
  const char *name;
  const struct hk_option_table *table;
};

static struct named by_own_name(const struct hk_option_table *table) {
  return table ? (struct named){table->name, table} : (struct named){NULL, NULL};
}

static struct named of_run(int64_t k) {
  return k == 0 ? (struct named){"run", &hk_run_options} : by_own_name(NULL);
}

static struct named of_force(int64_t k) {
  for (int32_t r = 0; hk_force_table(r); r++) {
    const struct hk_force_row *row = hk_force_table(r);
    if (row->options && k-- == 0) return (struct named){row->name, row->options};
  }
  return by_own_name(NULL);
}

static struct named of_scene(int64_t k) {
  return by_own_name(hk_scene_table(k));
}

static struct named of_part(int64_t k) {
  return by_own_name(hk_part_table(k));
}

static struct named of_measurement(int64_t k) {
  const char *kind = hooke_measurement_table(NULL, k, "name");
  return (struct named){kind, kind ? hk_measurement_options(kind) : NULL};
}

static struct named (*const sources[])(int64_t k) = {of_run, of_force, of_scene, of_part, of_measurement};
enum { SOURCES = sizeof sources / sizeof sources[0] };

static int32_t refuse(const char *name) {
  char names[512] = "";
  for (int s = 0; s < SOURCES; s++) {
    for (int64_t k = 0; sources[s](k).name; k++)
      hk_append(names, sizeof names, "%s%s", names[0] ? ", " : "", sources[s](k).name);
  }
  return hk_fail(HOOKE_BAD_VALUE, "name", "there are no options for \"%.64s\"; there are those for %s", name,
                 names);
}

int32_t hooke_options_create(const char *name, hooke_options **options) {
  *options = NULL;
  for (int s = 0; s < SOURCES; s++) {
    struct named found;
    for (int64_t k = 0; (found = sources[s](k)).name; k++) {
      if (strcmp(found.name, name) == 0) return hk_options_create(found.table, options);
    }
  }
  return refuse(name);
}
