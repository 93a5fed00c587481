/* Frames as plain bytes in a file whose arrays are contiguous and of their final size. These functions do not
 * call HDF5, which only one thread at a time may use, so a thread of the library may call them at any time.
 */
#pragma once

#include "hooke/state.h"

enum { HOOKE_OBSERVABLE_COUNT = 6 };

/* The arrays with one row a frame, in the order in which the check value covers their rows. */
enum hk_frame_array {
  HOOKE_FRAME_STEP,
  HOOKE_FRAME_TIME,
  HOOKE_FRAME_POSITION,
  HOOKE_FRAME_VELOCITY,
  HOOKE_FRAME_OBSERVABLE, /* the first of them */
  HOOKE_FRAME_CHECK = HOOKE_FRAME_OBSERVABLE + HOOKE_OBSERVABLE_COUNT,
  HOOKE_FRAME_ARRAY_COUNT
};

struct hk_frame_file {
  const hooke_system *system;
  char group[48];
  int descriptor;                      /* belongs to the file's owner, who sets it; -1: none */
  int64_t particle_count, frame_count; /* frames: those planned; while a file is read -1: not known yet */
  int64_t written;
  int64_t
      at[HOOKE_FRAME_ARRAY_COUNT]; /* offsets of the arrays; in a file that is read also -1: not as here */
};

struct hk_observable {
  const char *name;
  int32_t columns;
};
extern const struct hk_observable hk_observables[HOOKE_OBSERVABLE_COUNT];

/* Numbers in a row of an array, and its bytes. */
int64_t hk_frame_numbers(int64_t particle_count, int array);
int64_t hk_frame_bytes(int64_t particle_count, int array);

/* Bytes of all frames that are planned. */
double hk_frame_all_bytes(const struct hk_frame_file *file);

/* Path of an array of a group: "/particles/all/position/value". */
enum { HOOKE_FRAME_PATH = 160 };
void hk_frame_path(const char *group, int array, char path[HOOKE_FRAME_PATH]);

/* Writes a frame: its numbers, their check value, and its time last. Returns 0 or an errno. */
int hk_frame_write(const struct hk_frame_file *file, int64_t frame, int64_t step, const hooke_state *state);

/* Sets `whole` to 1 if the frame has a time and its numbers match the check value. */
int hk_frame_look(const struct hk_frame_file *file, int64_t frame, int32_t *whole);

/* Copies the first `count` frames unchanged. */
int hk_frame_copy(const struct hk_frame_file *from, const struct hk_frame_file *to, int64_t count);
