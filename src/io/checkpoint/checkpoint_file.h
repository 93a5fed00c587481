/* Checkpoint files beside what else a run writes. */
#ifndef HOOKE_IO_CHECKPOINT_CHECKPOINT_FILE_H
#define HOOKE_IO_CHECKPOINT_CHECKPOINT_FILE_H

#include "hooke/checkpoint.h"

/* What was found where a checkpoint was looked for: of several files, the last one that was looked at. */
enum hk_checkpoint_finding {
  HOOKE_CHECKPOINT_FOUND,
  HOOKE_CHECKPOINT_ABSENT,
  HOOKE_CHECKPOINT_DAMAGED,
  HOOKE_CHECKPOINT_OTHER_RUN,
  HOOKE_CHECKPOINT_OTHER /* another scene, other options */
};

/* hooke_checkpoint_read(), and what was found. */
int32_t hk_checkpoint_take(const char *path, const char *run, hooke_integrator *integrator,
                           hooke_state *state, enum hk_checkpoint_finding *finding);

/* The file and the previous one, as far as they are there. */
void hk_checkpoint_remove(const char *path);

#endif
