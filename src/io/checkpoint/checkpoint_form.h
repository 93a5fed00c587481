/* A checkpoint file. Numbers have the machine's byte order, as those of frames:
 *
 *   0    "hookeCKP", version u32, 1 if there are velocities and 2 times the callbacks (model/callbacks.h) u32
 *   16   bytes of the file i64, numbers in q i64
 *   32   check values of the system and of the options u32 each
 *   40   method, 32 bytes; run, 64 bytes; both end in zeros
 *   136  t0, t, energy0, scale0, gravity0, gravity_swing, wall_seconds f64 each
 *   192  k, frames, and the counts, the first seven of struct hk_counts i64 each
 *   264  q, then v f64 each
 *   end  CRC-32 of all bytes before it u32 */
#ifndef HOOKE_IO_CHECKPOINT_CHECKPOINT_FORM_H
#define HOOKE_IO_CHECKPOINT_CHECKPOINT_FORM_H

#include "integrate/integrator.h"

#include <stddef.h>

enum {
  HOOKE_CHECKPOINT_HEADER = 264,
  HOOKE_CHECKPOINT_METHOD = 32,
  HOOKE_CHECKPOINT_RUN = 64,
  HOOKE_CHECKPOINT_END = 4
};

/* Its first HOOKE_CHECKPOINT_HEADER bytes are those of the file. */
struct hk_checkpoint_header {
  char magic[8];
  uint32_t version, kind; /* without callbacks also where an older version wrote it */
  int64_t length, size;
  uint32_t system, options;
  char method[HOOKE_CHECKPOINT_METHOD], run[HOOKE_CHECKPOINT_RUN];
  struct hk_standing standing;
};
_Static_assert(offsetof(struct hk_checkpoint_header, standing.count.zero_passages) == HOOKE_CHECKPOINT_HEADER,
               "members lie as in the file");

/* Header for the run of an integrator at `standing`. */
void hk_checkpoint_describe(const hooke_integrator *integrator, const struct hk_standing *standing,
                            const char *run, struct hk_checkpoint_header *header);

/* Check value of the options of a run that have a value, given or default, except `threads`, which affects no
 * bit. */
uint32_t hk_checkpoint_options(const hooke_options *options);

/* NULL, or the fault of a header of a file of `length` bytes. */
const char *hk_checkpoint_damage(const struct hk_checkpoint_header *header, int64_t length);
/* HOOKE_BAD_VALUE for one of another problem or other options, or with impossible numbers. */
int32_t hk_checkpoint_check(const char *path, const struct hk_checkpoint_header *header,
                            const hooke_integrator *integrator);

#endif
