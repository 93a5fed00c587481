/* Runs a scenario of tests/fault repeatedly, without faults: cycles NAME COUNT. Every cycle has to give the
 * same results; after the first ones heap, resident memory, open files and threads have to stay constant.
 * Without arguments it prints the names, one a line. Scenarios of which a sweep tries one point in twenty
 * are slow, and run a tenth as often. GLIBC_TUNABLES=glibc.malloc.tcache_count=0 has to be set: released
 * memory cached by threads would count as held. */
#include "check.h"
#include "held.h"
#include "scenarios.h"

#include <inttypes.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- what has to stay constant ---- */

struct held {
  int64_t heap, resident, files, threads;
};

static struct held held_now(void) {
  long long pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  assert_non_null(file);
  assert_int_equal(fscanf(file, "%*d %lld", &pages), 1);
  fclose(file);
  return (struct held){.heap = (int64_t)mallinfo2().uordblks,
                       .resident = pages * sysconf(_SC_PAGESIZE),
                       .files = open_files(),
                       .threads = thread_count()};
}

/* Growth of the heap [bytes] that is allowed with libhdf5, whose lists of released blocks fill slowly: less
 * than a block in a hundred cycles. */
enum { SLOW = 20, HDF5_KEEPS = 4096 };
static const struct scenario *asked;
static int64_t cycles;

/* Caches of libraries fill in the first twentieth. */
static void test_cycles(void **unused) {
  (void)unused;
  const int64_t warm = cycles / 20 + 10, kept = asked->needs && strstr(asked->needs, "hdf5") ? HDF5_KEEPS : 0;
  char folder[128];
  uint64_t first = 0;
  struct held start = {0}, now = {0};
  assert_int_equal(open_folder(folder), 0);
  for (int64_t k = 0; k < cycles; k++) {
    struct attempt a = scenario_attempt(folder);
    asked->run(&a, asked->with);
    if (k == 0) first = a.hash;
    if (a.wrong[0]) check_failed("cycle %" PRId64 ": %s", k, a.wrong);
    if (a.hash != first)
      check_failed("cycle %" PRId64 " comes to %016" PRIx64 ", the first to %016" PRIx64, k, a.hash, first);
    if (k == warm) start = held_now();
  }
  now = held_now();
  printf("%s: %" PRId64 " cycles, hash %016" PRIx64 ", heap %" PRId64 " -> %" PRId64
         " bytes, resident %" PRId64 " -> %" PRId64 " KiB, files %" PRId64 ", threads %" PRId64 "\n",
         asked->name, cycles, first, start.heap, now.heap, start.resident / 1024, now.resident / 1024,
         now.files, now.threads);
  if (now.heap > start.heap + kept) check_failed("the heap has grown");
  if (now.resident - start.resident > 1 << 20) check_failed("the process has grown");
  assert_true(now.files > 0 && now.threads > 0);
  assert_int_equal(now.files, start.files);
  assert_int_equal(now.threads, start.threads);
  assert_int_equal(close_folder(folder), 0);
}

int main(int argc, char **argv) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_cycles)};
  const struct scenario *scenario;
  for (int32_t k = 0; (scenario = scenario_at(k)) != NULL; k++) {
    if (argc < 3) puts(scenario->name);
    if (argc >= 3 && strcmp(argv[1], scenario->name) == 0) asked = scenario;
  }
  if (argc < 3) return 0;
  if (asked == NULL) return fprintf(stderr, "no scenario is called %s\n", argv[1]), 2;
  cycles = strtoll(argv[2], NULL, 10) / (asked->share < SLOW ? 1 : 10);
  if (cycles < 100) return fprintf(stderr, "at least 100 cycles, or 1000\n"), 2;
  return cmocka_run_group_tests(tests, NULL, NULL);
}
