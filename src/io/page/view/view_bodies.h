/* What of a scene has a surface or is a line of particles, and its groups of springs, for the page of a
 * trajectory. */
#ifndef HOOKE_IO_PAGE_VIEW_BODIES_H
#define HOOKE_IO_PAGE_VIEW_BODIES_H

#include "hooke/system.h"
#include "io/page/view/view.h"

/* Adds "bodies": of each part kind, name, first particle, count, and "size" (particles along each axis) of a
 * grid or "triangle" (corners, from the first particle on) of a mesh. Failures go to the text's status. */
void hk_view_add_bodies(struct hk_text *data, const hooke_system *system);
/* Adds them, "groups": name and count of each, and whether it only pulls; and "stiffness": that of the
 * springs shown [N/m]. */
void hk_view_bodies_add(struct hk_text *data, const struct hk_view *view, const hooke_system *system);

/* Numbers of the springs shown, picked from those of all, as floats in base64. */
void hk_view_add_floats(struct hk_text *data, const char *key, const struct hk_view *view, const double *all);

#endif
