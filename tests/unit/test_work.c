/* Counted work follows from counts and systems alone: no test here looks at a clock. */
#include "check.h"
#include "random_scene.h"
#include "run.h"
#include "small.h"

#include "measure/counted_work/work.h"
#include "model/force/force.h"
#include "model/sum/tiled.h"

#include <math.h>
#include <stdlib.h>

static const struct random_scene_request mixed = {.seed = 3,
                                                  .particles = 40,
                                                  .springs = 120,
                                                  .triples = 10,
                                                  .tetrahedra = 8,
                                                  .anchors = 6,
                                                  .features = SCENE_GRAVITY | SCENE_DRAG | SCENE_DAMPING |
                                                              SCENE_PINNED | SCENE_CALLBACK,
                                                  .with_product = 1};
/* Large enough for several threads. */
static const struct random_scene_request large = {
    .seed = 5, .particles = 3, .springs = 2, .features = SCENE_GRAVITY, .cloth = {80, 80}};

static double work_of(const struct random_scene *scene, struct run run, int64_t steps) {
  owned_integrator *it = start_run(scene->system, run);
  owned_state *state = start_state(scene->system);
  assert_true(hk_work_of(it) == 0.0);
  check_ok(hooke_integrator_step(it, state, steps));
  return hk_work_of(it);
}

TEST(test_every_cost_is_positive) {
  int32_t forces = 0;
  while (hk_force_table(forces))
    forces++;
  for (int k = 0; k < HOOKE_WORKS; k++) {
    if (k < HOOKE_WORKS_OF_FORCE * forces || k >= HOOKE_WORK_STEP) assert_true(hk_costs[k] > 0.0);
  }
}

TEST(test_every_method_has_work) {
  owned_random_scene scene;
  random_scene_create(mixed, &scene);
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    const char *method = hooke_method_name(k);
    if (hooke_method_is_built(method))
      assert_true(work_of(&scene, (struct run){.method = method, .step = 1e-5}, 3) > 0.0);
  }
}

TEST(test_twice_the_steps_are_twice_the_work) {
  static const char *const methods[] = {
      "forward-euler", "symplectic-euler", "verlet", "shardlow", "heun", "rk4"};
  owned_random_scene scene;
  random_scene_create(mixed, &scene);
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    const struct run run = {.method = methods[k], .step = 1e-6};
    const double once = work_of(&scene, run, 200), twice = work_of(&scene, run, 400);
    assert_true(fabs(twice / once - 2.0) < 0.02);
  }
}

/* What it foretells is what is counted, where nothing is solved. */
TEST(test_steps_are_foretold) {
  static const char *const methods[] = {"forward-euler", "symplectic-euler", "verlet", "heun", "rk4"};
  owned_random_scene scene;
  random_scene_create(large, &scene);
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    const double counted = work_of(&scene, (struct run){.method = methods[k], .step = 1e-6}, 200);
    assert_true(fabs(hk_work_of_steps(scene.system, methods[k], 200) / counted - 1.0) < 0.01);
  }
  assert_true(isnan(hk_work_of_steps(scene.system, "backward-euler", 200)));
  assert_true(isnan(hk_work_of_steps(scene.system, "cvode-bdf", 200)));
  assert_true(isnan(hk_work_of_steps(scene.system, "no-method", 200)));
  assert_true(hk_work_of_evaluation(scene.system) > 0.0);
  random_scene_destroy(&scene);
  random_scene_create(mixed, &scene);
  assert_true(isnan(hk_work_of_steps(scene.system, "verlet", 200))); /* it may solve for damping */
}

TEST(test_threads_do_not_count) {
  static const char *const methods[] = {"symplectic-euler", "rk4", "backward-euler", "cvode-bdf"};
  struct random_scene scene;
  random_scene_create(large, &scene);
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    if (!hooke_method_is_built(methods[k])) continue;
    struct run run = {.method = methods[k], .step = 1e-6, .newton_tolerance = BY_DEFAULT, .threads = 1};
    const double one = work_of(&scene, run, 20);
    run.threads = 4;
    assert_true(work_of(&scene, run, 20) == one);
  }
  random_scene_destroy(&scene);
}

