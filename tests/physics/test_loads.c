/* Loads: their course in time, closed forms under them, what they do to bodies and to overdamped particles,
 * their energy and work, and what is refused. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>

static void add_load(hooke_system *system, int64_t particle, const char *words) {
  owned_options *options = options_with("loads", "%s", words);
  check_ok(hooke_system_add_loads(system, 1, &particle, options));
}

static void load_at(const hooke_system *system, double t, double force[3]) {
  const double zero[3] = {0.0};
  check_ok(hooke_system_force(system, t, zero, zero, force));
}

/* One free particle of 2 kg with the load, committed. */
static hooke_system *loaded(const char *words) {
  hooke_system *system = small_system(1, (double[]){0, 0, 0}, NULL, 2.0, 0);
  add_load(system, 0, words);
  return committed(system);
}

TEST(the_force_follows_its_course) {
  const double size[3] = {1, -2, 3}, angle = 2.0 * acos(-1.0) * 1.5 * 0.7 + 0.4;
  owned_system *constant = loaded("force=1,-2,3"),
               *harmonic = loaded("motion=harmonic force=1,-2,3 frequency=1.5 phase=0.4"),
               *table = loaded("motion=table force=0,0,0;4,0,-2;0,0,0;0,0,1 time=1,2,3,5");
  double f[3];
  load_at(constant, 7.0, f);
  assert_true(f[0] == 1.0 && f[1] == -2.0 && f[2] == 3.0);
  load_at(harmonic, 0.7, f);
  for (int a = 0; a < 3; a++)
    check_close(f[a], size[a] * sin(angle), 1e-14);
  /* held outside; a cubic whose slopes are those of parabolas, 4 and 0 at the first two samples */
  load_at(table, 0.3, f);
  assert_true(f[0] == 0.0 && f[1] == 0.0 && f[2] == 0.0);
  load_at(table, 9.0, f);
  assert_true(f[0] == 0.0 && f[2] == 1.0);
  load_at(table, 1.5, f);
  check_close(f[0], 0.5 * 4.0 + 8.0 / 8.0, 1e-14);
  load_at(table, 3.0, f);
  assert_true(f[0] == 0.0 && f[2] == 0.0);
}

/* Bathe, Finite Element Procedures, section 9.2: masses 2 and 1, stiffness 6 -2 -2 4, a load of 10 on the
 * second from rest. Exact: the modes of that matrix; the others are the methods' formulas at a step of 0.28.
 */
TEST(two_masses_under_a_constant_load) {
  static const struct {
    struct run run;
    double x, y, within;
  } rows[] = {
      {{.method = "verlet", .step = 0.28}, 1.0222996, 2.6008278, 1e-7},
      {{.method = "symplectic-euler", .step = 0.00028}, 1.1572258, 2.4887562, 3e-3},
      {{.method = "implicit-midpoint", .step = 0.28}, 1.3967845, 2.3129249, 1e-6},
      {{.method = "rk4", .step = 0.0028}, 1.1572258, 2.4887562, 1e-7},
      {{.method = "shardlow", .step = 0.00028}, 1.1572258, 2.4887562, 1e-6},
      {{.method = "tr-bdf2", .step = 0.0028}, 1.1572258, 2.4887562, 3e-5},
      {{.method = "cvode-bdf", .rtol = 1e-10, .atol = 1e-10}, 1.1572258, 2.4887562, 1e-7},
  };
  const double place[12] = {0, 0, 0, 100, 0, 0, 200, 0, 0, 300, 0, 0}, mass[4] = {1, 2, 1, 1};
  owned_system *system = new_system();
  check_ok(hooke_system_add_particles(system, 4, place, NULL, 4, mass, NULL));
  check_ok(hooke_system_pin(system, 2, (int64_t[]){0, 3}));
  small_group(system, "springs", NULL, 3, (int64_t[]){0, 1, 1, 2, 2, 3}, "law=length stiffness=4,2,2");
  add_load(system, 2, "force=10,0,0");
  check_ok(hooke_system_commit(system));
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
    struct run run = rows[k].run;
    double q[12];
    if (!hooke_method_is_built(run.method)) continue;
    run.duration = 3.36;
    run_to_end(system, run, q, NULL);
    check_close(q[3] - 100.0, rows[k].x, rows[k].within);
    check_close(q[6] - 200.0, rows[k].y, rows[k].within);
  }
}

static int32_t see(int64_t step, const hooke_state *state, void *ctx) {
  return hooke_estimate_see(step, state, ctx);
}

/* A mass of 1 kg on 100 N/m and 0.4 N s/m under 10 N sin(8 t), after 10 s: the sum of the steady oscillation
 * and of the damped one that meets rest at the start. */
