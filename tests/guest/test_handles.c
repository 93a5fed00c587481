/* Every public function refuses each of its handles if it is NULL, unless that is allowed, and in builds that
 * check handles if it was destroyed, if it is of another type, and if it is no address of an object. The list
 * of calls is made from the headers. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Result of a call: 1 if the refusal was returned. */
#define NUMBER(value, call)       ((double)(call) == (double)(value))
#define NOT_A_NUMBER(value, call) (isnan(call))
#define NULL_POINTER(value, call) ((call) == NULL)
#define NOTHING(value, call)      ((call), 1)

static void *bad;
static char no_object[256];

/* ---- one object of each type, for the other arguments of a call ---- */

struct alive {
  hooke_system *system;
  hooke_options *options;
  hooke_state *state;
  hooke_integrator *integrator;
  hooke_measurement *measurement;
  hooke_trajectory *trajectory;
  hooke_record *record;
};
static struct alive alive;
static const char path[] = "guest_handles.h5";

static void bring_to_life(void) {
  alive.system = small_oscillator(100.0);
  alive.state = start_state(alive.system);
  const struct run run = {.method = "forward-euler", .step = 0.5, .duration = 500.0};
  alive.options = run_options(run);
  alive.integrator = start_run(alive.system, run);
  check_status(hooke_integrator_run(alive.integrator, alive.state), HOOKE_DIVERGED);
  check_ok(hooke_measurement_create("cost", alive.system, NULL, NULL, &alive.measurement));
#if HOOKE_HAVE_HDF5
  check_ok(hooke_trajectory_create(path, alive.system, alive.integrator, NULL, &alive.trajectory));
  check_ok(hooke_trajectory_write(alive.trajectory, 0, alive.state));
  check_ok(hooke_trajectory_close(alive.trajectory, HOOKE_OK));
  check_ok(hooke_record_open(path, &alive.record));
  check_ok(hooke_trajectory_create(path, alive.system, alive.integrator, NULL, &alive.trajectory));
#endif
}

static void end_life(void) {
  hooke_record_close(alive.record);
  hooke_trajectory_close(alive.trajectory, HOOKE_OK);
  remove(path);
  hooke_measurement_destroy(alive.measurement);
  hooke_integrator_destroy(alive.integrator);
  hooke_state_destroy(alive.state);
  hooke_options_destroy(alive.options);
  hooke_system_destroy(alive.system);
}

/* NULL if this build cannot create one. */
static void *good(const char *type) {
  const struct {
    const char *type;
    void *object;
  } objects[] = {{"hooke_system", alive.system},
                 {"hooke_options", alive.options},
                 {"hooke_state", alive.state},
                 {"hooke_integrator", alive.integrator},
                 {"hooke_measurement", alive.measurement},
                 {"hooke_trajectory", alive.trajectory},
                 {"hooke_record", alive.record}};
  for (size_t k = 0; k < sizeof objects / sizeof objects[0]; k++)
    if (strcmp(type, objects[k].type) == 0) return objects[k].object;
  check_failed("no %s to hand", type);
  return NULL;
}
#define GOOD(type) ((type *)good(#type))
#define BAD(type)  ((type *)bad)

enum badness { DESTROYED, OTHER_TYPE, NO_OBJECT, ABSENT };

static void make_bad(enum badness how, const char *type) {
  hooke_options *other = NULL;
  switch (how) {
  case DESTROYED:
    if (strcmp(type, "hooke_system") == 0) {
      hooke_system *gone;
      check_ok(hooke_system_create(&gone));
      hooke_system_destroy(gone);
      bad = gone;
    } else {
      check_ok(hooke_options_create("run", &other));
      hooke_options_destroy(other);
      bad = other;
    }
    return;
  case OTHER_TYPE:
    bad = strcmp(type, "hooke_options") == 0 ? (void *)alive.system : (void *)alive.options;
    return;
  case NO_OBJECT:
    bad = no_object + 64;
    return;
  default:
    bad = NULL;
  }
}

static void check_refused(int refused, const char *function, const char *argument, const char *type) {
  const char *message = hooke_last_error();
  const size_t length = strlen(argument);
  if (!refused) check_failed("%s() took a bad %s", function, argument);
  if (strncmp(message, argument, length) != 0 || message[length] != ':' || strstr(message, type) == NULL ||
      strstr(message, function) == NULL)
    check_failed("%s() with a bad %s says: %s", function, argument, message);
}

static int64_t call_all(enum badness how) {
  int64_t calls = 0;
#define BAD_CALL(kind, value, type, may_be_null, first, argument, function, arguments)                       \
  if ((how != ABSENT || !(may_be_null)) && good(first)) {                                                    \
    make_bad(how, #type);                                                                                    \
    hooke_options_create("no such kind", &(hooke_options *){NULL}); /* another message */                    \
    check_refused(kind(value, function arguments), #function, #argument, #type);                             \
    calls++;                                                                                                 \
  }
#include "handle_calls.inc"
  return calls;
}

TEST(test_every_function_refuses) {
  bring_to_life();
  for (enum badness how = HOOKE_CHECK_HANDLES ? DESTROYED : ABSENT; how <= ABSENT; how++)
    assert_true(call_all(how) > 120);
  end_life();
}

/* Destroyed objects, each in a call of its own. */
#if HOOKE_CHECK_HANDLES
TEST(test_destroyed_is_refused) {
  bring_to_life();
  const struct alive gone = alive;
  end_life();
  double *position = hooke_state_position(gone.state);
  assert_null(position);
  check_message("was destroyed");
  assert_true(hooke_integrator_count(gone.integrator, "frames") == -1);
  assert_true(isnan(hooke_measurement_number(gone.measurement, "cost", 0, "step")));
  assert_true(hooke_options_is_set(gone.options, "step") == 0);
  assert_true(hooke_system_particle_count(gone.system) == -1);
  hooke_options *options = NULL;
  check_status(hooke_integrator_create(gone.system, NULL, &(hooke_integrator *){NULL}), HOOKE_BAD_CALL);
  check_ok(hooke_options_create("run", &options));
  hooke_options_destroy(options);
  hooke_options_destroy(options); /* nothing happens */
  check_message("options: is no hooke_options");
  assert_true(hooke_measurement_row_count(gone.measurement, "rows") == -1);
#if HOOKE_HAVE_HDF5
  check_status(hooke_trajectory_close(gone.trajectory, HOOKE_OK), HOOKE_BAD_CALL);
  assert_true(hooke_record_count(gone.record, "frames") == -1);
#endif
}

#else

TEST(test_destroyed_is_refused) {
  skip(); /* this build does not check handles */
}

#endif
