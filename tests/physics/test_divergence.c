/* Runs that blow up end as "diverged", at the time that the rule predicts, with the last good state kept. */
#include "canonical.h"
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The rule, on the canonical steps: the first check (every `stride` steps and every 1000) at which a number
 * is not finite or E - E(0) > 100 (T(0) + U_springs(0) + the largest |U_gravity - U_gravity(0)| so far + M
 * g^2 h^2 / 2), the last term being the energy that gravity gives free particles at rest in one step. The
 * term for rounding is left out: it is negligible here. 0 if there is none. */
struct verdict {
  int64_t step, good; /* where it is noticed, and the check before */
};

static struct verdict predict(const hooke_system *system, const double *gravity, const char *method, double h,
                              int64_t steps, int64_t stride) {
  struct canonical canonical;
  struct verdict verdict = {0, 0};
  owned_state *state = start_state(system);
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  canonical_create(system, &canonical);
  canonical.gravity = gravity;
  const double springs = hooke_system_energy(system, "springs", q, NULL),
               kinetic = hooke_system_energy(system, "kinetic", NULL, v);
  const double start = hooke_system_energy(system, "total", q, v),
               weight = hooke_system_energy(system, "gravity", q, NULL);
  double swing = 0.0, mass = 0.0, square = 0.0;
  for (int64_t p = 0; p < canonical.particle_count; p++) {
    if (canonical.inverse_mass[p] != 0.0) mass += hooke_system_mass(system)[p];
  }
  for (int a = 0; a < 3 && gravity != NULL; a++)
    square += gravity[a] * gravity[a];
  const double scale = kinetic + springs + mass * square * h * h / 2.0;
  for (int64_t k = 1; k <= steps && verdict.step == 0; k++) {
    assert_int_equal(canonical_step(&canonical, method, (double)(k - 1) * h, (double)k * h, h, q, v),
                     CANONICAL_STEPPED);
    if (k % stride != 0 && k % 1000 != 0) continue;
    swing = fmax(swing, fabs(hooke_system_energy(system, "gravity", q, NULL) - weight));
    const double rise = hooke_system_energy(system, "total", q, v) - start;
    if (!isfinite(rise) || rise > 100.0 * (scale + swing))
      verdict.step = k;
    else
      verdict.good = k;
  }
  canonical_destroy(&canonical);
  return verdict;
}

static void compare_with_rule(const hooke_system *system, const double *gravity, const char *method, double h,
                              int64_t steps, int64_t stride) {
  const struct verdict expected = predict(system, gravity, method, h, steps, stride);
  const int64_t size = 3 * hooke_system_particle_count(system);
  owned_run(integrator, state, system, .method = method, .step = h, .duration = (double)steps * h,
            .every = (double)stride * h);
  const int32_t status = hooke_integrator_run(integrator, state);
  if (expected.step == 0) {
    assert_int_equal(status, HOOKE_OK);
    assert_true(isnan(hooke_integrator_number(integrator, "diverged_at")));
  } else {
    check_status(status, HOOKE_DIVERGED);
    check_message("diverged");
    check_close(hooke_integrator_number(integrator, "diverged_at"), (double)expected.step * h, 0.0);
    check_close(hooke_state_time(state), (double)expected.good * h, 0.0);
    const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
    for (int64_t k = 0; k < size; k++)
      assert_true(isfinite(q[k]) && isfinite(v[k]));
    if (expected.good > 0) { /* the kept state is the one of that time, to the bit */
      owned_doubles *same = new_doubles(size);
      end_of_run(same, NULL, system, .method = method, .step = h, .duration = (double)expected.good * h);
      check_same_bits(size, q, same);
    }
  }
}

TEST(test_step_above_the_limit) {
  owned_system *system = small_oscillator(10.0);
  const struct verdict at_limit = predict(system, NULL, "symplectic-euler", 0.21, 2000, 1);
  check_between((double)at_limit.step, 3.0, 30.0);
  const int64_t strides[] = {1, 3, 7, 2000};
  for (int k = 0; k < 4; k++) {
    compare_with_rule(system, NULL, "symplectic-euler", 0.21, 2000, strides[k]); /* 2/omega is 0.2 */
    compare_with_rule(system, NULL, "symplectic-euler", 0.19, 2000, strides[k]);
    compare_with_rule(system, NULL, "symplectic-euler", 0.9, 2000,
                      strides[k]); /* beyond every number in 1000 steps */
    compare_with_rule(system, NULL, "forward-euler", 0.02, 2000, strides[k]);
  }
  assert_int_equal(predict(system, NULL, "symplectic-euler", 0.19, 2000, 1).step, 0);
}

/* Between frames the check comes every 1000 steps. */
TEST(test_check_every_thousand) {
  owned_system *system = small_oscillator(10.0);
  owned_run(integrator, state, system, .method = "forward-euler", .step = 0.01, .duration = 30.0,
            .every = 30.0);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  check_close(hooke_integrator_number(integrator, "diverged_at"), 10.0, 0.0);
  check_close(hooke_state_time(state), 0.0, 0.0);
}

