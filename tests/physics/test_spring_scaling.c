/* Springs whose rest length and stiffness follow time, against Bessel's and Mathieu's equations. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <gsl/gsl_sf_bessel.h>
#include <math.h>

/* ---- a pendulum that becomes longer ---- */

static const double LENGTH = 1.0, SPEED = 0.2, GRAVITY = 9.81, SMALL = 1e-4;

/* Of l = LENGTH + SPEED t from rest at the angle SMALL: (A J1(u) + B Y1(u))/u, u = 2 sqrt(g l)/SPEED, whose
 * derivative by u is -(A J2(u) + B Y2(u))/u. */
static double bessel_angle(double t) {
  const double start = 2.0 * sqrt(GRAVITY * LENGTH) / SPEED;
  const double u = 2.0 * sqrt(GRAVITY * (LENGTH + SPEED * t)) / SPEED;
  const double b = -gsl_sf_bessel_Jn(2, start) / gsl_sf_bessel_Yn(2, start);
  const double first = (gsl_sf_bessel_J1(start) + b * gsl_sf_bessel_Y1(start)) / start;
  return SMALL * (gsl_sf_bessel_J1(u) + b * gsl_sf_bessel_Y1(u)) / u / first;
}

TEST(a_lengthening_pendulum_follows_bessel) {
  const double place[6] = {0, 0, 0, LENGTH * sin(SMALL), 0, -LENGTH * cos(SMALL)};
  const double velocity[6] = {0, 0, 0, SPEED * sin(SMALL), 0, -SPEED * cos(SMALL)};
  const int64_t ends[2] = {0, 1}, first = 0;
  owned_system *system = small_system(2, place, velocity, 1.0, 0);
  small_group(system, "springs", "line", 1, ends,
              "law=length stiffness=1e6 rest_length=%.17g rest_scale.motion=table rest_scale.time=0,10 "
              "rest_scale.value=1,%.17g",
              LENGTH, (LENGTH + SPEED * 10.0) / LENGTH);
  check_ok(hooke_system_set_gravity(system, (double[]){0, 0, -GRAVITY}));
  check_ok(hooke_system_pin(system, 1, &first));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "rk4", .step = 2e-4);
  double lowest = 0.0;
  for (int k = 1; k <= 20; k++) {
    check_ok(hooke_integrator_step(integrator, state, 2500));
    const double *x = hooke_state_position(state) + 3, angle = atan2(x[0], -x[2]);
    check_close(angle, bessel_angle(0.5 * k), 1e-3 * SMALL);
    lowest = fmin(lowest, angle);
  }
  check_between(lowest, -SMALL, -0.5 * SMALL); /* it has swung */
}

/* ---- an oscillator whose stiffness oscillates ---- */

/* The largest deviation over 20 s, over that at the start, with stiffness 100 (1 + 0.1 sin(beside 20 t)). */
static double growth(double beside) {
  const double place[6] = {0, 0, 0, 1.0001, 0, 0};
  const int64_t ends[2] = {0, 1}, first = 0;
  owned_system *system = small_system(2, place, NULL, 1.0, 0);
  small_group(system, "springs", "pumped", 1, ends,
              "law=length stiffness=100 rest_length=1 stiffness_scale.motion=harmonic "
              "stiffness_scale.amplitude=0.1 stiffness_scale.frequency=%.17g",
              beside * 20.0 / 6.28318530717958647693);
  check_ok(hooke_system_pin(system, 1, &first));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "rk4", .step = 0.005);
  double most = 0.0;
  for (int k = 0; k < 4000; k++) {
    check_ok(hooke_integrator_step(integrator, state, 1));
    most = fmax(most, fabs(hooke_state_position(state)[3] - 1.0));
  }
  return most / 0.0001;
}

/* In the middle of the first tongue it grows by exp(0.1 omega t/4), of which one of two motions has half or
 * more; 5 % beside it stays. */
TEST(a_pumped_oscillator_grows_in_the_first_tongue_alone) {
  check_between(growth(1.0), 0.4 * exp(5.0), 1.0 * exp(5.0));
  check_between(growth(1.05), 0.9, 4.0);
  check_between(growth(0.95), 0.9, 4.0);
}

/* ---- limits ---- */

#if HOOKE_HAVE_LAPACK
/* Of one spring whose stiffness is four times as large at t = 1: 2/omega of Verlet there, and along a run. */
TEST(a_limit_is_that_of_the_asked_time) {
  const double place[6] = {0, 0, 0, 1.001, 0, 0};
  const int64_t ends[2] = {0, 1}, first = 0;
  owned_system *system = small_system(2, place, NULL, 1.0, 0);
  small_group(system, "springs", "pumped", 1, ends,
              "stiffness=100 rest_length=1 stiffness_scale.motion=table stiffness_scale.time=0,1,2 "
              "stiffness_scale.value=1,4,1");
  check_ok(hooke_system_pin(system, 1, &first));
  check_ok(hooke_system_commit(system));
  owned_options *run =
      run_options((struct run){.method = "verlet", .step = 0.01, .duration = 2.0, .every = 0.1});
  for (int along = 0; along < 2; along++) {
    owned_state *state = start_state(system);
    if (!along) hooke_state_set_time(state, 1.0);
    owned_options *options = options_with("limit", "methods=verlet predict=1 along=%d", along);
    owned_measurement *limit = NULL;
    check_ok(hooke_measurement_create("limit", system, run, options, &limit));
    check_ok(hooke_measurement_run(limit, state));
    check_close(hooke_measurement_number(limit, "rows", 0, along ? "smallest" : "predicted"), 0.1, 1e-6);
    if (along) check_close(hooke_measurement_number(limit, "rows", 0, "smallest_time"), 1.0, 1e-9);
  }
}
#endif
