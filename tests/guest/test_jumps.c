/* A callback may leave any call by longjmp(): the integrator, the state and the system can then be destroyed,
 * and run again they give the same bits as without the jump, with every method, with threads, and with a
 * queued frame. */
#include "check.h"
#include "held.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <setjmp.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- jumping from one call of any callback ---- */

static struct {
  jmp_buf back;
  int64_t calls; /* until the jump; 0: no jump */
} jump;

static void count_call(void) {
  if (jump.calls > 0 && --jump.calls == 0) longjmp(jump.back, 1);
}

static int32_t pull(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t, (void)ctx;
  count_call();
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] -= 0.5 * q[k] + 0.01 * v[k];
  return 0;
}

static int32_t product(int64_t n, double t, const double *q, const double *v, const double *dq,
                       const double *dv, double *out, void *ctx) {
  (void)t, (void)q, (void)v, (void)ctx;
  count_call();
  for (int64_t k = 0; k < 3 * n; k++)
    out[k] -= 0.5 * dq[k] + 0.01 * dv[k];
  return 0;
}

static int32_t shake(int64_t count, double t, double *q, double *v, void *ctx) {
  (void)count, (void)ctx;
  count_call();
  q[0] = 0.1 * t * t;
  q[1] = q[2] = v[1] = v[2] = 0.0;
  v[0] = 0.2 * t;
  return 0;
}

static int32_t watch(int64_t step, const hooke_state *state, void *ctx) {
  (void)step;
  count_call();
  return ctx ? hooke_trajectory_write(ctx, step, state) : 0;
}

static int32_t warn(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  (void)kind, (void)sentence, (void)t, (void)limit, (void)spring, (void)particle, (void)ctx;
  count_call();
  return 0;
}

static int32_t progress(double done, const char *what, void *ctx) {
  (void)done, (void)what, (void)ctx;
  count_call();
  return 0;
}

/* ---- a rope with every kind of callback ---- */

/* LARGE: a frame is written by a thread; CREWED: enough springs for two threads. */
enum { SMALL = 6, LARGE = 1500, CREWED = 17000, SHARE = HOOKE_SANITIZED ? 3 : 1 };
/* An iterative solver calls many times as often as a direct one. */
enum { OFTEN = HOOKE_HAVE_CHOLMOD ? 1 : 150 };

static hooke_system *make_rope(int64_t links) {
  double *q = new_doubles(3 * (links + 1));
  int64_t *ends = new_block(2 * links, sizeof *ends);
  for (int64_t k = 0; k < links; k++) {
    q[3 * k + 3] = (double)(k + 1) / (double)links;
    ends[2 * k] = k;
    ends[2 * k + 1] = k + 1;
  }
  const int64_t driven = 0;
  hooke_system *system = small_system(links + 1, q, NULL, 1.0, 0);
  small_springs(system, links, ends,
                (struct springs){.stiffness = 2.0, .damping = 0.01, .rest_length = -1.0});
  check_ok(hooke_system_set_force(system, pull, product, NULL));
  check_ok(hooke_system_drive_callback(system, 1, &driven, shake, NULL));
  check_ok(hooke_system_commit(system));
  free(q);
  free(ends);
  return system;
}

static hooke_integrator *watched(const hooke_system *system, struct run run) {
  hooke_integrator *integrator = start_run(system, run);
  check_ok(hooke_integrator_on_frame(integrator, watch, NULL));
  check_ok(hooke_integrator_on_step(integrator, 2, watch, NULL));
  check_ok(hooke_integrator_on_warning(integrator, warn, NULL));
  return integrator;
}

/* Runs, and jumps from call `at` if there is one. 1 if it jumped. */
static int run_until(hooke_integrator *integrator, hooke_state *state, int64_t at) {
  jump.calls = at;
  if (setjmp(jump.back) != 0) return 1;
  const int32_t status = hooke_integrator_run(integrator, state);
  jump.calls = 0;
  check_status(status, HOOKE_OK);
  return 0;
}

static void check_same_state(hooke_state *state, hooke_state *expected) {
  const int64_t size = hooke_state_size(state);
  check_close(hooke_state_time(state), hooke_state_time(expected), 0.0);
  check_same_bits(size, hooke_state_position(state), hooke_state_position(expected));
  check_same_bits(size, hooke_state_velocity(state), hooke_state_velocity(expected));
}

/* Checks the number of started threads, to which a sanitizer may add one; on one processor there are none. */
static void check_crew(int64_t before, int64_t started) {
  if (before < 0 || sysconf(_SC_NPROCESSORS_ONLN) < 2) return;
  check_between((double)(thread_count() - before), (double)started, (double)started + 1.0);
}

/* Every `stride`-th call of a run in turn. */
static int64_t jump_everywhere(const char *method, int64_t links, int32_t threads, int64_t stride) {
  const struct run run = {.method = method,
                          .step = 0.125,
                          .duration = links == CREWED ? 0.25 : 1.0,
                          .every = 0.25,
                          .rtol = 1e-4,
                          .atol = 1e-4,
                          .threads = threads};
  hooke_system *system = make_rope(links);
  hooke_state *start = start_state(system), *expected = start_state(system), *state = start_state(system);
  const int64_t alone = thread_count();
  hooke_integrator *calm = watched(system, run), *again = watched(system, run);
  if (links == CREWED) check_crew(alone, 2 * (threads - 1));
  assert_int_equal(run_until(calm, expected, 0), 0);
  int64_t at = 1;
  for (;; at += stride + at / 4) { /* sparser towards the end */
    hooke_integrator *integrator = watched(system, run);
    check_ok(hooke_state_copy(start, state));
    const int jumped = run_until(integrator, state, at);
    hooke_integrator_destroy(integrator); /* in mid-run */
    if (!jumped) break;
    check_ok(hooke_state_copy(start, state));
    assert_int_equal(run_until(again, state, at), 1);
    check_ok(hooke_state_copy(start, state));
    assert_int_equal(run_until(again, state, 0), 0);
    check_same_state(state, expected);
  }
  hooke_integrator_destroy(again);
  hooke_integrator_destroy(calm);
  hooke_state_destroy(start);
  hooke_state_destroy(state);
  hooke_state_destroy(expected);
  hooke_system_destroy(system);
  return at;
}

