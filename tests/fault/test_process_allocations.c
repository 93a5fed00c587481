#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
/* Fails every allocation of the process in turn, including those of the libraries that hooke uses, each in a
 * process of its own. A call ends with a failure, or with its proper result: no crash, no hang. Libraries
 * that do not survive missing memory are reported and not counted: HDF5 1.10.8 fails for good ("infinite loop
 * closing library") if memory was missing at its start, SUNDIALS 6.4.1 writes through the NULL of some
 * allocations, and the error handler of GSL 2.7, which belongs to its user, calls abort(). */
#include "check.h"
#include "hash.h"
#include "process_faults.h"
#include "scenarios.h"
#include "sweep.h"

#if FAULT_WHOLE_PROCESS

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_SECONDS = 20 };

#if HOOKE_COUNTED
void __gcov_dump(void); /* _exit() discards line coverage */
#else
static void __gcov_dump(void) {
}
#endif

static struct sweep sweep = {.share = 60, .share_factor = 10};

/* Number of crashes, by name. */
static struct {
  const char *library;
  int64_t crashed, broken; /* broken: no further call succeeds */
} excused[] = {{"libhdf5", 0, 0}, {"libsundials", 0, 0}, {"libgsl", 0, 0}};
enum { EXCUSED = sizeof excused / sizeof excused[0] };

static struct shared {
  struct attempt attempt;
  struct fault_trace trace;
  int64_t points, failures;
  int32_t done;
} * shared;

static void be_child(const struct scenario *scenario, int64_t k, enum fault_reach reach) {
  const struct rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  signal(SIGSEGV, SIG_DFL);
  signal(SIGABRT, SIG_DFL);
  alarm(MOST_SECONDS);
  shared->attempt = sweep_attempt(&sweep, reach);
  shared->attempt.foreign = 1;
  fault_begin(k, reach);
  scenario->run(&shared->attempt, scenario->with);
  fault_end();
  shared->points = fault_points();
  shared->failures = fault_failures();
  shared->done = 1;
  __gcov_dump();
  _exit(0);
}

/* It crashed or hung, which is excused for some libraries. */
static void look_at_end(int status, const char *owner, struct attempt *a) {
  fault_take_counts(shared->points, 1);
  a->gave_up = 1;
  a->refused = 1;
  for (int e = 0; e < EXCUSED; e++) {
    if (strstr(owner, excused[e].library) == NULL) continue;
    excused[e].crashed++;
    return;
  }
  attempt_wrong(a, "it %s, by an allocation of %s", WTERMSIG(status) == SIGALRM ? "hangs" : "crashes", owner);
}

/* It continued without the memory, and cannot be used any more in this process. */
static void excuse_what_is_broken(const char *owner, struct attempt *a) {
  for (int e = 0; e < EXCUSED; e++) {
    if (strstr(owner, excused[e].library) == NULL) continue;
    excused[e].broken++;
    a->wrong[0] = '\0';
    a->gave_up = 1;
  }
}

static void try_point(const struct scenario *scenario, int64_t k, enum fault_reach reach, struct attempt *a) {
  int status = 0;
  memset(shared, 0, sizeof *shared);
  fflush(NULL);
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) be_child(scenario, k, reach);
  assert_int_equal(waitpid(child, &status, 0), child);
  const char *owner = process_fault_owner(&shared->trace, !shared->done);
  *a = shared->attempt;
  fault_take_counts(shared->points, shared->failures);
  if (!shared->done)
    look_at_end(status, owner, a);
  else if (a->wrong[0])
    excuse_what_is_broken(owner, a);
  else if (a->refused && a->status != HOOKE_NO_MEMORY && strcmp(owner, "hooke") == 0)
    attempt_wrong(a, "an allocation of %s failed, and the message is: %s", owner, a->message);
}

static int set_up(void **unused) {
  (void)unused;
  shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return -1;
  process_faults_prepare(&shared->trace);
  return sweep_open(&sweep);
}

static int tear_down(void **unused) {
  (void)unused;
  for (int e = 0; e < EXCUSED; e++)
    print_message("%s, by its own allocations: crashed %lld times, broken afterwards %lld times\n",
                  excused[e].library, (long long)excused[e].crashed, (long long)excused[e].broken);
  return sweep_close(&sweep);
}

int main(void) {
  return sweep_every_list(&sweep, try_point, set_up, tear_down);
}

#else

/* A sanitizer has its own allocator, which cannot be replaced. */
int main(void) {
  return 0;
}

#endif
