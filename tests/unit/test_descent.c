/* The potential of an overdamped stage tells a wrong solution of its equations from the right one. */
#include "integrate/solve/stage.h"

#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const double KAPPA = 10.0, START = 0.97, STEP = 10.0;

/* A free particle on a spring of 1 m from the origin, with drag 1. */
static hooke_system *make_pair(int calls_back) {
  hooke_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_set_drag(system, 1.0));
  check_ok(hooke_system_add_particles(system, 2, (double[]){0, 0, 0, START, 0, 0}, NULL, 0, NULL, NULL));
  check_ok(hooke_system_pin(system, 1, (int64_t[]){0}));
  small_group(system, "springs", NULL, 1, (int64_t[]){0, 1}, "stiffness=%.17g rest_length=1", KAPPA);
  if (calls_back) check_ok(hooke_system_set_force(system, idle_force, NULL, NULL));
  return committed(system);
}

/* With x = START + h v, the equations v = -kappa (x -+ 1) have a solution on either side of the origin. */
static double potential_at(struct hk_descent *descent, const hooke_integrator *it, double v, double *slack) {
  const double velocity[6] = {0.0, v, 0.0, 0.0, 0.0, 0.0}; /* x of both, y, z */
  it->motion->q[0][1] = START + STEP * v;
  const double found = hk_descent_potential(descent, it, STEP, velocity, slack), x = START + STEP * v;
  check_close(found, 0.5 * KAPPA * (fabs(x) - 1.0) * (fabs(x) - 1.0) + 0.5 * STEP * v * v, 1e-13);
  return found;
}

TEST(test_wrong_solution) {
  owned_system *system = make_pair(0);
  owned_run(it, state, system, .method = "backward-euler", .step = STEP);
  struct hk_stage *stage = it->own;
  double slack = 0.0;
  check_ok(hooke_integrator_step(it, state, 1));
  const double right = -KAPPA * (START - 1.0) / (1.0 + KAPPA * STEP),
               wrong = -KAPPA * (START + 1.0) / (1.0 + KAPPA * STEP);
  check_close(hooke_state_position(state)[3], START + STEP * right, 1e-12);
  const double start = potential_at(&stage->descent, it, 0.0, &slack);
  check_between(slack, 0.0, 1e-14);
  assert_true(potential_at(&stage->descent, it, right, &slack) < start);
  assert_true(potential_at(&stage->descent, it, wrong, &slack) > start + 0.1);
}

static int32_t plant(struct hk_stage *stage) {
  const double wrong = -KAPPA * (START + 1.0) / (1.0 + KAPPA * STEP);
  struct hk_motion *m = stage->reduced.integrator->motion;
  memset(stage->v, 0, (size_t)stage->size * sizeof(double));
  stage->v[1] = m->v[0][1] = wrong;
  m->q[0][1] = START + STEP * wrong;
  const int32_t status = hk_integrator_forces(stage->reduced.integrator, stage->at.t);
  check_close(m->f[0][1], wrong, 1e-12); /* it is a solution */
  return status;
}

/* A first solution on the other side: the stage ends at the right one. */
TEST(test_planted) {
  owned_system *system = make_pair(0);
  owned_integrator *it = start_with(system, .method = "backward-euler", .step = STEP);
  const double start[6] = {0.0, 0.0, 0.0, START, 0.0, 0.0}, still[6] = {0}, place[6] = {0.0, START};
  const struct hk_equations equations = {0.0, STEP, place, still, STEP};
  hk_motion_load(system, it->motion, start, still);
  check_ok(hk_stage_solve_by(it->own, &equations, plant));
  check_close(it->motion->q[0][1], START - STEP * KAPPA * (START - 1.0) / (1.0 + KAPPA * STEP), 1e-9);
}

TEST(test_no_potential) {
  owned_system *system = make_pair(1);
  owned_integrator *it = start_with(system, .method = "backward-euler", .step = STEP);
  assert_null(((struct hk_stage *)it->own)->descent.rows);
}
