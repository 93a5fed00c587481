/* Creates, locks and commits files.
 *
 * A file is locked before it gets its name, so whoever opens a name finds the lock; after locking, one has to
 * check that the name still belongs to the file. File systems without locks are used without. */
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/os/os_file.h"
#include "core/status.h"
#include "io/file/bytes.h"
#include "io/file/atomic_file.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <unistd.h>

/* ---- locks ---- */

static int32_t refuse_written(const char *path, int descriptor) {
  if (!hk_os_is_locked(descriptor)) return HOOKE_OK;
  return hk_fail(HOOKE_IO_FAILED, NULL,
                 "%s: another run is writing this file; wait for it to end, or name another file", path);
}

static void drop(int descriptor, int32_t own) {
  if (descriptor < 0) return;
  /* a process that was forked meanwhile may hold the descriptor for longer */
  if (own) hk_os_unlock(descriptor);
  close(descriptor);
}

static int32_t lock(const char *path, int descriptor) {
  return hk_os_lock(descriptor) == 0 ? HOOKE_OK : refuse_written(path, descriptor);
}

/* Opens and locks the file that has the name at that moment; -1 if there is none. */
static int32_t open_locked(const char *path, int *descriptor) {
  for (;;) {
    struct hk_os_file there, own;
    *descriptor = hk_os_open_to_change(path);
    if (*descriptor < 0) return errno == ENOENT ? HOOKE_OK : hk_file_fail(path, "open the file", errno);
    const int32_t status = lock(path, *descriptor);
    const int same = hk_os_look(path, &there) == 0 && hk_os_look_open(*descriptor, &own) == 0 &&
                     hk_os_is_same(&there, &own);
    if (status == HOOKE_OK && same) return status;
    close(*descriptor);
    *descriptor = -1;
    if (status != HOOKE_OK) return status;
  }
}

/* A file without write permission may still be replaced. */
static int32_t look_whether_free(const char *path) {
  const int descriptor = hk_os_open(path);
  if (descriptor < 0) return HOOKE_OK;
  const int32_t status = refuse_written(path, descriptor);
  close(descriptor);
  return status;
}

static int32_t lock_older(struct hk_atomic_file *file) {
  struct hk_os_file there;
  if (hk_os_look(file->path, &there) == 0 && !hk_os_may_write(file->path))
    return look_whether_free(file->path);
  const int32_t status = open_locked(file->path, &file->older);
  file->is_new = status == HOOKE_OK && file->older < 0;
  return status;
}

/* ---- creating ---- */

/* A temporary name in the folder of the path, short enough for every file system. */
static int32_t name_anew(struct hk_atomic_file *file) {
  const int folder = (int)(hk_os_last_slash(file->path) - file->path) + 1;
  const size_t capacity = (size_t)folder + 32;
  uint64_t number;
  hk_free(file->temporary);
  file->temporary = hk_new((int64_t)capacity, 1);
  if (file->temporary == NULL) return HOOKE_NO_MEMORY;
  if (hk_os_random(&number, sizeof number) != 0)
    return hk_file_fail(file->path, "take a random number for a name", errno);
  snprintf(file->temporary, capacity, "%.*shooke-%016" PRIx64 ".part", folder, file->path, number);
  return HOOKE_OK;
}

static int32_t create(const char *path, struct hk_atomic_file *file) {
  do {
    const int32_t status = name_anew(file);
    if (status != HOOKE_OK) return status;
    file->descriptor = hk_os_create(file->temporary, file->path);
  } while (file->descriptor < 0 && errno == EEXIST);
  if (file->descriptor < 0) {
    const int error = errno;
    hk_free(file->temporary); /* the file is not ours */
    file->temporary = NULL;
    return hk_file_fail(path, "create the file", error);
  }
  return HOOKE_OK;
}

static int32_t begin(const char *path, struct hk_atomic_file *file) {
  *file = HOOKE_NO_ATOMIC_FILE;
  file->process = getpid();
  return hk_file_resolve(path, &file->path);
}

int32_t hk_atomic_file_make(const char *path, struct hk_atomic_file *file) {
  HOOKE_KEEP_ERRNO;
  int32_t status = begin(path, file);
  if (status == HOOKE_OK) status = look_whether_free(file->path);
  return status == HOOKE_OK ? create(path, file) : status;
}

int32_t hk_atomic_file_check(const char *path) {
  HOOKE_KEEP_ERRNO;
  struct hk_atomic_file file;
  int32_t status = begin(path, &file);
  if (status == HOOKE_OK) status = look_whether_free(path);
  if (status == HOOKE_OK) file.path[hk_os_last_slash(file.path) - file.path + 1] = '\0'; /* its folder */
  if (status == HOOKE_OK && !hk_os_may_write(file.path))
    status = hk_file_fail(path, "create the file", errno);
  hk_atomic_file_release(&file);
  return status;
}

int32_t hk_atomic_file_make_locked(const char *path, int32_t again, struct hk_atomic_file *file) {
  HOOKE_KEEP_ERRNO;
  int32_t status = begin(path, file);
  file->locked = 1;
  if (status == HOOKE_OK && !again) status = lock_older(file);
  if (status == HOOKE_OK) status = create(path, file);
  if (status == HOOKE_OK) status = lock(path, file->descriptor);
  if (status == HOOKE_OK) hk_os_let_readers_in(file->temporary, file->descriptor);
  return status;
}

