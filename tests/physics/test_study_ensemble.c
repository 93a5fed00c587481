/* Results of a study on watched quantities are true, and where motion is chaotic its ensembles agree with
 * ones five times as large (with HOOKE_LONG=1 ten times), and detect a planted bias. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct study {
  double duration, every, members, seed;
  const char *methods, *watch;
  double step, rtol; /* 0: ladders */
};

/* Rows of "statistics" for each method, one a quantity: the reference comes first. */
static int64_t quantity_count(const hooke_measurement *study) {
  const int64_t rows = hooke_measurement_row_count(study, "statistics");
  int64_t count = 0;
  while (count < rows &&
         strcmp(hooke_measurement_text(study, "statistics", count, "method"), "reference") == 0)
    count++;
  return count;
}

/* NaN where there is no such row. */
static double statistic(const hooke_measurement *study, const char *method, const char *quantity,
                        const char *what) {
  const int64_t first = hooke_measurement_find(study, "statistics", "method", method),
                q = hooke_measurement_find(study, "statistics", "quantity", quantity);
  return first < 0 || q < 0 ? (double)NAN : hooke_measurement_number(study, "statistics", first + q, what);
}

static hooke_measurement *start(const hooke_system *system, struct study s) {
  hooke_measurement *study = NULL;
  owned_options *run = run_options((struct run){.duration = s.duration, .every = s.every}), *options;
  options = options_with("study", "methods=%s", s.methods);
  if (s.watch) check_ok(hooke_options_set_text(options, "watch", s.watch));
  if (s.step > 0.0) check_ok(hooke_options_set_number(options, "steps", s.step));
  if (s.rtol > 0.0) check_ok(hooke_options_set_number(options, "tolerances", s.rtol));
  check_ok(hooke_options_set_number(options, "ensemble", s.members));
  if (s.seed > 0.0) check_ok(hooke_options_set_number(options, "seed", s.seed));
  const int32_t status = hooke_measurement_create("study", system, run, options, &study);
  if (status == HOOKE_NOT_BUILT) {
    hooke_system_destroy((hooke_system *)(uintptr_t)system);
    skip();
  }
  check_status(status, HOOKE_OK);
  check_ok(hooke_measurement_run(study, NULL));
  return study;
}

/* ---- watched quantities ---- */

/* From the first row; NaN if it is not watched. */
static double error_in(const hooke_measurement *study, const char *quantity) {
  return hooke_measurement_number(study, "watched_errors",
                                  hooke_measurement_find(study, "watched_errors", "quantity", quantity),
                                  "error");
}

/* For the oscillator x(t) = cos(w t), by the known error of verlet: its period has a relative error of (w
 * h)^2/24. */
