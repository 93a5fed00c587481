/* Free fall with drag, from none to a million times what a step resolves. With z = h c/m and the terminal
 * velocity w = g m/c: v = w + (v0 - w) A^n, where A is what the method makes of exp(-z). Dampers that are
 * split off make another w of it: v' = B (B v + h g) with A = B^2. */
#include "check.h"
#include "extreme.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double FALL = 10.0;

/* A of a method; 0 and `known` 0 for a method that is not listed here. */
static long double factor(const char *method, long double z, int *known) {
  *known = 1;
  if (strcmp(method, "forward-euler") == 0 || strcmp(method, "symplectic-euler") == 0) return 1.0L - z;
  if (strcmp(method, "verlet") == 0) return (1.0L - z / 2.0L) / (1.0L + z / 2.0L);
  if (strcmp(method, "shardlow") == 0)
    return 1.0L / ((1.0L + z / 2.0L + z * z / 8.0L) * (1.0L + z / 2.0L + z * z / 8.0L));
  if (strcmp(method, "backward-euler") == 0) return 1.0L / (1.0L + z);
  if (strcmp(method, "implicit-midpoint") == 0) return (1.0L - z / 2.0L) / (1.0L + z / 2.0L);
  if (strcmp(method, "tr-bdf2") == 0) {
    const long double root = sqrtl(2.0L), a = (2.0L - root) / 2.0L * z, d = (root - 1.0L) / 2.0L;
    return ((1.0L + d) * (1.0L - a) / (1.0L + a) - d) / (1.0L + a);
  }
  if (strcmp(method, "heun") == 0) return 1.0L - z * (1.0L - z / 2.0L);
  if (strcmp(method, "rk4") == 0) return 1.0L - z * (1.0L - z / 2.0L * (1.0L - z / 3.0L * (1.0L - z / 4.0L)));
  *known = 0;
  return 0.0L;
}

static void check_method(const hooke_system *system, const char *name, const char *method, double z, double h,
                         double drag, double mass) {
  const int64_t steps = 100;
  int known;
  const long double a = factor(method, (long double)z, &known), end = expl(-(long double)z * steps);
  const long double terminal = drag > 0.0 ? -FALL * mass / (long double)drag : 0.0L;
  owned_outcome outcome;
  extreme_run(system,
              (struct extreme_run){.method = method, .step = h, .steps = steps, .rtol = 1e-9, .atol = 1e-12},
              &outcome);
  const long double right = drag > 0.0 ? terminal * (1.0L - end) : -FALL * (long double)(h * (double)steps);
  const double error = (double)fabsl((outcome.v[1] - right) / right);
  const char *complaint;
  if (known && fabsl(a) > 1.0L) {
    complaint = extreme_not_ended(&outcome, HOOKE_DIVERGED, "diverged");
  } else if (known) {
    /* the midpoint rule has the sum of roundings of `terminal`, of which little may be left */
    const double rounding = strcmp(method, "implicit-midpoint") == 0 ? 1e-16 * (double)steps : 0.0;
    const long double own =
        strcmp(method, "shardlow") == 0 ? -FALL * (long double)h * sqrtl(a) / (1.0L - a) : terminal;
    const long double there = drag > 0.0 ? own * (1.0L - powl(a, (long double)steps)) : right;
    complaint = extreme_not_right(&outcome, (double)fabsl((outcome.v[1] - there) / there), 0.0,
                                  1e-12 + (drag > 0.0 ? rounding * (double)fabsl(terminal / there) : 0.0));
  } else if (outcome.status == HOOKE_STEP_LIMIT && z > 1e3) {
    complaint = extreme_unsound(&outcome);
  } else {
    complaint = extreme_not_right(&outcome, error, 0.0, 1e-6);
  }
  extreme_demand("falls", name, method, complaint, &outcome);
  extreme_record("falls", name, method, &outcome, error);
}

TEST(test_fall) {
  const double resolved[] = {0.0, 1e-6, 0.1, 1.0, 10.0, 1e6};
  const double gravity[] = {0, -FALL, 0}, q[] = {0, 0, 0}, h = 0.25, mass = 2.0;
  for (int k = 0; k < 6; k++) {
    const double drag = resolved[k] * mass / h;
    owned_system *system = small_system(1, q, NULL, mass, 0);
    check_ok(hooke_system_set_gravity(system, gravity));
    check_ok(hooke_system_set_drag(system, drag));
    check_ok(hooke_system_commit(system));
    char name[64];
    snprintf(name, sizeof name, "drag c/m of %g/step", resolved[k]);
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      if (hooke_method_is_built(method) == 1) check_method(system, name, method, resolved[k], h, drag, mass);
    }
  }
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
