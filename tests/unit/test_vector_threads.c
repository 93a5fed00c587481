/* Large vectors of SUNDIALS are processed by several threads; its methods give the same bits for any number
 * of them, and right ones. */
#include "check.h"
#include "random_scene.h"
#include "run.h"

#include "core/thread_pool.h"
#include "integrate/integrator.h"

#include <string.h>

enum { SIDE = 108 }; /* 69984 numbers in a vector */

static const double DURATION = 4e-5;

static void run_by(const hooke_system *system, struct run run, double *state) {
  const int64_t size = 3 * hooke_system_particle_count(system);
  owned_integrator *integrator = start_run(system, run);
  owned_state *found = start_state(system);
  /* a thread pool of one would prove nothing */
  assert_true(run.threads <= 1 || hk_pool_members(integrator->pool) > 1);
  check_ok(hooke_integrator_run(integrator, found));
  memcpy(state, hooke_state_position(found), (size_t)size * sizeof(double));
  memcpy(state + size, hooke_state_velocity(found), (size_t)size * sizeof(double));
}

TEST(same_bits) {
  static const char *const methods[] = {"cvode-bdf", "cvode-adams"};
  if (hooke_method_is_built("cvode-bdf") != 1) skip();
  owned_random_scene scene;
  random_scene_with(&scene, .seed = 4, .particles = 1, .features = SCENE_GRAVITY | SCENE_DAMPING,
                    .cloth = {SIDE, SIDE});
  const int64_t size = 3 * hooke_system_particle_count(scene.system);
  double *exact = new_doubles(6 * size), *one = exact + 2 * size, *other = one + 2 * size;
  run_by(scene.system, (struct run){.method = "rk4", .step = 1e-6, .duration = DURATION}, exact);
  check_between(largest(size, exact + size), 1e-4, 1e-3); /* velocities, from rest: the scale of errors */
  for (int m = 0; m < 2; m++) {
    struct run run = {.method = methods[m],
                      .rtol = 1e-8,
                      .atol = 1e-10,
                      .atol_velocity = 1e-10,
                      .duration = DURATION,
                      .threads = 1};
    run_by(scene.system, run, one);
    check_between(largest_difference(size, one + size, exact + size), 0.0, 1e-10);
    for (run.threads = 2; run.threads <= 3; run.threads++) {
      run_by(scene.system, run, other);
      check_same_bits(2 * size, other, one);
    }
  }
  free(exact);
}
