/* Scenes without springs, without free particles, with disconnected parts, empty ones, and scenes at rest. */
#include "check.h"
#include "extreme.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const char *const FAMILY = "scenes";

static struct extreme_run usual(const char *method) {
  return (struct extreme_run){
      .method = method, .step = 0.01, .steps = 200, .rtol = 1e-9, .atol = 1e-11, .max_steps = 100000};
}

/* Runs every method and checks the position of each particle; `order1` is the error of a method of order 1 at
 * h = 0.01 s here, which bounds all methods. Returns nothing: it fails the test. */
static void check_scene(const hooke_system *system, const char *name, const double *expected, double order1) {
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_outcome outcome;
    extreme_run(system, usual(method), &outcome);
    const double error = extreme_error(&outcome, expected ? expected : outcome.q0, 1.0);
    extreme_demand(FAMILY, name, method, extreme_not_right(&outcome, error, 0.0, order1), &outcome);
    assert_int_equal(outcome.frames, 201);
    extreme_record(FAMILY, name, method, &outcome, error);
  }
}

/* ---- free floating ---- */

/* A square that spins about its centre at omega while it flies: each side is stretched so that it turns as a
 * rigid body. */
TEST(test_free_floating) {
  const double omega = 1.5, pull = 3.0, stiffness = 40.0, mass = 2.0, t = 2.0;
  const double flight[] = {0.3, -0.2, 0.1};
  /* a diagonal of length 2 pulls each corner inwards with m omega^2 */
  const double rest = 2.0 / (1.0 + mass * omega * omega / stiffness);
  double q[12], v[12], expected[12];
  for (int k = 0; k < 4; k++) {
    const double angle = 1.5707963267948966 * k, later = angle + omega * t;
    const double x[] = {cos(angle), sin(angle), 0}, u[] = {-omega * sin(angle), omega * cos(angle), 0};
    const double end[] = {cos(later), sin(later), 0};
    for (int a = 0; a < 3; a++) {
      q[3 * k + a] = pull + x[a];
      v[3 * k + a] = flight[a] + u[a];
      expected[3 * k + a] = pull + end[a] + flight[a] * t;
    }
  }
  const int64_t ends[] = {0, 2, 1, 3};
  owned_system *system = small_system(4, q, v, mass, 0);
  small_springs(system, 2, ends, (struct springs){.stiffness = stiffness, .rest_length = rest});
  check_ok(hooke_system_commit(system));
  check_scene(system, "free floating", expected, 0.06);
  double before[3], after[3];
  hooke_system_momentum(system, v, before);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_outcome outcome;
    extreme_run(system, usual(method), &outcome);
    hooke_system_momentum(system, outcome.v, after);
    for (int a = 0; a < 3; a++)
      check_close(after[a], before[a], 1e-12);
  }
}

/* ---- all pinned ---- */

TEST(test_all_pinned) {
  const double q[] = {0, 0, 0, 3, 0, 0, 0, 4, 0}, gravity[] = {0, -10, 0};
  const int64_t ends[] = {0, 1, 1, 2}, particles[] = {0, 1, 2};
  owned_system *system = small_system(3, q, NULL, 1.0, 0);
  small_springs(system, 2, ends, (struct springs){.stiffness = 1e6, .rest_length = 1.0, .damping = 1.0});
  check_ok(hooke_system_pin(system, 3, particles));
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, 1.0));
  check_ok(hooke_system_commit(system));
  check_scene(system, "all pinned", NULL, 0.0);
}

/* ---- disconnected ---- */

/* Two independent oscillators, a stiff and a soft one, and a particle that flies by: each moves as it does
 * alone, to the bit with fixed explicit steps. */
static hooke_system *pieces(int32_t stiff, int32_t soft, int32_t flier) {
  const double q[] = {0, 0, 0, 1.2, 0, 0, 0, 5, 0, 0, 5.9, 0, 7, 7, 7},
               v[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, -2, 3};
  const int64_t ends[] = {0, 1};
  const int64_t first_of[] = {0, 2, 4}, count_of[] = {2, 2, 1};
  const double stiffness[] = {1e4, 1.0};
  const int32_t wanted[] = {stiff, soft, flier};
  const double mass = 1.0;
  hooke_system *system = new_system();
  for (int k = 0; k < 3; k++) {
    if (!wanted[k]) continue;
    int64_t first;
    check_ok(hooke_system_add_particles(system, count_of[k], q + 3 * first_of[k], v + 3 * first_of[k], 1,
                                        &mass, &first));
    const int64_t here[] = {first + ends[0], first + ends[1]};
    if (k < 2)
      small_springs(system, 1, here, (struct springs){.stiffness = stiffness[k], .rest_length = 1.0});
    if (k < 2) check_ok(hooke_system_pin(system, 1, &first));
  }
  check_ok(hooke_system_commit(system));
  return system;
}

