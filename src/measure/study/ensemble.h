/* Ensembles: where small differences grow too much for a motion to be computed to its end, means and spreads
 * over many indistinguishable starts still can be. */
#ifndef HOOKE_MEASURE_STUDY_ENSEMBLE_H
#define HOOKE_MEASURE_STUDY_ENSEMBLE_H

#include "measure/quantity/watched.h"

struct hk_study;

/* A source of motion for all members: the method of the reference, or a method of the study with one step or
 * tolerance. */
struct hk_ensemble_source {
  int32_t method; /* of the study; -1: the reference */
  double value;   /* step or rtol */
  int64_t finished, failed;
  uint64_t random;
  double *sample; /* a row of quantities for each member that finished */
};

struct hk_ensemble {
  struct hk_watched_list quantities; /* kinetic, potential, energy, and the watched quantities */
  int64_t members;                   /* of each source */
  double noise;                      /* root mean square displacement of a free particle at the start [m] */
  double from, until;                /* of the means over time [s] */
  int64_t source_count;
  struct hk_ensemble_source *source; /* the reference first */
};

/* Runs the members of a study whose rows are complete, of all sources in turn, until all are done or the
 * deadline is reached. Does nothing if no ensemble is requested, or if the reference is trusted to the end.
 */
int32_t hk_ensemble_run(struct hk_study *study);
void hk_ensemble_release(struct hk_ensemble *ensemble);

#endif
