/* Numbers below 2.2e-308: computed as IEEE 754 prescribes, and never flushed to zero. */
#include "canonical.h"
#include "check.h"
#include "extreme.h"
#include "small.h"

#include <fenv.h>
#include <math.h>

/* 0 if subnormal operands or results are flushed to zero. */
static double denormals_left(void) {
  volatile double smallest = 2.2250738585072014e-308, tiny = 4.9406564584124654e-324;
  return smallest / 4.0 > 0.0 && tiny + tiny > tiny ? 1.0 : 0.0;
}

static int32_t probe(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)q, (void)v, (void)force;
  double *left = ctx;
  if (denormals_left() == 0.0 || fegetround() != FE_TONEAREST) *left = 0.0;
  return 0;
}

/* Neither loading the library nor any method changes the floating-point state of this thread. */
TEST(test_never_flushed) {
  const double q[] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[] = {0, 1};
  double left = denormals_left();
  assert_true(left == 1.0);
  owned_system *system = small_system(2, q, NULL, 1.0, 1);
  small_springs(system, 1, ends, (struct springs){.stiffness = 3.0, .damping = 0.1, .rest_length = 0.5});
  check_ok(hooke_system_set_force(system, probe, NULL, &left));
  check_ok(hooke_system_commit(system));
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_outcome outcome;
    extreme_run(system, (struct extreme_run){.method = method, .step = 0.01, .steps = 20}, &outcome);
    extreme_demand("denormals", "flush-to-zero", method, extreme_not_right(&outcome, 0.0, 0.0, 0.0),
                   &outcome);
    extreme_note("denormals", "flush-to-zero", method, left == 1.0 ? "never set" : "set");
    assert_true(left == 1.0 && denormals_left() == 1.0 && fegetround() == FE_TONEAREST);
  }
}

/* An oscillator close to its rest length of 1 m: speeds, forces and changes are subnormal, and every bit is
 * that of the plain loop. */
static void check_bits(const char *name, double amplitude, double rest_length, double drag) {
  const double q[] = {0, 0, 0, rest_length, amplitude, 0}, v[] = {0, 0, 0, 3.0 * amplitude, 0, amplitude};
  const int64_t ends[] = {0, 1}, steps = 200;
  const double h = 0.01;
  owned_system *system = small_system(2, q, v, 0.5, 1);
  small_springs(system, 1, ends,
                (struct springs){.law = "length", .stiffness = 2.0, .rest_length = rest_length});
  check_ok(hooke_system_set_drag(system, drag));
  check_ok(hooke_system_commit(system));
  struct canonical canonical;
  canonical_create(system, &canonical);
  canonical.drag = drag;
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_outcome outcome;
    extreme_run(system, (struct extreme_run){.method = method, .step = h, .steps = steps, .atol = 1e-300},
                &outcome);
    extreme_demand("denormals", name, method, extreme_not_right(&outcome, 0.0, 0.0, 0.0), &outcome);
    int32_t kind = hooke_method_is_adaptive(method) ? CANONICAL_UNKNOWN : CANONICAL_STEPPED;
    for (int64_t k = 0; k < steps && kind == CANONICAL_STEPPED; k++)
      kind =
          canonical_step(&canonical, method, (double)k * h, (double)(k + 1) * h, h, outcome.q0, outcome.v0);
    if (kind == CANONICAL_STEPPED) {
      check_same_bits(6, outcome.q, outcome.q0);
      check_same_bits(6, outcome.v, outcome.v0);
      assert_true(outcome.v[3] != 0.0);
      extreme_note("denormals", name, method, "to the bit");
    } else {
      check_between(fabs(outcome.v[3]), 0.0, 10.0 * amplitude + 1e-298);
      extreme_record("denormals", name, method, &outcome, NAN);
    }
  }
  canonical_destroy(&canonical);
}

TEST(test_bits) {
  check_bits("speed 1e-310 m/s about 1 m", 1e-310, 1.0, 0.0);
  check_bits("motion of 1e-310 m, rest length 0", 1e-310, 0.0, 0.0);
  check_bits("motion of 1e-150 m, rest length 0", 1e-150, 0.0, 0.0);
  check_bits("decay of 1e-320 m/s by drag", 1e-320, 1.0, 2.0);
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
