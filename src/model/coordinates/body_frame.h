/* What a body has from commit on, and the rigid motion nearest to given velocities. */
#ifndef HOOKE_MODEL_BODY_FRAME_H
#define HOOKE_MODEL_BODY_FRAME_H

#include "model/coordinates/body.h"
#include "model/particles.h"
#include "model/vector3.h"

/* Finds mass, inertia, axes and the three particles of the rule; leaves `moves` 0 if it is held or driven.
 * HOOKE_BAD_VALUE for particles that coincide, and if some are driven but not all; HOOKE_NO_MEMORY. */
int32_t hk_body_commit(hooke_system *system, struct hk_body *body);
/* Pins all particles of a body that is held still by some of them. */
void hk_body_pin_if_still(hooke_system *system, const struct hk_body *body);

/* Sets velocity and angular momentum of own coordinates to those of the initial velocities. */
void hk_body_fit(const hooke_system *system, const struct hk_body *body, double *own);

/* Makes a symmetric matrix m diagonal; the rows of `axis` become its eigenvectors. */
void hk_body_diagonalise(double m[3][3], double axis[3][3]);

#endif
