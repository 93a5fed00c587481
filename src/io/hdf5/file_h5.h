/* HDF5 files that are written, and the manners of a guest in a larger program: nothing printed, the thread's
 * error handler restored, every handle closed on every path. */
#ifndef HOOKE_IO_HDF5_FILE_H5_H
#define HOOKE_IO_HDF5_FILE_H5_H

#include "hooke/base.h"

#include "io/file/atomic_file.h"

#include <hdf5.h>

/* Stands in for the thread's error handler while we work, and keeps the reason of the first failure. No file
 * makes HDF5 load code meanwhile. HDF5 takes one thread at a time: between begin and end no other thread of
 * hooke is in it. Guards are not nested. */
struct hk_h5_guard {
  char reason[256];
  int32_t no_memory; /* is the reason */
  int64_t failures;  /* of ours, before */
  unsigned second_version;
  void (*handler)(void);
  void *data;
  unsigned plugins; /* kinds that HDF5 may load, before */
  int error;        /* errno before */
};
void hk_h5_guard_begin(struct hk_h5_guard *guard);
void hk_h5_guard_end(const struct hk_h5_guard *guard);

/* Fails with "path: could not <what>: reason": HOOKE_IO_FAILED, or HOOKE_NO_MEMORY where that is the reason,
 * HDF5's or ours. */
int32_t hk_h5_fail(const struct hk_h5_guard *guard, const char *path, const char *what);

struct hk_h5_file {
  hid_t id;
  hid_t list; /* its access list, which holds the driver: HDF5 looks at that until the file is closed */
  int error;  /* of the first write that failed while HDF5 had the file, as errno has it */
  struct hk_atomic_file atomic; /* bytes may be written by its descriptor once HDF5 is done with the file */
};

/* A file that nothing is of yet, which may be released. */
#define HOOKE_NO_H5_FILE ((struct hk_h5_file){.id = -1, .list = -1, .atomic = HOOKE_NO_ATOMIC_FILE})

/* Creates a file that is going to have up to `bytes`, as hk_atomic_file_make() does: default format, no raw
 * data held back in memory, everything aligned to 16 bytes so that no number lies across two pages.
 * HOOKE_IO_FAILED, HOOKE_NO_MEMORY; hk_h5_file_release() has to follow in any case. */
int32_t hk_h5_file_create(struct hk_h5_guard *guard, const char *path, double bytes, struct hk_h5_file *file);

/* The same for the output of a run, as hk_atomic_file_make_locked() does. */
int32_t hk_h5_file_create_locked(struct hk_h5_guard *guard, const char *path, double bytes, int32_t again,
                                 struct hk_h5_file *file);

/* Gives it room on the disk for all of it and closes it for HDF5; from here on bytes in it may be written by
 * the descriptor. HOOKE_IO_FAILED. */
int32_t hk_h5_file_settle(struct hk_h5_guard *guard, struct hk_h5_file *file);

/* Brings everything to the disk and takes the place of an older file; the descriptor stays.
 * HOOKE_IO_FAILED. */
int32_t hk_h5_file_publish(struct hk_h5_file *file);

/* Brings everything to the disk, and closes. HOOKE_IO_FAILED, also if another file has taken the name
 * meanwhile. */
int32_t hk_h5_file_close(struct hk_h5_file *file);

/* Closes for HDF5, brings everything to the disk and takes the place of an older file. HOOKE_IO_FAILED. */
int32_t hk_h5_file_finish(struct hk_h5_guard *guard, struct hk_h5_file *file);

/* Opens the published file for HDF5 to read; HOOKE_IO_FAILED, also if another file has taken the name
 * meanwhile. The caller closes everything that it opens in it. */
int32_t hk_h5_file_open(struct hk_h5_guard *guard, const struct hk_h5_file *file, hid_t *id);

/* Bytes that it has now, by its descriptor. */
double hk_h5_file_bytes(const struct hk_h5_file *file);

/* Closes whatever is still open, removes a file that was not published, and releases the names. */
void hk_h5_file_release(struct hk_h5_file *file);

#endif
