#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "places.h"

#include <stdlib.h>

#if defined(__GLIBC__)

#include "plan.h"

#include <execinfo.h>
#include <pthread.h>
#include <stddef.h>
#include <string.h>
#include <sys/mman.h>

enum { SLOTS = 1 << 16, MOST = SLOTS / 2, DEPTH = 64, OWN = 1 };

extern const char __executable_start, etext; /* the linker's symbols: the code linked into the program */

static struct places {
  int64_t count, point[MOST], times[SLOTS];
  uint64_t way[SLOTS]; /* 0: free */
} * places;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int are_kept;

int places_prepare(void) {
  void *some[2];
  if (getenv("HOOKE_FAULT_PLACES") == NULL) return 0;
  backtrace(some, 2); /* loads its library */
  void *shared = mmap(NULL, sizeof *places, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return -1;
  places = shared;
  return 0;
}

void places_begin(void) {
  if (places == NULL) return;
  memset(places, 0, sizeof *places);
  are_kept = 1;
}

void places_end(void) {
  are_kept = 0;
}

/* Hash of the call path to a point: the calls, from the innermost outwards, without those of other libraries.
 */
static uint64_t way_here(void) {
  void *frame[DEPTH];
  fault_pause();
  const int depth = backtrace(frame, DEPTH);
  fault_resume();
  uint64_t way = 14695981039346656037u;
  for (int k = OWN; k < depth; k++) {
    const char *at = frame[k];
    if (at >= &__executable_start && at < &etext) way = (way ^ (uint64_t)(uintptr_t)at) * 1099511628211u;
  }
  return way | 1;
}

static int is_power_of_sixteen(int64_t times) {
  while (times % 16 == 0)
    times /= 16;
  return times == 1;
}

void places_note(int64_t k) {
  if (!are_kept) return;
  const uint64_t way = way_here();
  pthread_mutex_lock(&lock);
  uint64_t at = way % SLOTS;
  while (places->way[at] != 0 && places->way[at] != way)
    at = (at + 1) % SLOTS;
  if (places->way[at] == way || places->count < MOST) {
    places->way[at] = way;
    if (is_power_of_sixteen(++places->times[at]) && places->count < MOST) places->point[places->count++] = k;
  }
  pthread_mutex_unlock(&lock);
}

int64_t places_point(int64_t i) {
  return places && i < places->count ? places->point[i] : 0;
}

#else

int places_prepare(void) {
  return 0;
}

void places_begin(void) {
}

void places_end(void) {
}

void places_note(int64_t k) {
  (void)k;
}

int64_t places_point(int64_t i) {
  (void)i;
  return 0;
}

#endif
