/* What a diagnosis blames: the spring with the largest share, or its group where that share is small. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <string.h>

/* Of a cloth of 16 x 16 no spring has 5 % of what grows, so the group is named; of one of 4 x 4 some has. */
TEST(test_a_small_share_names_the_group) {
  if (!HOOKE_HAVE_LAPACK) skip();
  for (int64_t side = 4; side <= 16; side *= 4) {
    owned_system *system = small_cloth(side, 50.0, 0.0);
    owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.02, .duration = 2.0,
              .every = 0.02);
    owned_measurement *why = NULL;
    check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
    check_ok(explain_run(integrator, &why));
    const char *sentence = hooke_measurement_text(why, "why", 0, "sentence");
    const double share = hooke_measurement_number(why, "blame", 0, "share");
    const int small = side == 16;
    check_between(share, small ? 0.0 : 0.05, small ? 0.05 : 1.0);
    if (!strstr(sentence, small ? "most of all in group " : "most of all in spring ") ||
        (strstr(sentence, " % of that motion, first at particle ") != NULL) != small)
      check_failed("%d x %d: %s", (int)side, (int)side, sentence);
  }
}
