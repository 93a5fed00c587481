#include "measure/trial/bracket.h"

#include "hooke/base.h"

#include <math.h>

static int32_t see(struct hk_bracket *b, double step) {
  enum hk_trial_end end = HOOKE_TRIAL_UNKNOWN;
  const int32_t status = b->try_step(b->ctx, step, &end);
  if (status != HOOKE_OK) return status;
  if (end == HOOKE_TRIAL_HOLDS)
    b->holds = fmax(b->holds, step);
  else if (end == HOOKE_TRIAL_FAILS)
    b->fails = fmin(b->fails, step);
  else
    b->unknown = 1;
  /* a step failed although a larger one held: the smaller one is the limit */
  if (b->fails < b->holds) b->holds = 0.0;
  return HOOKE_OK;
}

/* The next step outwards: about 1, 4, 16, ... times `nearest` from the guess, then by factors of 2, 4, 16,
 * 16, ... Not alike on both sides, since halving would then end at a good guess itself, where nothing can be
 * seen to grow or decay. */
struct reach {
  double fraction, factor;
};

static double outwards(struct reach *reach, double guess, int up) {
  reach->fraction *= 4.0;
  if (reach->fraction < 0.5) return up ? guess * (1.0 + reach->fraction) : guess * (1.0 - reach->fraction);
  reach->factor = fmin(16.0, reach->factor * reach->factor);
  return up ? guess * reach->factor : guess / reach->factor;
}

int32_t hk_bracket_search(struct hk_bracket *b, double guess) {
  const double nearest = b->sharp ? 0.25 * b->accuracy : b->accuracy;
  struct reach below = {0.2 * nearest, sqrt(2.0)}, above = {0.25 * nearest, sqrt(2.0)};
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK && !b->unknown && isinf(b->fails) && b->holds < b->most)
    status = see(b, fmin(b->most, outwards(&above, fmax(guess, b->holds), 1)));
  while (status == HOOKE_OK && !b->unknown && !(b->holds > 0.0) && b->fails > b->least)
    status = see(b, fmax(b->least, outwards(&below, fmin(guess, b->fails), 0)));
  while (status == HOOKE_OK && !b->unknown && b->holds > 0.0 && isfinite(b->fails) &&
         b->fails - b->holds > 0.5 * b->accuracy * b->fails) {
    const double middle = b->fails > 4.0 * b->holds ? sqrt(b->fails * b->holds) : 0.5 * (b->fails + b->holds);
    status = see(b, middle);
  }
  return status;
}
