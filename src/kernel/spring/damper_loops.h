/* The loop of dampers that are applied one pair after the other (Shardlow 2003). Springs of one colour have
 * no particle in common, so that none sees what another does and their order is any.
 *
 * To the parenthesis, with d = x_i - x_j and e = v_i - v_j of a spring from i to j:
 *   r = sqrt((dx*dx + dy*dy) + dz*dz)     ir = 1/r, 0 where r = 0     rate = ((ex*dx + ey*dy) + ez*dz)*ir
 *   J = m*rate, m = impulse_per_rate     b = (J*ir) d     v_i -= w_i b     v_j += w_j b
 * A spring that only pulls has J = 0 where r <= l0, and -J is at most what its tension does: half*(kappa*(r -
 * l0)). */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* `impulse_per_rate` [kg]: the fraction by which a damper reduces the rate, over the sum of inverse
 * masses. */
struct hk_damped_springs {
  const int32_t *head, *tail;
  const double *impulse_per_rate;
  const double *kappa, *rest_length; /* of springs that only pull; else NULL */
  double half;                       /* time [s] for which they do so */
};

struct hk_damper_point {
  const double *q[3], *w;
  double *v[3];
};

typedef void hk_damper_loop(const struct hk_damped_springs *springs, ptrdiff_t count,
                            const struct hk_damper_point *at);

/* The part of a rate that a damper takes in a time h: 1 - 1/(1 + z + z^2/2), with z = h c w of its strength c
 * and the inverse mass w that it acts on. From 0 to 1 for any z >= 0. */
static inline double hk_damper_part(double z) {
  const double y = z * (1.0 + z / 2.0);
  return y > 0.0 ? 1.0 / (1.0 + 1.0 / y) : 0.0;
}
