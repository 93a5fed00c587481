/* The highest order that cvode-bdf chooses if max_order is not given: 2 where stiff springs are weakly damped
 * and the tolerance is not tight, otherwise 5. With 5 the run equals, to the bit, that with max_order 5. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <string.h>

enum { SEGMENTS = 24, PARTICLES = SEGMENTS + 1, SIZE = 3 * PARTICLES };

struct outcome {
  int64_t steps, force_evaluations;
  double q[SIZE];
};

/* A rope released from horizontal: one metre, 0.25 kg. */
static hooke_system *rope(double stiffness, double damping) {
  const double gravity[3] = {0.0, -9.81, 0.0};
  double position[SIZE] = {0.0};
  int64_t ends[2 * SEGMENTS], bends[2 * (SEGMENTS - 1)];
  for (int k = 0; k < PARTICLES; k++)
    position[3 * k] = (double)k / SEGMENTS;
  for (int k = 0; k < SEGMENTS; k++) {
    ends[2 * k] = k;
    ends[2 * k + 1] = k + 1;
  }
  for (int k = 0; k < SEGMENTS - 1; k++) {
    bends[2 * k] = k;
    bends[2 * k + 1] = k + 2;
  }
  hooke_system *system = small_system(PARTICLES, position, NULL, 0.25 / PARTICLES, 1);
  springs_with(system, SEGMENTS, ends, NULL, stiffness, damping, -1.0, 0);
  small_springs(system, SEGMENTS - 1, bends, (struct springs){NULL, 2.0, 0.01, -1.0, 0});
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, 0.2));
  return committed(system);
}

/* Options of a run; max_order 0: not given. */
struct ask {
  const char *method;
  double rtol, atol, duration;
  int max_order;
};

static hooke_integrator *start(const hooke_system *system, struct ask ask) {
  owned_options *options = run_options((struct run){
      .method = ask.method, .rtol = ask.rtol, .atol = ask.atol, .duration = ask.duration, .every = 0.1});
  hooke_integrator *integrator = NULL;
  if (ask.max_order > 0) check_ok(hooke_options_set_number(options, "max_order", ask.max_order));
  check_ok(hooke_integrator_create(system, options, &integrator));
  return integrator;
}

/* A run from the initial state; the counts are those of this run. */
static struct outcome run_on(hooke_integrator *integrator, const hooke_system *system) {
  const int64_t steps = hooke_integrator_count(integrator, "steps");
  const int64_t evaluations = hooke_integrator_count(integrator, "force_evaluations");
  owned_state *state = start_state(system);
  struct outcome outcome;
  check_ok(hooke_integrator_run(integrator, state));
  outcome.steps = hooke_integrator_count(integrator, "steps") - steps;
  outcome.force_evaluations = hooke_integrator_count(integrator, "force_evaluations") - evaluations;
  memcpy(outcome.q, hooke_state_position(state), sizeof outcome.q);
  return outcome;
}

static struct outcome run_once(const hooke_system *system, struct ask ask) {
  owned_integrator *integrator = start(system, ask);
  const struct outcome outcome = run_on(integrator, system);
  return outcome;
}

static struct outcome run_with(const hooke_system *system, struct ask ask, int max_order) {
  ask.max_order = max_order;
  return run_once(system, ask);
}

static void check_same(const struct outcome *a, const struct outcome *b) {
  assert_int_equal(a->steps, b->steps);
  assert_int_equal(a->force_evaluations, b->force_evaluations);
  check_same_bits(SIZE, a->q, b->q);
}

static void needs_cvode(void) {
  if (hooke_method_is_built("cvode-bdf") != 1) skip();
}

static const double STIFF = 1e5, WEAK = 0.05, STRONG = 100.0;
static const struct ask LOOSE = {"cvode-bdf", 1e-4, 1e-7, 0.3, 0};

/* ---- lowered ---- */

TEST(test_stiff_and_weakly_damped) {
  needs_cvode();
  owned_system *system = rope(STIFF, WEAK);
  const struct outcome exact = run_once(system, (struct ask){"cvode-adams", 1e-8, 1e-11, 0.3, 0});
  struct ask ask = LOOSE;
  for (int k = 0; k < 2; k++, ask.rtol /= 10.0, ask.atol /= 10.0) {
    const struct outcome chosen = run_with(system, ask, 0);
    const struct outcome low = run_with(system, ask, 2), high = run_with(system, ask, 5);
    check_between((double)chosen.steps / (double)high.steps, 0.005, 0.2);
    check_between((double)chosen.steps / (double)low.steps, 0.5, 2.5);
    /* positions are up to a metre */
    const double error = largest_difference(SIZE, chosen.q, exact.q);
    check_between(error / ask.rtol, 1e-4, 1.0);
    /* whose many steps, limited far below those of the tolerance, have a smaller error */
    check_between(error / largest_difference(SIZE, high.q, exact.q), 0.03, 300.0);
  }
}

TEST(test_a_given_order_stays) {
  needs_cvode();
  owned_system *system = rope(STIFF, WEAK);
  const struct outcome chosen = run_with(system, LOOSE, 0);
  for (int order = 3; order <= 5; order++) {
    const struct outcome given = run_with(system, LOOSE, order);
    check_between((double)given.steps / (double)chosen.steps, 1.5, 50.0);
  }
  const struct outcome low = run_with(system, LOOSE, 2);
  assert_true(low.steps != chosen.steps); /* which begins with all orders */
}

/* A run chooses anew, independently of the previous one. */
TEST(test_again) {
  needs_cvode();
  owned_system *system = rope(STIFF, WEAK);
  owned_integrator *integrator = start(system, LOOSE);
  const struct outcome first = run_on(integrator, system), second = run_on(integrator, system);
  const struct outcome alone = run_once(system, LOOSE);
  check_same(&second, &first);
  check_same(&alone, &first);
}

/* ---- unchanged ---- */

/* The check is meaningful: order 2 gives another run. */
static void check_left_alone(double stiffness, double damping, struct ask ask) {
  owned_system *system = rope(stiffness, damping);
  const struct outcome chosen = run_with(system, ask, 0);
  const struct outcome low = run_with(system, ask, 2), high = run_with(system, ask, 5);
  check_same(&chosen, &high);
  assert_true(low.steps != high.steps);
}

TEST(test_strongly_damped) {
  needs_cvode();
  check_left_alone(STIFF, STRONG, LOOSE);
}

/* With a wide absolute tolerance, steps are long for both of these; only the first drops the higher orders.
 */
TEST(test_tight_tolerance) {
  needs_cvode();
  owned_system *system = rope(STIFF, WEAK);
  const struct ask last = {"cvode-bdf", 1e-6, 1e-5, 0.3, 0}, tight = {"cvode-bdf", 0.999e-6, 1e-5, 0.3, 0};
  const struct outcome chosen = run_with(system, last, 0), high = run_with(system, last, 5);
  assert_true(chosen.steps != high.steps);
  check_left_alone(STIFF, WEAK, tight);
  check_left_alone(STIFF, WEAK, (struct ask){"cvode-bdf", 1e-8, 1e-5, 0.3, 0});
}

/* Steps that follow the fastest motion: accuracy limits them. */
TEST(test_soft) {
  needs_cvode();
  check_left_alone(20.0, 0.0, (struct ask){"cvode-bdf", 1e-5, 1e-8, 0.3, 0});
}
