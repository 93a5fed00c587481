/* What contact would do to the step where it does not act yet. */
#ifndef HOOKE_MEASURE_LIMIT_CONTACT_H
#define HOOKE_MEASURE_LIMIT_CONTACT_H

#include "hooke/system.h"
#include "measure/claims.h"

/* A claim for each obstacle that nothing touches at q (3n) and time t. */
void hk_claim_contacts(struct hk_claims *claims, const hooke_system *system, double t, const double *q);

#endif
