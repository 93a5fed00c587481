/* The place of a file that is written: under a name of its own in the same folder until it is ready, then
 * synced and renamed, so that an older file is replaced as a whole or not at all; and the lock by which a run
 * keeps its output to itself. */
#ifndef HOOKE_IO_FILE_PLACE_H
#define HOOKE_IO_FILE_PLACE_H

#include "hooke/base.h"

#include <sys/types.h>

/* Fails with "path: could not <what>: reason"; `error` is an errno. HOOKE_IO_FAILED, HOOKE_NO_MEMORY for
 * ENOMEM. */
int32_t hk_place_fail(const char *path, const char *what, int error);

/* `path` with links followed, so that a link stays one when its target is replaced or made, and from the
 * root, so that it still holds when the process changes its folder; for the caller to free. HOOKE_IO_FAILED
 * if something other than a regular file is there, HOOKE_NO_MEMORY. */
int32_t hk_place_find(const char *path, char **place);

/* A file on its way, or one that is held. */
struct hk_place {
  char *path;      /* where it is going to be, as hk_place_find() has it */
  char *temporary; /* where it is until then; NULL once it has its place */
  int descriptor;  /* of the file, to read and write; -1: none */
  int32_t holds;   /* against other runs */
  int32_t is_new;  /* nothing had the name when a run began */
  int older;       /* the file that it will replace, held until then; -1: none */
  pid_t process;   /* that made it: a fork of that has the same descriptors, and leaves files alone */
};

/* A place that nothing is in yet, which may be released. */
#define HOOKE_NO_PLACE ((struct hk_place){.descriptor = -1, .older = -1})

/* Makes an empty file under a short random name in the folder of `path`. One that will replace an older file
 * has its mode, and its owner and group as far as the process may give them. HOOKE_IO_FAILED, also if a run
 * is writing the older file; HOOKE_NO_MEMORY. hk_place_release() has to follow in any case. */
int32_t hk_place_make(const char *path, struct hk_place *place);

/* The same for the output of a run: no other run can have it until the place is released or closed, or the
 * process ends. `again`: the file that it will replace is held by the caller. */
int32_t hk_place_make_held(const char *path, int32_t again, struct hk_place *place);

/* Opens the file that is there to go on with it, and holds it in the same way. */
int32_t hk_place_hold(const char *path, struct hk_place *place);

/* Brings the file to the disk and gives it its name. A failure leaves the file that was there, but for one:
 * where only the name does not come to the disk the new file is in place, and the message says so.
 * `previous`: a path for the file that was there; NULL: it goes. The descriptor of a held file stays open. */
int32_t hk_place_take(struct hk_place *place, const char *previous);

/* Closes the descriptor, after which others may have the file. HOOKE_IO_FAILED. */
int32_t hk_place_close(struct hk_place *place);

/* Closes what is open, removes a file that did not come to its place, and frees the names. */
void hk_place_release(struct hk_place *place);

/* HOOKE_BAD_CALL in a process that was forked from the one that made it. */
int32_t hk_place_require_own(const struct hk_place *place);

/* A path with `ending` added, for the caller to free; a name that would be too long is cut, and ends with a
 * check value of all of it before the ending. HOOKE_NO_MEMORY. */
int32_t hk_place_beside(const char *path, const char *ending, char **beside);

/* Opens a regular file for reading, a link to one, too; what would block or never end is refused: pipes,
 * devices, folders. A descriptor, or -1 with errno; EINVAL if it is no regular file, EISDIR if it is a
 * folder. */
int hk_place_open(const char *path);

/* Writes a whole file, which takes its place when it is complete. HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
int32_t hk_place_write(const char *path, const char *bytes, int64_t length);

/* Two descriptors of one file, or a name and a descriptor. HOOKE_IO_FAILED if another file has taken the name
 * meanwhile, or none has it any more: what is written by the descriptor is then lost. */
int32_t hk_place_same(const char *path, int descriptor, int other);
int32_t hk_place_is(const char *path, int descriptor);

#endif
