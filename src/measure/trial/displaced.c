#include "measure/trial/displaced.h"

#include "core/random.h"
#include "model/coordinates/coordinates.h"

void hk_displace(hooke_state *state, const hooke_system *system, double length, uint64_t *random) {
  double *q = hooke_state_position(state);
  for (int64_t p = 0; p < system->particle_count; p++) {
    for (int64_t k = 3 * p; k < 3 * p + 3 && system->inverse_mass[p] > 0.0; k++)
      q[k] += length * hk_random_normal(random);
  }
  hk_movers_renew(system, q, hooke_state_velocity(state));
}
