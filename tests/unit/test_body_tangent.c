/* Forces and torques on a body in small motions, by its tangent and by differences. */
#include "measure/spectrum/rigid.h"
#include "model/coordinates/body_tangent.h"
#include "model/force/force.h"
#include "model/vector3.h"

#include "check.h"
#include "small.h"

#include <math.h>
#include <string.h>

enum { CORNERS = 5, ALL = 2 * CORNERS };

static const double CORNER[3 * CORNERS] = {0,   0,   0,   0.7, 0.1, 0,    -0.2, 0.8,
                                           0.1, 0.3, 0.2, 0.9, 0.5, -0.4, 0.3};

/* A body of unequal masses that five stretched springs hold at pinned particles, none of them in equilibrium;
 * its first particle may be pinned, too. */
static hooke_system *hung_body(int pinned, double stiffness) {
  double q[3 * ALL];
  const double mass[ALL] = {1.0, 0.5, 2.0, 0.7, 0.3, 1, 1, 1, 1, 1};
  int64_t body[CORNERS], posts[CORNERS], ends[2 * CORNERS];
  for (int p = 0; p < CORNERS; p++) {
    for (int a = 0; a < 3; a++) {
      q[3 * p + a] = CORNER[3 * p + a];
      q[3 * (CORNERS + p) + a] = 1.3 * CORNER[3 * p + a] + 0.2 * sin(1.0 + 3.0 * p + a) + 0.4;
    }
    body[p] = p;
    posts[p] = CORNERS + p;
    ends[2 * p] = p;
    ends[2 * p + 1] = CORNERS + p;
  }
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, ALL, q, NULL, ALL, mass, NULL));
  check_ok(hooke_system_pin(system, CORNERS, posts));
  if (pinned) check_ok(hooke_system_pin(system, 1, body));
  small_group(system, "springs", NULL, CORNERS, ends, "stiffness=%.17g rest_length=0.2", stiffness);
  check_ok(hooke_system_set_gravity(system, (double[]){1.0, -9.81, 2.0}));
  check_ok(hooke_system_add_body(system, "body", CORNERS, body, 0));
  return committed(system);
}

/* Force and torque about the point at the rows that are `size` times the motion away: (I + a x + b a x a x)
 * is the rotation by the length of a (Rodrigues). */
static void pushed(const hooke_system *system, const struct hk_body_tangent *t, const double motion[6],
                   double size, double push[6]) {
  double q[3 * ALL], force[3 * ALL], turn[3];
  const double still[3 * ALL] = {0.0}, *const from[3] = {force, force + 1, force + 2};
  struct hk_body_tangents moved;
  memcpy(q, system->position, sizeof q);
  hk_scale3(size, motion + 3, turn);
  const double angle = fmax(1e-300, hk_length3(turn)), s = sin(angle) / angle,
               c = angle < 1e-9 ? 0.5 : (1.0 - cos(angle)) / (angle * angle);
  for (int p = 0; p < CORNERS; p++) {
    double once[3], twice[3];
    if (system->constrained[p]) continue;
    hk_cross3(turn, t->arm + 3 * p, once);
    hk_cross3(turn, once, twice);
    for (int a = 0; a < 3; a++)
      q[3 * p + a] += size * motion[a] + s * once[a] + c * twice[a];
  }
  check_ok(hooke_system_force(system, 0.0, q, still, force));
  check_ok(hk_body_tangents_create(system, q, &moved));
  hk_body_gather(system, &moved.body[0], NULL, from, 3, push, push + 3);
  hk_body_tangents_release(&moved);
}

TEST(derivative_is_that_of_differences) {
  for (int pinned = 0; pinned <= 1; pinned++) {
    owned_system *system = hung_body(pinned, 40.0);
    owned(hk_body_tangents_release) struct hk_body_tangents tangents;
    owned(hk_rigid_release) struct hk_rigid rigid;
    double force[3 * ALL], x[3 * ALL] = {0.0}, change[3 * ALL];
    const double still[3 * ALL] = {0.0}, *const forces[3] = {force, force + 1, force + 2},
                           *const changes[3] = {change, change + 1, change + 2};
    double *const to[3] = {x, x + 1, x + 2};
    check_ok(hk_body_tangents_create(system, system->position, &tangents));
    check_ok(hk_rigid_create(system, system->position, NULL, &rigid));
    const struct hk_body_tangent *t = &tangents.body[0];
    check_ok(hooke_system_force(system, 0.0, system->position, still, force));
    hk_body_tangents_stiffen(&tangents, forces, 3);
    for (int k = pinned ? 3 : 0; k < 6; k++) {
      double motion[6] = {0.0}, push[6], before[6], after[6], spread[3 * ALL];
      motion[k] = 1.0;
      hk_body_spread(system, t, motion, motion + 3, to, 3);
      memcpy(spread, x, sizeof spread);
      hk_rigid_project(&rigid, to, 3);
      check_close(largest_difference(3 * ALL, spread, x), 0.0, 1e-13);
      check_ok(hooke_system_derivative_product(system, 0.0, system->position, still, x, still, change));
      hk_body_gather(system, t, NULL, changes, 3, push, push + 3);
      hk_body_turn_forces(t, 1.0, motion + 3, push + 3);
      pushed(system, t, motion, -1e-5, before);
      pushed(system, t, motion, 1e-5, after);
      for (int j = pinned ? 3 : 0; j < 6; j++)
        check_close(push[j], (after[j] - before[j]) / 2e-5, 2e-7);
    }
  }
}

/* Of springs that factors make stiffer as of springs that are. */
TEST(stiffer_springs_turn_more) {
  const double twice[CORNERS] = {2.0, 2.0, 2.0, 2.0, 2.0};
  owned_system *soft = hung_body(1, 40.0), *stiff = hung_body(1, 80.0);
  struct hk_rigid factors, found;
  check_ok(hk_rigid_create(soft, soft->position, twice, &factors));
  check_ok(hk_rigid_create(stiff, stiff->position, NULL, &found));
  const double *expected = found.tangents.body[0].geometric[0];
  check_between(expected[0], 1.0, 1e4);
  check_close(largest_difference(9, factors.tangents.body[0].geometric[0], expected) / expected[0], 0.0,
              1e-12);
  hk_rigid_release(&factors);
  hk_rigid_release(&found);
}
