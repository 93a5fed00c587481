/* Dampers applied to their pairs alone: their factor, momentum, the limit of the step at any damping, and
 * what a callback sees. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>

/* ---- one pair ---- */

/* Two free particles of masses 1 and 3 with a damper and hardly a spring, after one step. */
static double part_left(double z) {
  const double q[] = {0, 0, 0, 1, 0, 0}, v[] = {0, 0, 0, 1, 0, 0}, mass[] = {1.0, 3.0}, h = 0.5;
  const int64_t ends[] = {0, 1};
  owned_system *system = new_system();
  check_ok(hooke_system_add_particles(system, 2, q, v, 2, mass, NULL));
  const double w = 1.0 / mass[0] + 1.0 / mass[1];
  springs_with(system, 1, ends, .law = "length", .stiffness = 0.0, .damping = 2.0 * z / (h * w),
               .rest_length = 1.0);
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "shardlow", .step = h);
  check_ok(hooke_integrator_step(integrator, state, 1));
  const double *u = hooke_state_velocity(state), left = u[3] - u[0];
  check_close(mass[0] * u[0] + mass[1] * u[3], 3.0, 1e-15);
  return left;
}

/* From z = 1e-3 to 1e4 a half step: the relative velocity is what the formula says, falls as z rises, and
 * never grows nor changes its sign. */
TEST(factor_is_the_formula) {
  double before = 1.0;
  for (int k = 0; k <= 140; k++) {
    const double z = pow(10.0, -3.0 + k / 20.0), factor = 1.0 / (1.0 + z + z * z / 2.0);
    const double left = part_left(z);
    check_close(left / (factor * factor), 1.0, 1e-15 / (factor * factor) + 1e-12);
    assert_true(left > 0.0 || z > 1e3);
    assert_true(left >= -1e-15 && left < before + 1e-15);
    before = left;
  }
}

/* ---- many pairs ---- */

static double total(const hooke_system *system, hooke_state *state) {
  return hooke_system_energy(system, "total", hooke_state_position(state), hooke_state_velocity(state));
}

/* Momentum and moment of momentum stay to rounding, and the energy falls. */
TEST(momentum_stays) {
  const double dampings[] = {1e-3, 1.0, 1e3, 1e6};
  for (int k = 0; k < 4; k++) {
    owned_system *system = small_net((uint64_t)(k + 1), dampings[k], 1e-6, 0);
    owned_run(integrator, state, system, .method = "shardlow", .step = 1e-3);
    struct random_source source = {99};
    double *v = hooke_state_velocity(state), before[6], after[6];
    for (int i = 0; i < 3 * SMALL_NET_PARTICLES; i++)
      v[i] = random_between(&source, -1.0, 1.0);
    const double energy = total(system, state);
    hooke_system_momentum(system, v, before);
    hooke_system_angular_momentum(system, hooke_state_position(state), v, before + 3);
    check_ok(hooke_integrator_step(integrator, state, 2000));
    hooke_system_momentum(system, v, after);
    hooke_system_angular_momentum(system, hooke_state_position(state), v, after + 3);
    for (int a = 0; a < 6; a++)
      check_close(after[a], before[a], 1e-12);
    assert_true(total(system, state) < energy);
  }
}

/* Stable up to 2/omega of the frozen springs, however strong the damping is; and not above, where it is weak.
 * */
TEST(damping_leaves_the_limit) {
  if (!hooke_build_fact("lapack")[0]) skip();
  const double dampings[] = {0.0, 1e-3, 0.1, 10.0, 1e4};
  for (int k = 0; k < 5; k++) {
    owned_system *system = small_net(7, dampings[k], 1e-6, 1);
    owned_options *run = run_options((struct run){.method = "shardlow", .step = 1e-3, .duration = 1.0});
    owned_measurement *limit = NULL;
    owned_options *options = options_with("limit", "methods=shardlow,verlet");
    check_ok(hooke_measurement_create("limit", system, run, options, &limit));
    check_ok(hooke_measurement_run(limit, NULL));
    const double predicted = hooke_measurement_number(limit, "rows", 0, "predicted"),
                 measured = hooke_measurement_number(limit, "rows", 0, "measured");
    check_close(predicted, hooke_measurement_number(limit, "rows", 1, "predicted"), 1e-12 * predicted);
    if (dampings[k] <= 1e-3)
      check_between(measured / predicted, 0.999, 1.002);
    else
      check_between(measured / predicted, 0.999, INFINITY);
    owned_run(integrator, state, system, .method = "shardlow", .step = 0.98 * predicted);
    hooke_state_velocity(state)[5] += 1e-6;
    const double energy = total(system, state);
    check_ok(hooke_integrator_step(integrator, state, 20000));
    check_between(total(system, state) / energy, 0.0, 1e3);
  }
}

/* ---- a callback ---- */

struct witness {
  int64_t calls;
  double v[4];
};

static int32_t brake(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  struct witness *witness = ctx;
  (void)n, (void)q, (void)t;
  witness->v[witness->calls++ % 4] = v[0];
  force[0] -= 0.5 * v[0];
  return witness->calls > 2 ? 7 : 0;
}

/* After the first sweep, and the predicted velocity; one that stops leaves the state as it was. */
TEST(callback_sees_the_predicted_velocity) {
  const double q[] = {0, 0, 0}, v[] = {1, 0, 0}, h = 0.25, drag = 0.8;
  struct witness witness = {0};
  owned_system *system = small_system(1, q, v, 1.0, 0);
  check_ok(hooke_system_set_force(system, brake, NULL, &witness));
  check_ok(hooke_system_set_drag(system, drag));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "shardlow", .step = h);
  check_ok(hooke_integrator_step(integrator, state, 1));
  const double z = h / 2.0 * drag, factor = 1.0 / (1.0 + z + z * z / 2.0);
  const double half = factor * (1.0 - h / 2.0 * 0.5), ahead = half - h / 2.0 * 0.5 * factor;
  check_close(witness.v[0], factor, 1e-15);
  check_close(witness.v[1], ahead, 1e-15);
  const double end = factor * (half - h / 2.0 * 0.5 * ahead);
  check_close(hooke_state_velocity(state)[0], end, 1e-15);
  const double before = hooke_state_velocity(state)[0];
  check_status(hooke_integrator_step(integrator, state, 1), HOOKE_STOPPED);
  assert_true(hooke_state_velocity(state)[0] == before);
}

/* A cable that goes slack is not pushed: its damper takes no more than its tension. */
TEST(cables_never_push) {
  const double q[] = {0, 0, 0, 1.1, 0, 0}, v[] = {0, 0, 0, -5, 0, 0}, h = 1e-3, kappa = 10.0;
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, v, 1.0, 1);
  springs_with(system, 1, ends, .law = "length", .stiffness = kappa, .damping = 1e3, .rest_length = 1.0,
               .pull_only = 1);
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "shardlow", .step = h);
  /* while it is taut, tension and damper are in balance, and then there is neither */
  check_ok(hooke_integrator_step(integrator, state, 40));
  check_close(hooke_state_velocity(state)[3], -5.0, 2.0 * h * kappa * 0.1);
  check_close(hooke_state_position(state)[3], 1.1 - 40.0 * h * 5.0, 1e-3);
}
