/* What of a scene has a surface or is a line of particles, and its groups of springs, for the page of a
 * trajectory. */
#ifndef HOOKE_IO_PAGE_VIEW_BODIES_H
#define HOOKE_IO_PAGE_VIEW_BODIES_H

#include "hooke/system.h"
#include "io/file/text.h"

/* Adds "bodies": of each part kind, name, first particle, count, and "size" (particles along each axis) of a
 * grid or "triangle" (corners, from the first particle on) of a mesh; and "groups": name and count of each,
 * with stiffness [N/m] and rest length [m] where all its springs have the same. Failures go to the text's
 * status. */
void hk_view_bodies_add(struct hk_text *data, const hooke_system *system);

#endif
