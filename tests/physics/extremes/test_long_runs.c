/* Very many steps of 64 oscillators of 64 phases: energy and phase follow the theory, rounding errors
 * accumulate as a random walk and no faster (Brouwer 1937), and time does not drift. A million steps; with
 * HOOKE_LONG=1 in the environment a hundred million, which take a few minutes. */
#include "check.h"
#include "extreme.h"
#include "oscillator.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { PHASES = 64 };

static const char *const FAMILY = "long runs";

struct ensemble {
  hooke_system *system;
  double rest, amplitude;
  long double omega;
};

static struct ensemble ensemble(const char *law, double stiffness, double mass, double rest,
                                double amplitude) {
  double q[6 * PHASES] = {0}, v[6 * PHASES] = {0};
  int64_t ends[2 * PHASES], pinned[PHASES];
  const double omega = sqrt(stiffness / mass);
  for (int k = 0; k < PHASES; k++) {
    const double phase = 2.0 * 3.14159265358979323846 * (k + 0.37) / PHASES;
    pinned[k] = ends[2 * k] = k;
    ends[2 * k + 1] = PHASES + k;
    q[3 * (PHASES + k)] = rest + amplitude * cos(phase);
    v[3 * (PHASES + k)] = -amplitude * omega * sin(phase);
  }
  struct ensemble e = {.rest = rest, .amplitude = amplitude};
  double kappa[PHASES];
  check_ok(hooke_system_create(&e.system));
  check_ok(hooke_system_add_particles(e.system, 2 * PHASES, q, v, 1, &mass, NULL));
  check_ok(hooke_system_pin(e.system, PHASES, pinned));
  owned_options *options =
      options_with("springs", "law=%s stiffness=%.17g rest_length=%.17g", law, stiffness, rest);
  check_ok(hooke_system_add_springs(e.system, NULL, PHASES, ends, options));
  check_ok(hooke_system_commit(e.system));
  check_ok(hooke_system_members(e.system, "springs", NULL, kappa, NULL, NULL));
  e.omega = sqrtl((long double)kappa[0] * hooke_system_inverse_mass(e.system)[PHASES]);
  return e;
}

/* (x, x') of one of them, in units of amplitude and 1/omega. */
static void place_of(const struct ensemble *e, hooke_state *state, int k, long double place[2]) {
  const int64_t at = 3 * (PHASES + k);
  place[0] = ((long double)hooke_state_position(state)[at] - e->rest) / e->amplitude;
  place[1] = hooke_state_velocity(state)[at] / (e->omega * e->amplitude);
}

/* The invariant of symplectic Euler, which changes by rounding only, and the energy. */
static long double kept(const long double place[2], long double step) {
  return place[0] * place[0] + place[1] * place[1] - step * place[0] * place[1];
}

static long double energy(const long double place[2]) {
  return place[0] * place[0] + place[1] * place[1];
}

/* Root mean squares over the phases, relative to the start. */
struct errors {
  double rounding; /* of the invariant of symplectic Euler */
  double energy;   /* of the energy */
  double theory;   /* of the theoretical energy */
  double distance; /* largest distance from the theoretical position, including phase */
};

static struct errors compare(const struct ensemble *e, hooke_state *start, hooke_state *state,
                             const char *method, long double step, int64_t steps) {
  struct errors errors = {0.0, 0.0, 0.0, 0.0};
  long double matrix[4], rounding = 0.0L, found = 0.0L, theory = 0.0L;
  assert_true(oscillator_step(method, 0.0L, step, matrix));
  for (int k = 0; k < PHASES; k++) {
    long double before[2], after[2], known[2];
    place_of(e, start, k, before);
    place_of(e, state, k, after);
    oscillator_power(matrix, steps, before, known);
    const long double r = kept(after, step) / kept(before, step) - 1.0L;
    const long double f = energy(after) / energy(before) - 1.0L, t = energy(known) / energy(before) - 1.0L;
    rounding += r * r / PHASES;
    found += f * f / PHASES;
    theory += t * t / PHASES;
    errors.distance = fmax(errors.distance, (double)hypotl(after[0] - known[0], after[1] - known[1]));
  }
  errors.rounding = (double)sqrtl(rounding);
  errors.energy = (double)sqrtl(found);
  errors.theory = (double)sqrtl(theory);
  return errors;
}

static int is_long(void) {
  const char *wanted = getenv("HOOKE_LONG");
  return wanted != NULL && wanted[0] == '1';
}