TEST(a_damped_oscillator_under_a_harmonic_load) {
  char words[80];
  snprintf(words, sizeof words, "motion=harmonic force=10,0,0 frequency=%.17g", 4.0 / acos(-1.0));
  owned_system *system = small_system(2, (double[]){0, 0, 0, 10, 0, 0}, NULL, 1.0, 1);
  small_group(system, "springs", NULL, 1, (int64_t[]){0, 1}, "law=length stiffness=100 damping=0.4");
  add_load(system, 1, words);
  check_ok(hooke_system_commit(system));
  double q[6];
  end_of_run(q, NULL, system, .method = "rk4", .step = 1e-3, .duration = 10);
  check_close(q[3] - 10.0, -0.252797542112, 2e-10);
  /* its error is said, and is true */
  owned_state *state = start_state(system);
  owned_options *options =
      run_options((struct run){.method = "verlet", .step = 1e-2, .duration = 10, .every = 1});
  owned_integrator *run;
  owned_measurement *estimate;
  check_ok(hooke_integrator_create(system, options, &run));
  check_ok(estimate_of(system, NAN, &estimate));
  check_ok(hooke_integrator_on_frame(run, see, estimate));
  check_ok(hooke_estimate_begin(estimate, run, state));
  check_ok(hooke_integrator_run(run, state));
  check_ok(hooke_measurement_run(estimate, state));
  const double error = fabs(hooke_state_position(state)[3] - 10.0 + 0.252797542112);
  check_between(hooke_measurement_number(estimate, "estimate", 0, "estimate"), error, 20.0 * error);
}

/* gamma x' = F(t) - k x; the harmonic part of the answer and its decay. */
TEST(overdamped_particles_take_loads) {
  static const char *const methods[] = {"rk4", "heun", "backward-euler", "tr-bdf2", "implicit-midpoint"};
  static const double within[] = {1e-10, 1e-5, 2e-3, 1e-5, 1e-5};
  const double gamma = 2.0, k = 6.0, w = 2.0 * acos(-1.0) * 0.5, rate = k / gamma, t = 2.0;
  const double size = 3.0 / gamma / (rate * rate + w * w);
  const double right =
      size * ((rate * sin(w * t) - w * cos(w * t)) + w * exp(-rate * t)) + 5.0 / k * (1.0 - exp(-rate * t));
  owned_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, "overdamped"));
  check_ok(hooke_system_set_drag(system, gamma));
  check_ok(hooke_system_add_particles(system, 1, (double[]){0, 0, 0}, NULL, 0, NULL, NULL));
  small_group(system, "anchors", NULL, 1, (int64_t[]){0}, "stiffness=6");
  add_load(system, 0, "motion=harmonic force=3,0,0 frequency=0.5");
  add_load(system, 0, "force=5,0,0");
  check_ok(hooke_system_commit(system));
  for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
    double q[3];
    end_of_run(q, NULL, system, .method = methods[m], .step = 1e-3, .duration = t);
    check_close(q[0], right, within[m]);
  }
}

/* Two particles of 1 kg on a rod of 2 m, a load on one of them across: its torque about the centre turns the
 * rod by F/(2 m) per metre of arm. */
TEST(a_load_turns_a_body) {
  const double place[6] = {-1, 0, 0, 1, 0, 0}, zero[6] = {0.0};
  owned_system *system = small_system(2, place, NULL, 1.0, 0);
  check_ok(hooke_system_add_body(system, NULL, 2, (int64_t[]){0, 1}, 0));
  add_load(system, 1, "force=0,4,0");
  check_ok(hooke_system_commit(system));
  double a[6];
  check_ok(hooke_system_acceleration(system, 0.0, place, zero, a));
  check_close(a[1], 2.0 - 2.0, 1e-14);
  check_close(a[4], 2.0 + 2.0, 1e-14);
}

/* Of a body that three pins hold, nothing is left of it, in copies neither. */
TEST(a_load_on_a_body_that_is_held_does_nothing) {
  const double place[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1};
  owned_system *system = small_system(4, place, NULL, 1.0, 0);
  check_ok(hooke_system_pin(system, 3, (int64_t[]){0, 1, 2}));
  check_ok(hooke_system_add_body(system, NULL, 4, (int64_t[]){0, 1, 2, 3}, 0));
  add_load(system, 3, "force=0,4,0");
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_count(system, "loads"), 0);
  assert_null(hooke_system_force_name(system, 0));
}

/* The energy of a constant load; a run by it from rest does not count as diverging, whatever the step, and
 * one by another load has its work. */
TEST(energies_and_power) {
  owned_system *constant = loaded("force=3,0,-1"),
               *other = loaded("motion=harmonic force=3,0,-1 frequency=1 phase=1.5");
  const double q[3] = {2, 5, 7}, v[3] = {1, 1, 1};
  check_close(hooke_system_energy(constant, "loads", q, NULL), -3.0 * 2.0 + 7.0, 1e-14);
  check_close(hooke_system_energy(constant, "total", q, v), 1.0 + 3.0, 1e-14);
  assert_true(hooke_system_energy(other, "potential", q, NULL) == 0.0);
  for (int m = 0; m < 2; m++) {
    const struct run run = {.method = m ? "forward-euler" : "symplectic-euler", .step = 1.0, .duration = 50};
    double end[3];
    run_to_end(constant, run, end, NULL);
    check_close(end[0], 1.5 * 0.5 * (m ? 50.0 * 49.0 : 50.0 * 51.0), 1e-10);
    run_to_end(other, run, end, NULL);
  }
}

