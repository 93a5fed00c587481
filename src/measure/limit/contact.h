/* What the figures of a limit do not know of: contact where it does not act yet, and a force callback. */
#pragma once

#include "hooke/system.h"
#include "measure/claims.h"

/* A claim that the derivatives of a force callback, where there is one, are left out. */
void hk_claim_callback(struct hk_claims *claims, const hooke_system *system);

/* A claim for each obstacle that nothing touches at q (3n) and time t. */
void hk_claim_contacts(struct hk_claims *claims, const hooke_system *system, double t, const double *q);
