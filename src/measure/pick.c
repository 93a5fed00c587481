/* Picking a method and its step for a run, from a quick study of its beginning. */
#include "measure/study.h"

#include "core/option.h"
#include "core/status.h"
#include "integrate/integrator.h"

#include <math.h>
#include <stddef.h>

static const double SHARE = 0.1;   /* of the run that is studied */
static const double BUDGET = 30.0; /* [s] for the study */

/* The beginning of the run, in whole steps of which its frames and its end are multiples too. */
static int32_t shorten(const hooke_system *system, const hooke_options *run, hooke_options *beginning,
                       double *share) {
  hooke_study *whole = NULL;
  int32_t status = hooke_study_create(system, run, NULL, &whole);
  if (status != HOOKE_OK) return status;
  const double unit = whole->unit, units = round(whole->duration / unit);
  const double taken = fmax(1.0, ceil(SHARE * units));
  hooke_study_destroy(whole);
  *share = taken / units;
  status = hooke_options_set_number(beginning, "every", unit);
  return status == HOOKE_OK ? hooke_options_set_number(beginning, "duration", taken * unit) : status;
}

static int32_t take_over(const hooke_study *study, hooke_options *run) {
  const double step = hooke_study_recommendation_number(study, "step");
  int32_t status = hooke_options_set_text(run, "method", hooke_study_recommendation_text(study, "method"));
  if (status == HOOKE_OK && !isnan(step)) return hooke_options_set_number(run, "step", step);
  if (status == HOOKE_OK) {
    status = hooke_options_set_number(run, "rtol", hooke_study_recommendation_number(study, "rtol"));
  }
  if (status == HOOKE_OK) {
    status = hooke_options_set_number(run, "atol", hooke_study_recommendation_number(study, "atol"));
  }
  return status == HOOKE_OK ? hooke_options_unset(run, "atol_velocity") : status;
}

int32_t hooke_study_pick(const hooke_system *system, hooke_options *run, double want,
                         hooke_progress *progress, void *ctx) {
  hooke_options *beginning = NULL, *options = NULL;
  hooke_study *study = NULL;
  double share = 1.0;
  int32_t status = hooke_run_options_require(run, "run");
  if (status == HOOKE_OK) status = hooke_options_copy(run, &beginning);
  if (status == HOOKE_OK) status = shorten(system, run, beginning, &share);
  if (status == HOOKE_OK) status = hooke_study_options_create(&options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "budget", BUDGET);
  /* errors grow at least in proportion to time */
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "want", want * share);
  if (status == HOOKE_OK) status = hooke_study_create(system, beginning, options, &study);
  if (status == HOOKE_OK) {
    hooke_study_on_progress(study, progress, ctx);
    status = hooke_study_run(study);
  }
  /* judged for less than that time, a run may be off by less */
  const double judged = study ? hooke_study_figure(study, "trusted_until") / study->duration : 1.0;
  if (status == HOOKE_OK && judged < 1.0) {
    share *= judged;
    status = hooke_study_recommend(study, want * share);
  }
  if (status == HOOKE_OK && hooke_study_recommendation_number(study, "met") == 1.0) {
    status = take_over(study, run);
  } else if (status == HOOKE_OK) {
    status = hooke_fail(HOOKE_BAD_VALUE, "want", "%g m cannot be had: over the first %.3g of the run, %s",
                        want, share, hooke_study_recommendation_text(study, "note"));
  }
  hooke_study_destroy(study);
  hooke_options_destroy(options);
  hooke_options_destroy(beginning);
  return status;
}
