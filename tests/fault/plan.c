#include "plan.h"

#include "places.h"

#include <stdatomic.h>

static atomic_llong points, failures, looks;
static atomic_int on;
static int64_t chosen;
static enum fault_reach reach_of_chosen;
static _Thread_local int paused;

double __wrap_hk_clock_seconds(void);

double __wrap_hk_clock_seconds(void) {
  return 1e-6 * (double)atomic_fetch_add(&looks, 1);
}

void fault_begin(int64_t k, enum fault_reach reach) {
  atomic_store(&points, 0);
  atomic_store(&failures, 0);
  chosen = k;
  reach_of_chosen = reach;
  atomic_store(&on, 1);
}

void fault_end(void) {
  atomic_store(&on, 0);
}

void fault_pause(void) {
  paused++;
}

void fault_resume(void) {
  paused--;
}

/* A place for a breakpoint. */
__attribute__((noinline)) static void strike(void) {
  atomic_fetch_add(&failures, 1);
}

int32_t fault_strikes(void) {
  if (!atomic_load(&on) || paused) return 0;
  const int64_t k = atomic_fetch_add(&points, 1) + 1;
  places_note(k);
  if (chosen == 0 || k < chosen || (k > chosen && reach_of_chosen == FAULT_ONCE)) return 0;
  strike();
  return 1;
}

void fault_take_counts(int64_t points_there, int64_t failures_there) {
  atomic_store(&points, points_there);
  atomic_store(&failures, failures_there);
}

int64_t fault_points(void) {
  return atomic_load(&points);
}

int64_t fault_failures(void) {
  return atomic_load(&failures);
}
