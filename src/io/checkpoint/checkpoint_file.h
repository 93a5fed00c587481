/* Checkpoint files beside the other output of a run. */
#ifndef HOOKE_IO_CHECKPOINT_CHECKPOINT_FILE_H
#define HOOKE_IO_CHECKPOINT_CHECKPOINT_FILE_H

#include "hooke/checkpoint.h"

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

/* Removes the file and the previous one, if they exist. */
void hk_checkpoint_remove(const char *path);

#endif
