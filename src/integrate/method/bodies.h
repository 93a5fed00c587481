/* How methods step systems with rigid bodies. */
#ifndef HOOKE_INTEGRATE_METHOD_BODIES_H
#define HOOKE_INTEGRATE_METHOD_BODIES_H

#include "integrate/integrator.h"

/* Row of the same name for systems in which bodies move; NULL if there is none. */
const struct hk_method *hk_method_with_bodies(const struct hk_method *method);

#endif
