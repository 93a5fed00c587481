/* HDF5 files for writing, and guards that keep HDF5's global state as the program has it: nothing printed,
 * the thread's error handler restored, every handle closed on every path. */
#pragma once

#include "hooke/base.h"

#include "io/file/atomic_file.h"

#include <hdf5.h>

/* Replaces the thread's error handler while a file is read or written, and keeps the reason of the first
 * failure. Meanwhile no file makes HDF5 load code. Between begin and end no other thread of hooke is in HDF5.
 * Guards are not nested. */
struct hk_h5_guard {
  const char *path;
  hid_t file;          /* -1: not open */
  double memory_limit; /* of arrays that are read [bytes]; 0: the machine's memory */
  char reason[256];
  int32_t no_memory; /* the reason is missing memory */
  int64_t failures;  /* objects of ours, before */
  unsigned second_version;
  void (*handler)(void);
  void *data;
  unsigned plugins; /* plugin kinds that HDF5 may load, before */
  int error;        /* errno before */
};
/* Begins to read a file; hk_h5_guard_end() has to follow in any case. HOOKE_IO_FAILED. */
int32_t hk_h5_guard_read(struct hk_h5_guard *guard, const char *path);
void hk_h5_guard_end(const struct hk_h5_guard *guard);

/* Opens the file of `guard` for reading, beside the one that is written. HOOKE_IO_FAILED. */
int32_t hk_h5_open(struct hk_h5_guard *guard, hid_t *file);

/* Fails with "path: could not <what>: reason": HOOKE_IO_FAILED, or HOOKE_NO_MEMORY if HDF5 or the library was
 * out of memory. */
int32_t hk_h5_fail(const struct hk_h5_guard *guard, const char *what);

/* A new file while HDF5 writes it. */
struct hk_h5_file {
  struct hk_h5_guard guard;
  hid_t list; /* its access list, which owns the driver: HDF5 uses that until the file is closed */
  int error;  /* errno of the first write that failed */
  const struct hk_atomic_file *atomic;
};

/* Creates a file of at least `bytes`, for which there must be room before anything is written, in one that
 * was just made: default format, no raw data cached in memory, everything aligned to 16 bytes so that no
 * number crosses a page boundary. HOOKE_IO_FAILED, HOOKE_NO_MEMORY; hk_h5_file_settle() has to follow in any
 * case. */
int32_t hk_h5_file_create(double bytes, const struct hk_atomic_file *atomic, struct hk_h5_file *file);

/* Allocates its disk space and closes it for HDF5; from here on bytes in it may be written by the descriptor.
 * With a `status` that is a failure, nothing more is written, and it is returned, unless a failed write came
 * first. HOOKE_IO_FAILED. */
int32_t hk_h5_file_settle(struct hk_h5_file *file, int32_t status);
