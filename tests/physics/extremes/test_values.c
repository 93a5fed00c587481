/* Values at the ends of the range of numbers: refused if they are not finite, used if they are; energies
 * beyond the largest number are infinite, never NaN. */
#include "check.h"
#include "extreme.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const FAMILY = "values";

static void note_all(const char *name, const char *words) {
  for (int64_t m = 0; m < hooke_method_count(); m++)
    extreme_note(FAMILY, name, hooke_method_name(m), words);
}

/* ---- refused ---- */

static int32_t add_mass(double mass) {
  const double q[] = {0, 0, 0};
  owned_system *system = new_system();
  const int32_t status = hooke_system_add_particles(system, 1, q, NULL, 1, &mass, NULL);
  assert_int_equal(hooke_system_particle_count(system), status == HOOKE_OK ? 1 : 0);
  return status;
}

TEST(test_masses) {
  const double refused[] = {0.0, -1.0, NAN, INFINITY, -INFINITY, 5e-324, 5e-309};
  for (int k = 0; k < 7; k++) {
    check_status(add_mass(refused[k]), HOOKE_BAD_VALUE);
    check_message("mass");
    check_message("allowed");
  }
  check_ok(add_mass(1e-307));
  check_ok(add_mass(1.7e308));
  note_all("mass 0, negative, not finite, 5e-309 kg", "bad value");
}

TEST(test_materials) {
  const char *names[] = {"stiffness", "damping", "rest_length", "rest_scale"};
  const double refused[] = {-1.0, NAN, INFINITY, 1e301};
  owned_options *options = new_options("springs");
  for (int n = 0; n < 4; n++) {
    for (int k = 0; k < 4; k++) {
      check_status(hooke_options_set_number(options, names[n], refused[k]), HOOKE_BAD_VALUE);
      check_message(names[n]);
      check_message("allowed");
    }
  }
  note_all("stiffness, damping, lengths negative or not finite", "bad value");
}

/* A state with one wrong number, by hand. */
static void check_state(double wrong, int place, const char *named) {
  const double q[] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 1);
  small_springs(system, 1, ends, (struct springs){.stiffness = 1.0, .rest_length = 1.0});
  check_ok(hooke_system_commit(system));
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_integrator *integrator = NULL;
    owned_state *state = NULL;
    owned_options *options = options_with("run", "method=%s step=0.1 duration=1", method);
    check_ok(hooke_integrator_create(system, options, &integrator));
    check_ok(hooke_state_create(system, &state));
    if (place < 0)
      hooke_state_set_time(state, wrong);
    else
      (place < 6 ? hooke_state_position(state) : hooke_state_velocity(state))[place % 6] = wrong;
    check_status(hooke_integrator_run(integrator, state), HOOKE_BAD_VALUE);
    check_message(named);
    check_message("allowed");
    check_status(hooke_integrator_step(integrator, state, 1), HOOKE_BAD_VALUE);
  }
}

TEST(test_states) {
  check_state(NAN, 4, "position[1][1]");
  check_state(INFINITY, 11, "velocity[1][2]");
  check_state(NAN, -1, "time");
  check_state(-INFINITY, -1, "time");
  note_all("initial state or time not finite", "bad value");
}

/* ---- accepted ---- */

/* A free flight at a speed whose energy overflows, or underflows. */
static void check_flight(const char *name, double speed, double energy) {
  const double q[] = {0, 0, 0}, v[] = {speed, 0, 0}, h = 0.25, expected[] = {speed * h * 40.0, 0, 0};
  owned_system *system = small_system(1, q, v, 1.0, 0);
  check_ok(hooke_system_commit(system));
  assert_true(hooke_system_energy(system, "total", q, v) == energy);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_outcome outcome;
    extreme_run(
        system,
        (struct extreme_run){.method = method, .step = h, .steps = 40, .atol = 1e-12 * fmin(1.0, speed)},
        &outcome);
    const double error = extreme_error(&outcome, expected, expected[0]);
    extreme_demand(FAMILY, name, method, extreme_not_right(&outcome, error, 0.0, 1e-5), &outcome);
    extreme_record(FAMILY, name, method, &outcome, error);
  }
}

