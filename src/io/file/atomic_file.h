/* Files that appear as a whole or not at all: written under a temporary name in the same folder, synced, then
 * renamed over the older file; and the lock by which a run keeps its output to itself. */
#ifndef HOOKE_IO_FILE_ATOMIC_FILE_H
#define HOOKE_IO_FILE_ATOMIC_FILE_H

#include "hooke/base.h"

#include <sys/types.h>

/* Fails with "path: could not <what>: reason"; `error` is an errno. HOOKE_IO_FAILED, HOOKE_NO_MEMORY for
 * ENOMEM. */
int32_t hk_file_fail(const char *path, const char *what, int error);

/* `path` with links followed, so that a link stays one when its target is replaced or made, and from the
 * root, so that it still holds when the process changes its folder; for the caller to free. HOOKE_IO_FAILED
 * if something other than a regular file is there, HOOKE_NO_MEMORY. */
int32_t hk_file_resolve(const char *path, char **resolved);

/* A file that is being written, or one that is locked. */
struct hk_atomic_file {
  char *path;      /* final, as hk_file_resolve() has it */
  char *temporary; /* until it is committed; NULL afterwards */
  int descriptor;  /* of the file, to read and write; -1: none */
  int32_t locked;  /* against other runs */
  int32_t is_new;  /* nothing had the name when a run began */
  int older;       /* the file that it will replace, locked until then; -1: none */
  pid_t process;   /* that made it: a fork of that has the same descriptors, and leaves files alone */
};

/* No file yet; may be released. */
#define HOOKE_NO_ATOMIC_FILE ((struct hk_atomic_file){.descriptor = -1, .older = -1})

/* Makes an empty file under a short random name in the folder of `path`. One that will replace an older file
 * has its mode, and its owner and group as far as the process may give them. HOOKE_IO_FAILED, also if a run
 * is writing the older file; HOOKE_NO_MEMORY. hk_atomic_file_release() has to follow in any case. */
int32_t hk_atomic_file_make(const char *path, struct hk_atomic_file *file);

/* The same for the output of a run: locked against other runs until it is released or closed, or the
 * process ends. `again`: the caller holds the lock of the file that it will replace. */
int32_t hk_atomic_file_make_locked(const char *path, int32_t again, struct hk_atomic_file *file);

/* Opens the file that is there to go on with it, and locks it in the same way. */
int32_t hk_atomic_file_lock(const char *path, struct hk_atomic_file *file);

/* Brings the file to the disk and gives it its name. A failure leaves the file that was there, but for one:
 * where only the name does not come to the disk the new file is there, and the message says so. `previous`: a
 * path for the file that was there; NULL: it goes. The descriptor of a locked file stays open. */
int32_t hk_atomic_file_commit(struct hk_atomic_file *file, const char *previous);

/* Closes the descriptor, after which others may have the file. HOOKE_IO_FAILED. */
int32_t hk_atomic_file_close(struct hk_atomic_file *file);

/* Closes the descriptors, removes a file that was not committed, and frees the names. */
void hk_atomic_file_release(struct hk_atomic_file *file);

/* HOOKE_BAD_CALL in a process that was forked from the one that made it. */
int32_t hk_atomic_file_require_own(const struct hk_atomic_file *file);

/* A path with `ending` added, for the caller to free; a name that would be too long is cut, and ends with a
 * check value of all of it before the ending. HOOKE_NO_MEMORY. */
int32_t hk_file_beside(const char *path, const char *ending, char **beside);

/* Opens a regular file for reading, a link to one, too; what would block or never end is refused: pipes,
 * devices, folders. A descriptor, or -1 with errno; EINVAL if it is no regular file, EISDIR if it is a
 * folder. */
int hk_file_open(const char *path);

/* Writes a whole file, which appears when it is complete. HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hk_file_write(const char *path, const char *bytes, int64_t length);

/* Two descriptors of one file, or a name and a descriptor. HOOKE_IO_FAILED if another file has taken the name
 * meanwhile, or none has it any more: what is written by the descriptor is then lost. */
int32_t hk_file_same(const char *path, int descriptor, int other);
int32_t hk_file_is(const char *path, int descriptor);

#endif
