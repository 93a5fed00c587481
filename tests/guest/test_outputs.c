/* After a failure the object that a function should have created is NULL, whatever was there before; but for
 * hooke_system_create() and hooke_options_copy(), which fail without memory alone. tests/abi/test_symbols.py
 * holds this list against the headers. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <stdio.h>
#include <string.h>

static char left_over; /* its address stands for an old object */

#define FAILS(type, function, ...)                                                                           \
  do {                                                                                                       \
    type *object = (type *)(void *)&left_over;                                                               \
    const int32_t status = function(__VA_ARGS__, &object);                                                   \
    if (status == HOOKE_OK) check_failed("%s() did not fail", #function);                                    \
    if (object != NULL) check_failed("%s() left its output as it was: %s", #function, hooke_last_error());   \
  } while (0)

static int32_t stay(int64_t size, double t, const double *x, double *rate, void *ctx) {
  (void)t, (void)x, (void)ctx;
  memset(rate, 0, (size_t)size * sizeof *rate);
  return 0;
}

static int32_t fall(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)v;
  return stay(n, t, q, force, ctx);
}

struct objects {
  hooke_system *open, *system;
  hooke_options *wrong;
  hooke_integrator *integrator;
  hooke_state *state;
};

static void check_models(const struct objects *o) {
  FAILS(hooke_options, hooke_options_create, "no such table");
  FAILS(hooke_options, hooke_options_create, NULL);
  FAILS(hooke_system, hooke_system_with_force, o->open, fall, NULL, NULL);
  FAILS(hooke_state, hooke_state_create, o->open);
  FAILS(hooke_state, hooke_state_create_first_order, -1);
  FAILS(hooke_state, hooke_state_create_second_order, -1);
  FAILS(hooke_integrator, hooke_integrator_create, o->open, NULL);
  FAILS(hooke_integrator, hooke_integrator_create, o->system, o->wrong);
  FAILS(hooke_integrator, hooke_integrator_create_first_order, -1, stay, NULL, NULL);
  FAILS(hooke_integrator, hooke_integrator_create_first_order, 3, stay, NULL, o->wrong);
  FAILS(hooke_integrator, hooke_integrator_create_second_order, -1, fall, NULL, NULL, 0, NULL, NULL);
}

static void check_measurements(const struct objects *o) {
  hooke_measurement *cost;
  FAILS(hooke_measurement, hooke_measurement_create, "no such kind", o->system, NULL, NULL);
  FAILS(hooke_measurement, hooke_measurement_create, "limit", o->open, NULL, NULL);
  FAILS(hooke_measurement, hooke_measurement_create, "limit", o->system, NULL, o->wrong);
  FAILS(hooke_measurement, hooke_why_create, o->integrator, NULL);
  FAILS(hooke_measurement, hooke_why_create_kept, o->system, o->wrong, o->state, o->state, NULL);
  check_ok(hooke_measurement_create("cost", o->system, NULL, NULL, &cost));
  FAILS(hooke_comparison_file, hooke_comparison_file_create, "none/file.h5", cost);
  hooke_measurement_destroy(cost);
}

static void check_files(const struct objects *o) {
  FAILS(hooke_scene, hooke_scene_load, "none.json", NULL);
  FAILS(hooke_scene, hooke_scene_parse, "{", 1, "a scene", NULL, NULL);
  FAILS(hooke_scene, hooke_scene_of_system, o->system, NULL, o->wrong, NULL, NULL);
  FAILS(hooke_trajectory, hooke_trajectory_create, "none/file.h5", o->system, o->integrator, NULL);
  FAILS(hooke_trajectory, hooke_trajectory_resume, "none/file.h5", o->system, o->integrator, o->state);
  FAILS(hooke_record, hooke_record_open, "none.h5");
  FAILS(hooke_measurement, hooke_verify_create, "none.h5", NULL, NULL);
#if HOOKE_HAVE_HDF5
  hooke_trajectory *trajectory;
  hooke_record *record;
  check_ok(hooke_trajectory_create("outputs.h5", o->system, o->integrator, NULL, &trajectory));
  check_ok(hooke_trajectory_write(trajectory, 0, o->state));
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
  check_ok(hooke_record_open("outputs.h5", &record));
  FAILS(hooke_measurement, hooke_view_create, record, o->wrong);
  hooke_record_close(record);
  remove("outputs.h5");
#endif
}

TEST(outputs_are_null_after_a_failure) {
  struct objects o = {.system = small_oscillator(100.0)};
  const struct run run = {.method = "forward-euler", .step = 0.5, .duration = 5.0};
  check_ok(hooke_system_create(&o.open));
  check_ok(hooke_options_create("springs", &o.wrong));
  o.integrator = start_run(o.system, run);
  o.state = start_state(o.system);
  check_models(&o);
  check_measurements(&o);
  check_files(&o);
  hooke_state_destroy(o.state);
  hooke_integrator_destroy(o.integrator);
  hooke_options_destroy(o.wrong);
  hooke_system_destroy(o.open);
  hooke_system_destroy(o.system);
}
