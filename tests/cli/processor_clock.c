/* In place of the system's clock that only goes forward, to be loaded before all libraries (LD_PRELOAD): the
 * time that the process was given by its processors. What fits in a budget is then the same on a busy machine
 * as on an idle one. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <string.h>
#include <time.h>

int clock_gettime(clockid_t clock, struct timespec *now) {
  int (*own)(clockid_t, struct timespec *);
  void *found = dlsym(RTLD_NEXT, "clock_gettime");
  memcpy(&own, &found, sizeof own); /* C knows no cast from the one to the other */
  return own(clock == CLOCK_MONOTONIC ? CLOCK_PROCESS_CPUTIME_ID : clock, now);
}
