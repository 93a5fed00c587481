/* The energy balance: its residual is the error of the method, decreases with the step like its order, and
 * does not if the power is wrong. */
#include "hooke.h"
#include "check.h"
#include "run.h"
#include "small.h"

#include "measure/trial/balance.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

enum { FRAMES = 8 };

/* Held at its end, driven there, held under loads in a wind, or held while its springs are wound up and down.
 */
enum { HELD, DRIVEN, LOADED, WOUND, WAYS };

static hooke_system *damped_chain(int way) {
  const double place[] = {0, 0, 0, 1.1, 0.1, 0, 2, 0.3, 0, 3.2, 0, 0.2}, mass = 0.5;
  const int64_t ends[] = {0, 1, 1, 2, 2, 3}, first = 0;
  hooke_system *system = small_system(4, place, NULL, mass, 0);
  small_group(system, "springs", "", 3, ends, "%s%s", "law=length stiffness=40 damping=0.3 rest_length=1",
              way == WOUND
                  ? " law=strain rest_scale.motion=harmonic rest_scale.amplitude=0.2 rest_scale.frequency=1 "
                    "stiffness_scale.motion=table stiffness_scale.time=-1,0.4,2 stiffness_scale.value=1,2,0.5"
                  : "");
  check_ok(hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  check_ok(hooke_system_set_drag(system, 0.2));
  if (way == LOADED) {
    const int64_t loaded[2] = {1, 2};
    owned_options *load = options_with("loads", "motion=harmonic force=2,-1,3 frequency=2");
    check_ok(hooke_system_add_loads(system, 2, loaded, load));
    check_ok(hooke_options_unset(load, "frequency"));
    set_options(load, "motion=constant force=1,4,0");
    check_ok(hooke_system_add_loads(system, 1, loaded, load));
    const double time[] = {0, 0.3, 0.8}, velocity[] = {0, 0, 0, 2, 1, 0, 1, 3, 1};
    owned_options *options = options_with("scene", "drag=0.2,0.1,0.3,0.2,0.1,0.1 quadratic_drag=0.1");
    check_ok(hooke_options_set_numbers(options, "wind.time", 3, time));
    check_ok(hooke_options_set_numbers(options, "wind.velocity", 9, velocity));
    check_ok(hooke_scene_options_apply(options, system));
    small_part(system, "rope", "rope",
               "from=0,1,0 to=1,1,0 segments=1 mass=1 stretch.stiffness=40 fluid_drag.density=2 "
               "fluid_drag.diameter=0.3 fluid_drag.normal=1 fluid_drag.tangential=0.1 pinned=start");
  }
  if (way == DRIVEN)
    check_ok(hooke_system_drive_harmonic(system, 1, &first, (double[]){0.2, 0.1, 0}, 1.5, 0.3));
  else
    check_ok(hooke_system_pin(system, 1, &first));
  return committed(system);
}

struct watch {
  const hooke_system *system;
  struct hk_balance balance;
  double (*power)(const hooke_system *system, double t, const double *q, const double *v);
  int64_t count;
  double residual[FRAMES + 1];
};

static int32_t on_step(int64_t step, const hooke_state *state, void *ctx) {
  struct watch *watch = ctx;
  (void)step;
  return hk_balance_step(&watch->balance, state);
}

static int32_t on_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct watch *watch = ctx;
  if (step == 0) {
    check_ok(hk_balance_begin(&watch->balance, watch->system, state));
    if (watch->power == NULL) return 0;
    watch->balance.dissipated_power = watch->power;
    watch->balance.power_out = watch->power(watch->system, hooke_state_time(state),
                                            hooke_state_position(state), hooke_state_velocity(state));
    return 0;
  }
  check_ok(hk_balance_step(&watch->balance, state));
  hk_balance_close(&watch->balance, state);
  watch->residual[watch->count++] = watch->balance.residual;
  return 0;
}

