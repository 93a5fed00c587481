/* Datasets of untrusted files: no links out of the file are followed, and sizes are checked against those
 * that the file can hold. */
#pragma once

#include "io/hdf5/file_h5.h"

struct hk_dataset {
  struct hk_h5_guard *guard;
  const char *name; /* valid while it is opened */
  hid_t id;         /* -1: none */
  int rank;
  hsize_t size[3];
};

/* Opens an array of numbers of rank 1 to 3 that is stored in this very file; the caller closes `id` in any
 * case. HOOKE_IO_FAILED if there is none, HOOKE_BAD_VALUE if it is something else. An optional one that is
 * not there leaves `id` at -1; HOOKE_IO_FAILED if HDF5 cannot tell, such as behind a link to another file. */
int32_t hk_dataset_open(struct hk_h5_guard *guard, const char *name, int32_t optional,
                        struct hk_dataset *data);

/* Like hk_array_read(). Without `check` a frame is not compared with its check value. */
int32_t hk_array_read_open(struct hk_h5_guard *guard, const char *dataset, int64_t frame, int32_t has_frame,
                           int32_t check, double **values, int64_t *rows, int64_t *columns);

/* Fails with HOOKE_BAD_VALUE, "path: dataset <name> <what>". */
int32_t hk_dataset_refuse(const struct hk_dataset *data, const char *what);
