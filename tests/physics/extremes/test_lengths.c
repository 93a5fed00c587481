/* Springs of rest length zero, of a rest length that no position can have, and springs whose ends coincide or
 * nearly do. */
#include "check.h"
#include "extreme.h"
#include "small.h"

#include <math.h>
#include <stdio.h>

/* ---- rest lengths ---- */

TEST(test_rest_length) {
  const double rest[] = {0.0, 1e-300, 1e-12};
  for (int k = 0; k < 3; k++) {
    char name[64];
    snprintf(name, sizeof name, "rest length %g m", rest[k]);
    extreme_oscillate(
        &(struct extreme_oscillator){.family = "lengths",
                                     .name = name,
                                     .law = "length",
                                     .stiffness = 4.0,
                                     .mass = 1.0,
                                     .rest_length = rest[k],
                                     .step = 0.05,
                                     .steps = 25}); /* less than half a turn: the ends do not pass */
  }
}

static int32_t add_spring(const char *law, double stiffness, double rest_length) {
  const double q[] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 1);
  owned_options *options =
      options_with("springs", "law=%s stiffness=%.17g rest_length=%.17g", law, stiffness, rest_length);
  const int32_t status = hooke_system_add_springs(system, NULL, 1, ends, options);
  return status;
}

TEST(test_refused) {
  const struct {
    const char *name, *law;
    double stiffness, rest_length;
    int32_t status;
  } springs[] = {
      {"rest length 0, strain law", "strain", 1.0, 0.0, HOOKE_BAD_VALUE},
      {"rest length 1e-300 m, 1e6 N, strain law", "strain", 1e6, 1e-300, HOOKE_BAD_VALUE},
      {"rest length 1e-300 m, 1e-300 N, strain law", "strain", 1e-300, 1e-300, HOOKE_OK},
      {"rest length 1e300 m, length law", "length", 1.0, 1e300, HOOKE_OK},
  };
  for (size_t k = 0; k < sizeof springs / sizeof springs[0]; k++) {
    check_status(add_spring(springs[k].law, springs[k].stiffness, springs[k].rest_length), springs[k].status);
    if (springs[k].status == HOOKE_OK) continue;
    check_message("rest length");
    check_message(springs[k].rest_length == 0.0 ? "needs" : "allowed");
    for (int64_t m = 0; m < hooke_method_count(); m++)
      extreme_note("lengths", springs[k].name, hooke_method_name(m), "bad value");
  }
}

/* ---- coincident ends, or nearly ---- */

struct pair {
  const char *name;
  double distance;
  int32_t coincident; /* the spring has no direction: no force, and it is counted */
  double rounding;    /* of the direction */
  int32_t may_fail;   /* so stiff across the spring that an implicit solver may give up */
};

/* Two free particles, `distance` apart, with a spring of 1 m between them: x = 1 - (1 - distance) cos(omega
 * t). */
static void check_pair(const struct pair *pair) {
  const double q[] = {0, 0, 0, pair->distance, 0, 0}, h = 0.01, steps = 100, d = pair->distance;
  const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 2.0, 0);
  small_springs(system, 1, ends, (struct springs){.stiffness = 1.0, .rest_length = 1.0});
  check_ok(hooke_system_commit(system));
  const double moved = pair->coincident ? 0.0 : 0.5 * (1.0 - d) * (1.0 - cos(h * steps));
  const double expected[] = {-moved, 0, 0, d + moved, 0, 0};
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1) continue;
    owned_outcome outcome;
    extreme_run(system, (struct extreme_run){.method = method, .step = h, .steps = (int64_t)steps}, &outcome);
    const double error = extreme_error(&outcome, expected, 1.0);
    /* a method of order 1 has an error of about h/2 of the way */
    const double high = pair->coincident ? 0.0 : 0.6 * h + pair->rounding;
    const char *complaint = extreme_not_right(&outcome, error, 0.0, high);
    if (pair->may_fail && outcome.status == HOOKE_SOLVER_FAILED) complaint = extreme_unsound(&outcome);
    extreme_demand("lengths", pair->name, method, complaint, &outcome);
    assert_int_equal(outcome.coincident, pair->coincident);
    extreme_record("lengths", pair->name, method, &outcome, error);
  }
}

TEST(test_coincident) {
  const struct pair pairs[] = {
      {"ends 0 m apart", 0.0, 1, 0.0, 0},          {"ends 1e-300 m apart", 1e-300, 1, 0.0, 0},
      {"ends 1e-162 m apart", 1e-162, 1, 0.0, 0},  {"ends 2e-162 m apart", 2e-162, 0, 0.2, 1},
      {"ends 1e-160 m apart", 1e-160, 0, 1e-4, 1}, {"ends 1e-153 m apart", 1e-153, 0, 0.0, 1},
      {"ends 1e-12 m apart", 1e-12, 0, 0.0, 0},
  };
  for (size_t k = 0; k < sizeof pairs / sizeof pairs[0]; k++)
    check_pair(&pairs[k]);
}

/* The length of the force, kappa l0, shows the accuracy of the direction: below 1.5e-154 m the square of a
 * distance is subnormal and loses digits, below 1.6e-162 m it is 0. */
TEST(test_direction) {
  const struct {
    double distance, low, high; /* bounds of |force - 1| */
  } at[] = {{1e-12, 0.0, 1e-11}, {1e-100, 0.0, 4e-16}, {1.6e-154, 0.0, 4e-16}, {1e-158, 1e-12, 1e-6},
            {2e-162, 0.01, 0.5}, {1.5e-162, 1.0, 1.0}, {1e-310, 1.0, 1.0}};
  for (size_t k = 0; k < sizeof at / sizeof at[0]; k++) {
    const double q[] = {0, 0, 0, 0, at[k].distance, 0}, v[6] = {0};
    const int64_t ends[] = {0, 1};
    double force[6];
    owned_system *system = small_system(2, q, NULL, 1.0, 0);
    small_springs(system, 1, ends, (struct springs){.stiffness = 1.0, .rest_length = 1.0});
    check_ok(hooke_system_commit(system));
    check_ok(hooke_system_force(system, 0.0, q, v, force));
    check_between(fabs(force[4] - 1.0), at[k].low, at[k].high);
    assert_true(force[1] == -force[4] && force[0] == 0.0 && force[5] == 0.0);
    assert_int_equal(hooke_system_coincident_springs(system, q), at[k].low == 1.0);
  }
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