TEST(test_disconnected) {
  hooke_system *all = pieces(1, 1, 1), *alone[] = {pieces(1, 0, 0), pieces(0, 1, 0), pieces(0, 0, 1)};
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    struct extreme_run run = usual(method);
    run.step = 1e-3;
    owned_outcome together;
    double apart[15];
    int64_t at = 0;
    int32_t worst = HOOKE_OK;
    for (int k = 0; k < 3; k++) {
      owned_outcome outcome;
      extreme_run(alone[k], run, &outcome);
      const char *complaint = extreme_unsound(&outcome);
      extreme_demand(FAMILY, "disconnected, alone", method, complaint, &outcome);
      if (outcome.status != HOOKE_OK) worst = outcome.status;
      memcpy(apart + at, outcome.q, (size_t)outcome.size * sizeof(double));
      at += outcome.size;
    }
    extreme_run(all, run, &together);
    if (worst != HOOKE_OK) { /* each piece alone moves as in the scene */
      extreme_demand(FAMILY, "disconnected", method, extreme_not_ended(&together, worst, ""), &together);
      extreme_record(FAMILY, "disconnected, against alone", method, &together, NAN);
    } else {
      const double error = extreme_error(&together, apart, 1.0);
      const int solved = hooke_method_is_adaptive(method) || strstr(method, "backward") != NULL;
      extreme_demand(FAMILY, "disconnected", method,
                     extreme_not_right(&together, error, 0.0, solved ? 1e-6 : 0.0), &together);
      extreme_record(FAMILY, "disconnected, against alone", method, &together, error);
    }
  }
  hooke_system_destroy(all);
  for (int k = 0; k < 3; k++)
    hooke_system_destroy(alone[k]);
}

/* ---- empty, and one particle ---- */

TEST(test_empty) {
  const double gravity[] = {0, -10, 0};
  for (int weight = 0; weight <= 1; weight++) {
    owned_system *system = new_system();
    if (weight) check_ok(hooke_system_set_gravity(system, gravity));
    check_ok(hooke_system_commit(system));
    check_scene(system, weight ? "empty, with gravity" : "empty", NULL, 0.0);
    assert_true(hooke_system_energy(system, "total", NULL, NULL) == 0.0);
  }
}

TEST(test_single) {
  const double q[] = {1, 2, 3}, v[] = {0.5, 0, -1}, fall[] = {0, -10, 0};
  const double flown[] = {1 + 0.5 * 2, 2, 3 - 1.0 * 2},
               fallen[] = {1 + 0.5 * 2, 2 - 10.0 * 2 * 2 / 2, 3 - 1.0 * 2};
  hooke_system *system = small_system(1, q, v, 3.0, 0);
  check_ok(hooke_system_commit(system));
  check_scene(system, "one particle", flown, 1e-8);
  hooke_system_destroy(system);
  system = small_system(1, q, v, 3.0, 0);
  check_ok(hooke_system_set_gravity(system, fall));
  check_ok(hooke_system_commit(system));
  check_scene(system, "one particle, falling", fallen, 10.0 * 2 * 0.01 / 2 * 1.0001); /* g t h/2 */
  hooke_system_destroy(system);
}

/* ---- at rest ---- */

/* A chain at its rest lengths but for rounding: 0.1 k - 0.1 (k - 1) is not 0.1. Nothing happens: the energy
 * of rounding must not count as divergence. */
TEST(test_at_rest) {
  enum { COUNT = 20 };
  double q[3 * COUNT] = {0};
  int64_t ends[2 * (COUNT - 1)];
  for (int k = 0; k < COUNT; k++)
    q[3 * k] = 0.1 * k;
  for (int k = 0; k < COUNT - 1; k++) {
    ends[2 * k] = k;
    ends[2 * k + 1] = k + 1;
  }
  owned_system *system = small_system(COUNT, q, NULL, 0.01, 1);
  small_springs(system, COUNT - 1, ends, (struct springs){.stiffness = 50.0, .rest_length = 0.1});
  check_ok(hooke_system_commit(system));
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    const struct extreme_run run = {.method = method, .step = 1e-3, .steps = 2000, .frame_steps = 20};
    owned_outcome outcome;
    extreme_run(system, run, &outcome);
    const double error = extreme_error(&outcome, outcome.q0, 1.0);
    /* in Heun's method, of 2000 steps with omega h = 0.45, rounding grows by the factor exp(10) */
    const double most = hooke_method_is_adaptive(method) ? 1e-5 : strcmp(method, "heun") == 0 ? 1e-11 : 1e-12;
    const char *complaint = extreme_not_right(&outcome, error, 0.0, most);
    if (strcmp(method, "forward-euler") == 0) /* unstable: rounding grows, and the run reports divergence */
      complaint = extreme_not_ended(&outcome, HOOKE_DIVERGED, "diverged");
    extreme_demand(FAMILY, "at rest but for rounding", method, complaint, &outcome);
    extreme_record(FAMILY, "at rest but for rounding", method, &outcome, error);
  }
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
