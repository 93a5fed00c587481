/* Valid HDF5 files with edits in them: a trajectory that hooke itself wrote, changed by HDF5 or in the bytes
 * of its numbers, in a file in memory. */
#ifndef TESTS_FUZZ_CONTAINER_H
#define TESTS_FUZZ_CONTAINER_H

#include "edit.h"

#include <stdint.h>

/* A number and a text that are in the file beside the container alone: no reader may come to it. The text is
 * longer than an edit can be, as libFuzzer puts what is compared into its inputs. */
#define SECRET_NUMBER 7777.25
#define SECRET_TEXT   "what nobody asked for and no one is told"

struct container {
  char folder[64], path[80];
  const char *const *name; /* of all objects of the trajectory, with a slash before each */
  int32_t names;
  int32_t structures; /* edits that changed the objects */
};

/* Writes the trajectory and the file beside it; once. */
void container_begin(struct container *container);

/* Makes the file at `path` what the edits say. */
void container_edit(struct container *container, const struct edits *edits);

/* The file as a run leaves it that was killed after so many frames of 4, for those who go on with it; as it
 * is for more. Until the next edits, who opens the path opens the file and may write into it. */
void container_kill_after(int64_t frames);

/* The whole of a dataset as HDF5 reads it, without the rules of hooke's readers; the caller frees it. NULL if
 * it cannot be read, lies in another file, or is large. `size` has `rank` <= 4 numbers. */
double *container_read(const struct container *container, const char *dataset, int32_t *rank,
                       int64_t size[4]);

/* Whether anybody has opened a file beside the container since this was last asked. */
int32_t container_others_opened(void);

/* Objects of HDF5 of any kind that are open: the same before and after a call of hooke. */
int64_t container_open_objects(void);

#endif