static void run_watched(struct watch *watch, const char *method, double step) {
  watch->count = 0;
  const struct run run = {.method = method, .step = step, .duration = 0.8, .every = 0.1};
  owned_integrator *integrator = start_run(watch->system, run);
  check_ok(hooke_integrator_on_step(integrator, 1, on_step, watch));
  check_ok(hooke_integrator_on_frame(integrator, on_frame, watch));
  owned_state *state = start_state(watch->system);
  check_ok(hooke_integrator_run(integrator, state));
  assert_int_equal(watch->count, FRAMES);
  hk_balance_release(&watch->balance);
}

static int32_t holds(const char *method, int way,
                     double (*power)(const hooke_system *system, double t, const double *q, const double *v),
                     double *ratio) {
  owned_system *system = damped_chain(way);
  struct watch coarse = {.system = system, .power = power}, fine = coarse;
  double largest, bound, smaller, other;
  run_watched(&coarse, method, 1e-3);
  run_watched(&fine, method, 5e-4);
  const double floor = hk_balance_floor(&fine.balance);
  const int32_t kept = hk_balance_holds(FRAMES, coarse.residual, fine.residual, floor, &largest, &bound);
  hk_balance_holds(FRAMES, fine.residual, fine.residual, floor, &smaller, &other);
  *ratio = largest / smaller;
  return kept;
}

static const struct {
  const char *method;
  double low, high; /* reduction at half the step */
} methods[] = {{"forward-euler", 1.8, 2.2},
               {"symplectic-euler", 1.8, 2.2},
               {"backward-euler", 1.8, 2.2},
               {"verlet", 3.6, 4.4},
               {"tr-bdf2", 3.6, 4.4},
               {"implicit-midpoint", 3.6, 4.4},
               {"rk4", 3.6, 4.4}}; /* the trapezoidal rule is of second order */

TEST(what_is_left_over_is_the_error_of_the_method) {
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    for (int way = 0; way < WAYS; way++) {
      double ratio;
      if (!holds(methods[k].method, way, NULL, &ratio))
        check_failed("%s, way %d: does not hold", methods[k].method, way);
      check_between(ratio, methods[k].low, methods[k].high);
    }
  }
}

static double a_fiftieth_too_much(const hooke_system *system, double t, const double *q, const double *v) {
  return 1.02 * hooke_system_dissipated_power_at(system, t, q, v);
}

static double none(const hooke_system *system, double t, const double *q, const double *v) {
  (void)system, (void)t, (void)q, (void)v;
  return 0.0;
}

TEST(wrong_heat_is_seen) {
  double ratio;
  for (int way = 0; way < WAYS; way++) {
    assert_false(holds("verlet", way, a_fiftieth_too_much, &ratio));
    assert_false(holds("rk4", way, a_fiftieth_too_much, &ratio));
    assert_false(holds("rk4", way, none, &ratio));
    assert_false(holds("symplectic-euler", way, none, &ratio));
  }
}

/* Missing work is detected, too, of drives and of what winds springs. */
static void check_wrong_work(int way) {
  owned_system *system = damped_chain(way);
  struct watch coarse = {.system = system}, fine = coarse;
  double largest, bound;
  run_watched(&coarse, "verlet", 1e-3);
  run_watched(&fine, "verlet", 5e-4);
  assert_true(fabs(coarse.balance.work) > 0.1);
  for (int k = 0; k < FRAMES; k++) {
    coarse.residual[k] += 0.05 * coarse.balance.work;
    fine.residual[k] += 0.05 * fine.balance.work;
  }
  assert_false(hk_balance_holds(FRAMES, coarse.residual, fine.residual, hk_balance_floor(&fine.balance),
                                &largest, &bound));
  check_between(largest, bound, INFINITY);
}

TEST(wrong_work_is_seen) {
  check_wrong_work(DRIVEN);
  check_wrong_work(WOUND);
}
