/* Datasets of files that nobody vouches for: nothing outside the file is followed, and nothing is taken for
 * numbers that the file cannot hold. */
#ifndef HOOKE_IO_HDF5_DATASET_H5_H
#define HOOKE_IO_HDF5_DATASET_H5_H

#include "io/hdf5/file_h5.h"

struct hk_dataset {
  hid_t id; /* -1: none */
  int rank;
  hsize_t size[3];
};

/* Opens a file to read it. HOOKE_IO_FAILED. */
int32_t hk_dataset_file(struct hk_h5_guard *guard, const char *path, hid_t *file);

/* Opens an array of numbers of rank 1 to 3 that is stored in this very file; whatever comes back, the caller
 * drops `id`. HOOKE_IO_FAILED if there is none, HOOKE_BAD_VALUE if it is something else. */
int32_t hk_dataset_open(struct hk_h5_guard *guard, hid_t file, const char *path, const char *name,
                        struct hk_dataset *data);

/* The same where there may be none, which leaves `id` at -1. HOOKE_IO_FAILED also where HDF5 cannot tell, as
 * behind a link to another file. */
int32_t hk_dataset_find(struct hk_h5_guard *guard, hid_t file, const char *path, const char *name,
                        struct hk_dataset *data);

/* Bytes that HDF5 takes, besides the numbers, to read so much of it along each dimension: a whole chunk
 * however little of it is asked for, and what it keeps of each. */
double hk_dataset_read_bytes(const struct hk_dataset *data, const hsize_t *part);

/* Fails with HOOKE_BAD_VALUE, "path: dataset <name> <what>". */
int32_t hk_dataset_refuse(const char *path, const char *name, const char *what);

#endif
