/* Round steps that fit: the largest of 1, 2 or 5 times a power of ten up to the limit of which frames and the
 * whole run are multiples, or else an integer fraction of these times. */
#include "measure/why/why.h"

#include "check.h"

#include <math.h>

TEST(handy_steps) {
  const struct {
    double step, limit, every, duration, expected;
  } rows[] = {
      {NAN, 0.7, NAN, NAN, 0.5},                  /* nothing to fit */
      {NAN, 0.2, NAN, NAN, 0.2},                  /* the limit itself */
      {NAN, 0.0199, NAN, NAN, 0.01},              /* the next smaller one */
      {0.3, 0.07, 0.9, 1.8, 0.05},                /* fits both */
      {0.3, 0.07, 0.03, 1.8, 0.01},               /* 0.05 and 0.02 do not fit the frames */
      {0.3, 0.07, NAN, 0.11, 0.01},               /* 0.05 and 0.02 do not fit the whole */
      {0.3, 0.07, NAN, 0.06, 0.02},               /* 0.05 does not */
      {0.3, 0.07, 0.01, 1.8, 0.01},               /* a frame is the longest step */
      {0.37, 0.2, 0.37, 3.7, 0.01},               /* a step of an odd length fits its frames by hundredths */
      {1.0 / 3.0, 0.2, NAN, 1.0, 0.2},            /* for any step */
      {M_PI, 1.0, M_PI, 10.0 * M_PI, M_PI / 4.0}, /* no power of ten fits: a fraction of the step */
      {NAN, 1.0, M_PI, 10.0 * M_PI, M_PI / 4.0},  /* of a frame */
      {NAN, 1.0, NAN, 10.0 * M_PI, 10.0 * M_PI / 32.0}, /* of the whole */
      {NAN, 1.0, M_PI, 7.0, 7.0 / 7.0}, /* frames that do not fit the whole do not count then */
      {NAN, 3e-310, NAN, NAN, 2e-310},  /* subnormal */
  };
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
    const double step = hk_handy_step(rows[k].step, rows[k].limit, rows[k].every, rows[k].duration);
    if (!(fabs(step - rows[k].expected) <= 1e-12 * rows[k].expected))
      check_failed("row %d: %.17g in place of %.17g", (int)k, step, rows[k].expected);
    assert_true(step <= rows[k].limit);
  }
}
