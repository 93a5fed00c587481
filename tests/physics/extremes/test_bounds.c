/* Bounds and limits of steps at the ends of what masses, stiffness and distances can be. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>

/* A mass on a damped spring: a step depends on stiffness and damping over mass alone. */
static hooke_system *damped(double mass) {
  const double place[] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[] = {0, 1};
  hooke_system *system = small_system(2, place, NULL, mass, 1);
  small_springs(
      system, 1, ends,
      (struct springs){.law = "length", .stiffness = mass, .damping = 0.1 * mass, .rest_length = 1.0});
  check_ok(hooke_system_commit(system));
  return system;
}

TEST(bounds_have_no_scale_of_mass) {
  static const char *const methods[] = {"forward-euler", "symplectic-euler", "verlet", "heun", "rk4"};
  const double mass[] = {ldexp(1.0, -600), ldexp(1.0, 600)};
  owned_system *one = damped(1.0);
  for (int k = 0; k < 2; k++) {
    owned_system *other = damped(mass[k]);
    for (int m = 0; m < 5; m++) {
      const double right = bound_at_start(one, methods[m]);
      check_between(right, 0.05, 3.0);
      check_close(bound_at_start(other, methods[m]), right, 1e-12 * right);
    }
  }
}

/* Half of critical damping: gamma is the root of kappa m/2, which is below the smallest number squared. */
TEST(damping_ratios_have_no_scale_of_mass) {
  const double mass[] = {1.0, 1e-158, 1e-200};
  double gamma[3];
  for (int k = 0; k < 3; k++) {
    owned_system *system = new_system();
    owned_options *options = options_with(
        "rope", "from=0,0,0 to=1,0,0 segments=1 mass=%.17g stretch.stiffness=%.17g stretch.damping_ratio=0.5",
        mass[k], mass[k]);
    check_ok(hooke_system_add_part(system, "rope", NULL, options, NULL, NULL));
    check_ok(hooke_system_commit(system));
    check_ok(hooke_system_members(system, "springs", NULL, NULL, gamma + k, NULL));
  }
  check_between(gamma[0], 0.1, 1.0);
  check_close(gamma[1] / mass[1], gamma[0], 1e-12);
  check_close(gamma[2] / mass[2], gamma[0], 1e-12);
}

#if HOOKE_HAVE_LAPACK
/* Where a distance has no square, no bound is known; a limit is refused, and the message says where and up to
 * what. */
TEST(distances_without_a_square) {
  const double places[2][6] = {{0, 0, 0, 1e152, 0, 0}, {0, 0, 0, 1e160, 0, 0}};
  const int64_t ends[] = {0, 1};
  for (int far = 0; far < 2; far++) {
    owned_system *system = small_system(2, places[far], NULL, 1.0, 1);
    small_springs(system, 1, ends, (struct springs){.law = "length", .stiffness = 4.0, .rest_length = 1.0});
    check_ok(hooke_system_commit(system));
    const double bound = bound_at_start(system, "verlet");
    if (far && !isnan(bound)) check_failed("a bound of %g s at 1e160 m", bound);
    if (!far) check_close(bound, 1.0, 1e-12);
    owned_measurement *limit = NULL;
    owned_state *state = start_state(system);
    check_ok(hooke_measurement_create("limit", system, NULL, NULL, &limit));
    check_status(hooke_measurement_run(limit, state), far ? HOOKE_BAD_VALUE : HOOKE_OK);
    if (far) check_message("particle 1 is at 1e+160 m");
    if (far) check_message("up to 1e+153 m");
  }
}
#endif
