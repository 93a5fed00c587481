/* What parts make of values of a material, which do not name a resolution: density, damping ratio, bending
 * stiffness. Every number that comes of them goes into the system's list of derived numbers. */
#ifndef HOOKE_PARTS_MATERIAL_H
#define HOOKE_PARTS_MATERIAL_H

#include "parts/part.h"

/* One number, or `count`, for the `rows` x `columns` particles: an equal share of the option `mass`, or what
 * the option `density` has for the piece that each stands for: `piece` [m or m^2], half of it at an edge, a
 * quarter at a corner, a rope (one row) having no edges but its ends. Sets the part's inner mass. `mass` is
 * the caller's to free. */
int32_t hk_part_masses(struct hk_part *part, int64_t rows, int64_t columns, double piece, int64_t *mass_count,
                       double **mass);

/* HOOKE_BAD_VALUE unless one of the options `mass` and `density` is given. */
int32_t hk_part_check_masses(const struct hk_part *part);

/* The option damping [N s] of every spring of a family, `count` long, from its damping_ratio: kd = gamma l0,
 * gamma = 2 zeta sqrt(kappa m/2), l0 the rest length as the springs will have it, m the part's inner mass;
 * m/2 is the reduced mass of the two `ends` where there is no inner mass. */
void hk_part_damping(const struct hk_part *part, const char *family, int64_t count, const int64_t *ends,
                     const double *rest_length, double *damping);

/* Puts down what the springs of the group added last have come to, one of each direction. */
int32_t hk_part_derive_springs(const struct hk_part *part, const char *family, int32_t strip_count,
                               const struct hk_part_strip *strip);

#endif
