/* Fails every allocation of hooke in turn, alone and with all after it: the call reports it,
 * its objects work afterwards as before, and every block is released. */
#include "check.h"
#include "memory_faults.h"
#include "scenarios.h"
#include "sweep.h"

#include <stdio.h>
#include <stdlib.h>

static struct sweep sweep;

static void try_point(const struct scenario *scenario, int64_t k, enum fault_reach reach, struct attempt *a) {
  const int64_t blocks = memory_blocks();
  *a = sweep_attempt(&sweep, reach);
  fault_begin(k, reach);
  scenario->run(a, scenario->with);
  fault_end();
  const int64_t left = memory_blocks() - blocks;
  if (left != 0) attempt_wrong(a, "%lld blocks are left", (long long)left);
}

static int set_up(void **unused) {
  (void)unused;
  return sweep_open(&sweep);
}

static int tear_down(void **unused) {
  (void)unused;
  return sweep_close(&sweep);
}

int main(void) {
  return sweep_every_list(&sweep, try_point, set_up, tear_down);
}
