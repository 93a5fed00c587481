#include "fuzz.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum { EXECUTIONS, PAST_SYNTAX, ACCEPTED, NANOSECONDS, COUNTS, BETWEEN_CLOCKS = 64 };

static uint64_t own[COUNTS], *tally;
static int is_past_syntax, is_accepted;

static uint64_t *open_tally(void) {
  const char *path = getenv("HOOKE_FUZZ_TALLY");
  const int file = path ? open(path, O_RDWR | O_CREAT, 0644) : -1;
  void *there = MAP_FAILED;
  if (file >= 0 && ftruncate(file, sizeof own) == 0)
    there = mmap(NULL, sizeof own, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (file >= 0) close(file);
  return there == MAP_FAILED ? own : there;
}

static uint64_t nanoseconds(void) {
  struct timespec used = {0};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return (uint64_t)used.tv_sec * 1000000000 + (uint64_t)used.tv_nsec;
}

void hooke_fuzz_begin(void) {
  if (tally == NULL) tally = open_tally();
  if (tally[EXECUTIONS]++ % BETWEEN_CLOCKS == 0) tally[NANOSECONDS] = nanoseconds();
  is_past_syntax = is_accepted = 0;
}

void hooke_fuzz_is_past_syntax(void) {
  if (!is_past_syntax) tally[PAST_SYNTAX]++;
  is_past_syntax = 1;
}

void hooke_fuzz_is_accepted(void) {
  if (!is_accepted) tally[ACCEPTED]++;
  is_accepted = 1;
}
