/* Options by the name of their table. */
#include "parts/part.h"
#include "model/force/spring.h"
#include "model/force/altitude.h"
#include "io/scene/scene_file.h"
#include "io/page/view.h"
#include "integrate/integrator.h"
#include "core/table/option.h"
#include "core/status.h"
#include "hooke/parts.h"
#include "hooke/integrator.h"
#include "hooke/trajectory.h"
#include "io/measurement/measurement_file.h"

#include <stdio.h>
#include <string.h>

static const struct maker {
  const char *name;
  int32_t (*create)(hooke_options **options);
} makers[] = {{"run", hk_run_options_create}, {"view", hk_view_options_create}};
enum { MAKERS = sizeof makers / sizeof makers[0] };
static const char *const scene_names[] = {"scene", "particles", "driven", "limits"};
enum { SCENE_NAMES = sizeof scene_names / sizeof scene_names[0] };

static int32_t refuse(const char *name) {
  char names[512] = "";
  for (int k = 0; k < MAKERS; k++)
    snprintf(names + strlen(names), sizeof names - strlen(names), "%s, ", makers[k].name);
  for (int32_t k = 0; hk_force_table(k); k++) {
    if (hk_force_table(k)->options)
      snprintf(names + strlen(names), sizeof names - strlen(names), "%s, ", hk_force_table(k)->name);
  }
  for (int k = 0; k < SCENE_NAMES; k++)
    snprintf(names + strlen(names), sizeof names - strlen(names), "%s, ", scene_names[k]);
  for (int64_t k = 0; hooke_part_kind(k, "name"); k++)
    snprintf(names + strlen(names), sizeof names - strlen(names), "%s, ", hooke_part_kind(k, "name"));
  for (int64_t k = 0; hooke_measurement_table(NULL, k, "name"); k++)
    snprintf(names + strlen(names), sizeof names - strlen(names), "%s, ",
             hooke_measurement_table(NULL, k, "name"));
  names[strlen(names) - 2] = '\0';
  return hk_fail(HOOKE_BAD_VALUE, "name", "there are no options for \"%.64s\"; there are those for %s", name,
                 names);
}

int32_t hooke_options_create(const char *name, hooke_options **options) {
  *options = NULL;
  const struct hk_option_table *of_kind = hk_measurement_options(name);
  if (of_kind) return hk_options_create(of_kind, options);
  for (int k = 0; k < MAKERS; k++) {
    if (strcmp(makers[k].name, name) == 0) return makers[k].create(options);
  }
  for (int32_t k = 0; hk_force_table(k); k++) {
    const struct hk_force_row *row = hk_force_table(k);
    if (row->options && strcmp(row->name, name) == 0) return hk_options_create(row->options, options);
  }
  for (int k = 0; k < SCENE_NAMES; k++) {
    if (strcmp(scene_names[k], name) == 0) return hk_scene_options_create(name, options);
  }
  for (int64_t k = 0; hooke_part_kind(k, "name"); k++) {
    if (strcmp(hooke_part_kind(k, "name"), name) == 0) return hk_part_options_create(name, options);
  }
  return refuse(name);
}
