/* How much small displacements of the start grow. */
#include "measure/reference_run.h"

#include <math.h>

static const double DISPLACEMENT = 1e-6; /* of the start, as a share of the extent */

/* Every free particle by the same length, in directions that follow no line of the scene. */
static void displace(hooke_state *state, void *ctx) {
  const struct hooke_reference *reference = ((const struct hooke_reference_watch *)ctx)->displacement;
  const struct hooke_frames *frames = &reference->frames;
  double *q = hooke_state_position(state);
  for (int64_t k = 0; k < frames->free_count; k++) {
    const double angle = 2.399963229728653 * (double)(k + 1), z = cos(1.7 * (double)(k + 1));
    const double length = DISPLACEMENT * reference->extent, across = sqrt(1.0 - z * z);
    q[3 * frames->free_particle[k]] += length * across * cos(angle);
    q[3 * frames->free_particle[k] + 1] += length * across * sin(angle);
    q[3 * frames->free_particle[k] + 2] += length * z;
  }
}

int32_t hooke_reference_measure_growth(struct hooke_reference_watch *watch, struct hooke_reference *r,
                                       struct hooke_trial *trial) {
  struct hooke_listener listener = hooke_reference_listen(watch, watch->begun + watch->request->budget);
  listener.on_start = displace;
  watch->displacement = r;
  watch->ahead = 0.0;
  const int32_t status = hooke_reference_judge(watch, r, r->method, r->rtol, &listener, trial);
  for (int64_t f = 0; f < r->frames.count && status == HOOKE_OK; f++) /* fmax leaves out those without one */
    r->growth = fmax(r->growth, trial->error_at[f] / (DISPLACEMENT * r->extent));
  return status;
}