TEST(errors_of_what_is_watched_are_true) {
  const double omega = 6.0, h = 0.01, period = 2.0 * 3.14159265358979323846 / omega;
  owned_system *system = small_oscillator(omega);
  owned_measurement *study = start(system, (struct study){.duration = 10.0,
                                                          .every = 0.02,
                                                          .methods = "verlet",
                                                          .step = h,
                                                          .watch = "1.x,period:1.x,kinetic,energy"});
  assert_string_equal(hooke_measurement_text(study, "watched", 1, "quantity"), "period:1.x");
  assert_null(hooke_measurement_text(study, "watched", 4, "quantity"));
  assert_string_equal(hooke_measurement_text(study, "watched", 1, "unit"), "s");
  assert_int_equal(hooke_measurement_row_count(study, "watched"), 4);
  const double off = period * pow(omega * h, 2.0) / 24.0;
  check_between(error_in(study, "period:1.x"), 0.98 * off, 1.02 * off);
  /* the phase error is w t (w h)^2/24 */
  const double phase = omega * 10.0 * pow(omega * h, 2.0) / 24.0;
  check_between(error_in(study, "1.x"), 0.9 * phase, 1.1 * phase);
  check_close(error_in(study, "energy"), hooke_measurement_number(study, "rows", 0, "energy_drift"), 1e-12);
  check_between(hooke_measurement_number(study, "watched",
                                         hooke_measurement_find(study, "watched", "quantity", "1.x"),
                                         "agreement"),
                1e-15, 1e-7);
  assert_true(isnan(error_in(study, "1.y")));
  assert_null(hooke_measurement_series(study, "watched_errors", 4, "value", NULL));
  /* the series of the error, and the motion itself */
  const double *time = hooke_measurement_series(study, "reference", 0, "time", NULL),
               *exact = hooke_measurement_series(study, "watched", 0, "value", NULL),
               *found = hooke_measurement_series(study, "watched_errors", 0, "value", NULL);
  double largest = 0.0;
  for (int64_t f = 0; f < (int64_t)hooke_measurement_number(study, "study", 0, "frames"); f++) {
    check_close(exact[f], cos(omega * time[f]), 1e-7);
    largest = fmax(largest, fabs(found[f] - exact[f]));
  }
  check_close(error_in(study, "1.x"), largest, 0.0);
  /* all of it is trusted, so no statistics are needed */
  assert_int_equal(hooke_measurement_row_count(study, "ensemble"), 0);
  assert_true(isnan(statistic(study, "verlet", "kinetic", "mean")));
}

/* ---- ensembles ---- */

static hooke_system *double_pendulum(void) {
  static const double q[] = {0, 0, 0, 1, 0.2, 0, 2, 0.5, 0.3}, down[] = {0, -9.81, 0};
  static const int64_t ends[] = {0, 1, 1, 2};
  hooke_system *system = small_system(3, q, NULL, 1.0, 1);
  check_ok(hooke_system_set_gravity(system, down));
  small_springs(system, 2, ends, (struct springs){.stiffness = 200.0, .rest_length = -1.0});
  check_ok(hooke_system_commit(system));
  return system;
}

/* Counts the means of a quantity within 3 standard errors of that of the large ensemble; adds the total
 * number. */
static int agrees(const hooke_measurement *small, const hooke_measurement *large, const char *method,
                  const char *quantity) {
  const hooke_measurement *const from[] = {small, large};
  const char *const by[] = {method, "reference"};
  double mean[2], variance = 0.0;
  for (int k = 0; k < 2; k++) {
    const double spread = statistic(from[k], by[k], quantity, "spread");
    const double members = statistic(from[k], by[k], quantity, "members");
    mean[k] = statistic(from[k], by[k], quantity, "mean");
    variance += spread * spread / members;
    check_between(members, 2.0, hooke_measurement_number(from[k], "ensemble", 0, "members"));
    assert_true(spread > 0.0);
  }
  if (fabs(mean[0] - mean[1]) <= 3.0 * sqrt(variance)) return 1;
  print_message("%s of %s: %g, in the large ensemble %g, %.1f standard errors apart\n", quantity, method,
                mean[0], mean[1], fabs(mean[0] - mean[1]) / sqrt(variance));
  return 0;
}

/* Adds the number of means, and of those that agree. */
static void count_agreement(const hooke_measurement *small, const hooke_measurement *large,
                            const char *method, int64_t *means, int64_t *agreeing) {
  const int64_t count = quantity_count(small);
  for (int64_t k = 0; k < 2 * count; k++) {
    *agreeing += agrees(small, large, k % 2 ? method : "reference",
                        hooke_measurement_text(small, "statistics", k / 2, "quantity"));
  }
  *means += 2 * count;
}

/* For the small ensemble, and with HOOKE_LONG=1 in the environment for nineteen others. */
static void check_rate(const hooke_system *system, struct study s, const hooke_measurement *small,
                       const hooke_measurement *large, const char *method) {
  const int others = getenv("HOOKE_LONG") ? 19 : 0;
  int64_t means = 0, agreeing = 0;
  count_agreement(small, large, method, &means, &agreeing);
  s.methods = method;
  for (int k = 0; k < others; k++) {
    s.seed = 3.0 + k;
    owned_measurement *other = start(system, s);
    count_agreement(other, large, method, &means, &agreeing);
  }
  print_message("%d of %d means agree\n", (int)agreeing, (int)means);
  assert_true((double)agreeing >= 0.95 * (double)means - 1e-9);
}