static int32_t look(int64_t step, const hooke_state *state, void *ctx) {
  (void)step, (void)state, (void)ctx;
  return 0;
}

/* Of a large scene that goes by tiles no good state is kept but the caller's, unless steps are observed: the
 * bits are the same. A run with too large a step leaves that of the last good frame. */
TEST(test_large_scenes_keep_the_state_of_the_caller) {
  const double steps[] = {1e-4, 1e-2};
  owned_system *system = small_falling(
      small_part(NULL, "rope", NULL,
                 "from=0,0,0 to=12000,0,0 segments=120000 mass=1200 stretch.stiffness=1000 pinned=start"));
  const int64_t size = 3 * hooke_system_particle_count(system);
  for (int k = 0; k < 2; k++) {
    const struct run run = {
        .method = "symplectic-euler", .step = steps[k], .duration = 8 * steps[k], .every = steps[k]};
    owned_integrator *plain = start_run(system, run), *watched = start_run(system, run);
    owned_state *end = start_state(system), *same = start_state(system);
    check_ok(hooke_integrator_on_step(watched, 1, look, NULL));
    check_status(hooke_integrator_run(plain, end), k ? HOOKE_DIVERGED : HOOKE_OK);
    check_status(hooke_integrator_run(watched, same), k ? HOOKE_DIVERGED : HOOKE_OK);
    check_close(hooke_state_time(end), hooke_state_time(same), 0.0);
    check_between(hooke_state_time(end), k ? 0.0 : run.duration, run.duration);
    check_same_bits(size, hooke_state_position(end), hooke_state_position(same));
    check_same_bits(size, hooke_state_velocity(end), hooke_state_velocity(same));
    if (k) continue;
    check_ok(hooke_integrator_step(plain, end, 1));
    check_ok(hooke_integrator_advance(plain, 2));
    check_ok(hooke_integrator_sync(plain, end));
    check_ok(hooke_integrator_step(watched, same, 3));
    check_same_bits(size, hooke_state_position(end), hooke_state_position(same));
  }
}

/* A long fall gains more than 100 times the initial energy of springs and motion: the term for gravity allows
 * for it. */
TEST(test_falling_is_not_diverging) {
  const double q[] = {0, 0, 0, 1, 0, 0}, gravity[] = {0, -10, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 0);
  springs_with(system, 1, ends, .stiffness = 100, .rest_length = 0.999);
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_commit(system));
  assert_int_equal(predict(system, gravity, "forward-euler", 1e-3, 3000, 10).step, 0);
  compare_with_rule(system, gravity, "forward-euler", 1e-3, 3000, 10);
  compare_with_rule(system, gravity, "symplectic-euler", 1e-3, 3000, 10);
  compare_with_rule(system, gravity, "symplectic-euler", 0.2, 3000, 10); /* 2/omega is 0.141 */
}

/* Forward Euler gives particles at rest a velocity before they have moved: there is no energy to compare with
 * yet, and no divergence at any step. */
TEST(test_first_step_of_a_fall) {
  const double q[] = {0, 0, 0, 1, 0, 0}, gravity[] = {0, -10, 0};
  const int64_t ends[] = {0, 1};
  for (double h = 1.0; h > 1e-6; h /= 8.0) {
    owned_system *system = small_system(2, q, NULL, 1.0, 0);
    springs_with(system, 1, ends, .stiffness = 1, .rest_length = 1.0);
    check_ok(hooke_system_set_gravity(system, gravity));
    check_ok(hooke_system_commit(system));
    compare_with_rule(system, gravity, "forward-euler", h, 1000, 1);
    assert_int_equal(predict(system, gravity, "forward-euler", h, 1000, 1).step, 0);
  }
}

/* ---- with a callback only non-finite numbers count, not the energy ---- */

static int32_t push(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  const double *from = ctx;
  (void)q;
  (void)v;
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] += t >= from[0] ? from[1] : 0.0;
  return 0;
}

static int32_t run_pushed(double strength, double *diverged_at, double *end) {
  const double q[] = {0, 0, 0};
  double from[] = {0.5, strength};
  owned_system *system = small_system(1, q, NULL, 1.0, 0);
  check_ok(hooke_system_set_force(system, push, NULL, from));
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 0.0625, .duration = 1.0,
            .every = 0.125);
  const int32_t status = hooke_integrator_run(integrator, state);
  *diverged_at = hooke_integrator_number(integrator, "diverged_at");
  *end = hooke_state_time(state);
  for (int k = 0; k < 3; k++)
    assert_true(isfinite(hooke_state_position(state)[k]));
  return status;
}

TEST(test_callbacks) {
  double diverged_at, end;
  assert_int_equal(run_pushed(1e9, &diverged_at, &end), HOOKE_OK);
  assert_true(isnan(diverged_at));
  check_close(end, 1.0, 0.0);
  assert_int_equal(run_pushed(NAN, &diverged_at, &end), HOOKE_DIVERGED);
  check_close(diverged_at, 0.625, 0.0); /* the step from 0.5 is the first wrong one; the next frame sees it */
  check_close(end, 0.5, 0.0);
  assert_int_equal(run_pushed(-INFINITY, &diverged_at, &end), HOOKE_DIVERGED);
  check_close(diverged_at, 0.625, 0.0);
}

