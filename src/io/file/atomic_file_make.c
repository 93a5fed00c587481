/* Creates, locks and commits files.
 *
 * The lock is on the file itself, for all of it, and belongs to the open descriptor (F_OFD_SETLK): it ends
 * with the process, and other descriptors of the same process do not share it. HDF5's readers use flock(),
 * which on local file systems is an independent kind of lock. A file is locked before it gets its name, so
 * whoever opens a name finds the lock; after locking, one has to check that the name still belongs to the
 * file. File systems without locks are used without. */
#define _GNU_SOURCE /* F_OFD_SETLK, renameat2() */
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/status.h"
#include "io/file/bytes.h"
#include "io/file/atomic_file.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- locks ---- */

/* A lock of a reader, where flock() is equivalent, is not that of a run. */
static int32_t refuse_written(const char *path, int descriptor) {
  struct flock lock = {.l_type = F_RDLCK, .l_whence = SEEK_SET};
  if (fcntl(descriptor, F_OFD_GETLK, &lock) != 0 || lock.l_type != F_WRLCK) return HOOKE_OK;
  return hk_fail(HOOKE_IO_FAILED, NULL,
                 "%s: another run is writing this file; wait for it to end, or name another file", path);
}

static void unlock(int descriptor) {
  struct flock lock = {.l_type = F_UNLCK, .l_whence = SEEK_SET};
  fcntl(descriptor, F_OFD_SETLK, &lock);
}

static void drop(int descriptor, int32_t own) {
  if (descriptor < 0) return;
  /* a process that was forked meanwhile may hold the descriptor for longer */
  if (own) unlock(descriptor);
  close(descriptor);
}

static int32_t lock(const char *path, int descriptor) {
  struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  return fcntl(descriptor, F_OFD_SETLK, &lock) == 0 ? HOOKE_OK : refuse_written(path, descriptor);
}

/* Readers may hold a lock where flock() and our lock are of one kind, as on NFS: the file is then not locked.
 * `path`: the file's name. */
