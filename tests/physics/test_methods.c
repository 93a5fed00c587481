/* Every registered method on every reference scene: a new method is tested by being registered. */
#include "check.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

TEST(test_table) {
  const char *expected[] = {"forward-euler", "symplectic-euler", "verlet",  "shardlow",          "heun",
                            "rk4",           "backward-euler",   "tr-bdf2", "implicit-midpoint", "cvode-bdf",
                            "cvode-adams"};
  for (size_t k = 0; k < sizeof expected / sizeof expected[0]; k++) {
    int64_t found = 0;
    for (int64_t m = 0; m < hooke_method_count(); m++)
      found += strcmp(hooke_method_name(m), expected[k]) == 0;
    assert_int_equal(found, 1);
  }
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *name = hooke_method_name(m);
    assert_true(strlen(hooke_method_summary(name)) > 10);
    assert_in_range(hooke_method_is_adaptive(name), 0, 1);
    assert_in_range(hooke_method_is_built(name), 0, 1);
  }
  assert_null(hooke_method_name(hooke_method_count()));
  assert_null(hooke_method_name(-1));
  assert_null(hooke_method_summary("no-such-method"));
  assert_int_equal(hooke_method_is_adaptive("no-such-method"), -1);
  const int32_t sundials = hooke_build_fact("sundials")[0] != '\0';
  assert_int_equal(hooke_method_is_built("cvode-bdf"), sundials);
  assert_int_equal(hooke_method_is_built("cvode-adams"), sundials);
  for (int k = 0; k < 8; k++)
    assert_int_equal(hooke_method_is_built(expected[k]), 1);
}

/* ---- what a method takes ---- */

static int32_t no_rate(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)n, (void)t, (void)x, (void)ctx;
  rate[0] = 0.0;
  return 0;
}

static hooke_system *system_of(const char *problem) {
  static const double position[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  static const int64_t all[] = {0, 1, 2};
  hooke_system *system = small_system(3, position, NULL, 1.0, 0);
  if (strcmp(problem, "overdamped") == 0) {
    check_ok(hooke_system_set_dynamics(system, problem));
    check_ok(hooke_system_set_drag(system, 1.0));
  }
  if (strcmp(problem, "bodies") == 0) check_ok(hooke_system_add_body(system, "plate", 3, all, 0));
  return committed(system);
}

static int32_t create(const char *method, const char *problem) {
  owned_options *options = run_options((struct run){.method = method, .step = 0.1, .duration = 1.0});
  owned_system *system = system_of(problem);
  owned_integrator *integrator = NULL;
  const int32_t status = strcmp(problem, "first-order") == 0
                             ? hooke_integrator_create_first_order(1, no_rate, NULL, options, &integrator)
                             : hooke_integrator_create(system, options, &integrator);
  return status;
}

/* The message of a refusal lists those that take the problem, and no other. */
static void check_list(const char *method, const char *problem) {
  char list[512] = "; allowed: ";
  for (int64_t m = 0, count = 0; m < hooke_method_count(); m++) {
    const size_t used = strlen(list);
    const char *name = hooke_method_name(m);
    if (hooke_method_is_built(name) && hooke_method_is_suited(name, problem) == 1)
      snprintf(list + used, sizeof list - used, "%s%s", count++ ? ", " : "", name);
  }
  check_message(method);
  check_message(list);
  const char *end = strstr(hooke_last_error(), "; allowed: ");
  assert_string_equal(end, list);
}

/* Integrators are made of what a method says that it takes, and of nothing else. */
TEST(test_methods_take_what_they_say) {
  static const char *const problems[] = {"second-order", "bodies", "overdamped", "first-order"};
  int32_t taken[4] = {0};
  for (int k = 0; k < 4; k++) {
    for (int64_t m = 0; m < hooke_method_count() + 2; m++) {
      static const char *const others[] = {"rk8pd", "arkode-esdirk"};
      const int64_t other = m - hooke_method_count();
      const char *method = other < 0 ? hooke_method_name(m) : others[other];
      const int32_t takes = hooke_method_is_suited(method, problems[k]);
      assert_in_range(takes, 0, 1);
      taken[k] += other < 0 && takes;
      if (hooke_method_is_built(method) != 1) continue;
      check_status(create(method, problems[k]), takes ? HOOKE_OK : HOOKE_UNSUITED);
      if (!takes) check_list(method, problems[k]);
    }
  }
  assert_int_equal(taken[0], hooke_method_count());
  for (int k = 1; k < 4; k++)
    check_between(taken[k], 5.0, (double)hooke_method_count() - 1.0);
  assert_string_equal(hooke_method_meant("velocity-verlet-with-more-letters-than-a-name"), "");
  assert_int_equal(hooke_method_is_suited("no-such-method", "bodies"), -1);
  assert_int_equal(hooke_method_is_suited("verlet", "no such problem"), -1);
}

/* The largest position error at the first reference time, over the largest position. */
static double error_of(const struct reference *reference, const hooke_system *system, struct run run) {
  const int64_t size = 3 * reference->particle_count;
  owned_doubles *q = new_doubles(size), *v = new_doubles(size);
  run.duration = reference->state[0].time;
  run_to_end(system, run, q, v);
  for (int64_t k = 0; k < size; k++)
    assert_true(isfinite(q[k]) && isfinite(v[k]));
  const double error = largest_difference(size, q, reference->state[0].position);
  return error / largest(size, reference->state[0].position);
}

static void refuse_absent(const hooke_system *system, const char *method) {
  hooke_integrator *integrator = NULL;
  owned_options *options = run_options((struct run){.method = method, .step = 0.1, .duration = 1.0});
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_NOT_BUILT);
  assert_null(integrator);
  check_message(method);
}