/* `planted` loses energy at its step; `method` loses none that is visible. */
static void test_ensembles(hooke_system *system, struct study s, const char *method, const char *planted) {
  owned_measurement *small = start(system, s);
  struct study larger = s;
  larger.members *= getenv("HOOKE_LONG") ? 10.0 : 5.0;
  larger.seed = 2.0;
  larger.methods = "symplectic-euler"; /* no requirement here, and the least time */
  owned_measurement *large = start(system, larger);
  check_between(hooke_measurement_number(small, "reference", 0, "trusted_until"), 0.05 * s.duration,
                0.95 * s.duration);
  check_between(hooke_measurement_number(small, "ensemble", 0, "from"),
                hooke_measurement_number(small, "reference", 0, "trusted_until"),
                hooke_measurement_number(small, "reference", 0, "trusted_until") + 1.001 * s.every);
  check_close(hooke_measurement_number(small, "ensemble", 0, "until"), s.duration, 1e-9);
  check_rate(system, s, small, large, method);
  check_between(statistic(small, planted, "energy", "bias"), -INFINITY, -5.0);
  check_between(statistic(small, planted, "kinetic", "bias"), -INFINITY, -5.0);
  hooke_system_destroy(system);
}

TEST(a_pendulum_has_statistics) {
  test_ensembles(double_pendulum(),
                 (struct study){.duration = 30.0,
                                .every = 0.1,
                                .members = 10.0,
                                .methods = "cvode-adams,backward-euler",
                                .step = 0.01,
                                .rtol = 1e-9,
                                .watch = "1.y,2.y,2.z,potential"},
                 "cvode-adams", "backward-euler");
}

TEST(a_crumpling_cloth_has_statistics) {
  test_ensembles(small_crumpling_cloth(4),
                 (struct study){.duration = 6.0,
                                .every = 0.1,
                                .members = 10.0,
                                .methods = "cvode-adams,backward-euler",
                                .step = 0.01,
                                .rtol = 1e-9,
                                .watch = "cloth0:15.y,cloth0.structural:0.tension,cloth0.bend:3.length"},
                 "cvode-adams", "backward-euler");
}

TEST(the_seed_decides) {
  owned_system *system = double_pendulum();
  double mean[3];
  for (int k = 0; k < 3; k++) {
    hooke_measurement *study =
        start(system, (struct study){.duration = 20.0,
                                     .every = 0.1,
                                     .members = 2.0,
                                     .seed = k == 2 ? 2.0 : 1.0,
                                     .methods = k == 1 ? "symplectic-euler,verlet" : "verlet",
                                     .step = 0.01});
    mean[k] = statistic(study, "verlet", "kinetic", "mean");
    hooke_measurement_destroy(study);
  }
  check_same_bits(1, &mean[0], &mean[1]);
  assert_true(mean[0] != mean[2]);
}

/* ---- the noise of starts ---- */

enum { CHAIN = 9, PLATE = 4, ALL = CHAIN + PLATE, MEMBERS = 4, SOURCES = 2, STARTS = SOURCES * MEMBERS };

/* What a force sees: the last displaced starts, which are those of the ensemble. */
struct starts {
  double place[3 * ALL], displaced[STARTS][3 * ALL], last;
  int64_t count;
};

static int32_t look(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  struct starts *starts = ctx;
  (void)v, (void)force;
  assert_int_equal(n, ALL);
  if (t == 0.0 && starts->last != 0.0 && q[3] != starts->place[3])
    memcpy(starts->displaced[starts->count++ % STARTS], q, sizeof starts->place);
  starts->last = t;
  return 0;
}

