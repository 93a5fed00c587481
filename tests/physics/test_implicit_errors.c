/* Errors of implicit methods on cloths fall with the step, in both forms, below the coarsest third of a
 * ladder; over the time up to which references agree. */
#include "check.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const char METHODS[] = "backward-euler,tr-bdf2,implicit-midpoint";
static const double DURATION = 0.02, EVERY = 0.01;
static const double steps[] = {1e-2, 5e-3, 2.5e-3, 1.25e-3, 6.25e-4, 3.125e-4};
enum { MOST_STEPS = sizeof steps / sizeof steps[0] };

static hooke_measurement *ladder(const hooke_system *system, const char *form, int64_t count) {
  hooke_measurement *study = NULL;
  /* linear equations of one iteration are solved to a fixed residual, which no step makes smaller */
  const double tolerance = strcmp(form, "converged") == 0 ? BY_DEFAULT : 1e-4;
  owned_options *run = run_options((struct run){
                    .newton = form, .newton_tolerance = tolerance, .duration = DURATION, .every = EVERY}),
                *options;
  options = options_with("study", "methods=%s", METHODS);
  check_ok(hooke_options_set_numbers(options, "steps", count, steps));
  const int32_t status = hooke_measurement_create("study", system, run, options, &study);
  if (status == HOOKE_NOT_BUILT) skip();
  check_status(status, HOOKE_OK);
  check_ok(hooke_measurement_run(study, NULL));
  return study;
}

static void check_ladder(const hooke_measurement *study, const char *form, int64_t count) {
  const int64_t rows = hooke_measurement_row_count(study, "rows");
  assert_true(hooke_measurement_number(study, "reference", 0, "trusted_until") >= EVERY);
  assert_int_equal(rows, 3 * count);
  for (int64_t k = 0; k < rows; k++) {
    const double error = hooke_measurement_number(study, "rows", k, "error");
    const char *method = hooke_measurement_text(study, "rows", k, "method");
    if (!isfinite(error)) check_failed("%s, %s: no error at %g s", method, form, steps[k % count]);
    if (k % count <= (count + 2) / 3 || hooke_measurement_number(study, "rows", k, "near_floor") == 1.0)
      continue;
    const double coarser = hooke_measurement_number(study, "rows", k - 1, "error");
    if (!(error < coarser))
      check_failed("%s, %s: %g m at %g s, and %g m at the step before", method, form, error, steps[k % count],
                   coarser);
  }
}

static void check_cloth(int64_t side, double stiffness, double damping, const char *form, int64_t count) {
  owned_system *system = small_cloth(side, stiffness, damping);
  owned_measurement *study = ladder(system, form, count);
  check_ladder(study, form, count);
}

TEST(errors_fall_on_cloths_of_20) {
  check_cloth(20, 1e3, 0.0, "converged", MOST_STEPS);
  if (HOOKE_SANITIZED) return;
  check_cloth(20, 1e3, 0.0, "one-iteration", MOST_STEPS);
  check_cloth(20, 1e4, 20.0, "converged", MOST_STEPS);
  check_cloth(20, 1e4, 20.0, "one-iteration", MOST_STEPS);
}

TEST(errors_fall_on_cloths_of_41) {
  if (HOOKE_SANITIZED) skip(); /* the code is that of the other, which is shorter */
  check_cloth(41, 1e3, 0.5, "converged", MOST_STEPS - 2);
}
