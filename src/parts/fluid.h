/* Drag by shape: the options `fluid_drag` of ropes and of surfaces. */
#pragma once

#include "parts/part.h"

extern const struct hk_option_table hk_part_rope_fluid, hk_part_surface_fluid;
#define HOOKE_PART_FLUID(table)                                                                              \
  HOOKE_OPTION("fluid_drag", .type = HOOKE_OPTION_FAMILY, NULL,                                              \
               "drag by shape in a fluid that the wind moves, without added mass", .family = &(table))

/* Adds it to the system, for a part that has it; `corners` are three particles of each piece, of which a
 * segment repeats the second. */
int32_t hk_part_add_fluid_drag(const struct hk_part *part, int64_t count, const int64_t *corners);
