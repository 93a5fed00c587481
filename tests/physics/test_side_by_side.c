/* Trials of measurements that run side by side have the numbers of those that run one after the other, for
 * any number of threads: all but times. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two masses on springs, whose motion is soon chaotic. */
static hooke_system *double_pendulum(void) {
  static const double q[] = {0, 0, 0, 1, 0.2, 0, 2, 0.5, 0.3};
  static const int64_t ends[] = {0, 1, 1, 2};
  hooke_system *system = small_system(3, q, NULL, 1.0, 1);
  small_springs(system, 2, ends, (struct springs){.stiffness = 200.0, .rest_length = -1.0});
  return small_falling(system);
}

static hooke_system *oscillator(void) {
  return small_oscillator(6.0);
}

static hooke_system *cloth(void) {
  return small_cloth(4, 50.0, 0.01);
}

static hooke_system *two_ropes(void) {
  hooke_system *system = small_part(NULL, "rope", "one",
                                    "from=0,0,0 to=1,0,0 segments=4 mass=0.1 pinned=start "
                                    "stretch.stiffness=20 stretch.damping=0.05");
  return small_falling(small_part(system, "rope", "two",
                                  "from=0,0,1 to=2,0,1 segments=6 mass=0.1 pinned=start "
                                  "stretch.stiffness=30 stretch.damping=0.05 bend.stiffness=1e-4"));
}

static const struct trials {
  const char *kind, *options;
  hooke_system *(*make)(void);
  struct run run;
  const char *found; /* a table with rows, if it measured what it is here for */
} all[] = {
    {"study",
     "methods=verlet,rk4 once=1 ensemble=6 watch=1.y",
     double_pendulum,
     {.step = 0.01, .duration = 30.0, .every = 0.1},
     "statistics"},
    {"study", "methods=verlet,rk4 want=1e-3", oscillator, {.duration = 1.0, .every = 0.1}, "recommendation"},
    {"needs", "want=1e-2", cloth, {.method = "verlet", .duration = 0.3, .every = 0.05}, "degrees"},
    {"needs", "want=1e-2", two_ropes, {.method = "rk4", .duration = 0.2, .every = 0.05}, "degrees"},
    {"needs", "want=1e-2 refine=1", two_ropes, {.method = "verlet", .duration = 0.2, .every = 0.1}, "parts"}};
enum { ALL = sizeof all / sizeof all[0] };

static hooke_measurement *prepare(const hooke_system *system, const struct trials *trials, int32_t threads) {
  struct run of_run = trials->run;
  hooke_measurement *m = NULL;
  of_run.threads = threads;
  owned_options *run = run_options(of_run), *options = options_with(trials->kind, "%s", "");
  check_ok(try_words(options, trials->options));
  check_ok(hooke_measurement_create(trials->kind, system, run, options, &m));
  return m;
}

/* Times, and what depends on them. */
static int is_of_clock(const char *column) {
  static const char *const names[] = {"wall_seconds", "wall_median", "repeats",    "timed_alone",
                                      "runs",         "spread",      "times_less", "other_seconds"};
  for (size_t k = 0; k < sizeof names / sizeof names[0]; k++)
    if (strcmp(column, names[k]) == 0) return 1;
  return 0;
}

static int is_same(double a, double b) {
  return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static int same_value(const hooke_measurement *a, const hooke_measurement *b, const char *table, int64_t row,
                      const char *column, const char *type) {
  if (strcmp(type, "series") == 0) {
    int64_t counts[2], same = 1;
    const double *x = hooke_measurement_series(a, table, row, column, &counts[0]),
                 *y = hooke_measurement_series(b, table, row, column, &counts[1]);
    for (int64_t k = 0; k < counts[0] && counts[0] == counts[1]; k++)
      same &= is_same(x[k], y[k]);
    return same && counts[0] == counts[1];
  }
  if (strcmp(type, "text") != 0)
    return is_same(hooke_measurement_number(a, table, row, column),
                   hooke_measurement_number(b, table, row, column));
  const char *x = hooke_measurement_text(a, table, row, column),
             *y = hooke_measurement_text(b, table, row, column);
  return x == y || (x && y && strcmp(x, y) == 0);
}

/* Compares all values; returns how many there are. */
static int64_t compare(const hooke_measurement *a, const hooke_measurement *b, const char *kind,
                       int32_t threads) {
  int64_t count = 0;
  const char *table, *column;
  for (int64_t t = 0; (table = hooke_measurement_table(kind, t, "name")); t++) {
    const int64_t rows = hooke_measurement_row_count(a, table);
    assert_int_equal(hooke_measurement_row_count(b, table), rows);
    for (int64_t c = 0; (column = hooke_measurement_column(kind, table, c, "name")); c++) {
      const char *type = hooke_measurement_column(kind, table, c, "type");
      for (int64_t row = 0; row < rows && !is_of_clock(column); row++, count++) {
        const char *by = strcmp(table, "claims") == 0 ? hooke_measurement_text(a, table, row, "by") : "";
        if (strcmp(by, "clock") != 0 && !same_value(a, b, table, row, column, type))
          check_failed("%s by %d threads: %s of row %d of %s is another", kind, (int)threads, column,
                       (int)row, table);
      }
    }
  }
  return count;
}

TEST(numbers_do_not_depend_on_threads) {
  for (int k = 0; k < ALL; k++) {
    owned_system *system = all[k].make();
    owned_measurement *one = prepare(system, &all[k], 1);
    check_ok(hooke_measurement_run(one, NULL));
    if (hooke_measurement_row_count(one, all[k].found) < 1)
      check_failed("%s %s: no %s", all[k].kind, all[k].options, all[k].found);
    for (int32_t threads = 2; threads <= 5; threads += 3) {
      owned_measurement *more = prepare(system, &all[k], threads);
      check_ok(hooke_measurement_run(more, NULL));
      assert_true(compare(one, more, all[k].kind, threads) > 20);
    }
  }
}

/* ---- the thread that called ---- */

struct seen {
  int64_t calls, last;
  double most;
};

static int32_t stop_at_last(double done, const char *what, void *ctx) {
  struct seen *seen = ctx;
  (void)what;
  seen->most = fmax(seen->most, done);
  return ++seen->calls >= seen->last;
}

/* Wherever that is, and without another call. */
TEST(a_callback_stops_all) {
  for (int k = 0; k < ALL; k++) {
    owned_system *system = all[k].make();
    int32_t status = HOOKE_STOPPED;
    for (int64_t last = 1; last < 1000 && status == HOOKE_STOPPED; last = 10 * last + 7) {
      struct seen seen = {.last = last};
      owned_measurement *stopped = prepare(system, &all[k], 2);
      hooke_measurement_on_progress(stopped, stop_at_last, &seen);
      status = hooke_measurement_run(stopped, NULL);
      assert_int_equal(seen.calls == last, status == HOOKE_STOPPED);
      check_between((double)seen.calls, 1.0, (double)last);
      check_between(seen.most, 0.0, 1.0);
    }
  }
}
