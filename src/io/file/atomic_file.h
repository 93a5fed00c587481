/* Atomic files: written under a temporary name in the same folder, synced, then renamed over the older file;
 * and the lock that reserves an output file for one run. */
#pragma once

#include "hooke/base.h"

/* Fails with "path: could not <what>: reason"; `error` is an errno. HOOKE_IO_FAILED, HOOKE_NO_MEMORY for
 * ENOMEM. */
int32_t hk_file_fail(const char *path, const char *what, int error);

/* Resolves the links in `path`, so that a link remains one when its target is replaced or created, and makes
 * it absolute, so that it remains valid when the process changes its folder; the caller frees it.
 * HOOKE_IO_FAILED if the path is something other than a regular file, HOOKE_NO_MEMORY. */
int32_t hk_file_resolve(const char *path, char **resolved);

/* A file that is being written, or a locked one. */
struct hk_atomic_file {
  char *path;      /* final, resolved by hk_file_resolve() */
  char *temporary; /* until it is committed; NULL afterwards */
  int descriptor;  /* of the file, for reading and writing; -1: none */
  int32_t locked;  /* against other runs */
  int32_t is_new;  /* no file had the name when a run began */
  int older;       /* the file to be replaced, locked until then; -1: none */
  int64_t process; /* process that made it: a forked one has the same descriptors, and leaves files alone */
};

/* Initial value, which may be released. */
#define HOOKE_NO_ATOMIC_FILE ((struct hk_atomic_file){.descriptor = -1, .older = -1})

/* Creates an empty file under a short random name in the folder of `path`. If it will replace an older file
 * it gets its mode, and its owner and group as far as the process may set them. HOOKE_IO_FAILED, also if a
 * run is writing the older file; HOOKE_NO_MEMORY. hk_atomic_file_release() has to follow in any case. */
int32_t hk_atomic_file_make(const char *path, struct hk_atomic_file *file);

/* Whether that would be refused now, without creating anything. */
int32_t hk_atomic_file_check(const char *path);

/* The same for the output of a run: locked against other runs until it is released or closed, or the process
 * ends. `again`: the caller already holds the lock of the file to be replaced. */
int32_t hk_atomic_file_make_locked(const char *path, int32_t again, struct hk_atomic_file *file);

/* Opens the existing file to continue it, and locks it in the same way. */
int32_t hk_atomic_file_lock(const char *path, struct hk_atomic_file *file);

/* Flushes the file to the disk and renames it to its final name. A failure leaves the older file in place,
 * with one exception: if only the name cannot be flushed, the new file is in place, and the message says so.
 * `previous`: a path to keep the older file under; NULL: it is removed. The descriptor of a locked file stays
 * open. */
int32_t hk_atomic_file_commit(struct hk_atomic_file *file, const char *previous);

/* Closes the descriptor, and with it the lock. HOOKE_IO_FAILED. */
int32_t hk_atomic_file_close(struct hk_atomic_file *file);

/* The same after checking that the file still has its name, and flushing it to the disk. */
int32_t hk_atomic_file_finish(struct hk_atomic_file *file);

/* Closes the descriptors, removes a file that was not committed, and frees the names. */
void hk_atomic_file_release(struct hk_atomic_file *file);

/* HOOKE_BAD_CALL in a process that was forked from the one that made it. */
int32_t hk_atomic_file_require_own(const struct hk_atomic_file *file);

/* 1 if the name ends so, and has more before it. */
int hk_file_ends_in(const char *path, const char *ending);

/* A path with `ending` appended, which the caller frees; a name that would be too long is truncated and ends
 * with a check value of the whole name before the ending. HOOKE_NO_MEMORY. */
int32_t hk_file_beside(const char *path, const char *ending, char **beside);

/* Opens a regular file for reading, also through a link. Pipes, devices and folders, which might block or
 * never end, are refused. Returns a descriptor, or -1 with errno; EINVAL if it is no regular file, EISDIR if
 * it is a folder. */
int hk_file_open(const char *path);

/* Fails with `status`, or HOOKE_NO_MEMORY, with its reason and what is allowed: a `kind`, such as "scene
 * file". The message does not name the file. */
int32_t hk_file_refuse(int32_t status, int error, const char *kind);

/* Writes a whole file atomically. HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hk_file_write(const char *path, const char *bytes, int64_t length);

/* HOOKE_IO_FAILED if another file than that of the descriptor has the name meanwhile, or none any more: data
 * written by the descriptor would be lost. */
int32_t hk_file_is(const char *path, int descriptor);
