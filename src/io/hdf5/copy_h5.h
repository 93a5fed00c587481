/* Groups, attributes and contiguous arrays of a file of ours, made again in another. H5Ocopy does the same,
 * but takes some versions down with it where a write fails; so HDF5 makes the arrays, and what is in them is
 * copied as bytes when it is done with the new file. */
#ifndef HOOKE_IO_HDF5_COPY_H5_H
#define HOOKE_IO_HDF5_COPY_H5_H

#include "io/hdf5/file_h5.h"

#include <stdint.h>

#include <hdf5.h>

/* Bytes that are still to be copied, and who is told why they are not. */
struct hk_h5_copy {
  struct hk_h5_guard *guard;
  int64_t count;
  struct {
    int64_t from, to, bytes;
  } * piece;
};

/* Makes the object `path` and all that is in it, except what is called `skip` (NULL: nothing) and attributes
 * that are references; what is not in this very file is refused. Whatever comes back, hk_h5_copy_release()
 * has to follow at last. Negative on failure. */
herr_t hk_h5_copy(hid_t from, hid_t to, const char *path, const char *skip, struct hk_h5_copy *copy);

/* 0, or the number of the system's error. */
int hk_h5_copy_bytes(const struct hk_h5_copy *copy, int from, int to);

void hk_h5_copy_release(struct hk_h5_copy *copy);

#endif
