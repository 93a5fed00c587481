/* The frames of a run, kept for judging other runs: memory is bounded by the number of frames, not of steps.
 */
#ifndef HOOKE_MEASURE_TRIAL_FRAMES_H
#define HOOKE_MEASURE_TRIAL_FRAMES_H

#include "integrate/integrator.h"
#include "measure/quantity/watched.h"

struct hk_frames {
  const hooke_system *system;
  int64_t count, size; /* frames, and numbers in a position (3n) */
  int64_t recorded;    /* frames recorded so far */
  double *time;        /* count [s] */
  double *energy;      /* count [J] */
  double *position;    /* count x size [m] */
  double *rounding;    /* count: by how much rounding may have displaced a particle until then [m] */
  int64_t *free_particle, free_count;      /* errors are measured over these */
  struct hk_watched_series watched;        /* empty unless created */
  char zero_passages[HOOKE_PASSAGES_TOLD]; /* of their run: see hooke_integrator_text() */
};

/* Allocates `count` frames of a committed system. HOOKE_NO_MEMORY. */
int32_t hk_frames_create(const hooke_system *system, int64_t count, struct hk_frames *frames);
void hk_frames_release(struct hk_frames *frames);

/* Records the next frame; those beyond `count` are ignored. */
void hk_frames_record(struct hk_frames *frames, const hooke_state *state);

/* Root mean square over the free particles of the distance between q and frame f [m]; the largest distance
 * too. */
double hk_frames_distance(const struct hk_frames *frames, int64_t f, const double *q, double *largest);

/* What the positions q can hold [m]: half a unit in the last place of the largest coordinate of a free
 * particle. */
double hk_frames_resolution(const struct hk_frames *frames, const double *q);

#endif
