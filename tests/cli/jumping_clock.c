/* Replaces the system's monotonic clock by one that jumps 1000 s ahead at every reading; to be loaded before
 * all libraries (LD_PRELOAD). What depends on a clock then has another result. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>

int clock_gettime(clockid_t clock, struct timespec *now) {
  static atomic_long readings;
  int (*own)(clockid_t, struct timespec *);
  void *found = dlsym(RTLD_NEXT, "clock_gettime");
  memcpy(&own, &found, sizeof own); /* C has no cast from one to the other */
  const int status = own(clock, now);
  if (clock == CLOCK_MONOTONIC) now->tv_sec += 1000 * (1 + atomic_fetch_add(&readings, 1));
  return status;
}
