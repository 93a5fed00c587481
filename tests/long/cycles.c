/* Creates, uses and destroys one kind of object repeatedly: cycles KIND COUNT [FOLDER]. Every cycle has to
 * give the same numbers; after the first ones heap, resident memory, open files and threads have to stay
 * constant. Without arguments it prints the kinds, one a line. FOLDER is for the files of kinds that write
 * some; its files are replaced. GLIBC_TUNABLES=glibc.malloc.tcache_count=0 has to be set: released memory
 * cached by threads would count as held. */
#include "check.h"
#include "held.h"
#include "lives.h"

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

static const struct life *asked;
static int64_t cycles;

/* Caches of libraries fill in the first twentieth. */
static void test_cycles(void **unused) {
  (void)unused;
  const int64_t warm = cycles / 20 + 10;
  uint64_t first = 0;
  struct held start = {0}, now = {0};
  for (int64_t k = 0; k < cycles; k++) {
    const uint64_t hash = asked->live(asked->detail);
    if (k == 0) first = hash;
    if (hash != first)
      check_failed("cycle %" PRId64 " comes to %016" PRIx64 ", the first to %016" PRIx64, k, hash, first);
    if (k == warm) start = held_now();
  }
  now = held_now();
  printf("%s: %" PRId64 " cycles, hash %016" PRIx64 ", heap %" PRId64 " -> %" PRId64
         " bytes, resident %" PRId64 " -> %" PRId64 " KiB, files %" PRId64 ", threads %" PRId64 "\n",
         asked->name, cycles, first, start.heap, now.heap, start.resident / 1024, now.resident / 1024,
         now.files, now.threads);
  if (now.heap > start.heap + asked->kept) check_failed("the heap has grown");
  if (now.resident - start.resident > 1 << 20) check_failed("the process has grown");
  assert_true(now.files > 0 && now.threads > 0);
  assert_int_equal(now.files, start.files);
  assert_int_equal(now.threads, start.threads);
}

static void set_files(const char *folder, const char *name) {
  const struct {
    char *path;
    const char *ending;
  } files[] = {{life_files.trajectory, "h5"},
               {life_files.page, "page"},
               {life_files.scene, "json"},
               {life_files.checkpoint, "checkpoint"}};
  for (size_t k = 0; k < sizeof files / sizeof files[0]; k++) {
    snprintf(files[k].path, sizeof life_files.page, "%s/%s.%s", folder, name, files[k].ending);
    remove(files[k].path);
  }
}

int main(int argc, char **argv) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_cycles)};
  const struct life *const tables[] = {object_lives, file_lives, measure_lives};
  for (int t = 0; t < 3; t++) {
    for (const struct life *life = tables[t]; life->name != NULL; life++) {
      if (argc < 3) puts(life->name);
      if (argc >= 3 && strcmp(argv[1], life->name) == 0) asked = life;
    }
  }
  if (argc < 3) return 0;
  if (asked == NULL) return fprintf(stderr, "no kind is called %s\n", argv[1]), 2;
  cycles = strtoll(argv[2], NULL, 10);
  if (cycles < 100) return fprintf(stderr, "at least 100 cycles\n"), 2;
  set_files(argc > 3 ? argv[3] : ".", asked->name);
  return cmocka_run_group_tests(tests, NULL, NULL);
}
