/* Methods that solve for their steps: what they make of a damped oscillator against the closed forms, at
 * steps from a thousandth to a million of 1/omega, and what the steps of a nonlinear scene keep. */
#include "check.h"
#include "oscillator.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const char *const methods[] = {"backward-euler", "tr-bdf2", "implicit-midpoint"};
static const char *const forms[] = {"converged", "one-iteration"};
enum { METHODS = 3, FORMS = 2 };

/* A spring of no length along x, m = 1: x'' + 2 zeta omega x' + omega^2 x = 0. */
static hooke_system *oscillator(double omega, double zeta) {
  const double q[] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[] = {0, 1};
  hooke_system *system = small_system(2, q, NULL, 1.0, 1);
  springs_with(system, 1, ends, .law = "length", .stiffness = omega * omega, .damping = 2.0 * zeta * omega);
  return committed(system);
}

/* One step from x, x'/omega = start against the matrix of the method, as a share of the start. */
static void check_step(const char *method, const char *form, double zeta, double h, const double start[2]) {
  const double omega = 40.0;
  owned_system *system = oscillator(omega, zeta);
  owned_run(integrator, state, system, .method = method, .newton = form, .step = h / omega);
  hooke_state_position(state)[3] = start[0];
  hooke_state_velocity(state)[3] = start[1] * omega;
  check_ok(hooke_integrator_step(integrator, state, 1));
  long double matrix[4];
  const long double from[2] = {start[0], start[1]};
  long double there[2];
  assert_true(oscillator_step(method, (long double)zeta, (long double)(h / omega) * omega, matrix));
  oscillator_power(matrix, 1, from, there);
  const double x = hooke_state_position(state)[3] - (double)there[0];
  const double v = hooke_state_velocity(state)[3] / omega - (double)there[1];
  /* the one iteration has v' from the change of v, to the 1e-12 of its linear equations and with its
   * rounding, and a step of h makes that of h omega of the place */
  const double open = strcmp(form, "one-iteration") == 0 ? 1e-13 * h : 0.0;
  if (!(hypot(x, v) <= 1e-12 + open)) {
    check_failed("%s, %s, zeta = %g, h omega = %g: off by %g and %g of %Lg and %Lg", method, form, zeta, h, x,
                 v, there[0], there[1]);
  }
}

TEST(amplification_is_the_closed_form) {
  const double zetas[] = {0.0, 0.01, 0.5, 1.0, 30.0}, starts[][2] = {{1.0, 0.0}, {0.6, -0.8}};
  for (int m = 0; m < METHODS * FORMS; m++) {
    for (int z = 0; z < 5; z++) {
      for (int decade = -6; decade <= 12; decade++) {
        for (int s = 0; s < 2; s++)
          check_step(methods[m / FORMS], forms[m % FORMS], zetas[z], pow(10.0, decade / 2.0), starts[s]);
      }
    }
  }
}

/* Between 0 and 1 of the energy after one step that resolves nothing: all of it by the midpoint rule, almost
 * nothing by the others. */
TEST(what_no_step_resolves) {
  const double low[] = {0.0, 0.0, 1.0 - 1e-12}, high[] = {1e-10, 1e-8, 1.0 + 1e-12};
  for (int m = 0; m < METHODS; m++) {
    owned_system *system = oscillator(40.0, 0.0);
    owned_run(integrator, state, system, .method = methods[m], .step = 1e6 / 40.0);
    const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
    const double before = hooke_system_energy(system, "total", q, v);
    check_ok(hooke_integrator_step(integrator, state, 1));
    check_between(hooke_system_energy(system, "total", q, v) / before, low[m], high[m]);
  }
}

/* A free net that turns: the midpoint rule keeps momentum and angular momentum, whose flow is quadratic. */
TEST(midpoint_keeps_angular_momentum) {
  const double q[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.3}, v[] = {0, -1, 0, 1, 0, 0.5, 0, 2, 0, -1, 0, 0};
  const int64_t ends[] = {0, 1, 1, 2, 2, 3, 3, 0, 0, 2, 1, 3};
  owned_system *system = small_system(4, q, v, 0.5, 0);
  springs_with(system, 6, ends, .stiffness = 40, .damping = 0.02, .rest_length = 0.9);
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "implicit-midpoint", .step = 0.02);
  double before[3], after[3], moved[3];
  hooke_system_angular_momentum(system, hooke_state_position(state), hooke_state_velocity(state), before);
  check_ok(hooke_integrator_step(integrator, state, 500));
  hooke_system_angular_momentum(system, hooke_state_position(state), hooke_state_velocity(state), after);
  for (int a = 0; a < 3; a++)
    moved[a] = fabs(after[a] - before[a]);
  check_between(largest(3, moved), 0.0, 1e-10 * largest(3, before));
}
