/* A study from C: what error does each method buy for what time on this rope, which one is the cheapest for a
 * tenth of a millimetre, and a run with it. */
#include <hooke.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check(int32_t status) {
  if (status == HOOKE_OK) return;
  fprintf(stderr, "%s: %s\n", hooke_status_name(status), hooke_last_error());
  exit(1);
}

static hooke_system *rope_of(int segments) {
  hooke_system *system;
  hooke_options *rope;
  check(hooke_system_create(&system));
  check(hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  check(hooke_options_create("rope", &rope));
  check(hooke_options_set_text(rope, "from", "0,0,0"));
  check(hooke_options_set_text(rope, "to", "1,0,0")); /* m */
  check(hooke_options_set_number(rope, "segments", segments));
  check(hooke_options_set_number(rope, "mass", 0.25)); /* kg */
  check(hooke_options_set_text(rope, "pinned", "start"));
  check(hooke_options_set_number(rope, "stretch.stiffness", 200)); /* N */
  check(hooke_options_set_number(rope, "stretch.damping", 0.05));  /* N s */
  check(hooke_system_add_part(system, "rope", "rope", rope, NULL, NULL));
  check(hooke_system_commit(system));
  hooke_options_destroy(rope);
  return system;
}

static void print_rows(const hooke_measurement *study) {
  printf("%-18s %10s %10s %12s %10s\n", "method", "step [s]", "rtol", "error [m]", "time [s]");
  for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++)
    printf("%-18s %10.3g %10.3g %12.3g %10.3g\n", hooke_measurement_text(study, "rows", k, "method"),
           hooke_measurement_number(study, "rows", k, "step"),
           hooke_measurement_number(study, "rows", k, "rtol"),
           hooke_measurement_number(study, "rows", k, "error"),
           hooke_measurement_number(study, "rows", k, "wall_seconds"));
}

static void run_recommended(const hooke_system *system, const hooke_measurement *study, hooke_options *run) {
  hooke_integrator *integrator;
  hooke_state *state;
  const double step = hooke_measurement_number(study, "recommendation", 0, "step");
  check(hooke_options_set_text(run, "method", hooke_measurement_text(study, "recommendation", 0, "method")));
  if (!isnan(step)) {
    check(hooke_options_set_number(run, "step", step));
  } else {
    check(
        hooke_options_set_number(run, "rtol", hooke_measurement_number(study, "recommendation", 0, "rtol")));
    check(
        hooke_options_set_number(run, "atol", hooke_measurement_number(study, "recommendation", 0, "atol")));
  }
  check(hooke_integrator_create(system, run, &integrator));
  check(hooke_state_create(system, &state));
  check(hooke_integrator_run(integrator, state));
  printf("run with it: %lld steps in %.3g s\n", (long long)hooke_integrator_count(integrator, "steps"),
         hooke_integrator_number(integrator, "wall_seconds"));
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
}

int main(void) {
  hooke_system *system = rope_of(12);
  hooke_options *run, *options;
  hooke_measurement *study;
  check(hooke_options_create("run", &run));
  check(hooke_options_set_number(run, "duration", 0.25));
  check(hooke_options_create("study", &options));
  check(hooke_options_set_text(options, "methods", "symplectic-euler,verlet,rk4,cvode-adams"));
  check(hooke_options_set_number(options, "want", 1e-4)); /* m */
  check(hooke_measurement_create("study", system, run, options, &study));
  check(hooke_measurement_run(study, NULL));

  printf("reference: %s, checked by %s: they agree within %.1e m\n",
         hooke_measurement_text(study, "reference", 0, "method"),
         hooke_measurement_text(study, "reference", 0, "check"),
         hooke_measurement_number(study, "reference", 0, "agreement"));
  print_rows(study);
  printf("order of verlet: %.2f\n",
         hooke_measurement_number(study, "orders",
                                  hooke_measurement_find(study, "orders", "method", "verlet"), "order"));
  printf("for 0.1 mm: %s, %.2g m in %.2g s\n", hooke_measurement_text(study, "recommendation", 0, "method"),
         hooke_measurement_number(study, "recommendation", 0, "error"),
         hooke_measurement_number(study, "recommendation", 0, "wall_seconds"));
  run_recommended(system, study, run);

  hooke_measurement_destroy(study);
  hooke_options_destroy(options);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
  return 0;
}
