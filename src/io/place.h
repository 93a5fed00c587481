/* The place of a file that is written: under another name beside it until it is ready, then synced and renamed, so that
 * an older file is replaced as a whole or not at all. */
#ifndef HOOKE_IO_PLACE_H
#define HOOKE_IO_PLACE_H

#include "hooke/base.h"

/* Fails with "path: could not <what>: reason"; `error` is an errno. HOOKE_IO_FAILED, HOOKE_NO_MEMORY for ENOMEM. */
int32_t hooke_place_fail(const char *path, const char *what, int error);

/* `place`: `path` with links followed, so that a link stays one when its target is replaced, and from the root, so that
 * it still holds when the process changes its folder; `temporary`: a name beside it. Both are the caller's to free, on
 * failure, too. HOOKE_IO_FAILED if something other than a regular file is there, HOOKE_NO_MEMORY. */
int32_t hooke_place_find(const char *path, char **place, char **temporary);

/* Brings the closed file `temporary` to the disk and gives it the name `place`; then frees and clears `temporary`. A failure
 * leaves the file that was there, but for one: where only the name does not come to the disk the new file is in place, and the
 * message says so. */
int32_t hooke_place_take(const char *place, char **temporary);

/* The same, the file that was there before being kept as `previous`. If that is as far as it comes, there is only the latter. */
int32_t hooke_place_take_and_keep(const char *place, const char *previous, char **temporary);

/* A path with `ending` added, for the caller to free. HOOKE_NO_MEMORY. */
int32_t hooke_place_beside(const char *path, const char *ending, char **beside);

/* Opens a regular file for reading, a link to one, too; what would block or never end is refused: pipes, devices, folders.
 * A descriptor, or -1 with errno; EINVAL if it is no regular file, EISDIR if it is a folder. */
int hooke_place_open(const char *path);

/* Writes a whole file, which takes its place when it is complete. HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hooke_place_write(const char *path, const char *bytes, int64_t length);

/* Two descriptors of one file, or a name and a descriptor. HOOKE_IO_FAILED if another file has taken the name meanwhile, or
 * none has it any more: what is written by the descriptor is then lost. */
int32_t hooke_place_same(const char *path, int descriptor, int other);
int32_t hooke_place_is(const char *path, int descriptor);

#endif
