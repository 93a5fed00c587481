/* Backward Euler: its formula, any step, both forms, drives and callbacks in its equations, and steps without
 * solution. */
#include "check.h"
#include "order.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const char *const forms[] = {"converged", "one-iteration"};

/* ---- linear scenes: both forms equal the formula ---- */

TEST(one_step_is_the_formula) {
  const double omega = 3.0, zeta = 0.4, mass = 0.5, q[] = {0, 0, 0, 1, 0, 0}, down[] = {2.5, 0, 0};
  const int64_t ends[] = {0, 1};
  const double steps[] = {0.01, 0.3, 1e3 / 3.0};
  for (int k = 0; k < 6; k++) {
    const double h = steps[k % 3];
    owned_system *system = small_system(2, q, NULL, mass, 1);
    springs_with(system, 1, ends, .law = "length", .stiffness = mass * omega * omega,
                 .damping = 2.0 * zeta * omega * mass);
    check_ok(hooke_system_set_gravity(system, down));
    check_ok(hooke_system_commit(system));
    owned_run(integrator, state, system, .method = "backward-euler", .newton = forms[k / 3], .step = h);
    double x = 1.0, v = 0.0;
    for (int n = 0; n < 20; n++) {
      v = (v + h * (down[0] - omega * omega * x)) / (1.0 + 2.0 * zeta * omega * h + omega * omega * h * h);
      x += h * v;
      check_ok(hooke_integrator_step(integrator, state, 1));
      check_close(hooke_state_position(state)[3], x, 1e-12);
      check_close(hooke_state_velocity(state)[3], v, 1e-12 / h);
    }
  }
}

/* A linear callback force, with and without its derivative, and a driven end. */
static int32_t pull(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)ctx;
  for (int64_t k = 0; k < 3 * n; k += 3)
    force[k] += cos(3.0 * t) - 20.0 * q[k] - 0.7 * v[k];
  return 0;
}

static int32_t pull_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                            const double *dv, double *out, void *ctx) {
  (void)t, (void)q, (void)v, (void)ctx;
  for (int64_t k = 0; k < 3 * n; k++)
    out[k] += -20.0 * dq[k] - 0.7 * dv[k];
  return 0;
}

static hooke_system *pulled(int with_product) {
  const double q[] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, amplitude[] = {0.1, 0, 0};
  const int64_t ends[] = {0, 1, 1, 2}, driven = 0;
  hooke_system *system = small_system(3, q, NULL, 0.5, 0);
  springs_with(system, 2, ends, .law = "length", .stiffness = 30, .damping = 0.4);
  check_ok(hooke_system_set_drag(system, 0.2));
  check_ok(hooke_system_drive_harmonic(system, 1, &driven, amplitude, 0.8, 0.3));
  check_ok(hooke_system_set_force(system, pull, with_product ? pull_product : NULL, NULL));
  return committed(system);
}

/* Along one line springs of no length are linear, so one iteration solves the equations. */
TEST(forms_agree_where_all_is_linear) {
  for (int with_product = 0; with_product < 2; with_product++) {
    owned_system *system = pulled(with_product);
    double q[2][9], v[2][9];
    for (int form = 0; form < 2; form++) {
      end_of_run(q[form], v[form], system, .method = "backward-euler", .newton = forms[form], .step = 0.05,
                 .duration = 3.0, .every = 3.0);
    }
    check_between(largest_difference(9, q[0], q[1]), 0.0, with_product ? 1e-12 : 1e-9);
    check_between(largest_difference(9, v[0], v[1]), 0.0, with_product ? 1e-11 : 1e-8);
    assert_true(largest(9, q[0]) > 1e-2);
  }
}

TEST(order_with_a_drive) {
  owned_system *system = pulled(1);
  double fine[9], error[4];
  end_of_run(fine, NULL, system, .method = "rk4", .step = 1e-3, .duration = 1.0);
  for (int form = 0; form < 2; form++) {
    for (int k = 0; k < 4; k++) {
      double found[9];
      end_of_run(found, NULL, system, .method = "backward-euler", .newton = forms[form],
                 .step = 1.0 / (400 << k), .duration = 1.0);
      error[k] = largest_difference(9, found, fine);
    }
    check_order(forms[form], 4, error, 0.85, 1.25);
  }
}

/* ---- nonlinear scenes ---- */

/* A pendulum on a stiff rod, in steps of a fifth of its swing and of h omega = 2000 along the rod: energy
 * never rises. */
TEST(strides_over_a_stiff_rod) {
  const double q[] = {0, 0, 0, 1, 0, 0}, down[] = {0, -10, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 1);
  springs_with(system, 1, ends, .stiffness = 1e8, .rest_length = 1);
  check_ok(hooke_system_set_gravity(system, down));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "backward-euler", .step = 0.2);
  const double *at = hooke_state_position(state), *v = hooke_state_velocity(state);
  double energy = hooke_system_energy(system, "total", at, v);
  for (int k = 0; k < 200; k++) {
    check_ok(hooke_integrator_step(integrator, state, 1));
    const double now = hooke_system_energy(system, "total", at, v);
    check_between(now - energy, -1e2, 1e-6);
    check_close(hypot(at[3], at[4]), 1.0, 1e-3);
    energy = now;
  }
  /* it hangs at rest */
  check_close(at[4], -1.0 - 1e-7, 1e-9);
  check_between(largest(6, v), 0.0, 1e-6);
  assert_int_equal(hooke_integrator_count(integrator, "nonlinear_failures"), 0);
}

