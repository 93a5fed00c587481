/* Stiffness from 1e-12 to 1e15 by both laws. */
#include "check.h"
#include "extreme.h"

#include <stdio.h>

TEST(test_stiffness) {
  const double stiffness[] = {1e-12, 1e-6, 1.0, 1e6, 1e15};
  const char *laws[] = {"length", "strain"};
  for (int law = 0; law < 2; law++) {
    for (int k = 0; k < 5; k++) {
      char name[64];
      snprintf(name, sizeof name, "%.0e %s", stiffness[k], law == 0 ? "N/m" : "N, strain law");
      extreme_oscillate(&(struct extreme_oscillator){.family = "stiffness",
                                                     .name = name,
                                                     .law = laws[law],
                                                     .stiffness = stiffness[k],
                                                     .mass = 1.0,
                                                     .step = 0.05,
                                                     .steps = 200});
    }
  }
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
