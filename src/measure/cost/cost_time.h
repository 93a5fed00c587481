/* Increase of the time of a step due to an ingredient. */
#ifndef HOOKE_MEASURE_COST_COST_TIME_H
#define HOOKE_MEASURE_COST_COST_TIME_H

#include "hooke/integrator.h"

/* An integrator with a state, and the time of a step in its shortest blocks [ns]. */
struct hk_timed {
  hooke_integrator *integrator;
  hooke_state *state;
  double best[2]; /* of two series; infinite before the first block */
};

/* HOOKE_NO_MEMORY and the failures of hooke_integrator_create(); hk_timed_release() is allowed after a
 * failure. */
int32_t hk_timed_create(const hooke_system *system, const hooke_options *run, struct hk_timed *timed);
void hk_timed_release(struct hk_timed *timed);

/* Runs blocks of `full`, `lean` and `full` again in turn, each from `start`, for about `seconds`, two rounds
 * at least. Both series of `full` are kept, whose difference measures the noise, and the first of `lean`.
 * Times stay infinite if the method can take no step. HOOKE_STOPPED by a callback; failures of the method are
 * not failures here. */
int32_t hk_timed_compare(struct hk_timed *full, struct hk_timed *lean, const hooke_state *start,
                         double seconds);

#endif
