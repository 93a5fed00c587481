/* Drag of a fluid on the segments of ropes and the triangles of surfaces. */
#pragma once

#include "model/group.h"

/* Members of three particles, of which a segment repeats the second. A segment of length l has the force
 * -l (normal |wn| wn + tangential |wt| wt), a triangle with the normal n and twice the area N has
 * -N normal |w.n| (w.n) n [kg/m^2]. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_system_add_fluid(struct hooke_system *system, const struct hk_addition *added, double normal,
                            double tangential);
