#include "measure/limit_predict.h"

#include "core/memory.h"
#include "measure/limit_rules.h"

#include <math.h>

int32_t hooke_limit_predict(const hooke_system *system, const double *q, const char *method, double accuracy,
                            hooke_progress *progress, void *ctx, double *limit) {
  struct hooke_patience endless = hooke_patience_of(INFINITY, progress, ctx);
  return hooke_limit_predict_within(system, q, method, NULL, NULL, accuracy, 0.0, &endless, limit);
}

int32_t hooke_limit_predict_within(const hooke_system *system, const double *q, const char *method,
                                   const double *spring_scale, const double *mass_scale, double accuracy,
                                   double room, struct hooke_patience *patience, double *limit) {
  struct hooke_linearised linearised;
  struct hooke_spectrum spectrum;
  int32_t status = hooke_linearised_create(system, q, spring_scale, mass_scale, &linearised);
  if (status != HOOKE_OK) return status;
  linearised.patience = patience;
  linearised.room = room;
  status = hooke_spectrum_create(&linearised, accuracy, !hooke_limit_rule_needs_all(method), NULL, &spectrum);
  if (status == HOOKE_OK) {
    struct hooke_prediction prediction = {.mode = hooke_new(linearised.size, sizeof(double))};
    status = prediction.mode ? hooke_limit_rule(&spectrum, method, &prediction) : HOOKE_NO_MEMORY;
    if (status == HOOKE_OK) *limit = prediction.limit;
    hooke_free(prediction.mode);
    hooke_spectrum_release(&spectrum);
  }
  hooke_linearised_release(&linearised);
  return status;
}