/* A chain, whose motion is chaotic, with a body at its end. */
static hooke_system *chain_and_plate(struct starts *starts) {
  static const double corner[] = {3.5, 0, 0, 4, 0, 0, 3.5, 0.5, 0, 3.5, 0, 0.5}, down[] = {0, -9.81, 0};
  static const int64_t plate[] = {CHAIN, CHAIN + 1, CHAIN + 2, CHAIN + 3};
  int64_t ends[2 * CHAIN];
  for (int k = 0; k < 3 * ALL; k++)
    starts->place[k] = k < 3 * CHAIN ? 0.4 * (k / 3) * (k % 3 == 0) + 0.1 * sin(k) : corner[k - 3 * CHAIN];
  for (int k = 0; k < 2 * CHAIN; k++)
    ends[k] = (k + 1) / 2;
  hooke_system *system = small_system(ALL, starts->place, NULL, 1.0, 1);
  check_ok(hooke_system_set_gravity(system, down));
  small_springs(system, CHAIN, ends, (struct springs){.stiffness = 300.0, .rest_length = -1.0});
  check_ok(hooke_system_add_body(system, "plate", PLATE, plate, 0));
  check_ok(hooke_system_set_force(system, look, NULL, starts));
  check_ok(hooke_system_commit(system));
  return system;
}

static double apart(const double *q, int i, int j) {
  const double *a = q + 3 * i, *b = q + 3 * j;
  return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* As large as it says and about the start, by four standard errors; and bodies move, but stay rigid. */
static void check_noise(const struct starts *starts, double noise) {
  const double count = STARTS * (CHAIN - 1);
  double squares = 0.0, sum[3] = {0.0}, moved = 0.0, torn = 0.0;
  for (int s = 0; s < STARTS; s++) {
    const double *q = starts->displaced[s];
    for (int k = 3; k < 3 * CHAIN; k++) {
      squares += pow(q[k] - starts->place[k], 2.0);
      sum[k % 3] += q[k] - starts->place[k];
    }
    moved = fmax(moved, largest_difference(3 * PLATE, q + 3 * CHAIN, starts->place + 3 * CHAIN));
    for (int k = 0; k < PLATE * PLATE; k++)
      torn = fmax(torn, fabs(apart(q, CHAIN + k / PLATE, CHAIN + k % PLATE) -
                             apart(starts->place, CHAIN + k / PLATE, CHAIN + k % PLATE)));
  }
  check_close(sqrt(squares / count) / noise, 1.0, 4.0 / sqrt(6.0 * count));
  for (int a = 0; a < 3; a++)
    check_close(sum[a] / count, 0.0, 4.0 * noise / sqrt(3.0 * count));
  check_between(moved, 0.5 * noise, 5.0 * noise);
  check_between(torn, 0.0, 1e-3 * noise);
}

TEST(the_noise_is_what_it_is_said_to_be) {
  struct starts starts = {.last = 0.0};
  owned_system *system = chain_and_plate(&starts);
  owned_measurement *study = start(
      system,
      (struct study){
          .duration = 12.0, .every = 1.0, .members = MEMBERS, .methods = "symplectic-euler", .step = 0.01});

  assert_true(starts.count >= STARTS);
  check_noise(&starts, hooke_measurement_number(study, "ensemble", 0, "noise"));
}

TEST(one_start_is_refused) {
  owned_system *system = double_pendulum();
  owned_options *run = run_options((struct run){.duration = 1.0}), *options;
  hooke_measurement *study = NULL;
  options = options_with("study", "ensemble=1");
  check_status(hooke_measurement_create("study", system, run, options, &study), HOOKE_BAD_VALUE);
  check_message("at least 2");
  set_options(options, "ensemble=2 watch=3.y");
  check_status(hooke_measurement_create("study", system, run, options, &study), HOOKE_BAD_VALUE);
  check_message("particles 0 to 2");
}
