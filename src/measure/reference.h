/* A reference that checks itself: two integrators that share only the force, at tightening tolerances, until they agree.
 * Where they part for good (chaos), the time until which they agree is what can be judged. */
#ifndef HOOKE_MEASURE_REFERENCE_H
#define HOOKE_MEASURE_REFERENCE_H

#include "measure/trial.h"

struct hooke_reference {
  struct hooke_frames frames; /* of `method` at `rtol` */
  const char *method, *check;
  double rtol;
  double extent;    /* diagonal of the box that holds all frames [m] */
  double agreement; /* twice the largest rms distance of the two over trusted frames [m] */
  int64_t checked;  /* frames at which the two were compared: all, or as many as the budget allowed */
  int64_t trusted;  /* of those, frames that agree to the wanted digits, from the first on */
  int32_t hurried;  /* 1: with more time they would have been compared further, or at tighter tolerances */
  double growth;    /* largest growth of a small displacement at the start, over the frames that were run */
  double wall_seconds; /* of everything */
};

/* What a reference is asked for. */
struct hooke_reference_request {
  const hooke_options *run; /* duration, every */
  int64_t frame_count;
  double
      digits; /* distance that the two may be apart at a trusted frame [m]; at least, and if NaN, 1e-6 of the extent */
  double budget; /* [s], infinity for none */
  const struct hooke_watched_list
      *watched; /* kept at every frame, with how far the two are apart in it; NULL: nothing */
  const struct hooke_listener *listener; /* told of progress with the share of the whole reference */
};

/* Within the budget: a run that it ends is compared as far as it got, and counts if that is further than before.
 * HOOKE_NOT_BUILT without SUNDIALS; HOOKE_BAD_VALUE if the budget ends before one frame after the start; HOOKE_STOPPED;
 * HOOKE_SOLVER_FAILED, HOOKE_DIVERGED if an integrator gave up. */
int32_t hooke_reference_create(const hooke_system *system, const struct hooke_reference_request *request,
                               struct hooke_reference *reference);
void hooke_reference_release(struct hooke_reference *reference);

/* Options of a run by `method` with error control, the absolute tolerance by the size of the scene. */
int32_t hooke_reference_options(const hooke_options *run, const char *method, double rtol, double extent,
                                hooke_options **options);

/* The method that makes references cheapest on this system at positions q: Adams, or BDF where damping is faster than the
 * fastest oscillation, so that fast motion dies out and an implicit method strides over it. */
int32_t hooke_reference_method(const hooke_system *system, const double *q, const char **method);

#endif
