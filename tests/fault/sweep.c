#include "sweep.h"

#include "check.h"
#include "hash.h"
#include "places.h"
#include "sanitized.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

int sweep_open(struct sweep *sweep) {
  snprintf(sweep->folder, sizeof sweep->folder, "%s/hooke-fault-XXXXXX", P_tmpdir);
  if (mkdtemp(sweep->folder) == NULL) return -1;
  prepare_scenes(sweep->folder);
  return places_prepare();
}

static int remove_all(const char *folder) {
  char path[512];
  DIR *open_folder = opendir(folder);
  if (open_folder == NULL) return -1;
  for (struct dirent *entry; (entry = readdir(open_folder)) != NULL;) {
    if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
    snprintf(path, sizeof path, "%.250s/%s", folder, entry->d_name);
    unlink(path);
  }
  closedir(open_folder);
  return rmdir(folder);
}

int sweep_close(struct sweep *sweep) {
  return remove_all(sweep->folder);
}

struct attempt sweep_attempt(const struct sweep *sweep, enum fault_reach reach) {
  return (struct attempt){.folder = sweep->folder, .out = sweep->folder, .reach = reach, .hash = HASH_START};
}

enum { MOST_COMPLAINTS = 20, FEW = 20 };

struct counts {
  int64_t tried, refused, borne, wrong;
};

/* All that is wrong is told, a line each, before the test fails. */
static void complain(const struct scenario *scenario, int64_t k, const char *reach, const char *what,
                     struct counts *counts) {
  if (counts->wrong++ < MOST_COMPLAINTS)
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

static void check_clean(const struct scenario *scenario, sweep_point *try_point, uint64_t *hash,
                        int32_t first, struct counts *counts) {
  struct attempt a;
  try_point(scenario, 0, FAULT_ONCE, &a);
  if (a.wrong[0]) complain(scenario, 0, "none", a.wrong, counts);
  if (!first && a.hash != *hash) complain(scenario, 0, "none", "the result is another", counts);
  *hash = a.hash;
}

static int64_t share_of(const struct sweep *sweep, const struct scenario *scenario) {
  /* one that makes whole studies would take hours, and ten times as many with a sanitizer */
  if (getenv("HOOKE_LONG")) {
    const int64_t few = scenario->share >= 1000 ? scenario->share / 100 : 1;
    return HOOKE_SANITIZED && scenario->share > 10 * few ? scenario->share / 10 : few;
  }
  int64_t share = sweep->share > 0 ? sweep->share : scenario->share;
  if (sweep->times > 0 && sweep->times * scenario->share > share) share = sweep->times * scenario->share;
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

static void sweep_scenario(struct sweep *sweep, const struct scenario *scenario, sweep_point *try_point) {
  struct counts counts = {0};
  uint64_t hash = 0;
  if (!scenario_is_built(scenario)) return;
  const clock_t start = clock();
  check_clean(scenario, try_point, &hash, 1, &counts);
  places_begin();
  check_clean(scenario, try_point, &hash, 0, &counts);
  places_end();
  const int64_t points = fault_points();
  for (int reach = FAULT_ONCE; reach <= FAULT_FROM_THEN_ON; reach++) {
    const int64_t share = points < FEW ? 1 : share_of(sweep, scenario);
    for (int64_t k = 1 + sweep->first % share; counts.wrong < MOST_COMPLAINTS; k += share) {
      if (!strike_point(scenario, try_point, k, (enum fault_reach)reach, hash, &counts)) break;
    }
    for (int64_t i = 0; places_point(i) > 0 && counts.wrong < MOST_COMPLAINTS; i++)
      strike_point(scenario, try_point, places_point(i), (enum fault_reach)reach, hash, &counts);
  }
  check_clean(scenario, try_point, &hash, 0, &counts);
  print_message("%-34s %6lld points, %6lld faults: %6lld refused, %4lld borne; %.1f s\n", scenario->name,
                (long long)points, (long long)counts.tried, (long long)counts.refused,
                (long long)counts.borne, (double)(clock() - start) / CLOCKS_PER_SEC);
  sweep->wrong += counts.wrong;
}

void sweep_all(struct sweep *sweep, const struct scenario *scenario, sweep_point *try_point) {
  const char *only = getenv("HOOKE_FAULT_ONLY"); /* for a look at one of them */
  for (sweep->wrong = 0; scenario->name; scenario++) {
    if (only == NULL || strstr(scenario->name, only)) sweep_scenario(sweep, scenario, try_point);
  }
  assert_int_equal(sweep->wrong, 0);
}
