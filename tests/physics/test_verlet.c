/* Velocity Verlet: what it costs, what a callback sees, energy over long runs, and how large its step may
 * be. */
#include "canonical.h"
#include "check.h"
#include "random.h"
#include "reference.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* ---- work ---- */

struct expense {
  const char *what;
  double damping, drag;
  int callback;
  const char *how;
  int64_t first, each; /* force evaluations */
};

/* The force at the end of a step is that of the next one's start, unless velocities are in it. */
TEST(force_evaluations) {
  const struct expense expenses[] = {{"plain", 0, 0, 0, "auto", 1, 1},
                                     {"plain", 0, 0, 0, "explicit", 1, 1},
                                     {"drag", 0, 0.5, 0, "implicit", 1, 1},
                                     {"damping", 0.5, 0, 0, "auto", 0, 2},
                                     {"damping", 0.5, 0, 0, "explicit", 0, 2},
                                     {"damping", 0.5, 0, 0, "implicit", 0, 2},
                                     {"callback", 0, 0, 1, "auto", 0, 2},
                                     {"everything", 0.5, 0.5, 1, "auto", 0, 2},
                                     {"everything", 0.5, 0.5, 1, "implicit", 0, 2}};
  for (size_t k = 0; k < sizeof expenses / sizeof expenses[0]; k++) {
    const struct expense *e = &expenses[k];
    const double q[] = {0, 0, 0, 1, 0, 0, 1, 1.5, 0};
    const int64_t ends[] = {0, 1, 1, 2};
    owned_system *system = small_system(3, q, NULL, 1.0, 1);
    springs_with(system, 2, ends, .stiffness = 4, .damping = e->damping, .rest_length = 1);
    check_ok(hooke_system_set_drag(system, e->drag));
    if (e->callback) check_ok(hooke_system_set_force(system, idle_force, NULL, NULL));
    check_ok(hooke_system_commit(system));
    owned_run(integrator, state, system, .method = "verlet", .step = 0.01, .verlet_damping = e->how);
    check_ok(hooke_integrator_step(integrator, state, 40));
    check_ok(hooke_integrator_step(integrator, state, 60));
    const int64_t found = hooke_integrator_count(integrator, "force_evaluations");
    if (found != e->first + 100 * e->each) check_failed("%s: %lld evaluations", e->what, (long long)found);
    const int64_t solved = hooke_integrator_count(integrator, "linear_iterations");
    const int solves = e->damping > 0.0 && strcmp(e->how, "implicit") == 0;
    if (solves)
      assert_in_range(solved, 100, 400);
    else
      assert_int_equal(solved, 0);
    assert_int_equal(hooke_integrator_count(integrator, "explicit_damping"), e->damping > 0.0 && !solves);
    assert_string_equal(hooke_options_text(hooke_integrator_options(integrator), "verlet_damping"),
                        e->damping == 0.0 ? e->how
                        : solves          ? "implicit"
                                          : "explicit");
  }
}

/* ---- a callback ---- */

struct witness {
  int64_t calls;
  double t[4], v[4];
};

static int32_t brake(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  struct witness *witness = ctx;
  (void)n, (void)q;
  assert_true(witness->calls < 4);
  witness->t[witness->calls] = t;
  witness->v[witness->calls++] = v[0];
  force[0] -= 0.5 * v[0];
  return 0;
}

/* It sees the predicted velocity at the second kick. All numbers are binary fractions. */
TEST(callback_sees_the_predicted_velocity) {
  const double q[] = {0, 0, 0}, v[] = {1, 0, 0};
  struct witness witness = {0};
  owned_system *system = small_system(1, q, v, 1.0, 0);
  check_ok(hooke_system_set_force(system, brake, NULL, &witness));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "verlet", .step = 0.25);
  check_ok(hooke_integrator_step(integrator, state, 1));
  assert_int_equal(witness.calls, 2);
  const double half = 1.0 - 0.125 * 0.5, ahead = half - 0.125 * 0.5, whole = half - 0.125 * 0.5 * ahead;
  check_close(witness.t[0], 0.0, 0.0);
  check_close(witness.t[1], 0.25, 0.0);
  check_close(witness.v[0], 1.0, 0.0);
  check_close(witness.v[1], ahead, 0.0);
  check_close(hooke_state_velocity(state)[0], whole, 0.0);
  check_close(hooke_state_position(state)[0], 0.25 * half, 0.0);
}