/* First-order problems have no energy either. */
static int32_t explode(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)t;
  (void)ctx;
  for (int64_t k = 0; k < n; k++)
    rate[k] = 1e10 * x[k];
  return 0;
}

TEST(test_first_order) {
  owned_state *state = NULL;
  check_ok(hooke_state_create_first_order(1, &state));
  hooke_state_position(state)[0] = 1.0;
  owned_integrator *integrator = start_first_order(
      1, explode, NULL,
      (struct run){.method = "forward-euler", .step = 1.0, .duration = 100.0, .every = 1.0});
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  check_close(hooke_integrator_number(integrator, "diverged_at"), 31.0, 0.0); /* 1e310 is infinite */
  check_close(hooke_state_time(state), 30.0, 0.0);
  check_between(hooke_state_position(state)[0], 9e299, 1.1e300);
}

/* ---- frames after divergence ---- */

struct beyond {
  hooke_integrator *integrator;
  struct canonical canonical;
  double h, *q, *v, reached; /* where the canonical steps are; the largest coordinate of the last frame */
  int64_t step, frames, after, most_after;
};

/* Every frame is the canonical state of its step, before and after. */
static int32_t see_beyond(int64_t step, const hooke_state *state, void *ctx) {
  struct beyond *b = ctx;
  const int64_t size = hooke_state_size(state);
  for (; b->step < step; b->step++) {
    const double t = (double)b->step * b->h;
    assert_int_equal(
        canonical_step(&b->canonical, "symplectic-euler", t, (double)(b->step + 1) * b->h, b->h, b->q, b->v),
        CANONICAL_STEPPED);
  }
  const double *q = hooke_state_position((hooke_state *)state),
               *v = hooke_state_velocity((hooke_state *)state);
  for (int64_t k = 0; k < size; k++)
    assert_true(isfinite(q[k]) && isfinite(v[k]));
  if (largest(size, v) < 1e150) { /* its products overflow in the canonical sum first */
    check_same_bits(size, q, b->q);
    check_same_bits(size, v, b->v);
  }
  b->reached = largest(size, q);
  assert_true(hooke_state_time(state) == (double)step * b->h);
  b->frames++;
  b->after += !isnan(hooke_integrator_number(b->integrator, "diverged_at"));
  return b->after == b->most_after;
}

/* Runs past divergence, and as usual, from the same start: they end alike. */
static struct beyond run_beyond(const hooke_system *system, double after, int64_t most_after) {
  const struct run run = {.method = "symplectic-euler", .step = 0.21, .duration = 420.0, .every = 0.42};
  struct beyond b = {.h = 0.21, .most_after = most_after};
  owned_options *options = run_options(run);
  owned_integrator *usual = start_run(system, run);
  owned_state *state = start_state(system), *same = start_state(system);
  const int64_t size = hooke_state_size(state);
  canonical_create(system, &b.canonical);
  b.q = new_doubles(2 * size);
  b.v = b.q + size;
  memcpy(b.q, hooke_state_position(state), (size_t)size * sizeof(double));
  memcpy(b.v, hooke_state_velocity(state), (size_t)size * sizeof(double));
  if (after < 0.0)
    check_ok(hooke_options_set_number(options, "past_divergence", 1.0));
  else
    check_ok(hooke_options_set_number(options, "frames_after", after));
  check_ok(hooke_integrator_create(system, options, &b.integrator));
  check_ok(hooke_integrator_on_frame(b.integrator, see_beyond, &b));
  check_status(hooke_integrator_run(usual, same), HOOKE_DIVERGED);
  check_status(hooke_integrator_run(b.integrator, state), HOOKE_DIVERGED);
  check_message("the run diverged");
  assert_true(hooke_state_time(state) == hooke_state_time(same));
  check_same_bits(size, hooke_state_position(state), hooke_state_position(same));
  assert_true(hooke_integrator_number(b.integrator, "diverged_at") ==
              hooke_integrator_number(usual, "diverged_at"));
  assert_int_equal(hooke_integrator_count(b.integrator, "steps"), hooke_integrator_count(usual, "steps"));
  assert_int_equal(hooke_integrator_count(b.integrator, "stop_value"), 0);
  canonical_destroy(&b.canonical);
  hooke_integrator_destroy(b.integrator);
  return b;
}

TEST(test_frames_after) {
  owned_system *system = small_oscillator(10.0);
  struct beyond b = run_beyond(system, -1.0, -1);
  check_between((double)b.after, 100.0, 1000.0);
  assert_true(b.reached > 1e150); /* whose square is beyond all numbers soon after */
  free(b.q);
  b = run_beyond(system, 7.0, -1);
  assert_int_equal(b.after, 7);
  free(b.q);
  b = run_beyond(system, 0.0, -1);
  assert_int_equal(b.after, 0);
  free(b.q);
  b = run_beyond(system, 7.0, 3); /* an observer may end it */
  assert_int_equal(b.after, 3);
  free(b.q);
}
