/* Checkpoint files beside the other output of a run. Numbers have the machine's byte order, as those of
 * frames:
 *
 *   0    "hookeCKP", version u32, 1 if there are velocities and 2 times the callbacks (model/callbacks.h) u32
 *   16   bytes of the file i64, numbers in q i64
 *   32   check values of the system and of the options u32 each
 *   40   method, 32 bytes; run, 64 bytes; both end in zeros
 *   136  t0, t, energy0, scale0, gravity0, gravity_swing, wall_seconds f64 each
 *   192  k, frames, and the counts, the first seven of struct hk_counts i64 each
 *   264  q, then v f64 each
 *   end  CRC-32 of all bytes before it u32 */
#pragma once

#include "hooke/checkpoint.h"

enum { HOOKE_CHECKPOINT_HEADER = 264, HOOKE_CHECKPOINT_END = 4 };

/* Outcome of looking for a checkpoint: of several files, that of the last one examined. */
enum hk_checkpoint_finding {
  HOOKE_CHECKPOINT_FOUND,
  HOOKE_CHECKPOINT_ABSENT,
  HOOKE_CHECKPOINT_DAMAGED,
  HOOKE_CHECKPOINT_OTHER_RUN,
  HOOKE_CHECKPOINT_OTHER /* another scene, other options */
};

/* hooke_checkpoint_read(), with this outcome. */
int32_t hk_checkpoint_take(const char *path, const char *run, hooke_integrator *integrator,
                           hooke_state *state, enum hk_checkpoint_finding *finding);

/* Check value of the options of a run that have a value, given or default, except `threads`, which affects no
 * bit. */
uint32_t hk_checkpoint_options(const hooke_options *options);

/* Removes the file and the previous one, if they exist. */
void hk_checkpoint_remove(const char *path);