/* Half the step gives at most 0.6 of the error (order 1 or better), a tighter tolerance a smaller error, and
 * an error-controlled method at rtol 1e-9 a smaller error than every fixed step of order 1 here. */
TEST(test_every_method_on_every_scene) {
  for (int k = 0; k < REFERENCE_COUNT; k++) {
    const struct reference *reference = &references[k];
    owned_system *system = build_reference(reference);
    double best_fixed = INFINITY, worst_adaptive = 0.0;
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      if (hooke_method_is_built(method) != 1) {
        refuse_absent(system, method);
        continue;
      }
      double coarse, fine;
      if (hooke_method_is_adaptive(method) == 1) {
        coarse = error_of(reference, system, (struct run){.method = method, .rtol = 1e-4, .atol = 1e-6});
        fine = error_of(reference, system, (struct run){.method = method, .rtol = 1e-9, .atol = 1e-11});
        worst_adaptive = fmax(worst_adaptive, fine);
        if (!(fine < 1e-2 * coarse && fine < 1e-5)) {
          check_failed("%s by %s: errors %g at rtol 1e-4, %g at 1e-9", reference->name, method, coarse, fine);
        }
      } else {
        const double step = reference->state[0].time / 4000.0;
        coarse = error_of(reference, system, (struct run){.method = method, .step = step});
        fine = error_of(reference, system, (struct run){.method = method, .step = step / 2.0});
        if (strstr(method, "-euler") != NULL) best_fixed = fmin(best_fixed, fine);
        /* at the level of rounding no step improves it */
        if (!((fine < 0.6 * coarse || coarse < 1e-13) && fine < 1e-2)) {
          check_failed("%s by %s: errors %g at %g s, %g at half of it", reference->name, method, coarse, step,
                       fine);
        }
      }
    }
    if (!(worst_adaptive < best_fixed)) {
      check_failed("%s: error %g at rtol 1e-9, %g by a fixed step", reference->name, worst_adaptive,
                   best_fixed);
    }
  }
}

/* A pendulum on a stiff, strongly damped rod. Newton with the right derivative takes long steps over the fast
 * mode once it has died out; the fixed-point iteration of cvode-adams cannot, nor could Newton with a wrong
 * derivative. */
TEST(test_bdf_strides_over_damped_modes) {
  if (hooke_method_is_built("cvode-bdf") != 1) skip();
  const double position[] = {0, 0, 0, 1, 0, 0}, gravity[] = {0, -10, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, position, NULL, 0.3, 1);
  springs_with(system, 1, ends, .stiffness = 1e4, .damping = 1e3, .rest_length = 1.0);
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_commit(system));
  const char *methods[] = {"cvode-bdf", "cvode-adams"};
  double steps[2], end[2][6];
  for (int m = 0; m < 2; m++) {
    owned_run(integrator, state, system, .method = methods[m], .rtol = 1e-6, .atol = 1e-9, .duration = 2.0);
    check_ok(hooke_integrator_run(integrator, state));
    memcpy(end[m], hooke_state_position(state), sizeof end[m]);
    steps[m] = (double)hooke_integrator_count(integrator, "steps");
    if (m == 0) {
      check_between((double)hooke_integrator_count(integrator, "nonlinear_failures"), 0.0, 0.1 * steps[0]);
      check_between((double)hooke_integrator_count(integrator, "nonlinear_iterations"), steps[0],
                    3.0 * steps[0]);
    }
  }
  check_between(steps[0], 20.0, 0.3 * steps[1]);
  check_between(largest_difference(6, end[0], end[1]), 0.0, 1e-4);
}