TEST(test_every_call_of_every_method) {
  for (int64_t m = 0; m < hooke_method_count(); m++)
    if (hooke_method_is_built(hooke_method_name(m)))
      assert_true(jump_everywhere(hooke_method_name(m), SMALL, 1, HOOKE_SANITIZED ? 11 : 2) > 12);
}

TEST(test_with_a_crew) {
  const struct {
    const char *method;
    int64_t stride;
  } runs[] = {{"verlet", 7}, {"backward-euler", 41 * SHARE * OFTEN}, {"cvode-bdf", 61 * SHARE}};
  for (int64_t k = 0; k < 3; k++) {
    if (!hooke_method_is_built(runs[k].method) || left_out(k, 3)) continue;
    assert_true(jump_everywhere(runs[k].method, CREWED, 2, runs[k].stride) > runs[k].stride);
  }
}

/* ---- first-order problems ---- */

static int32_t decay(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)t, (void)ctx;
  count_call();
  for (int64_t k = 0; k < n; k++)
    rate[k] = -x[k];
  return 0;
}

TEST(test_rates) {
  const char *const methods[] = {"rk4", "cvode-adams"};
  for (int m = 0; m < 2; m++) {
    if (!hooke_method_is_built(methods[m])) continue;
    owned_state *state = NULL;
    check_ok(hooke_state_create_first_order(2, &state));
    hooke_integrator *integrator = start_first_order(
        2, decay, NULL,
        (struct run){.method = methods[m], .step = 0.125, .duration = 1.0, .rtol = 1e-6, .atol = 1e-6});
    double expected[2] = {0, 0};
    for (int64_t at = 0; at < 12; at++) {
      hooke_state_set_time(state, 0.0);
      hooke_state_position(state)[0] = hooke_state_position(state)[1] = 1.0;
      if (run_until(integrator, state, at)) continue;
      memcpy(expected, hooke_state_position(state), sizeof expected);
    }
    hooke_state_set_time(state, 0.0);
    hooke_state_position(state)[0] = hooke_state_position(state)[1] = 1.0;
    assert_int_equal(run_until(integrator, state, 0), 0);
    check_same_bits(2, hooke_state_position(state), expected);
    hooke_integrator_destroy(integrator);
  }
}

/* ---- with a queued frame ---- */

#if HOOKE_HAVE_HDF5

static const char path[] = "guest_jumps.h5";

TEST(test_while_frames_are_written) {
  hooke_system *system = make_rope(LARGE);
  hooke_state *state = start_state(system), *read = start_state(system);
  hooke_integrator *integrator = start_run(
      system, (struct run){.method = "verlet", .step = 0.125, .duration = 1.0, .every = 0.125, .threads = 2});
  hooke_trajectory *trajectory;
  check_ok(hooke_trajectory_create(path, system, integrator, NULL, &trajectory));
  check_ok(hooke_trajectory_write_behind(trajectory));
  check_ok(hooke_integrator_on_frame(integrator, watch, trajectory));
  /* drive, force and frame: some frames are written by then */
  assert_int_equal(run_until(integrator, state, 14), 1);
  hooke_integrator_destroy(integrator);
  check_ok(hooke_trajectory_close(trajectory, HOOKE_STOPPED));
  hooke_record *record;
  check_ok(hooke_record_open(path, &record));
  const int64_t frames = hooke_record_count(record, "frames");
  assert_true(frames >= 2 && frames < 9);
  for (int64_t k = 0; k < frames; k++) {
    check_ok(hooke_record_read(record, k, read));
    check_close(hooke_state_time(read), 0.125 * (double)k, 0.0);
  }
  hooke_record_close(record);
  hooke_state_destroy(read);
  hooke_state_destroy(state);
  hooke_system_destroy(system);
  remove(path);
}

#else

TEST(test_while_frames_are_written) {
  skip();
}

#endif

/* ---- calls that create temporary objects, which leak with their memory ---- */

TEST(test_studies_can_be_run_again) {
#if HOOKE_HAVE_SUNDIALS && !HOOKE_SANITIZED
  hooke_system *system = make_rope(SMALL);
  hooke_options *run = run_options((struct run){.method = "verlet", .duration = 1.0, .every = 0.25}),
                *options;
  hooke_measurement *study;
  options = options_with("study", "methods=verlet steps=0.125,0.0625");
  check_ok(hooke_measurement_create("study", system, run, options, &study));
  hooke_measurement_on_progress(study, progress, NULL);
  jump.calls = 2;
  if (setjmp(jump.back) == 0) {
    hooke_measurement_run(study, NULL);
    check_failed("the progress was not called twice");
  }
  hooke_measurement_destroy(study);
  check_ok(hooke_measurement_create("study", system, run, options, &study));
  check_ok(hooke_measurement_run(study, NULL));
  check_between(hooke_measurement_number(study, "rows", 1, "error"), 1e-12, 0.1);
  hooke_measurement_destroy(study);
  hooke_options_destroy(options);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
#else
  (void)progress;
  skip();
#endif
}
