/* Damping from nothing to a million times critical, of springs and by drag: with a step that resolves it, and
 * with one that does not, where explicit methods have to report it. */
#include "check.h"
#include "extreme.h"

#include <stdio.h>

static void test_damping(int32_t drag) {
  const double damping[] = {0.0, 1e-6, 0.1, 1.0, 10.0, 1e3, 1e6};
  for (int k = 0; k < 7; k++) {
    char name[64];
    for (int resolved = 0; resolved <= (damping[k] > 1.0); resolved++) {
      const double step = resolved ? 0.05 / damping[k] : 0.05;
      snprintf(name, sizeof name, "%g critical%s, step %g/omega", damping[k], drag ? " by drag" : "", step);
      extreme_oscillate(&(struct extreme_oscillator){.family = "damping",
                                                     .name = name,
                                                     .law = "length",
                                                     .stiffness = 10.0,
                                                     .mass = 0.1,
                                                     .damping = damping[k],
                                                     .drag = drag,
                                                     .step = step,
                                                     .steps = 200,
                                                     .max_steps = 100000,
                                                     .may_run_out = step * damping[k] > 1e2});
    }
  }
}

TEST(test_of_springs) {
  test_damping(0);
}

TEST(test_by_drag) {
  test_damping(1);
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
