/* Picks: two of one scene count the same work, to the bit, which no clock does. */
#include "check.h"
#include "measure/recommend/pick.h"
#include "run.h"
#include "small.h"

TEST(choices_are_by_counted_work) {
  hooke_system *system = small_net(3, 0.02, 1.0, 1);
  hooke_options *run = run_options((struct run){.duration = 0.1, .every = 0.01});
  struct hk_pick pick[2];
  for (int k = 0; k < 2; k++) {
    const int32_t status = hk_pick_run(&pick[k], system, run, 1e-4, 0, NULL, NULL, NULL);
    check_ok(status);
    assert_true(pick[k].met);
    check_between(pick[k].best.work, 1e-9, pick[k].work);
    check_between(pick[k].best.wall_seconds, 1e-9, 60.0);
  }
  assert_string_equal(pick[0].best.method, pick[1].best.method);
  assert_true(pick[0].best.work == pick[1].best.work && pick[0].work == pick[1].work);
  for (int k = 0; k < 2; k++)
    hk_pick_release(&pick[k]);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}
