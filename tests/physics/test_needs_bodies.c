/* Needs and rigid bodies: a stiff plate that hangs on soft springs is offered as a body, with the error
 * that a run of the scene made anew has; one that bends by more than the wanted error is not. */
#include "check.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 4, PLATE = 2 * SIDE * SIDE, ALL = PLATE + 4, MOST_FRAMES = 64 };
static const double WANT = 2e-3, DURATION = 1.0, EVERY = 0.02;

static hooke_options *plate_options(double stiffness) {
  hooke_options *options =
      options_with("lattice", "edges=0.4,0,0,0,0.04,0,0,0,0.4 size=%d,2,%d mass=1", SIDE, SIDE);
  for (int k = 0; k < 2; k++) {
    const char *const stiff[] = {"structural.stiffness", "shear.stiffness"};
    const char *const damped[] = {"structural.damping", "shear.damping"};
    check_ok(hooke_options_set_number(options, stiff[k], stiffness));
    check_ok(hooke_options_set_number(options, damped[k], 1e-4 * stiffness));
  }
  return options;
}

/* Let go where its four soft springs are slack. */
static hooke_system *hanging_plate(double stiffness) {
  const double corner[] = {0, 0.5, 0, 0.4, 0.5, 0, 0, 0.5, 0.4, 0.4, 0.5, 0.4}, mass = 1.0;
  owned_options *plate = plate_options(stiffness), *soft = NULL;
  int64_t first, pinned[4], ends[8];
  hooke_system *system = new_system();
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -9.81, 0.0}));
  check_ok(hooke_system_add_part(system, "lattice", "plate", plate, NULL, NULL));
  check_ok(hooke_system_add_particles(system, 4, corner, NULL, 1, &mass, &first));
  for (int k = 0; k < 4; k++) {
    pinned[k] = ends[2 * k] = first + k;
    ends[2 * k + 1] = SIDE + (k % 2) * (SIDE - 1) + (k / 2) * (PLATE - 2 * SIDE); /* on top */
  }
  check_ok(hooke_system_pin(system, 4, pinned));
  soft = options_with("springs", "stiffness=20 damping=0.3");
  check_ok(hooke_system_add_springs(system, "hangers", 4, ends, soft));
  check_ok(hooke_system_commit(system));
  return system;
}

static hooke_measurement *needs_of(const hooke_system *system, const char *method) {
  owned_options *options,
      *run = run_options((struct run){.method = method, .duration = DURATION, .every = EVERY});
  hooke_measurement *needs = NULL;
  options = options_with("needs", "want=%.17g", WANT);
  check_ok(hooke_measurement_create("needs", system, run, options, &needs));
  check_ok(hooke_measurement_run(needs, NULL));
  return needs;
}

static int64_t body_row(const hooke_measurement *needs) {
  int64_t row = 0;
  while (row < hooke_measurement_row_count(needs, "rows") &&
         strcmp(hooke_measurement_text(needs, "rows", row, "kind"), "rigid") != 0)
    row++;
  assert_string_equal(hooke_measurement_text(needs, "rows", row, "without"), "deformation of plate");
  return row;
}

/* ---- runs made apart ---- */

struct path {
  const hooke_measurement *needs; /* of the lean system; NULL: positions are those of the full one */
  int64_t count;
  double q[MOST_FRAMES][3 * ALL];
};

static int32_t keep_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct path *path = ctx;
  const double *q = hooke_state_position(state);
  (void)step;
  assert_true(path->count < MOST_FRAMES);
  double *row = path->q[path->count++];
  if (path->needs)
    check_ok(hooke_needs_lean_position(path->needs, q, row));
  else
    memcpy(row, q, sizeof path->q[0]);
  return 0;
}

static struct path *path_of(const hooke_system *system, const hooke_options *options,
                            const hooke_measurement *needs) {
  struct path *path = new_block(1, sizeof *path);
  owned_integrator *integrator;
  owned_state *state = start_state(system);
  path->needs = needs;
  check_ok(hooke_integrator_create(system, options, &integrator));
  check_ok(hooke_integrator_on_frame(integrator, keep_frame, path));
  check_ok(hooke_integrator_run(integrator, state));
  return path;
}

/* Largest distance of a particle of the plate, which all that is free belongs to, at any frame. */
static double apart(const struct path *a, const struct path *b) {
  double most = 0.0;
  assert_int_equal(a->count, b->count);
  for (int64_t f = 0; f < a->count; f++) {
    for (int k = 0; k < 3 * PLATE; k += 3) {
      double square = 0.0;
      for (int c = 0; c < 3; c++)
        square += (a->q[f][k + c] - b->q[f][k + c]) * (a->q[f][k + c] - b->q[f][k + c]);
      most = fmax(most, sqrt(square));
    }
  }
  return most;
}

/* ---- the tests ---- */

static double of_run(const hooke_measurement *needs, const char *table, const char *column) {
  return hooke_measurement_number(needs, table, 0, column);
}

TEST(a_stiff_plate_is_offered_as_a_body) {
  const char *const methods[] = {"verlet", "symplectic-euler"};
  for (int m = 0; m < 2; m++) {
    if (left_out(m, 2)) continue;
    owned_system *system = hanging_plate(2e4);
    owned_measurement *needs = needs_of(system, methods[m]);
    const int64_t row = body_row(needs);
    assert_true(hooke_measurement_number(needs, "rows", row, "needed") == 0.0);
    assert_true(hooke_measurement_number(needs, "rows", row, "left_out") == 1.0);
    assert_int_equal(hooke_system_count(hooke_needs_lean(needs), "bodies"), 1);
    check_between(of_run(needs, "cheapest", "steps") / of_run(needs, "lean", "steps"), 10.0, 1e5);
    check_between(of_run(needs, "lean", "step") / of_run(needs, "cheapest", "step"), 10.0, 1e5);
    check_between(of_run(needs, "lean", "times_less"), 5.0, 1e6);
    assert_non_null(
        strstr(hooke_measurement_text(needs, "lean", 0, "note"), "plate: rigid (\"rigid\": true); "));

    owned_options *fine = run_options((struct run){.method = methods[m],
                                                   .step = of_run(needs, "full", "step") / 8,
                                                   .duration = DURATION,
                                                   .every = EVERY});
    struct path *full = path_of(system, fine, NULL);
    struct path *lean = path_of(hooke_needs_lean(needs), hooke_needs_lean_run(needs), needs);
    const double error = apart(full, lean), told = of_run(needs, "lean", "error");
    check_between(told, error * (1.0 - 1e-3), error + 2.0 * of_run(needs, "full", "own_error") + 1e-6);
    check_between(told, 1e-5, WANT);
    free(full);
    free(lean);
  }
}

TEST(a_plate_that_bends_is_not) {
  owned_system *system = hanging_plate(100.0);
  owned_measurement *needs = needs_of(system, "verlet");
  const int64_t row = body_row(needs);
  check_between(hooke_measurement_number(needs, "rows", row, "error"), 2.0 * WANT, 1.0);
  assert_true(hooke_measurement_number(needs, "rows", row, "needed") == 1.0);
  assert_true(hooke_measurement_number(needs, "rows", row, "left_out") == 0.0);
  assert_int_equal(hooke_system_count(hooke_needs_lean(needs), "bodies"), 0);
  assert_null(strstr(hooke_measurement_text(needs, "lean", 0, "note"), "rigid"));
}