int32_t hk_atomic_file_lock(const char *path, struct hk_atomic_file *file) {
  HOOKE_KEEP_ERRNO;
  int32_t status = begin(path, file);
  file->locked = 1;
  if (status == HOOKE_OK) status = open_locked(file->path, &file->descriptor);
  if (status == HOOKE_OK && file->descriptor < 0) status = hk_file_fail(path, "open the file", ENOENT);
  if (status == HOOKE_OK) hk_os_let_readers_in(file->path, file->descriptor);
  return status;
}

/* ---- committing ---- */

/* If there was no file when the run began, another run may have created one. */
static int32_t rename_new(struct hk_atomic_file *file) {
  const char *path = file->path;
  if (file->is_new) {
    if (hk_os_rename_if_free(file->temporary, path) == 0) return HOOKE_OK;
    if (errno == EEXIST) {
      const int32_t status = look_whether_free(path);
      if (status != HOOKE_OK) return status;
    } else if (errno != EINVAL && errno != ENOSYS) { /* unsupported by some file systems */
      return hk_file_fail(path, "take this name", errno);
    }
  }
  return hk_os_rename(file->temporary, path, &file->older) == 0 ? HOOKE_OK
                                                                : hk_file_fail(path, "take this name", errno);
}

/* Gives the older file a second name, so that the first one always exists. */
static int keep_older(const char *path, const char *previous) {
  if (hk_os_remove(previous) != 0 && errno != ENOENT) return -1;
  if (hk_os_link(path, previous) == 0) return 0;
  return errno == ENOENT || errno == EEXIST ? 0 : -1; /* another process has just done so */
}

static int32_t take(struct hk_atomic_file *file, const char *previous, int folder) {
  const char *path = file->path;
  /* detect a folder that cannot be synced before anything is replaced */
  if (hk_os_sync_folder(folder) != 0) return hk_file_fail(path, "bring the name to the disk", errno);
  if (previous && keep_older(path, previous) != 0)
    return hk_file_fail(path, "keep the file that was there", errno);
  const int32_t status = rename_new(file);
  if (status != HOOKE_OK) return status;
  hk_free(file->temporary);
  file->temporary = NULL;
  if (hk_os_sync_folder(folder) == 0) return HOOKE_OK;
  return hk_file_fail(path, "bring the name to the disk, though the new file is in place", errno);
}

int32_t hk_atomic_file_commit(struct hk_atomic_file *file, const char *previous) {
  HOOKE_KEEP_ERRNO;
  if (hk_os_sync(file->descriptor) != 0) return hk_file_fail(file->path, "bring the data to the disk", errno);
  int32_t status = file->locked ? HOOKE_OK : hk_atomic_file_close(file);
  if (status != HOOKE_OK) return status;
  /* open it in advance, so that nothing but the disk can fail once the file has its name */
  int folder;
  if (hk_os_open_folder(file->path, &folder) != 0) return hk_file_fail(file->path, "open its folder", errno);
  status = take(file, previous, folder);
  hk_os_close_folder(folder);
  drop(file->older, 1);
  file->older = -1;
  return status;
}

/* ---- closing ---- */

static int32_t is_own(const struct hk_atomic_file *file) {
  return file->process == getpid();
}

int32_t hk_atomic_file_require_own(const struct hk_atomic_file *file) {
  if (is_own(file)) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_CALL, NULL,
                 "%s: belongs to the process that this one was forked from, which alone may write it",
                 file->path);
}

int32_t hk_atomic_file_close(struct hk_atomic_file *file) {
  const int descriptor = file->descriptor;
  file->descriptor = -1;
  if (file->locked && is_own(file)) hk_os_unlock(descriptor);
  return close(descriptor) == 0 ? HOOKE_OK : hk_file_fail(file->path, "write", errno);
}

int32_t hk_atomic_file_finish(struct hk_atomic_file *file) {
  int32_t status = hk_file_is(file->path, file->descriptor);
  if (status == HOOKE_OK && hk_os_sync(file->descriptor) != 0)
    status = hk_file_fail(file->path, "bring the data to the disk", errno);
  const int32_t closed = hk_atomic_file_close(file);
  return status == HOOKE_OK ? closed : status;
}

void hk_atomic_file_release(struct hk_atomic_file *file) {
  HOOKE_KEEP_ERRNO;
  const int32_t own = is_own(file);
  drop(file->older, own);
  drop(file->descriptor, file->locked && own);
  if (file->temporary && own) hk_os_remove(file->temporary);
  hk_free(file->temporary);
  hk_free(file->path);
  *file = HOOKE_NO_ATOMIC_FILE;
}

int32_t hk_file_write(const char *path, const char *bytes, int64_t length) {
  HOOKE_KEEP_ERRNO;
  struct hk_atomic_file file;
  int32_t status = hk_atomic_file_make(path, &file);
  const int error = status == HOOKE_OK ? hk_bytes_write(file.descriptor, 0, length, bytes) : 0;
  if (error) status = hk_file_fail(path, "write", error);
  if (status == HOOKE_OK) status = hk_atomic_file_commit(&file, NULL);
  hk_atomic_file_release(&file);
  return status;
}