/* ---- one oscillator ---- */

/* x'' + 2 zeta omega x' + omega^2 x = 0 along x, from x = 1 at rest; damped by the spring or by drag. */
static hooke_system *damped_oscillator(double omega, double zeta, int in_ether) {
  const double q[] = {0, 0, 0, 1, 0, 0}, mass = 0.5;
  const int64_t ends[] = {0, 1};
  hooke_system *system = small_system(2, q, NULL, mass, 1);
  const double c = 2.0 * zeta * omega * mass;
  springs_with(system, 1, ends, .law = "length", .stiffness = mass * omega * omega,
               .damping = in_ether ? 0.0 : c);
  check_ok(hooke_system_set_drag(system, in_ether ? c : 0.0));
  return committed(system);
}

/* Steps of the scalar formula: in the spring explicit and solved for, in the ether a division. */
TEST(one_step_is_the_formula) {
  const double omega = 3.0, zeta = 0.4, h = 0.3, c = 2.0 * zeta * omega;
  for (int how = 0; how < 3; how++) {
    owned_system *system = damped_oscillator(omega, zeta, how == 2);
    owned_run(integrator, state, system, .method = "verlet", .step = h,
              .verlet_damping = how == 1 ? "implicit" : NULL);
    double x = 1.0, v = 0.0;
    for (int k = 0; k < 20; k++) {
      const double kick = h / 2.0 * (-omega * omega * x - c * v), half = v + kick;
      x += h * half;
      v = how == 0 ? half + h / 2.0 * (-omega * omega * x - c * (half + kick))
                   : (half - h / 2.0 * omega * omega * x) / (1.0 + h / 2.0 * c);
      check_ok(hooke_integrator_step(integrator, state, 1));
      check_close(hooke_state_position(state)[3], x, 1e-14);
      check_close(hooke_state_velocity(state)[3], v, 3e-14);
    }
  }
}

/* A scene that has come to rest: velocities whose squares underflow are damped like any other. */
TEST(hardly_any_velocity) {
  const double q[] = {0, 0, 0, 1, 0, 0}, h = 0.1, gamma = 2.0;
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 1);
  springs_with(system, 1, ends, .law = "length", .stiffness = 1.0, .damping = gamma, .rest_length = 1.0);
  check_ok(hooke_system_commit(system));
  const double speeds[] = {1e-3, 1e-99, 1e-101, 1e-150, 1e-200, 1e-300};
  for (size_t i = 0; i < 2 * sizeof speeds / sizeof speeds[0]; i++) {
    const size_t k = i / 2, how = i % 2;
    owned_run(integrator, state, system, .method = "verlet", .step = h,
              .verlet_damping = how == 0 ? "explicit" : "implicit");
    hooke_state_velocity(state)[3] = speeds[k];
    check_ok(hooke_integrator_step(integrator, state, 1));
    const double half = 1.0 - h / 2.0 * gamma, stretch = k == 0 ? h * half : 0.0; /* else it rounds to none */
    const double expected = how == 0 ? half - h / 2.0 * (stretch + gamma * (2.0 * half - 1.0))
                                     : (half - h / 2.0 * stretch) / (1.0 + h / 2.0 * gamma);
    check_close(hooke_state_velocity(state)[3] / speeds[k], expected, 1e-12);
  }
}

/* ---- explicit damping ---- */

