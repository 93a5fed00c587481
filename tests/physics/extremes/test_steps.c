/* Invalid steps, steps too small to change anything, and steps that overflow. */
#include "check.h"
#include "extreme.h"
#include "small.h"

#include <math.h>

/* ---- refused when set ---- */

static const struct {
  const char *name, *text;
  double number;
} refused[] = {
    {"0", "0", 0.0},
    {"-1", "-1", -1.0},
    {"not a number", "nan", NAN},
    {"infinite", "inf", INFINITY},
    {"-infinite", "-inf", -INFINITY},
    {"1e301", "1e301", 1e301},
    {"1e999 as text", "1e999", NAN},
    {"1e-999 as text", "1e-999", NAN},
};

TEST(test_refused) {
  const char *options[] = {"step", "duration", "every"};
  owned_options *run = new_options("run");
  for (size_t k = 0; k < sizeof refused / sizeof refused[0]; k++) {
    for (int o = 0; o < 3; o++) {
      check_status(hooke_options_set_number(run, options[o], refused[k].number), HOOKE_BAD_VALUE);
      check_message(options[o]);
      check_message("allowed");
      check_status(hooke_options_set_text(run, options[o], refused[k].text), HOOKE_BAD_VALUE);
      check_message(options[o]);
      check_message("allowed");
      assert_false(hooke_options_is_set(run, options[o]));
    }
    for (int64_t m = 0; m < hooke_method_count(); m++)
      extreme_note("steps", refused[k].name, hooke_method_name(m), "bad value");
  }
}

/* ---- accepted ---- */

static struct extreme_oscillator oscillator(const char *name, double omega, double step) {
  return (struct extreme_oscillator){.family = "steps",
                                     .name = name,
                                     .law = "length",
                                     .stiffness = omega * omega,
                                     .mass = 1.0,
                                     .step = step * omega,
                                     .steps = 100,
                                     .max_steps = 1000};
}

/* No digit of any position changes, and none has to. */
TEST(test_subnormal) {
  struct extreme_oscillator smallest = oscillator("4.9e-324 s", 1.0, 4.9e-324);
  struct extreme_oscillator small = oscillator("1e-310 s", 1.0, 1e-310);
  smallest.adaptive_status = small.adaptive_status = HOOKE_SOLVER_FAILED;
  extreme_oscillate(&smallest);
  extreme_oscillate(&small);
}

/* Steps below the last digit of the time: positions do not depend on it, error control does. */
TEST(test_below_the_digits_of_time) {
  struct extreme_oscillator late = oscillator("1e-10 s at t = 1e9 s", 5e8, 1e-10);
  late.start = 1e9;
  late.adaptive_status = HOOKE_BAD_VALUE;
  extreme_oscillate(&late);
}

TEST(test_overflow) {
  struct extreme_oscillator large = oscillator("1e100 s", 1.0, 1e100);
  struct extreme_oscillator larger = oscillator("1e200 s", 1.0, 1e200);
  struct extreme_oscillator largest = oscillator("1e298 s", 1.0, 1e298);
  large.adaptive_status = larger.adaptive_status = largest.adaptive_status = HOOKE_STEP_LIMIT;
  larger.implicit_status = largest.implicit_status = HOOKE_SOLVER_FAILED;
  extreme_oscillate(&large);
  extreme_oscillate(&larger);
  extreme_oscillate(&largest);
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
