/* A reference that checks itself: two integrators that share only the force, at tightening tolerances, until they agree.
 * Where they part for good (chaos), the time until which they agree is what can be judged. */
#ifndef HOOKE_MEASURE_REFERENCE_H
#define HOOKE_MEASURE_REFERENCE_H

#include "measure/trial.h"

struct hooke_reference {
  struct hooke_frames frames; /* of `method` at `rtol` */
  const char *method, *check;
  double rtol;
  double extent;        /* diagonal of the box that holds all frames [m] */
  double agreement;     /* twice the largest rms distance of the two over trusted frames [m] */
  int64_t trusted;      /* frames that agree to the wanted digits, from the first on */
  double trusted_until; /* time of the last of them [s] */
  double growth;        /* largest growth of a small displacement at the start, over all frames */
  double wall_seconds;  /* of everything */
};

/* What a reference is asked for. */
struct hooke_reference_request {
  const hooke_options *run; /* duration, every */
  int64_t frame_count;
  double
      digits; /* distance that the two may be apart at a trusted frame [m]; at least, and if NaN, 1e-6 of the extent */
  double budget; /* [s], infinity for none; the first agreement is always made */
  const struct hooke_listener *listener;
};

/* HOOKE_NOT_BUILT without SUNDIALS; HOOKE_STOPPED; HOOKE_SOLVER_FAILED, HOOKE_DIVERGED if an integrator gave up. */
int32_t hooke_reference_create(const hooke_system *system, const struct hooke_reference_request *request,
                               struct hooke_reference *reference);
void hooke_reference_release(struct hooke_reference *reference);

/* The method that makes references cheapest on this system at positions q: Adams, or BDF where damping is faster than the
 * fastest oscillation, so that fast motion dies out and an implicit method strides over it. */
int32_t hooke_reference_method(const hooke_system *system, const double *q, const char **method);

#endif
