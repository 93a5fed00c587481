/* Progress of a study: the time spent, and an estimate of the time to come. */
#include "measure/study/study.h"

#include "core/clock.h"
#include "measure/counted_work/work.h"

#include <math.h>
#include <stddef.h>

/* Guesses, used for progress only. */
static const double EVALUATIONS_OF_STEP = 3.0; /* cost of a step: several evaluations, or one and a solve */
static const double SHARE_OF_REFERENCE = 0.06; /* time of a row by tolerance over that of the reference */
static const double SHARE_OF_SEARCH = 0.1;     /* added by the search for a recommendation */

static double guess_fixed(const struct hk_study *study, double step) {
  return EVALUATIONS_OF_STEP * hk_work_of_evaluation(study->m->system) * study->duration / step;
}

double hk_study_guess(const struct hk_study *study, int32_t method, double value) {
  return hk_study_is_adaptive(study, method) ? SHARE_OF_REFERENCE * study->reference.wall_seconds
                                             : guess_fixed(study, value);
}

void hk_study_prepare_guesses(struct hk_study *study) {
  study->told = study->fixed_rows = study->adaptive_rows = 0.0;
  for (int32_t m = 0; m < study->method_count; m++) {
    for (int32_t k = 0; !isnan(hk_study_ladder(study, m, k)); k++) {
      if (hk_study_is_adaptive(study, m))
        study->adaptive_rows += 1.0;
      else
        study->fixed_rows += guess_fixed(study, hk_study_ladder(study, m, k));
    }
  }
}

static int32_t tell(struct hk_study *study, double spent, double ahead) {
  if (!isnan(hooke_options_number(study->m->options, "want"))) ahead += SHARE_OF_SEARCH * (spent + ahead);
  ahead = fmax(0.0, fmin(ahead, study->budget - spent));
  const double done = spent > 0.0 ? spent / (spent + ahead) : 0.0;
  study->told = fmax(study->told, done);
  return hk_measurement_tell(study->m, study->told, study->under_way);
}

int32_t hk_study_tell_reference(double fraction, void *ctx) {
  struct hk_study *study = ctx;
  const double spent = hk_clock_seconds() - study->begun;
  const double reference = spent / fraction; /* infinite at first, when nothing is done */
  const double rows = study->fixed_rows + study->adaptive_rows * SHARE_OF_REFERENCE * reference;
  return tell(study, spent, reference - spent + rows);
}

int32_t hk_study_tell(double fraction, void *ctx) {
  struct hk_study *study = ctx;
  (void)fraction;
  return tell(study, hk_clock_seconds() - study->begun, study->work_ahead);
}

int32_t hk_study_tell_row(double fraction, void *ctx) {
  struct hk_study *study = ctx;
  const int32_t value = hk_study_tell(fraction, ctx);
  if (value != 0 || hk_clock_seconds() < study->row_deadline) return value;
  study->late = 1;
  return 1;
}
