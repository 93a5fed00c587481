#include "parts/fluid.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/force/fluid.h"
#include "model/system.h"
#include "parts/material.h"

static const double PI = 3.14159265358979323846;

#define DENSITY                                                                                              \
  HOOKE_OPTION("density", HOOKE_OPTION_POSITIVE("kg/m^3"), NULL, "of the fluid", .required = 1,              \
               .example = "1000")

static const struct hk_option_row rope_rows[] = {
    DENSITY,
    HOOKE_OPTION("diameter", HOOKE_OPTION_POSITIVE("m"), NULL, "of the rope", .required = 1,
                 .example = "0.02"),
    HOOKE_OPTION("normal", HOOKE_OPTION_NOT_NEGATIVE(NULL), NULL, "coefficient of drag across the rope",
                 .required = 1, .example = "1.2"),
    HOOKE_OPTION("tangential", HOOKE_OPTION_NOT_NEGATIVE(NULL), NULL, "coefficient of drag along the rope",
                 .required = 1, .example = "0.02"),
};

static const struct hk_option_row surface_rows[] = {
    DENSITY,
    HOOKE_OPTION("coefficient", HOOKE_OPTION_NOT_NEGATIVE(NULL), NULL,
                 "coefficient of drag of a surface across the flow", .required = 1, .example = "1.2"),
};

const struct hk_option_table hk_part_rope_fluid = {"drag of a rope", HOOKE_OPTION_ROWS(rope_rows)},
                             hk_part_surface_fluid = {"drag of a surface", HOOKE_OPTION_ROWS(surface_rows)};

int32_t hk_part_add_fluid_drag(const struct hk_part *part, int64_t count, const int64_t *corners) {
  if (part->system->overdamped)
    return hk_fail(HOOKE_BAD_VALUE, "fluid_drag", "is not allowed; in an overdamped scene drag is linear");
  const double half = 0.5 * hk_part_material(part, "fluid_drag", "density");
  const int rope = hk_options_find(hk_options_table(part->options), "fluid_drag.diameter") != NULL;
  /* a triangle has half of what its corners span */
  const double by = rope ? half * hk_part_material(part, "fluid_drag", "diameter") : 0.5 * half;
  const double normal = by * hk_part_material(part, "fluid_drag", rope ? "normal" : "coefficient");
  const double tangential = rope ? by * PI * hk_part_material(part, "fluid_drag", "tangential") : 0.0;
  char *name = hk_part_group_name(part, "fluid_drag");
  if (name == NULL) return HOOKE_NO_MEMORY;
  const struct hk_addition added = {&hk_force_fluid, name, count, corners, NULL, 1};
  const int32_t status = hk_system_add_fluid(part->system, &added, normal, tangential);
  hk_free(name);
  return status;
}