TEST(test_flights) {
  check_flight("speed 1e200 m/s", 1e200, INFINITY);
  check_flight("speed 1e-200 m/s", 1e-200, 0.0);
}

/* An oscillator whose energy is 0 at first and the smallest number there is later. */
TEST(test_oscillators) {
  const double amplitude[] = {1e-160, 1e-161, 1e150};
  for (int k = 0; k < 3; k++) {
    char name[64];
    snprintf(name, sizeof name, "oscillator of %.0e m", amplitude[k]);
    const double q[] = {0, 0, 0, amplitude[k], 0, 0}, h = 0.05;
    const int64_t ends[] = {0, 1}, steps = 200;
    owned_system *system = small_system(2, q, NULL, 1.0, 1);
    small_springs(system, 1, ends, (struct springs){.law = "length", .stiffness = 1.0, .rest_length = 0.0});
    check_ok(hooke_system_commit(system));
    const double expected[] = {0, 0, 0, amplitude[k] * cos(h * (double)steps), 0, 0};
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      if (hooke_method_is_built(method) != 1) continue;
      owned_outcome outcome;
      extreme_run(
          system,
          (struct extreme_run){.method = method, .step = h, .steps = steps, .atol = 1e-9 * amplitude[k]},
          &outcome);
      const double error = extreme_error(&outcome, expected, amplitude[k]);
      extreme_demand(FAMILY, name, method, extreme_not_right(&outcome, error, 0.0, 0.5), &outcome);
      extreme_record(FAMILY, name, method, &outcome, error);
    }
  }
}

/* The square of a length of 1e160 m overflows. */
TEST(test_too_long) {
  const char *name = "oscillator of 1e+160 m";
  const double q[] = {0, 0, 0, 1e160, 0, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 1);
  small_springs(system, 1, ends, (struct springs){.law = "length", .stiffness = 1.0, .rest_length = 0.0});
  check_ok(hooke_system_commit(system));
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_outcome outcome;
    extreme_run(system, (struct extreme_run){.method = method, .step = 0.05, .steps = 200}, &outcome);
    extreme_demand(FAMILY, name, method, extreme_not_refused(&outcome), &outcome);
    assert_true(outcome.energy == INFINITY);
    extreme_record(FAMILY, name, method, &outcome, NAN);
  }
}

/* A million equal energies add up to a million times one, to the last digits. */
TEST(test_long_sums) {
  enum { COUNT = 1000000 };
  double *q = new_doubles(3 * (int64_t)COUNT), *v = new_doubles(3 * (int64_t)COUNT), momentum[3];
  const double mass = 0.2, gravity[] = {0, 0, -0.5};
  for (int64_t k = 0; k < COUNT; k++) {
    v[3 * k] = 1.0;
    q[3 * k + 2] = 1.0;
  }
  owned_system *system = small_system(COUNT, q, v, mass, 0);
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, 0.1));
  check_ok(hooke_system_commit(system));
  hooke_system_momentum(system, v, momentum);
  check_close(hooke_system_energy(system, "kinetic", NULL, v) / (0.1 * COUNT), 1.0, 4e-16);
  check_close(hooke_system_energy(system, "gravity", q, NULL) / (0.1 * COUNT), 1.0, 4e-16);
  check_close(hooke_system_dissipated_power(system, q, v) / (0.1 * COUNT), 1.0, 4e-16);
  check_close(momentum[0] / (0.2 * COUNT), 1.0, 4e-16);
  double plain = 0.0; /* a plain sum has larger errors */
  for (int64_t k = 0; k < COUNT; k++)
    plain += 0.1;
  check_between(fabs(plain / (0.1 * COUNT) - 1.0), 1e-12, 1e-10);
  note_all("energy of 1e6 equal particles", "4e-16");
  free(q);
  free(v);
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
