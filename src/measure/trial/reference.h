/* A reference that checks itself: two integrators that share only the force, at tightening tolerances, until
 * they agree. Where they part for good (chaos), the time until which they agree is what can be judged. */
#ifndef HOOKE_MEASURE_TRIAL_REFERENCE_H
#define HOOKE_MEASURE_TRIAL_REFERENCE_H

#include "measure/trial/trial.h"

struct hk_reference {
  struct hk_frames frames; /* of `method` at `rtol` */
  const char *method, *check;
  double rtol, atol;               /* its tolerances, */
  double evaluations, run_seconds; /* force evaluations and wall time */
  double extent;                   /* diagonal of the box that holds all frames [m] */
  double digits;    /* distance up to which frames are trusted: the wanted one, or as `coarse` says [m] */
  double agreement; /* twice the largest rms distance of the two over trusted frames [m]; at most `digits` */
  double energy_agreement; /* twice the largest difference of their energies there [J] */
  int64_t checked;         /* frames at which the two were compared: all, or as many as the budget allowed */
  int64_t trusted;         /* of those, frames that agree to the digits, from the first on */
  int32_t coarse; /* 1: no frame agrees to the wanted digits; those trusted do to 1e-6 of the extent */
  /* 1: time was short to compare them further, or at tighter tolerances. 0: they agree, or rounding keeps
   * them apart */
  int32_t hurried;
  double growth;             /* of small displacements of the start, at most (reference_growth.c) */
  double growth_probability; /* that it is; both NaN where nothing is known */
  double growth_seen;        /* largest growth of one displacement; NaN: not measured */
  int32_t displacements;     /* that were run */
  int32_t growth_saturated;  /* 1: they grew beyond what is small, so nothing is known of the most */
  double wall_seconds;       /* of everything */
};

/* What a reference is asked for. */
struct hk_reference_request {
  const hooke_options *run; /* duration, every */
  int64_t frame_count;
  double digits; /* that a trusted frame is known to [m]; if NaN, 1e-6 of the extent */
  /* 1: no tighter than it takes to trust all frames, beginning loosely, and no growth. 0: on to 1e-9 of the
   * extent, while there is time */
  int32_t enough;
  double budget; /* [s], infinity for none */
  const struct hk_watched_list
      *watched; /* kept at every frame, with how far the two are apart in it; NULL: nothing */
  const struct hk_listener *listener; /* told of progress with the share of the whole reference */
};

/* Within the budget: a run that it ends is compared as far as it got, and counts if that is further than
 * before. HOOKE_NOT_BUILT without SUNDIALS; HOOKE_BAD_VALUE if the budget ends before one frame after the
 * start; HOOKE_STOPPED; HOOKE_SOLVER_FAILED, HOOKE_DIVERGED if an integrator gave up. */
int32_t hk_reference_create(const hooke_system *system, const struct hk_reference_request *request,
                            struct hk_reference *reference);
void hk_reference_release(struct hk_reference *reference);

/* Options of a run by `method` at a tolerance; the absolute one follows the size of the scene. */
int32_t hk_reference_options(const hooke_options *run, const char *method, double rtol, double extent,
                             hooke_options **out);

/* The method that makes references cheapest on this system at positions q: Adams, or BDF where damping is
 * faster than the fastest oscillation, so that fast motion dies out and an implicit method strides over
 * it. */
int32_t hk_reference_method(const hooke_system *system, const double *q, const char **method);

#endif