/* A hanging cloth that crumples, in steps at which Newton's matrix is no longer positive. */
TEST(gets_through_compression) {
  const double down[] = {0, -9.81, 0};
  owned_system *system = new_system();
  small_part(system, "cloth", NULL,
             "edges=1,0,0,0,0,1 size=16,16 mass=1 pinned=top-corners "
             "structural.stiffness=50 shear.stiffness=50");
  check_ok(hooke_system_set_gravity(system, down));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "backward-euler", .step = 0.02);
  check_ok(hooke_integrator_step(integrator, state, 50));
  const double energy =
      hooke_system_energy(system, "total", hooke_state_position(state), hooke_state_velocity(state));
  check_between(energy, -9.81, -0.1); /* it has fallen, and gained nothing */
}

/* With a matrix that has none of the compression until corrections have been slow four times, these steps
 * take 16,500 products. */
TEST(compression_does_not_slow_steps) {
  const double down[] = {0, -9.81, 0};
  owned_system *system = new_system();
  small_part(system, "cloth", NULL,
             "edges=1,0,0,0,0,1 size=20,20 mass=1 pinned=top-corners "
             "structural.stiffness=5e4 shear.stiffness=5e4 bend.stiffness=5e4");
  check_ok(hooke_system_set_gravity(system, down));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "implicit-midpoint", .newton_tolerance = BY_DEFAULT,
            .step = 0.01);
  check_ok(hooke_integrator_step(integrator, state, 20));
  assert_in_range(hooke_integrator_count(integrator, "derivative_products"), 5000, 12000);
}

TEST(work_is_counted) {
  owned_system *system = build_reference(find_reference("six-particles"));
  int64_t force[2], newton[2], linear[2], products[2];
  for (int form = 0; form < 2; form++) {
    owned_run(integrator, state, system, .method = "backward-euler", .newton = forms[form], .step = 0.01);
    check_ok(hooke_integrator_step(integrator, state, 100));
    force[form] = hooke_integrator_count(integrator, "force_evaluations");
    newton[form] = hooke_integrator_count(integrator, "nonlinear_iterations");
    linear[form] = hooke_integrator_count(integrator, "linear_iterations");
    products[form] = hooke_integrator_count(integrator, "derivative_products");
  }
  assert_int_equal(force[1], 200); /* one for the equations, one for the residual that they leave */
  assert_int_equal(newton[1], 100);
  assert_in_range(force[0], 300, 700);
  assert_in_range(newton[0], 200, 500);
  for (int form = 0; form < 2; form++) {
    assert_in_range(linear[form], newton[form], 20 * newton[form]);
    assert_in_range(products[form], linear[form], 4 * linear[form]);
  }
}

/* ---- no solution ---- */

/* A cable that runs taut within the step: strong damping would pull it back to where it is slack and does not
 * pull. */
static hooke_system *cable(double damping) {
  const double q[] = {0, 0, 0, 0.9, 0, 0}, v[] = {0, 0, 0, 10, 0.5, 0};
  const int64_t ends[] = {0, 1};
  hooke_system *system = small_system(2, q, v, 1.0, 1);
  springs_with(system, 1, ends, .stiffness = 1, .damping = damping, .rest_length = 1, .pull_only = 1);
  return committed(system);
}

/* The step has no solution, and parts of it have. */
TEST(a_step_is_split) {
  for (int form = 0; form < 2; form++) {
    owned_system *system = cable(1000);
    owned_run(integrator, state, system, .method = "backward-euler", .newton = forms[form], .step = 0.1,
              .duration = 1.0);
    check_ok(hooke_integrator_run(integrator, state));
    assert_in_range(hooke_integrator_count(integrator, "nonlinear_failures"), 1, 1000);
    assert_int_equal(hooke_integrator_count(integrator, "steps"), 10);
    const double *v = hooke_state_velocity(state);
    check_between(hypot(v[3], v[4]), 0.0, 1.0); /* its damping has caught it */
  }
}

TEST(a_step_without_solution) {
  const double q[] = {0, 0, 0, 0.9, 0, 0}, v[] = {0, 0, 0, 10, 0.5, 0};
  owned_system *system = cable(1e12);
  owned_run(integrator, state, system, .method = "backward-euler", .step = 0.1, .duration = 1.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_SOLVER_FAILED);
  check_message("no solution");
  check_message("t = 0 s");
  check_close(hooke_state_time(state), 0.0, 0.0);
  check_same_bits(6, hooke_state_position(state), q);
  check_same_bits(6, hooke_state_velocity(state), v);
  assert_int_equal(hooke_integrator_count(integrator, "nonlinear_failures"), 11);
}

/* ---- refused problems ---- */

static int32_t decay(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)t, (void)ctx;
  rate[0] = -x[0];
  return 0;
}

TEST(refusals) {
  hooke_integrator *integrator = NULL;
  owned_options *options = run_options((struct run){.method = "backward-euler", .step = 0.1});
  check_status(hooke_integrator_create_first_order(1, decay, NULL, options, &integrator), HOOKE_UNSUITED);
  check_message("derivative");
  assert_null(integrator);
  assert_string_equal(hooke_options_text(options, "newton"), "converged");
  check_status(hooke_options_set_text(options, "newton", "thrice"), HOOKE_BAD_VALUE);
  check_message("one-iteration");
}