/* The random walk of rounding between the first and the last count of steps; its expected exponent is 1/2. */
static void check_walk(const char *name, struct ensemble e) {
  const char *method = "symplectic-euler";
  const double h = (double)(0.1L / e.omega);
  const int64_t shorter = is_long() ? 1000000 : 100000, longer = (is_long() ? 100 : 10) * shorter;
  hooke_integrator *integrator = start_run(e.system, (struct run){.method = method, .step = h});
  owned_state *start = start_state(e.system), *state = start_state(e.system);
  check_ok(hooke_integrator_step(integrator, state, shorter));
  const struct errors first = compare(&e, start, state, method, h * e.omega, shorter);
  check_ok(hooke_integrator_step(integrator, state, longer - shorter));
  const struct errors last = compare(&e, start, state, method, h * e.omega, longer);
  const double exponent = log(last.rounding / first.rounding) / log((double)longer / (double)shorter);
  if (is_long()) {
    print_message(
        "%s: rounding %.3g after %lld steps, %.3g after %lld, exponent %.3f; energy %.9g, theory %.9g; "
        "distance %.3g amplitudes\n",
        name, first.rounding, (long long)shorter, last.rounding, (long long)longer, exponent, last.energy,
        last.theory, last.distance);
  }
  check_between(exponent, 0.4, 0.6);
  check_between(last.rounding, 1e-17 * sqrt((double)longer), 1e-15 * sqrt((double)longer));
  check_between(last.energy, 0.01, 0.1); /* at most h omega/2, without growth */
  check_close(last.energy, last.theory, 1e-9);
  check_close(last.distance, 0.0, 1e-16 * (double)longer + 1e-14 * sqrt((double)longer));
  assert_true(hooke_state_time(state) == (double)longer * h);
  char words[64];
  snprintf(words, sizeof words, "%.0e", last.rounding);
  if (!is_long()) extreme_note(FAMILY, name, method, words);
  hooke_integrator_destroy(integrator);
  hooke_system_destroy(e.system);
}

TEST(test_walk) {
  check_walk("rounding of what is kept, about 0 m", ensemble("length", 1.0, 1.0, 0.0, 1.0));
  check_walk("rounding of what is kept, about 1 m", ensemble("strain", 7.3, 0.37, 1.0, 0.3));
}

/* Every method over a thousand radians. */
TEST(test_every_method) {
  const char *name = "1000 radians, 64 phases";
  struct ensemble e = ensemble("length", 7.3, 0.37, 0.0, 0.3);
  const double h = (double)(0.05L / e.omega), tolerance = 1e-9;
  const int64_t steps = 20000;
  owned_state *start = start_state(e.system);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_outcome outcome;
    extreme_run(e.system,
                (struct extreme_run){.method = method,
                                     .step = h,
                                     .steps = steps,
                                     .frame_steps = 1000,
                                     .rtol = tolerance,
                                     .atol = tolerance * e.amplitude,
                                     .atol_velocity = (double)(tolerance * e.amplitude * e.omega)},
                &outcome);
    long double matrix[4];
    const int known = oscillator_step(method, 0.0L, h * e.omega, matrix);
    double error = 0.0, off = 0.0;
    for (int k = 0; k < PHASES; k++) {
      const int64_t at = 3 * (PHASES + k);
      const long double x = ((long double)outcome.q[at] - e.rest) / e.amplitude;
      const long double v = outcome.v[at] / (e.omega * e.amplitude);
      long double before[2], there[2];
      place_of(&e, start, k, before);
      oscillator_solution(0.0L, (long double)steps * h * e.omega, before, there);
      error = fmax(error, (double)hypotl(x - there[0], v - there[1]));
      if (!known) continue;
      oscillator_power(matrix, steps, before, there);
      off = fmax(off, (double)hypotl(x - there[0], v - there[1]));
    }
    long double unit[2] = {1.0L, 0.0L};
    const char *complaint =
        extreme_not_right(&outcome, known ? off : error, 0.0, known ? 1e-8 : 1e6 * tolerance);
    if (known && oscillator_diverges(matrix, steps, unit) > 0)
      complaint = extreme_not_ended(&outcome, HOOKE_DIVERGED, "diverged");
    extreme_demand(FAMILY, name, method, complaint, &outcome);
    extreme_record(FAMILY, name, method, &outcome, error);
  }
  hooke_system_destroy(e.system);
}

/* Time is k times the step, to the bit, where a running sum would be far off. */
TEST(test_time) {
  const double q[] = {0, 0, 0}, mass = 1.0, h = 0.1;
  const int64_t steps = 3000000;
  owned_system *system = small_system(1, q, NULL, mass, 0);
  check_ok(hooke_system_commit(system));
  owned_integrator *integrator = start_run(system, (struct run){.method = "symplectic-euler", .step = h});
  owned_state *state = start_state(system);
  double sum = 0.0;
  for (int64_t k = 0; k < steps; k++)
    sum += h;
  check_ok(hooke_integrator_step(integrator, state, steps / 3));
  check_ok(hooke_integrator_step(integrator, state, steps - steps / 3));
  assert_true(hooke_state_time(state) == (double)steps * h);
  check_between(fabs(sum - (double)steps * h), 1e-7, 1e-3);
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
