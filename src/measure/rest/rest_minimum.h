/* Whether the energy is least at a position of rest: the eigenvalues of its stiffness over mass. */
#ifndef HOOKE_MEASURE_REST_MINIMUM_H
#define HOOKE_MEASURE_REST_MINIMUM_H

#include "measure/rest/rest.h"

/* Sets `minimum`, `zero_modes` and `softest` where that is known: of scenes without bodies, of up to 200 free
 * particles and with LAPACK. HOOKE_STOPPED by a callback, HOOKE_NO_MEMORY. */
int32_t hk_rest_see_minimum(struct hk_resting *resting, double t, const double *v);

#endif