/* An evaluation has every member of every force; what else is in it is below 2 % of that. */
TEST(test_every_member_counts) {
  struct random_scene_request request = mixed;
  owned_random_scene scene;
  request.springs = 9000;
  request.triples = 8000;
  request.tetrahedra = 3000;
  request.anchors = 5000;
  random_scene_create(request, &scene);
  double sum = 0.0;
  for (int32_t k = 0; k < 4; k++) {
    const int64_t members = hk_force_count(scene.system, hk_force_table(k));
    assert_true(members > 2500);
    sum += 1e-9 * hk_costs[HOOKE_WORKS_OF_FORCE * k] * (double)members;
  }
  const double scattered = scene.system->tiled->order
                               ? 1e-9 * hk_costs[HOOKE_WORK_SCATTERED] * (double)scene.system->springs->count
                               : 0.0;
  const double work = hk_work_of_evaluation(scene.system);
  assert_true(work > sum && work < 1.02 * (sum + scattered));
}

/* A step of a long bar that hangs on one spring. */
static double work_of_body(int64_t particles) {
  double *q = calloc((size_t)(3 * particles), sizeof *q), *mass = calloc((size_t)particles, sizeof *mass);
  int64_t *member = calloc((size_t)particles, sizeof *member);
  for (int64_t p = 0; p < particles; p++) {
    q[3 * p] = (double)p;
    mass[p] = 1.0;
    member[p] = p + 1;
  }
  owned_system *system = new_system();
  check_ok(hooke_system_add_particles(system, 1, (double[]){0.0, 1.0, 0.0}, NULL, 1, (double[]){1.0}, NULL));
  check_ok(hooke_system_add_particles(system, particles, q, NULL, particles, mass, NULL));
  check_ok(hooke_system_pin(system, 1, (int64_t[]){0}));
  small_group(system, "springs", NULL, 1, (int64_t[]){0, 1}, "stiffness=40 rest_length=1");
  check_ok(hooke_system_add_body(system, "bar", particles, member, 0));
  free(q);
  free(mass);
  free(member);
  return hk_work_of_steps(committed(system), "rk4", 1);
}

/* A step visits the particles of a body that a force acts on. */
TEST(test_particles_that_nothing_acts_on_cost_nothing) {
  const double few = work_of_body(8);
  assert_true(few > 0.0 && work_of_body(20000) < 2.0 * few);
}

/* A factor counts by its size, and a step that has one is dearer than its matrix alone. */
TEST(test_factors_count) {
  struct random_scene scene;
  random_scene_create(large, &scene);
  owned_options *options =
      run_options((struct run){.method = "backward-euler", .step = 1e-3, .linear_solver = "direct"});
  hooke_integrator *it = NULL;
  const int32_t status = hooke_integrator_create(scene.system, options, &it);
  if (status == HOOKE_NOT_BUILT) {
    random_scene_destroy(&scene);
    skip();
  }
  check_ok(status);
  hooke_state *state = start_state(scene.system);
  check_ok(hooke_integrator_step(it, state, 1));
  const struct hk_counts *count = &it->count;
  assert_true(count->matrices > 0 && count->factor_products > 0 && count->factor_numbers > 0);
  const double cost = 1e-9 * hk_costs[HOOKE_WORK_FACTOR_PRODUCT] * (double)count->factor_products;
  assert_true(hk_work_of(it) > cost && cost > 0.0);
  hooke_state_destroy(state);
  hooke_integrator_destroy(it);
  random_scene_destroy(&scene);
}

static int32_t slope(int64_t size, double t, const double *x, double *out, void *ctx) {
  (void)t, (void)ctx;
  for (int64_t k = 0; k < size; k++)
    out[k] = -x[k];
  return 0;
}

TEST(test_first_order_problems_have_work) {
  owned_integrator *it = start_first_order(6, slope, NULL, (struct run){.method = "rk4", .step = 0.01});
  owned_state *state = NULL;
  check_ok(hooke_state_create_first_order(6, &state));
  check_ok(hooke_integrator_step(it, state, 10));
  const double once = hk_work_of(it);
  check_ok(hooke_integrator_step(it, state, 10));
  assert_true(once > 0.0);
  assert_true(fabs(hk_work_of(it) / once - 2.0) < 0.02);
}
