/* Passes by thread pools of any size have the bits of one thread. */
#pragma once

#include "check.h"

#include "model/sum/motion.h"

#include <stdlib.h>
#include <string.h>

/* Two steps in passes, and forces; all results in `out`, 9 numbers a particle. */
static int64_t step_with(const hooke_system *system, const double *q, const double *v, int32_t workers,
                         double *out) {
  const struct hk_move move = {
      .kind = HOOKE_KICK_THEN_DRIFT, .heavy = 1, .kick = 0.01, .drift = 0.01, .gravity = {0.0, -9.81, 0.0}};
  struct hk_pool *pool = hk_pool_create(workers);
  struct hk_motion *moved = NULL, *still = NULL;
  const int64_t n = system->particle_count;
  assert_non_null(pool);
  check_ok(hk_motion_create(system, HOOKE_MOTION_BY_TILES, pool, &moved));
  check_ok(hk_motion_create(system, 0, pool, &still));
  hk_motion_load(system, moved, q, v);
  int64_t lost = 0;
  for (int k = 0; k < 2; k++) {
    hk_motion_pass(system, moved, 0.0, &move);
    lost += moved->coincident;
  }
  hk_motion_store(moved, out, out + 3 * n);
  hk_motion_load(system, still, q, v);
  check_ok(hk_motion_forces(system, still, 0.0));
  lost += still->coincident;
  for (int a = 0; a < 3; a++)
    memcpy(out + 6 * n + a * n, still->f[a], (size_t)n * sizeof(double));
  hk_motion_destroy(moved);
  hk_motion_destroy(still);
  hk_pool_destroy(pool);
  return lost;
}

static void check_members(const hooke_system *system, const double *q, const double *v) {
  static const int32_t workers[] = {2, 3, 8, 16};
  const int64_t count = 9 * system->particle_count;
  double *alone = new_doubles(count), *together = new_doubles(count);
  const int64_t lost = step_with(system, q, v, 1, alone);
  for (int k = 0; k < 4; k++) {
    memset(together, 0, (size_t)count * sizeof *together);
    assert_int_equal(step_with(system, q, v, workers[k], together), lost);
    check_same_bits(count, together, alone);
  }
  free(alone);
  free(together);
}
