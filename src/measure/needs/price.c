#include "measure/needs/price.h"

#include "core/status.h"
#include "measure/needs/needs.h"
#include "model/callbacks.h"
#include "model/system.h"

#include <math.h>

static const double MOST_WORK = 0.5, MOST_BYTES = 1 << 26, SHARE = 1.0 / 3.0, BELOW_LIMIT = 0.9;
enum { PATHS = 3 };
static const double WANT = 0.01; /* of the size of the scene */

/* The largest step that fits the run. */
static double choose_step(const struct hk_needs *needs, double limit) {
  const double own = hooke_options_number(needs->m->run, "step"), most = BELOW_LIMIT * limit,
               largest = fmin(own <= most ? own : most, needs->unit);
  return needs->unit / ceil(needs->unit / largest * (1.0 - 1e-12));
}

static int32_t compare(struct hk_needs *needs, double limit, const struct hk_variant *change, double *error) {
  const double bytes = (double)(3 * needs->watch_count * needs->frame_count) * sizeof(double);
  if (PATHS * bytes > MOST_BYTES) return HOOKE_OK;
  needs->full = hk_needs_no_cost;
  needs->full.step = choose_step(needs, limit);
  const int32_t status = hk_needs_try(needs, change, 0, error, NULL);
  const struct hk_needs_path *full = &needs->by_step[0];
  if (status != HOOKE_OK || !isfinite(*error) || full->recorded < needs->frame_count ||
      !(hk_needs_moved(needs, full) > 0.0))
    *error = NAN;
  return status;
}

static int32_t create(const hooke_system *system, const hooke_options *run, const char *method, double want,
                      hooke_measurement **m) {
  hooke_options *options = NULL, *copy = NULL;
  int32_t status = hk_options_create(hk_needs_kind.options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "want", want);
  if (status == HOOKE_OK) status = hooke_options_copy(run, &copy);
  if (status == HOOKE_OK) status = hooke_options_set_text(copy, "method", method);
  if (status == HOOKE_OK) status = hk_measurement_create(&hk_needs_kind, NULL, system, copy, options, m);
  hooke_options_destroy(options);
  hooke_options_destroy(copy);
  return status;
}

int32_t hk_price_find(const hooke_system *system, const hooke_options *run, const char *method, double limit,
                      const struct hk_variant *change, struct hk_budget *budget, struct hk_price *price) {
  hooke_measurement *m = NULL;
  *price = (struct hk_price){NAN, NAN};
  if (run == NULL || !hooke_options_is_set(run, "duration") || system->generalized) return HOOKE_OK;
  const double want = WANT * hk_diagonal(system->particle_count, system->position),
               left = hk_budget_left(budget);
  const double unit = want > 0.0 ? pow(10.0, floor(log10(want))) : 1.0;
  const double asked = want > 0.0 ? round(want / unit) * unit : WANT;
  price->want = asked;
  if (!(left > 0.0) || !(limit > 0.0) || hk_system_calls_back(system)) return HOOKE_OK;
  int32_t status = create(system, run, method, asked, &m);
  if (status == HOOKE_OK) {
    struct hk_needs *needs = m->object;
    m->progress = budget->progress;
    m->progress_ctx = budget->ctx;
    hk_stage_begin(&needs->stage, "the error of what is advised", 1.0);
    needs->most_work = fmin(MOST_WORK, SHARE * left);
    status = compare(needs, limit, change, &price->error);
    hk_budget_spend(budget, needs->trial_work);
    if (!isnan(price->error)) price->want = NAN;
  }
  hooke_measurement_destroy(m);
  return status == HOOKE_STOPPED || status == HOOKE_NO_MEMORY ? status : HOOKE_OK;
}
