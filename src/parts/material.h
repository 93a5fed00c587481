/* Masses, damping and bending from material values, which do not depend on resolution: density, damping
 * ratio, bending stiffness. Every derived number is added to the system's list. */
#pragma once

#include "model/force/spring.h"
#include "parts/part.h"

/* A number of a family of springs, such as its stiffness, 1 of a factor that follows time; 1 if it was given.
 */
double hk_part_material(const struct hk_part *part, const char *family, const char *key);
int32_t hk_part_is_given(const struct hk_part *part, const char *family, const char *key);

/* Adds a number that follows from the part's options to the list that the system shows. */
int32_t hk_part_derive(const struct hk_part *part, const char *family, const char *name, const char *unit,
                       double value);

/* HOOKE_BAD_VALUE unless one of the options `mass` and `density` is given or, in an overdamped system,
 * none. */
int32_t hk_part_check_masses(const struct hk_part *part);
/* The option `mass` [kg]; 0: not given. */
double hk_part_total_mass(const struct hk_part *part);

/* Sets the option damping [N s] of springs from the damping_ratio of their family: kd = gamma l0, gamma = 2
 * zeta sqrt(kappa m/2), l0 the rest length of each of `count`, m the part's inner mass; without an inner mass
 * m/2 is the reduced mass of the two `ends`. HOOKE_NO_MEMORY. */
int32_t hk_part_set_damping(const struct hk_part *part, const char *family, int64_t count,
                            const int64_t *ends, const double *rest_length, hooke_options *springs);

/* HOOKE_BAD_VALUE if a family has both damping and damping_ratio. */
int32_t hk_part_check_damping(const struct hk_part *part, const char *family);

/* Records the derived stiffness and damping of spring `k` of the group added last, under these names. */
int32_t hk_part_derive_spring(const struct hk_part *part, const char *family, int64_t k, const char *kappa,
                              const char *gamma);
