/* Valid HDF5 files with edits in them: a trajectory that hooke itself wrote, changed by HDF5 or in the bytes
 * of its numbers, in a file in memory. */
#pragma once

#include "edit.h"

#include <stdint.h>

/* A number and a text that are only in the file beside the container, which no reader may reach. The text is
 * longer than an edit can be, as libFuzzer puts compared texts into its inputs. */
#define SECRET_NUMBER 7777.25
#define SECRET_TEXT   "what nobody asked for and no one is told"

struct container {
  char folder[64], path[80];
  const char *const *name; /* names of all objects of the trajectory, with a slash before each */
  int32_t names;
  int32_t structures; /* edits that changed the objects */
};

/* Writes the trajectory and the file beside it; once. */
void container_begin(struct container *container);

/* Applies the edits to the file at `path`. */
void container_edit(struct container *container, const struct edits *edits);

/* The file as left by a run that was killed after so many of 4 frames, for continuing it; the whole file for
 * more. Until the next edits, opening the path opens this file, also for writing. */
void container_kill_after(int64_t frames);

/* The whole of a dataset as HDF5 reads it, without the rules of hooke's readers; the caller frees it. NULL if
 * it cannot be read, is in another file, or is large. `size` has `rank` <= 4 numbers. */
double *container_read(const struct container *container, const char *dataset, int32_t *rank,
                       int64_t size[4]);

/* 1 if the file says that its run is over, so that all of its frames exist. */
int32_t container_is_over(const struct container *container);

/* True if a file beside the container was opened since the last call. */
int32_t container_others_opened(void);

/* Number of open HDF5 objects of any kind: the same before and after a call of hooke. */
int64_t container_open_objects(void);
