#pragma once

#include <stdint.h>
#include <time.h>

/* Seconds since a fixed moment. */
static inline double bench_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds of work of `threads` threads: of one, those of the processor, since others may have it meanwhile.
 */
static inline double bench_work_seconds(int32_t threads) {
  struct timespec now;
  if (threads > 1) return bench_seconds();
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