/* Beside a spring beyond its limit a constant load does not hide the divergence. */
TEST(divergence_is_seen_beside_a_load) {
  owned_system *system =
      small_system(2, (double[]){0, 0, 0, 1, 0, 0}, (double[]){0, 0, 0, 0.1, 0, 0}, 1.0, 1);
  small_group(system, "springs", NULL, 1, (int64_t[]){0, 1}, "law=length stiffness=100 rest_length=0");
  add_load(system, 1, "force=0,1,0");
  check_ok(hooke_system_commit(system));
  owned_run(run, state, system, .method = "symplectic-euler", .step = 0.21, .duration = 21);
  check_status(hooke_integrator_run(run, state), HOOKE_DIVERGED);
  assert_true(hooke_state_time(state) < 10.0);
}

/* Of two loads on a pendulum's end, the small one is not needed, and the large one is. */
TEST(needs_finds_loads_and_loses_none) {
  owned_system *system = small_system(2, (double[]){0, 0, 0, 1, 0, 0}, NULL, 1.0, 1);
  small_group(system, "springs", "rod", 1, (int64_t[]){0, 1}, "stiffness=100");
  add_load(system, 1, "force=0,3,0");
  add_load(system, 1, "motion=harmonic force=1e-4,0,0 frequency=1");
  check_ok(hooke_system_commit(system));
  owned_options *run =
                    run_options((struct run){.method = "rk4", .step = 0.01, .duration = 0.2, .every = 0.02}),
                *options = options_with("needs", "want=1e-3");
  owned_measurement *needs;
  check_ok(hooke_measurement_create("needs", system, run, options, &needs));
  check_ok(hooke_measurement_run(needs, NULL));
  for (int k = 0; k < 2; k++) {
    const int64_t row = hooke_measurement_find(needs, "rows", "without", k ? "loads[1]" : "loads[0]");
    assert_true(row >= 0);
    assert_string_equal(hooke_measurement_text(needs, "rows", row, "kind"), "loads");
    assert_true(hooke_measurement_number(needs, "rows", row, "needed") == (k == 0));
    const double change = hooke_measurement_number(needs, "rows", row, "error");
    check_close(change, k ? 1e-4 / 6.0 * 0.2 * 0.2 * 0.2 * 2.0 * acos(-1.0) : 0.06, k ? 1e-6 : 1e-3);
  }
}

TEST(a_particle_that_is_held_or_missing_is_refused) {
  const int64_t wrong[2] = {1, 7}, both[2] = {1, 0}, second = 1;
  owned_system *system = small_system(3, (double[]){0, 0, 0, 1, 0, 0, 2, 0, 0}, NULL, 1.0, 1);
  owned_options *options = options_with("loads", "force=1,0,0");
  check_status(hooke_system_add_loads(system, 2, wrong, options), HOOKE_BAD_VALUE);
  check_message("particles[1]: there is no particle 7");
  check_status(hooke_system_add_loads(system, 2, both, options), HOOKE_BAD_VALUE);
  check_message("particles[1]: particle 0 is pinned; allowed: particles that are neither pinned nor driven");
  check_ok(hooke_system_add_loads(system, 1, (int64_t[]){2}, options));
  check_ok(hooke_system_add_loads(system, 1, both, options));
  check_ok(hooke_system_drive_harmonic(system, 1, &second, (double[]){1, 0, 0}, 1.0, 0.0));
  check_status(hooke_system_commit(system), HOOKE_BAD_VALUE);
  check_message("loads[1].particles[0]: particle 1 is driven");
  assert_false(hooke_system_is_committed(system));
}

TEST(forces_of_the_wrong_shape_are_refused) {
  static const struct {
    const char *words, *message;
  } rows[] = {
      {"force=1,0,0;0,0,1", "force: 2 rows given; allowed: one, as the motion is \"constant\""},
      {"motion=harmonic force=1,0,0;0,0,1 frequency=1", "allowed: one, as the motion is \"harmonic\""},
      {"motion=table force=1,0,0 time=0,1", "force: 1 rows given; allowed: 2, one for each time"},
      {"motion=table force=1,0,0;0,0,1 time=1,1", "time[1]: 1 is not allowed; times are finite and ascend"},
      {"motion=harmonic force=1,0,0", "frequency: is required with motion \"harmonic\" but missing"},
      {"force=1,0,0 time=0,1", "time: belongs to motion \"table\""},
      {"motion=harmonic frequency=1", "force: is required but missing"},
  };
  owned_system *system = small_system(1, (double[]){0, 0, 0}, NULL, 1.0, 0);
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
    owned_options *options = options_with("loads", "%s", rows[k].words);
    check_status(hooke_system_add_loads(system, 1, (int64_t[]){0}, options), HOOKE_BAD_VALUE);
    check_message(rows[k].message);
  }
  assert_int_equal(hooke_system_count(system, "loads"), 0);
}