/* The largest step at which damping is explicit. */
static double largest_explicit(const hooke_system *system) {
  owned_canonical canonical;
  canonical_create(system, &canonical);
  const double most = 0.8 * canonical_explicit_bound(&canonical);
  return most;
}

/* At its largest step nothing grows, however strong the damping is, and the choice is made by the step. */
TEST(explicit_damping_is_stable) {
  const double dampings[] = {1e-3, 0.1, 1.0, 10.0, 1e3};
  for (int k = 0; k < 10; k++) {
    owned_system *system = small_net((uint64_t)(k + 1), dampings[k % 5], 0.0, 1);
    const double most = largest_explicit(system);
    for (int above = 0; above < 2; above++) {
      const double step = (above ? 1.0 + 1e-9 : 1.0 - 1e-9) * most;
      owned_run(integrator, state, system, .method = "verlet", .step = step);
      assert_int_equal(hooke_integrator_count(integrator, "explicit_damping"), !above);
      hooke_state_velocity(state)[5] += 1e-6;
      const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
      const double before = hooke_system_energy(system, "total", q, v);
      double after = before;
      for (int part = 0; part < 10; part++) {
        check_ok(hooke_integrator_step(integrator, state, 2000));
        after = fmax(after, hooke_system_energy(system, "total", q, v));
      }
      check_between(after / before, 0.0, 1.0 + 1e-3);
    }
  }
}

/* Where a damper depends on more than a direction no step is known to be stable. */
TEST(damped_cables_are_solved_for) {
  const double q[] = {0, 0, 0, 1.5, 0, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 1);
  springs_with(system, 1, ends, .stiffness = 1.0, .damping = 0.1, .rest_length = 1.0, .pull_only = 1);
  check_ok(hooke_system_commit(system));
  hooke_integrator *integrator = start_with(system, .method = "verlet", .step = 1e-3);
  assert_int_equal(hooke_integrator_count(integrator, "explicit_damping"), 0);
  hooke_integrator_destroy(integrator);
  integrator = start_with(system, .method = "verlet", .step = 1e-3, .verlet_damping = "explicit");
  assert_int_equal(hooke_integrator_count(integrator, "explicit_damping"), 1);
  hooke_integrator_destroy(integrator);
}

/* ---- explicit steps by the prediction ---- */

#if HOOKE_HAVE_LAPACK

/* A particle of 1 kg between four springs along x and y, two a direction: of their stiffness k and damping c
 * the bound of all directions counts four, and each mode has two. */
static const double K = 30.0, C = 1.5;

static hooke_system *cross_of(const char *extra, int obstacle) {
  const double q[] = {0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0};
  const int64_t held[] = {1, 2, 3, 4}, ends[] = {0, 1, 0, 2, 0, 3, 0, 4};
  hooke_system *system = small_system(5, q, NULL, 1.0, 0);
  check_ok(hooke_system_pin(system, 4, held));
  small_group(system, "springs", "cross", 4, ends, "law=length stiffness=%.17g damping=%.17g %s", K, C,
              extra);
  if (obstacle) {
    owned_options *plane = options_with("obstacles", "shape=plane point=0,-9,0 normal=0,1,0 stiffness=1e3");
    check_ok(hooke_system_add_obstacle(system, 0, NULL, plane));
  }
  return committed(system);
}

/* h^2 K + 2 h C = 4 for so many springs. */
static double step_of_springs(double count) {
  const double k = count * K, c = count * C;
  return 4.0 / (c + sqrt(c * c + 4.0 * k));
}

static void check_settles(const hooke_system *system, double step, const char *asked, const char *expected) {
  owned_options *run = run_options((struct run){.method = "verlet", .step = step, .verlet_damping = asked});
  check_ok(hooke_step_settle(system, run));
  assert_string_equal(hooke_options_text(run, "verlet_damping"), expected);
}

