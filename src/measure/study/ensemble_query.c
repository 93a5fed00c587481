/* Statistics of an ensemble. */
#include "measure/study/ensemble.h"

#include "core/named_number.h"
#include "measure/study/study.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

struct hk_ensemble_sample hk_ensemble_sample(const struct hk_ensemble *ensemble, int64_t source,
                                             int64_t quantity) {
  const struct hk_ensemble_source *s = &ensemble->source[source];
  struct hk_ensemble_sample sample = {.members = 0, .mean = NAN, .spread = NAN};
  double mean = 0.0, square = 0.0; /* running mean and variance (Welford 1962) */
  for (int64_t k = 0; k < s->finished; k++) {
    const double value = s->sample[k * ensemble->quantities.count + quantity];
    if (isnan(value)) continue;
    const double from_mean = value - mean;
    mean += from_mean / (double)++sample.members;
    square += from_mean * (value - mean);
  }
  if (s->failed) return sample;
  if (sample.members > 0) sample.mean = mean;
  if (sample.members > 1) sample.spread = sqrt(square / (double)(sample.members - 1));
  return sample;
}

double hk_ensemble_bias(const struct hk_ensemble *ensemble, int64_t source, int64_t quantity) {
  const struct hk_ensemble_sample own = hk_ensemble_sample(ensemble, source, quantity),
                                  other = hk_ensemble_sample(ensemble, 0, quantity);
  const double variance =
      own.spread * own.spread / (double)own.members + other.spread * other.spread / (double)other.members;
  const double difference = own.mean - other.mean;
  return difference == 0.0 && variance == 0.0 ? 0.0 : difference / sqrt(variance);
}
