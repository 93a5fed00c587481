#include "measure/limit/limit_predict.h"

#include "core/memory.h"
#include "core/status.h"
#include "measure/spectrum/limit_rules.h"

#include <math.h>

static const double SURE = 1e-3; /* accuracy of a limit that counts as exact */

int32_t hk_limit_predict(const hooke_system *system, const double *q, const double *v, const char *method,
                         double accuracy, hooke_progress *progress, void *ctx, double *limit) {
  struct hk_budget endless = hk_budget_of(INFINITY, progress, ctx);
  return hk_limit_predict_within(system, q, v, method, NULL, NULL, accuracy, 0.0, &endless, limit);
}

/* `prediction` without its mode. */
static int32_t predict(struct hk_linearised *linearised, const char *method, double accuracy,
                       enum hk_spectrum_extent extent, struct hk_prediction *prediction) {
  struct hk_spectrum spectrum;
  if (!hk_limit_rule_needs_all(method)) extent = HOOKE_SPECTRUM_STIFFEST;
  int32_t status = hk_spectrum_create(linearised, accuracy, extent, NULL, &spectrum);
  if (status != HOOKE_OK) return status;
  prediction->mode = hk_new(linearised->size, sizeof(double));
  status = prediction->mode ? hk_limit_rule(&spectrum, method, prediction) : HOOKE_NO_MEMORY;
  hk_free(prediction->mode);
  prediction->mode = NULL;
  hk_spectrum_release(&spectrum);
  return status;
}

int32_t hk_limit_predict_within(const hooke_system *system, const double *q, const double *v,
                                const char *method, const double *spring_scale, const double *mass_scale,
                                double accuracy, double memory, struct hk_budget *budget, double *limit) {
  struct hk_linearised linearised;
  struct hk_prediction prediction;
  int32_t status = hk_linearised_create(system, q, v, spring_scale, mass_scale, &linearised);
  if (status != HOOKE_OK) return status;
  linearised.budget = budget;
  linearised.memory = memory;
  status = predict(&linearised, method, accuracy, HOOKE_SPECTRUM_ALL, &prediction);
  if (status == HOOKE_OK) *limit = prediction.limit;
  hk_linearised_release(&linearised);
  return status;
}

int32_t hk_limit_sure(const hooke_system *system, const double *q, const double *v, const char *method,
                      struct hk_budget *budget, double *limit) {
  struct hk_linearised linearised;
  struct hk_prediction prediction;
  int32_t status = hk_linearised_create(system, q, v, NULL, NULL, &linearised);
  if (status != HOOKE_OK) return status;
  linearised.budget = budget;
  status = predict(&linearised, method, SURE, HOOKE_SPECTRUM_EXTREMES, &prediction);
  if (status == HOOKE_OK) *limit = fmax(*limit, (1.0 - SURE) * prediction.sure);
  const int more = hk_limit_rule_needs_all(method) && !prediction.exact && !prediction.spins &&
                   linearised.unknowns <= HOOKE_SPECTRUM_DAMPED;
  if (status == HOOKE_OK && more) {
    status = predict(&linearised, method, SURE, HOOKE_SPECTRUM_ALL, &prediction);
    if (status == HOOKE_OK && prediction.exact) *limit = fmax(*limit, (1.0 - SURE) * prediction.limit);
  }
  hk_linearised_release(&linearised);
  return status == HOOKE_NO_MEMORY ? status : HOOKE_OK;
}