TEST(runs_settle_on_explicit_damping) {
  const double certain = 0.8 * step_of_springs(4.0), k = 2.0 * K / (0.8 * 0.8), c = 4.0 * C,
               most = 4.0 / (c + sqrt(c * c + 4.0 * k)); /* dampers may turn until all act together */
  owned_system *system = cross_of("", 0), *floor = cross_of("", 1),
               *winch =
                   cross_of("rest_scale.motion=harmonic rest_scale.amplitude=0.1 rest_scale.frequency=1", 0);
  check_between(most / certain, 1.3, 1.9);
  check_settles(system, 0.999 * certain, NULL, "auto");
  check_settles(system, 1.001 * certain, NULL, "explicit");
  check_settles(system, 0.997 * most, NULL, "explicit");
  check_settles(system, 1.001 * most, NULL, "auto");
  check_settles(system, 0.997 * most, "implicit", "implicit");
  check_settles(floor, 0.997 * most, NULL, "auto");
  check_settles(winch, 0.997 * most, NULL, "auto");
}
#endif

struct heard {
  int64_t above;
  double limit;
};

static int32_t hear_above(const char *kind, const char *message, double t, double limit, int64_t spring,
                          int64_t particle, void *ctx) {
  struct heard *heard = ctx;
  (void)message, (void)t, (void)spring, (void)particle;
  if (strcmp(kind, "above-limit") == 0) *heard = (struct heard){heard->above + 1, limit};
  return 0;
}

/* At a step that is stable where damping is solved for, h^2 K <= 4, and not where it is explicit. */
TEST(warnings_know_how_damping_is_taken) {
  owned_system *system = damped_oscillator(1.0, 0.1, 0);
  for (int explicitly = 0; explicitly < 2; explicitly++) {
    struct heard heard = {0};
    owned_run(integrator, state, system, .method = "verlet", .step = 1.9,
              .verlet_damping = explicitly ? "explicit" : "implicit");
    check_ok(hooke_integrator_on_warning(integrator, hear_above, &heard));
    hooke_state_velocity(state)[3] = 1e-3;
    check_ok(hooke_integrator_step(integrator, state, 1)); /* after which it is looked at */
    check_status(hooke_integrator_step(integrator, state, 999), explicitly ? HOOKE_DIVERGED : HOOKE_OK);
    assert_int_equal(heard.above, explicitly);
    if (explicitly) check_close(heard.limit, 4.0 / (0.2 + sqrt(4.04)), 1e-12);
  }
}

/* ---- energy ---- */

struct energies {
  const hooke_system *system;
  double first, half[2]; /* the largest |E - E(0)| in each half */
  int64_t seen, steps;
};

static int32_t watch_energy(int64_t step, const hooke_state *state, void *ctx) {
  struct energies *e = ctx;
  hooke_state *seen = (hooke_state *)(uintptr_t)state; /* read only */
  const double off =
      fabs(hooke_system_energy(e->system, "total", hooke_state_position(seen), hooke_state_velocity(seen)) -
           e->first);
  double *most = &e->half[step > e->steps / 2];
  *most = fmax(*most, off);
  e->seen++;
  return 0;
}

/* A stiff elastic pendulum, nonlinear and without damping: energy oscillates without drift over 100 000
 * steps. */
TEST(energy_stays_bounded) {
  owned_system *system = build_reference(find_reference("elastic-pendulum"));
  struct energies e = {.system = system, .steps = 100000};
  owned_run(integrator, state, system, .method = "verlet", .step = 4e-3);
  e.first = hooke_system_energy(system, "total", hooke_state_position(state), hooke_state_velocity(state));
  check_ok(hooke_integrator_on_step(integrator, 7, watch_energy, &e));
  check_ok(hooke_integrator_step(integrator, state, e.steps));
  assert_int_equal(e.seen, e.steps / 7);
  const double weight =
      fabs(e.first) + hooke_system_energy(system, "kinetic", NULL, hooke_state_velocity(state));
  check_between(e.half[0], 1e-6 * weight, 0.05 * weight);
  check_between(e.half[1] / e.half[0], 0.8, 1.2);
}
