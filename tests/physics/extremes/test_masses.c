/* Masses from 1e-15 to 1e15 kg, alone and at a ratio of 1e12 in one scene. */
#include "check.h"
#include "extreme.h"

#include <stdio.h>

static struct extreme_oscillator oscillator(const char *name, double stiffness, double mass, double partner) {
  return (struct extreme_oscillator){.family = "masses",
                                     .name = name,
                                     .law = partner != 0.0 ? "strain" : "length",
                                     .stiffness = stiffness,
                                     .mass = mass,
                                     .partner = partner,
                                     .step = 0.05,
                                     .steps = 200};
}

TEST(test_mass) {
  const double mass[] = {1e-15, 1e-6, 1.0, 1e6, 1e15};
  for (int k = 0; k < 5; k++) {
    char name[64];
    snprintf(name, sizeof name, "%.0e kg", mass[k]);
    const struct extreme_oscillator o = oscillator(name, 1.0, mass[k], 0.0);
    extreme_oscillate(&o);
  }
}

TEST(test_with_stiffness) {
  const struct extreme_oscillator fast = oscillator("1e-15 kg on 1e15 N/m", 1e15, 1e-15, 0.0);
  const struct extreme_oscillator slow = oscillator("1e15 kg on 1e-12 N/m", 1e-12, 1e15, 0.0);
  extreme_oscillate(&fast);
  extreme_oscillate(&slow);
}

/* Two free ends, the moving one light or heavy. */
TEST(test_ratio) {
  const struct extreme_oscillator light = oscillator("1e-6 and 1e6 kg, light end moving", 1.0, 1e-6, 1e6);
  const struct extreme_oscillator heavy = oscillator("1e-6 and 1e6 kg, heavy end moving", 1.0, 1e6, 1e-6);
  extreme_oscillate(&light);
  extreme_oscillate(&heavy);
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
