/* A reference that checks itself: two integrators that share only the force, at tightening tolerances, until
 * they agree; without SUNDIALS, two runs by rk4, one in half the steps of the other. If they part for good
 * (chaos), only the time until which they agree can be judged. */
#pragma once

#include "measure/trial/trial.h"

struct hk_reference {
  struct hk_frames frames; /* of `method` at `rtol` */
  const char *method, *check;
  double rtol, run_extent; /* its tolerances are for this extent; */
  double longest;          /* see hk_reference_setting() [s] */
  double run_work;         /* counted, of its run [s] */
  double extent;           /* diagonal of the box that holds all frames [m] */
  double farthest;         /* largest coordinate at the start, at least the extent then [m] */
  double digits;           /* distance up to which frames are trusted: the wanted one, or see `coarse` [m] */
  /* twice the largest distance of a particle between the two over trusted frames, and of what rounding may do
   * to one [m]; at most `digits`; NaN if nothing after the start is trusted */
  double agreement;
  double wanted_agreement; /* twice the largest difference there of what is wanted (hk_trial.wanted); NaN
                              likewise */
  double energy_agreement; /* twice the largest difference of their energies there [J]; NaN likewise */
  int64_t checked;         /* frames at which the two were compared: all, or as many as the budget allowed */
  int64_t trusted;         /* of these, initial frames that agree to the digits */
  int32_t coarse; /* 1: no frame agrees to the wanted digits; the trusted ones agree to 1e-6 of the extent */
  int32_t
      parted; /* of a list, the want at which the two differ most at the first frame that is not trusted; */
  double parted_by; /* by how much, in its unit */
  /* 1: time was short to compare them further, or at tighter tolerances. 0: they agree, or rounding keeps
   * them apart */
  int32_t hurried;
  double growth;             /* of small displacements of the start, a bound (reference_growth.c) */
  double growth_probability; /* confidence of the bound; both NaN if unknown */
  double growth_seen;        /* largest growth of one displacement; NaN: not measured */
  int32_t displacements;     /* number of displacements */
  int32_t growth_saturated;  /* 1: displacements grew too large, so no bound is known */
  double wall_seconds, work; /* of the whole reference; counted [s] */
};

/* Requirements of a reference. */
struct hk_reference_request {
  const hooke_options *run; /* duration, every */
  int64_t frame_count;
  double digits; /* accuracy of a trusted frame [m], of `wants` by their length; NaN: 1e-6 of the extent */
  const struct hk_wants *wants; /* of `watched`; NULL: the distance of the farthest particle */
  /* 1: no tighter than needed to trust all frames, beginning loosely, and no growth. 0: down to 1e-9 of the
   * extent, while there is time */
  int32_t enough;
  int32_t brief;   /* 1: it ends where the two part, and measures no growth */
  int32_t counted; /* 1: the budget is one of counted work, which is the same on any machine */
  double budget;   /* [s], infinity for none */
  const struct hk_watched_list
      *watched;        /* recorded at every frame, with the difference of the two; NULL: nothing */
  int32_t keeps_state; /* 1: of hk_frames_within() */
  const struct hk_reference *alike;   /* of nearly the same motion, tells the first tolerance; NULL: none */
  const struct hk_listener *listener; /* receives progress as a fraction of the whole reference */
};

/* Without a budget, or with a counted one, no choice depends on a clock. Works within the budget: a run that
 * the budget ends is compared as far as it got, and counts if that is further than before. HOOKE_BAD_VALUE if
 * the budget ends before one frame after the start; HOOKE_STOPPED; HOOKE_SOLVER_FAILED, HOOKE_DIVERGED if an
 * integrator gave up. */
int32_t hk_reference_create(const hooke_system *system, const struct hk_reference_request *request,
                            struct hk_reference *reference);
void hk_reference_release(struct hk_reference *reference);

/* Time of frame `count` - 1, or the end of the run if that is the last frame, which may come before the end.
 * NaN for none [s]. */
double hk_reference_time(const struct hk_reference *reference, int64_t count, double duration);

/* 1 if both runs are by rk4, in steps and in half of them: an error that both make alike is not seen. */
int32_t hk_reference_is_halved(const struct hk_reference *reference);

/* What a method takes for a tolerance: that or, of fixed steps, the whole part of `longest` whose error falls
 * as the tolerance does [s]. */
double hk_reference_setting(const struct hk_reference *reference, const char *method, double rtol);

/* Options of a run by `method` at a tolerance, which counts in the size of the scene, wherever that lies: the
 * absolute one scales with it, and the relative one is smaller far from the origin. The caller destroys them
 * in either case. */
int32_t hk_reference_options(const hooke_options *run, const char *method, double rtol,
                             const struct hk_reference *reference, hooke_options **out);
