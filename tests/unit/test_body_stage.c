/* The matrix of an implicit stage with rigid bodies, by differences of its equations. */
#include "integrate/solve/stage.h"
#include "kernel/vector_loops.h"

#include "check.h"
#include "run.h"
#include "small.h"
#include "model/coordinates/body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ALL = 10, BODIES = 2, UNKNOWNS = HOOKE_BODY_VELOCITIES * BODIES };

/* A block, and a bar whose first particle is pinned, with damped springs between them and to posts. */
static hooke_system *two_bodies(int pinned) {
  double q[3 * ALL];
  const double mass[ALL] = {0.5, 1.0, 0.4, 0.7, 0.6, 0.9, 0.3, 1, 1, 1};
  const int64_t block[] = {0, 1, 2, 3}, bar[] = {4, 5, 6}, posts[] = {7, 8, 9, 4},
                ends[] = {0, 7, 1, 8, 2, 5, 3, 6, 6, 9};
  for (int k = 0; k < 3 * ALL; k++)
    q[k] = sin(1.0 + 2.3 * k) + 0.3 * (k / 3 % 4);
  for (int a = 0; a < 3; a++)
    q[18 + a] = q[12 + a] + 1.7 * (q[15 + a] - q[12 + a]);
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, ALL, q, NULL, ALL, mass, NULL));
  check_ok(hooke_system_pin(system, 3 + pinned, posts));
  check_ok(hooke_system_set_gravity(system, (double[]){1.0, -9.81, 2.0}));
  small_group(system, "springs", NULL, 5, ends, "stiffness=40 damping=1 rest_length=0.4");
  check_ok(hooke_system_add_body(system, "block", 4, block, 0));
  check_ok(hooke_system_add_body(system, "bar", 3, bar, 0));
  return committed(system);
}

static void find_right(struct hk_stage *stage, const double *v, double *right) {
  hk_body_stage_place(stage, v);
  check_ok(hk_integrator_forces(stage->reduced.integrator, 0.0));
  hk_body_stage_residual(stage, v);
  memcpy(right, stage->right + 3 * ALL, UNKNOWNS * sizeof *right);
}

/* The solution for the change of `right` is the change of the unknowns, far from where the stage begins. */
TEST(matrix_is_the_derivative) {
  const double small = 1e-6, still[3 * ALL] = {0.0};
  for (int pinned = 0; pinned < 2; pinned++) {
    owned_system *system = two_bodies(pinned);
    owned_integrator *it = start_with(system, .method = "backward-euler", .step = 0.1);
    struct hk_stage *stage = it->own;
    const int64_t size = 3 * ALL + UNKNOWNS;
    double v[3 * ALL + UNKNOWNS] = {0}, by[UNKNOWNS], moved[3 * ALL + UNKNOWNS] = {0}, right[2][UNKNOWNS];
    assert_int_equal(stage->size, size);
    hk_motion_load(system, it->motion, system->position, still);
    hk_movers_read(system, it->motion, stage->body.own);
    hk_stage_save(stage, stage->start);
    hk_stage_save(stage, stage->begin);
    stage->at = (struct hk_equations){0.0, 0.1, stage->start, stage->start + 3 * ALL, 0.1};
    hk_body_stage_begin(stage);
    for (int k = 0; k < UNKNOWNS; k++) {
      const int held = pinned && k >= 6 && k < 9; /* its point does not move */
      v[3 * ALL + k] = held ? 0.0 : 3.0 * cos(1.0 + 1.7 * k);
      by[k] = held ? 0.0 : sin(0.3 + 2.9 * k);
    }
    for (int back = 0; back < 2; back++) {
      for (int k = 0; k < UNKNOWNS; k++)
        moved[3 * ALL + k] = v[3 * ALL + k] + (back ? -small : small) * by[k];
      find_right(stage, moved, right[back]);
    }
    find_right(stage, v, stage->right + 3 * ALL);
    hk_body_stage_aim(stage);
    hk_reduced_set(&stage->reduced, 0.0, 0.01, 0.1);
    hk_body_stage_set(stage);
    for (int k = 0; k < UNKNOWNS; k++)
      stage->right[3 * ALL + k] = (right[1][k] - right[0][k]) / (2.0 * small);
    struct hk_solution solution;
    check_ok(hk_reduced_solve(&stage->reduced, stage->right, 1e-12, stage->change, &solution));
    for (int k = 0; k < UNKNOWNS; k++)
      check_close(stage->change[3 * ALL + k], by[k], 1e-7);
  }
}
