/* The search for a position of rest ends like Newton's method, and tells what it lacks. */
#include "measure/rest/rest_find.h"

#include "integrate/solve/stage.h"

#include "check.h"
#include "owned.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const double LONG_STEP = 1e6;

/* A weight on two springs between pins. */
static hooke_system *make_swing(double gravity) {
  hooke_system *system = new_system();
  check_ok(hooke_system_set_gravity(system, (double[]){0, gravity, 0}));
  check_ok(hooke_system_add_particles(system, 3, (double[]){0, 0, 0, 1, -0.2, 0, 2, 0.1, 0}, NULL, 1,
                                      (double[]){2}, NULL));
  check_ok(hooke_system_pin(system, 2, (int64_t[]){0, 2}));
  small_group(system, "springs", NULL, 2, (int64_t[]){0, 1, 1, 2}, "stiffness=80 rest_length=0.9");
  return committed(system);
}

/* How far two corrections of one long step from `off` beside rest leave the weight from there. */
static double error_after_two(const hooke_system *system, const double *rest, double off) {
  owned_options *options = options_with("run", "method=backward-euler step=1");
  owned_integrator *it = NULL;
  double q[9], v[9] = {0.0};
  check_ok(hooke_integrator_create(system, options, &it));
  struct hk_stage *stage = it->own;
  stage->tolerance = 1e30; /* the first correction never ends it, the second does */
  memcpy(q, rest, sizeof q);
  q[3] += off;
  q[4] -= 0.7 * off;
  hk_motion_load(system, it->motion, q, v);
  check_ok(hk_descent_create(it, &stage->descent));
  hk_stage_save(stage, stage->start);
  check_ok(hk_stage_descend(
      stage, &(struct hk_equations){0.0, LONG_STEP, stage->start, stage->start + it->size, LONG_STEP}));
  assert_int_equal(it->count.nonlinear_iterations, 2);
  hk_motion_store(it->motion, q, v);
  return hypot(q[3] - rest[3], q[4] - rest[4]);
}

TEST(test_last_corrections_are_quadratic) {
  owned_system *system = make_swing(-9.81);
  double q[9];
  struct hk_rest rest;
  memcpy(q, system->position, sizeof q);
  check_ok(hk_rest_find(system, 0.0, q, NULL, &rest));
  assert_int_equal(rest.lack, HOOKE_RESTS);
  check_between(rest.residual, 0.0, 1e-11);
  const double coarse = error_after_two(system, q, 0.04), fine = error_after_two(system, q, 0.02);
  check_between(log2(coarse / fine), 3.5, 4.5); /* each squares the error */
}

TEST(test_no_step_may_climb) {
  owned_system *system = make_swing(9.81);
  double q[9], zeros[9] = {0.0};
  struct hk_rest rest;
  memcpy(q, system->position, sizeof q);
  check_ok(hk_rest_find(system, 0.0, q, NULL, &rest));
  assert_int_equal(rest.has_energy, 1);
  assert_true(q[4] > 0.05);
  assert_true(hooke_system_energy(system, "total", q, zeros) <
              hooke_system_energy(system, "total", system->position, zeros));
}

TEST(test_a_budget_that_is_spent) {
  owned_system *system = make_swing(-9.81);
  double q[9];
  struct hk_rest rest;
  struct hk_budget budget = hk_budget_of(0.0, NULL, NULL);
  memcpy(q, system->position, sizeof q);
  check_ok(hk_rest_find(system, 0.0, q, &budget, &rest));
  assert_int_equal(rest.lack, HOOKE_REST_SPENT);
  check_between(rest.residual, 1.0, 100.0);
}