static void let_readers_in(const char *path, int descriptor) {
  const int reader = open(path, O_RDONLY | O_CLOEXEC);
  if (reader >= 0 && flock(reader, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) unlock(descriptor);
  if (reader >= 0) close(reader);
}

/* Opens and locks the file that has the name at that moment; -1 if there is none. */
static int32_t open_locked(const char *path, int *descriptor) {
  for (;;) {
    struct stat there, own;
    *descriptor = open(path, O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (*descriptor < 0) return errno == ENOENT ? HOOKE_OK : hk_file_fail(path, "open the file", errno);
    const int32_t status = lock(path, *descriptor);
    const int same = stat(path, &there) == 0 && fstat(*descriptor, &own) == 0 && there.st_dev == own.st_dev &&
                     there.st_ino == own.st_ino;
    if (status == HOOKE_OK && same) return status;
    close(*descriptor);
    *descriptor = -1;
    if (status != HOOKE_OK) return status;
  }
}

/* A file without write permission may still be replaced. */
static int32_t look_whether_free(const char *path) {
  const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) return HOOKE_OK;
  const int32_t status = refuse_written(path, descriptor);
  close(descriptor);
  return status;
}

static int32_t lock_older(struct hk_atomic_file *file) {
  if (access(file->path, F_OK) == 0 && access(file->path, W_OK) != 0) return look_whether_free(file->path);
  const int32_t status = open_locked(file->path, &file->older);
  file->is_new = status == HOOKE_OK && file->older < 0;
  return status;
}

/* ---- creating ---- */

/* Copies owner, group and mode of the file to be replaced, as far as permitted. */
static void inherit(int descriptor, const struct stat *older) {
  struct stat own;
  mode_t mode = older->st_mode & 0777;
  if (fstat(descriptor, &own) != 0) return;
  if ((own.st_uid != older->st_uid || own.st_gid != older->st_gid) &&
      fchown(descriptor, older->st_uid, older->st_gid) != 0 &&
      fchown(descriptor, (uid_t)-1, older->st_gid) != 0)
    mode = (mode & ~(mode_t)070) | (mode & 07) << 3; /* another group gets the rights of others */
  (void)fchmod(descriptor, mode);
}

/* A temporary name in the folder of the path, short enough for every file system. */
static int32_t name_anew(struct hk_atomic_file *file) {
  const int folder = (int)(strrchr(file->path, '/') - file->path) + 1;
  const size_t room = (size_t)folder + 32;
  uint64_t number;
  hk_free(file->temporary);
  file->temporary = hk_new((int64_t)room, 1);
  if (file->temporary == NULL) return HOOKE_NO_MEMORY;
  if (getentropy(&number, sizeof number) != 0)
    return hk_file_fail(file->path, "take a random number for a name", errno);
  snprintf(file->temporary, room, "%.*shooke-%016" PRIx64 ".part", folder, file->path, number);
  return HOOKE_OK;
}

static int32_t create(const char *path, struct hk_atomic_file *file) {
  struct stat older;
  const int replaces = stat(file->path, &older) == 0;
  do {
    const int32_t status = name_anew(file);
    if (status != HOOKE_OK) return status;
    /* the replacement of a private file must not be readable, not even for a moment */
    file->descriptor =
        open(file->temporary, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, replaces ? 0600 : 0666);
  } while (file->descriptor < 0 && errno == EEXIST);
  if (file->descriptor < 0) {
    const int error = errno;
    hk_free(file->temporary); /* the file is not ours */
    file->temporary = NULL;
    return hk_file_fail(path, "create the file", error);
  }
  if (replaces) inherit(file->descriptor, &older);
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

int32_t hk_atomic_file_make_locked(const char *path, int32_t again, struct hk_atomic_file *file) {
  HOOKE_KEEP_ERRNO;
  int32_t status = begin(path, file);
  file->locked = 1;
  if (status == HOOKE_OK && !again) status = lock_older(file);
  if (status == HOOKE_OK) status = create(path, file);
  if (status == HOOKE_OK) status = lock(path, file->descriptor);
  if (status == HOOKE_OK) let_readers_in(file->temporary, file->descriptor);
  return status;
}

int32_t hk_atomic_file_lock(const char *path, struct hk_atomic_file *file) {
  HOOKE_KEEP_ERRNO;
  int32_t status = begin(path, file);
  file->locked = 1;
  if (status == HOOKE_OK) status = open_locked(file->path, &file->descriptor);
  if (status == HOOKE_OK && file->descriptor < 0) status = hk_file_fail(path, "open the file", ENOENT);
  if (status == HOOKE_OK) let_readers_in(file->path, file->descriptor);
  return status;
}

/* ---- committing ---- */

static int open_folder_of(const char *path) {
  const char *slash = strrchr(path, '/');
  char *folder = hk_new(slash - path + 2, 1);
  if (folder == NULL) {
    errno = ENOMEM;
    return -1;
  }
  memcpy(folder, path, (size_t)(slash - path) + 1);
  const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  hk_free(folder);
  return descriptor;
}

/* The names of files are data of the folder. */
static int sync_folder(int folder) {
  const int result = fsync(folder);
  /* some file systems cannot sync a folder; the rename is then as durable as they make it */
  return result != 0 && (errno == EINVAL || errno == ENOTSUP) ? 0 : result;
}

/* Renames unless there is such a file; ENOSYS from C libraries that cannot. */
static int rename_if_free(const char *from, const char *to) {
#ifdef RENAME_NOREPLACE
  return renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
#else
  (void)from, (void)to;
  errno = ENOSYS;
  return -1;
#endif
}

/* If there was no file when the run began, another run may have created one. */
static int32_t rename_new(struct hk_atomic_file *file) {
  const char *path = file->path;
  if (file->is_new) {
    if (rename_if_free(file->temporary, path) == 0) return HOOKE_OK;
    if (errno == EEXIST) {
      const int32_t status = look_whether_free(path);
      if (status != HOOKE_OK) return status;
    } else if (errno != EINVAL && errno != ENOSYS) { /* unsupported by some file systems */
      return hk_file_fail(path, "take this name", errno);
    }
  }
  return rename(file->temporary, path) == 0 ? HOOKE_OK : hk_file_fail(path, "take this name", errno);
}

/* Links the older file under a second name, so that the first name always exists; renames where hard links
 * are not supported. */
static int keep_older(const char *path, const char *previous) {
  if (unlink(previous) != 0 && errno != ENOENT) return -1;
  if (link(path, previous) == 0 || errno == ENOENT || errno == EEXIST)
    return 0; /* another process has just done so */
  return errno == EPERM || errno == ENOTSUP || errno == ENOSYS || errno == EMLINK ? rename(path, previous)
                                                                                  : -1;
}

static int32_t take(struct hk_atomic_file *file, const char *previous, int folder) {
  const char *path = file->path;
  /* detect a folder that cannot be synced before anything is replaced */
  if (sync_folder(folder) != 0) return hk_file_fail(path, "bring the name to the disk", errno);
  if (previous && keep_older(path, previous) != 0)
    return hk_file_fail(path, "keep the file that was there", errno);
  const int32_t status = rename_new(file);
  if (status != HOOKE_OK) return status;
  hk_free(file->temporary);
  file->temporary = NULL;
  if (sync_folder(folder) == 0) return HOOKE_OK;
  return hk_file_fail(path, "bring the name to the disk, though the new file is in place", errno);
}

int32_t hk_atomic_file_commit(struct hk_atomic_file *file, const char *previous) {
  HOOKE_KEEP_ERRNO;
  if (fsync(file->descriptor) != 0) return hk_file_fail(file->path, "bring the data to the disk", errno);
  int32_t status = file->locked ? HOOKE_OK : hk_atomic_file_close(file);
  if (status != HOOKE_OK) return status;
  /* open it in advance, so that nothing but the disk can fail once the file has its name */
  const int folder = open_folder_of(file->path);
  if (folder < 0) return hk_file_fail(file->path, "open its folder", errno);
  status = take(file, previous, folder);
  close(folder);
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
  if (file->locked && is_own(file)) unlock(descriptor);
  return close(descriptor) == 0 ? HOOKE_OK : hk_file_fail(file->path, "write", errno);
}

void hk_atomic_file_release(struct hk_atomic_file *file) {
  HOOKE_KEEP_ERRNO;
  const int32_t own = is_own(file);
  drop(file->older, own);
  drop(file->descriptor, file->locked && own);
  if (file->temporary && own) unlink(file->temporary);
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
