#include "sweep.h"

#include "check.h"
#include "places.h"
#include "sanitized.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

int sweep_open(struct sweep *sweep) {
  return open_folder(sweep->folder) ? -1 : places_prepare();
}

int sweep_close(struct sweep *sweep) {
  return close_folder(sweep->folder);
}

struct attempt sweep_attempt(const struct sweep *sweep, enum fault_reach reach) {
  struct attempt attempt = scenario_attempt(sweep->folder);
  attempt.reach = reach;
  return attempt;
}

enum { MOST_COMPLAINTS = 20, POINTS_ALL_TRIED = 20 };

struct counts {
  int64_t tried, refused, borne, complaints;
};

/* All faults found are printed, one a line, before the test fails. */
static void complain(const struct scenario *scenario, int64_t k, const char *reach, const char *what,
                     struct counts *counts) {
  if (counts->complaints++ < MOST_COMPLAINTS)
    print_error("%s, point %lld %s: %s\n", scenario->name, (long long)k, reach, what);
}

static void judge(const struct scenario *scenario, int64_t k, const struct attempt *a, uint64_t hash,
                  struct counts *counts) {
  const char *reach = a->reach == FAULT_ONCE ? "alone" : "and all after it";
  if (a->wrong[0])
    complain(scenario, k, reach, a->wrong, counts);
  else if (!a->gave_up && a->hash != hash)
    complain(scenario, k, reach, a->refused ? "the result afterwards is another" : "the result is another",
             counts);
  counts->tried++;
  counts->refused += a->refused > 0;
  counts->borne += a->refused == 0;
}

/* Hash of the results. */
static uint64_t run_without_fault(const struct scenario *scenario, sweep_point *try_point,
                                  struct counts *counts) {
  struct attempt a;
  try_point(scenario, 0, FAULT_ONCE, &a);
  if (a.wrong[0]) complain(scenario, 0, "none", a.wrong, counts);
  return a.hash;
}

static void check_without_fault(const struct scenario *scenario, sweep_point *try_point, uint64_t hash,
                                struct counts *counts) {
  if (run_without_fault(scenario, try_point, counts) != hash)
    complain(scenario, 0, "none", "the result is another", counts);
}

static int64_t share_of(const struct sweep *sweep, const struct scenario *scenario) {
  /* scenarios with whole studies would take hours, and ten times as many with a sanitizer */
  if (getenv("HOOKE_LONG")) {
    const int64_t few = scenario->share >= 1000 ? scenario->share / 100 : 1;
    return HOOKE_SANITIZED && scenario->share > 10 * few ? scenario->share / 10 : few;
  }
  int64_t share = sweep->share > 0 ? sweep->share : scenario->share;
  if (sweep->share_factor * scenario->share > share) share = sweep->share_factor * scenario->share;
  return HOOKE_SANITIZED ? 6 * share : share;
}

/* 0 if there is no such point. */
static int strike_point(const struct scenario *scenario, sweep_point *try_point, int64_t k,
                        enum fault_reach reach, uint64_t hash, struct counts *counts) {
  struct attempt a;
  try_point(scenario, k, reach, &a);
  if (a.wrong[0] == '\0' && fault_failures() == 0) return 0;
  judge(scenario, k, &a, hash, counts);
  return 1;
}

/* A single point to run; 0: all. */
static int64_t only_point(void) {
  const char *only = getenv("HOOKE_FAULT_POINT");
  return only ? strtoll(only, NULL, 10) : 0;
}

static void sweep_scenario(struct sweep *sweep, const struct scenario *scenario, sweep_point *try_point) {
  struct counts counts = {0};
  if (!scenario_is_built(scenario)) return;
  const clock_t start = clock();
  const uint64_t hash = run_without_fault(scenario, try_point, &counts);
  const int64_t only = only_point();
  if (only == 0) places_begin();
  check_without_fault(scenario, try_point, hash, &counts);
  places_end();
  const int64_t points = fault_points();
  for (int reach = FAULT_ONCE; reach <= FAULT_FROM_THEN_ON; reach++) {
    const int64_t share = points < POINTS_ALL_TRIED ? 1 : share_of(sweep, scenario);
    for (int64_t k = only > 0 ? only : 1 + sweep->first_point % share; counts.complaints < MOST_COMPLAINTS;
         k += share) {
      if (!strike_point(scenario, try_point, k, (enum fault_reach)reach, hash, &counts) || only > 0) break;
    }
    for (int64_t i = 0; only == 0 && places_point(i) > 0 && counts.complaints < MOST_COMPLAINTS; i++)
      strike_point(scenario, try_point, places_point(i), (enum fault_reach)reach, hash, &counts);
  }
  check_without_fault(scenario, try_point, hash, &counts);
  print_message("%-34s %6lld points, %6lld faults: %6lld refused, %4lld borne; %.1f s\n", scenario->name,
                (long long)points, (long long)counts.tried, (long long)counts.refused,
                (long long)counts.borne, (double)(clock() - start) / CLOCKS_PER_SEC);
  sweep->complaints += counts.complaints;
}

void sweep_all(struct sweep *sweep, const struct scenario *scenario, sweep_point *try_point) {
  const char *only = getenv("HOOKE_FAULT_ONLY"); /* to debug one of them */
  for (sweep->complaints = 0; scenario->name; scenario++) {
    if (only == NULL || strstr(scenario->name, only)) sweep_scenario(sweep, scenario, try_point);
  }
  assert_int_equal(sweep->complaints, 0);
}

/* ---- every list ---- */

static struct {
  struct sweep *sweep;
  sweep_point *try_point;
} this_test;

static void every_point_fails(void **list) {
  sweep_all(this_test.sweep, *list, this_test.try_point);
}

#define EVERY_POINT_FAILS(list)                                                                              \
  { #list " fails", every_point_fails, NULL, NULL, (void *)list }

int sweep_every_list(struct sweep *sweep, sweep_point *try_point, int (*set_up)(void **),
                     int (*tear_down)(void **)) {
  const struct CMUnitTest tests[] = {
      EVERY_POINT_FAILS(creating),  EVERY_POINT_FAILS(loading),         EVERY_POINT_FAILS(running),
      EVERY_POINT_FAILS(measuring), EVERY_POINT_FAILS(writing),         EVERY_POINT_FAILS(resuming),
      EVERY_POINT_FAILS(typing),    EVERY_POINT_FAILS(typing_to_files),
  };
  this_test.sweep = sweep;
  this_test.try_point = try_point;
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
