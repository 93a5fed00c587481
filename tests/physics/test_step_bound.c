/* Safe steps compared with sharp limits that were computed independently (spectrum of the linearised system:
 * omega_max and the largest stable step of symplectic Euler, to 13 digits), and with runs. */
#include "check.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* 10 x 10 particles of 0.01 kg, 0.1 m apart, springs of 50 N and 0.02 N s, hung by two corners. */
static hooke_system *build_cloth10(void) {
  const double down[3] = {0.0, -9.81, 0.0};
  hooke_system *system = new_system();
  check_ok(hooke_system_set_gravity(system, down));
  small_part(system, "cloth", NULL,
             "edges=0.9,0,0,0,0,0.9 size=10,10 mass=1 pinned=top-corners "
             "structural.stiffness=50 structural.damping=0.02 shear.stiffness=50 shear.damping=0.02 "
             "bend.stiffness=50 bend.damping=0.02");
  check_ok(hooke_system_commit(system));
  return system;
}

/* A bound is never above the limit, and not far below it. */
TEST(symplectic_euler_is_bounded_from_both_sides) {
  owned_system *net6 = build_reference(find_reference("six-particles")), *cloth10 = build_cloth10();
  check_between(bound_at_start(net6, "symplectic-euler"), 0.5 * 0.13162450213044632, 0.13162450213044632);
  check_between(bound_at_start(cloth10, "symplectic-euler"), 0.8 * 0.003058102791710135,
                0.003058102791710135);
  check_between(bound_at_start(cloth10, "verlet"), 0.8 * 0.0034348908160279894, 0.0034348908160279894);
  check_between(bound_at_start(cloth10, "rk4"), 0.5 * 0.005078523465343316, 0.005078523465343316);
}

/* From the largest frequencies, computed independently; those of net6 and cloth10 are far from overdamped. */
TEST(verlet_and_rk4_are_bounded_from_both_sides) {
  owned_system *net6 = build_reference(find_reference("six-particles")), *cloth10 = build_cloth10();
  check_between(bound_at_start(net6, "verlet"), 0.5 * 0.136435852341, 0.136435852341);
  check_between(bound_at_start(net6, "rk4"), 0.5 * 0.197249285762, 0.197249285762);
  check_between(bound_at_start(cloth10, "verlet"), 0.8 * 0.00343489081603, 0.00343489081603);
  check_between(bound_at_start(cloth10, "rk4"), 0.7 * 0.00507852346534, 0.00507852346534);
  assert_true(isinf(bound_at_start(net6, "backward-euler")));
}

TEST(forward_euler_needs_damping) {
  owned_system *net6 = build_reference(find_reference("six-particles")), *cloth10 = build_cloth10();
  /* springs of net6 are stretched, and nothing damps motion across a stretched spring */
  check_between(bound_at_start(net6, "forward-euler"), 0.0, 0.0);
  /* flat and at rest, the limit is kd/ks for all modes alike */
  check_close(bound_at_start(cloth10, "forward-euler"), 0.02 / 50.0, 1e-15);
}

/* One mass on an undamped spring to a pinned end: the bound is the limit, 2/omega, exactly. */
TEST(one_spring_is_sharp) {
  const double omega = 7.0;
  owned_system *system = small_oscillator(omega);
  check_close(bound_at_start(system, "symplectic-euler"), 2.0 / omega, 1e-11);
  check_close(bound_at_start(system, "verlet"), 2.0 / omega, 1e-12);
  check_close(bound_at_start(system, "rk4"), 2.6156 / omega, 1e-11);
  check_between(bound_at_start(system, "forward-euler"), 0.0, 0.0);
  assert_true(isinf(bound_at_start(system, "cvode-bdf")));
}

TEST(all_at_once_are_those_one_by_one) {
  owned_system *cloth10 = build_cloth10();
  owned_state *state;
  double bounds[32];
  assert_true(hooke_method_count() <= 32);
  check_ok(hooke_state_create(cloth10, &state));
  check_ok(hooke_step_bound(cloth10, NULL, hooke_state_position(state), bounds));
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    const double one = bound_at_start(cloth10, hooke_method_name(k));
    assert_true(memcmp(&one, &bounds[k], sizeof one) == 0 || (isnan(one) && isnan(bounds[k])));
  }
}

TEST(nothing_to_bound) {
  const double place[3] = {0.0, 0.0, 0.0};
  owned_system *falling = small_system(1, place, NULL, 1.0, 0), *open = NULL;
  check_ok(hooke_system_set_drag(falling, 0.25));
  check_ok(hooke_system_commit(falling));
  /* x'' = -c x' alone: forward Euler holds up to 2 m/c, and so does symplectic Euler */
  check_close(bound_at_start(falling, "forward-euler"), 8.0, 1e-12);
  check_close(bound_at_start(falling, "symplectic-euler"), 8.0, 1e-10);
  /* where the only root is real, Runge-Kutta holds up to 2.785 m/c; implicit drag has no limit */
  check_close(bound_at_start(falling, "rk4"), 4.0 * 2.6156, 1e-10);
  assert_true(isinf(bound_at_start(falling, "verlet")) && isinf(bound_at_start(falling, "backward-euler")));
  double bound;
  check_status(hooke_step_bound(falling, "no-such-method", place, &bound), HOOKE_BAD_VALUE);
  check_message("no-such-method");
  open = new_system();
  check_status(hooke_step_bound(open, "symplectic-euler", place, &bound), HOOKE_BAD_CALL);
}
