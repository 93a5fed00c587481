/* A force for --force: a tether from the last particle to a point, 20 N/m from 0.3 m of length on.
 *   cc -O2 -ffp-contract=off -shared -fPIC $(pkg-config --cflags hooke) tether.c -o tether.so -lm
 *   hooke run rope.json --force ./tether.so */
#include <hooke.h>

#include <math.h>

const int32_t hooke_own_force_abi = HOOKE_ABI; /* by which hooke knows that both mean the same arguments */

int32_t hooke_own_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  const double point[3] = {0.5, 0.4, -0.2}, stiffness = 20, length = 0.3; /* m, N/m, m */
  double d[3];
  for (int a = 0; a < 3; a++)
    d[a] = q[3 * (n - 1) + a] - point[a];
  const double r = sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]), s = stiffness * (r - length) * (1 / r);
  for (int a = 0; a < 3; a++)
    force[3 * (n - 1) + a] -= s * d[a]; /* N */
  (void)t, (void)v, (void)ctx;
  return 0; /* anything else stops the run */
}
