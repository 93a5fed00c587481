/* Tests if the motion of a linear twin grows at a step: one run of the real integrator, observed through the
 * energy of the displacement. */
#pragma once

#include "hooke/measurement.h"
#include "measure/spectrum/linear_twin.h"

enum hk_verdict {
  HOOKE_GROWS,
  HOOKE_HOLDS,  /* it decays */
  HOOKE_STEADY, /* neither is seen within the allowed steps */
  HOOKE_OUT_OF_TIME,
  HOOKE_UNSOLVED /* the method did not solve its step */
};

struct hk_growth {
  struct hk_twin *twin;
  hooke_options *run; /* its own copy, without frames */
  hooke_state *state;
  double *direction;     /* of the initial motion, 3n; all zeros: none known */
  int32_t has_direction; /* 1: one was given or found */
  double accuracy;       /* of the limit that is looked for, relative */
  int32_t is_named;      /* 1: the direction is that of a mode that limits the step */
  int32_t turns_at_rest; /* 1: motion that turns round in every step has no velocity at its ends */
  int32_t is_convex;     /* 1: the energy is a sum of powers, so that what rises rises for ever */
  int64_t most_steps;    /* of one run */
  int64_t steps_run;     /* of all runs */
  uint64_t random;       /* of the generator */
  struct hk_budget *budget;
};

/* `mode`: 3n displacements, or NULL. `run` (options of a run) may be NULL. */
int32_t hk_growth_create(struct hk_twin *twin, const hooke_options *run, const char *method,
                         const double *mode, double accuracy, struct hk_budget *budget,
                         struct hk_growth *growth);
void hk_growth_release(struct hk_growth *growth);

/* Runs at `step` from the known direction with a thousandth of random motion, or from random motion alone,
 * until the energy clearly grows or decays, or for `most_steps`. A `thorough` run starts from random motion
 * and takes all of its steps before it reports stable motion, so that an unforeseen mode has time to show.
 * Growing motion becomes the direction of later runs if none was known or the run was thorough. HOOKE_STOPPED
 * by the progress; HOOKE_NO_MEMORY. */
int32_t hk_growth_see(struct hk_growth *growth, double step, int32_t thorough, int64_t most_steps,
                      enum hk_verdict *verdict);
