/* The objects of cycles.c: a life is an object created, used and destroyed. */
#ifndef TESTS_LONG_LIVES_H
#define TESTS_LONG_LIVES_H

#include "hooke.h"

/* `live` returns a hash of the results of a life; `detail` is its argument. `kept` is the allowed growth of
 * the heap in all lives after the first twentieth [bytes]: 0, or with libhdf5, whose lists of released blocks
 * fill slowly, less than a block in a hundred lives. Tables end with a name of NULL. */
enum { HDF5_KEEPS = 4096 };
struct life {
  const char *name, *detail;
  uint64_t (*live)(const char *detail);
  int64_t kept;
};
extern const struct life object_lives[], file_lives[], measure_lives[];

/* Folder of the files that a life may write, set before the first. */
struct life_files {
  char trajectory[4096], page[4096], scene[4096], checkpoint[4096];
};
extern struct life_files life_files;

/* A committed spring group and rope; the caller destroys it. MANY is enough for a frame to be written by a
 * thread. */
enum { SEGMENTS = 6, MANY = 1400 };
hooke_scene *life_scene(int32_t segments);

/* Time, positions and velocities. */
uint64_t life_hash(hooke_state *state, uint64_t hash);

#endif
