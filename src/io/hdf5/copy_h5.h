/* Recreates groups, attributes and contiguous arrays of a file in another. H5Ocopy does the same, but crashes
 * some versions of HDF5 if a write fails; so HDF5 creates the arrays, and their contents are copied as bytes
 * after it has closed the new file. */
#ifndef HOOKE_IO_HDF5_COPY_H5_H
#define HOOKE_IO_HDF5_COPY_H5_H

#include "io/hdf5/file_h5.h"

#include <stdint.h>

#include <hdf5.h>

/* Blocks of bytes still to be copied, and a destination for the reason of a failure. */
struct hk_h5_copy {
  struct hk_h5_guard *guard;
  int64_t count;
  struct {
    int64_t from, to, bytes;
  } * piece;
};

/* Recreates the object `path` and everything in it, except members called `skip` (NULL: none) and attributes
 * that are references; data outside this very file are refused. hk_h5_copy_release() has to follow in any
 * case. Negative on failure. */
herr_t hk_h5_copy(hid_t from, hid_t to, const char *path, const char *skip, struct hk_h5_copy *copy);

/* Returns 0 or an errno. */
int hk_h5_copy_bytes(const struct hk_h5_copy *copy, int from, int to);

void hk_h5_copy_release(struct hk_h5_copy *copy);

#endif
