/* Frames as plain bytes in a file whose arrays are contiguous and of their final size. No HDF5 is called, which one thread
 * at a time may use and which may be the caller's own at any time; so this may be done by a thread of ours. */
#ifndef HOOKE_IO_FRAME_FILE_H
#define HOOKE_IO_FRAME_FILE_H

#include "hooke/state.h"

enum { HOOKE_OBSERVABLE_COUNT = 6 };

struct hooke_frame_file {
  const hooke_system *system;
  int descriptor; /* -1: none */
  /* first bytes of the arrays */
  int64_t time, step, position, velocity, observable[HOOKE_OBSERVABLE_COUNT];
};

struct hooke_observable {
  const char *name;
  int32_t columns;
};
extern const struct hooke_observable hooke_observables[HOOKE_OBSERVABLE_COUNT];

/* Writes a frame, its time last. 0, or the number of the system's error. */
int hooke_frame_write(const struct hooke_frame_file *file, int64_t frame, int64_t step,
                      const hooke_state *state);

#endif
