#define _GNU_SOURCE /* F_OFD_SETLK, renameat2() */
#include "core/os/os_file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- names ---- */

const char *hk_os_last_slash(const char *path) {
  return strrchr(path, '/');
}

int32_t hk_os_is_absolute(const char *path) {
  return path[0] == '/';
}

char *hk_os_real_path(const char *path) {
  return realpath(path, NULL);
}

/* Puts `name` in the folder of `path`, unless it is absolute. */
static int join(const char *path, const char *name, char joined[PATH_MAX]) {
  const char *slash = name[0] == '/' ? NULL : strrchr(path, '/');
  const int folder = slash ? (int)(slash - path + 1) : 0;
  return snprintf(joined, PATH_MAX, "%.*s%s", folder, path, name) < PATH_MAX ? 0 : ENAMETOOLONG;
}

/* For a dangling link: the name that it points to. */
static int follow(const char *path, char name[PATH_MAX]) {
  enum { MOST_LINKS = 40 }; /* maximum depth of links, as in Linux */
  int error = join("", path, name);
  for (int k = 0; error == 0 && k < MOST_LINKS; k++) {
    char target[PATH_MAX], joined[PATH_MAX];
    const ssize_t length = readlink(name, target, sizeof target - 1);
    if (length < 0) return 0;
    target[length] = '\0';
    error = join(name, target, joined);
    if (error == 0) memcpy(name, joined, sizeof joined);
  }
  return error ? error : ELOOP;
}

char *hk_os_new_path(const char *path) {
  char name[PATH_MAX], folder[PATH_MAX] = "";
  errno = follow(path, name);
  if (errno || (name[0] != '/' && getcwd(folder, sizeof folder) == NULL)) return NULL;
  const size_t capacity = strlen(folder) + strlen(name) + 2;
  char *whole = malloc(capacity);
  if (whole) snprintf(whole, capacity, "%s%s%s", folder, folder[0] ? "/" : "", name);
  return whole;
}

/* ---- what there is ---- */

static void describe(const struct stat *there, struct hk_os_file *file) {
  *file = (struct hk_os_file){(uint64_t)there->st_dev, (uint64_t)there->st_ino, (int64_t)there->st_size,
                              S_ISREG(there->st_mode), S_ISDIR(there->st_mode)};
}

int hk_os_look(const char *path, struct hk_os_file *file) {
  struct stat there;
  if (stat(path, &there) != 0) return -1;
  describe(&there, file);
  return 0;
}

int hk_os_look_open(int descriptor, struct hk_os_file *file) {
  struct stat there;
  if (fstat(descriptor, &there) != 0) return -1;
  describe(&there, file);
  return 0;
}

int32_t hk_os_is_same(const struct hk_os_file *one, const struct hk_os_file *other) {
  return one->device == other->device && one->number == other->number;
}

int32_t hk_os_may_write(const char *path) {
  return access(path, W_OK) == 0;
}

/* ---- descriptors ---- */

int hk_os_open(const char *path) {
  return open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

int hk_os_open_to_change(const char *path) {
  return open(path, O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

FILE *hk_os_fopen(const char *path) {
  return fopen(path, "rb");
}

/* Copies owner, group and mode of the file to be replaced, as far as permitted. */
static void inherit(int descriptor, const struct stat *older) {
  struct stat own;
  mode_t mode = older->st_mode & 0777;
  if (fstat(descriptor, &own) != 0) return;
  if ((own.st_uid != older->st_uid || own.st_gid != older->st_gid) &&
      fchown(descriptor, older->st_uid, older->st_gid) != 0 &&
      fchown(descriptor, (uid_t)-1, older->st_gid) != 0)
    mode = (mode_t)((mode & ~070U) | (mode & 07U) << 3); /* another group gets the rights of others */
  (void)fchmod(descriptor, mode);
}

/* The replacement of a private file must not be readable, not even for a moment. */
int hk_os_create(const char *path, const char *older) {
  struct stat there;
  const int replaces = stat(older, &there) == 0;
  const int descriptor =
      open(path, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, replaces ? 0600 : 0666);
  if (descriptor >= 0 && replaces) inherit(descriptor, &there);
  return descriptor;
}

int64_t hk_os_read_at(int descriptor, int64_t at, int64_t count, void *bytes) {
  return pread(descriptor, bytes, (size_t)count, (off_t)at);
}

int64_t hk_os_write_at(int descriptor, int64_t at, int64_t count, const void *bytes) {
  return pwrite(descriptor, bytes, (size_t)count, (off_t)at);
}

int hk_os_set_length(int descriptor, int64_t bytes) {
  return ftruncate(descriptor, (off_t)bytes);
}

/* macOS has no posix_fallocate(), and its fsync() leaves data in the memory of the disk. */
#if defined(__APPLE__)

int hk_os_reserve_disk(int descriptor, int64_t bytes) {
  struct hk_os_file now;
  if (hk_os_look_open(descriptor, &now) != 0) return errno;
  if (now.bytes >= bytes) return 0;
  fstore_t capacity = {F_ALLOCATEALL, F_PEOFPOSMODE, 0, bytes - now.bytes, 0};
  if (fcntl(descriptor, F_PREALLOCATE, &capacity) != 0 && errno == ENOSPC) return errno;
  return ftruncate(descriptor, (off_t)bytes) == 0 ? 0 : errno;
}

int hk_os_sync(int descriptor) {
  return fcntl(descriptor, F_FULLFSYNC) == 0 ? 0 : fsync(descriptor);
}

#else

int hk_os_reserve_disk(int descriptor, int64_t bytes) {
  const int error = posix_fallocate(descriptor, 0, (off_t)bytes);
  return error == EINVAL || error == ENOTSUP ? 0 : error;
}

int hk_os_sync(int descriptor) {
  return fsync(descriptor);
}

#endif

/* ---- locks ---- */

#if !defined(F_OFD_SETLK) /* locks of Linux and POSIX 2024; elsewhere runs go without */
#define F_OFD_SETLK (-1)
#define F_OFD_GETLK (-1)
#endif

int hk_os_lock(int descriptor) {
  struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  return fcntl(descriptor, F_OFD_SETLK, &lock);
}

void hk_os_unlock(int descriptor) {
  struct flock lock = {.l_type = F_UNLCK, .l_whence = SEEK_SET};
  fcntl(descriptor, F_OFD_SETLK, &lock);
}

int32_t hk_os_is_locked(int descriptor) {
  struct flock lock = {.l_type = F_RDLCK, .l_whence = SEEK_SET};
  return fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type == F_WRLCK;
}

/* HDF5's readers use flock(), which on local file systems is an independent kind of lock, and on others, as
 * on NFS, the same. */
void hk_os_let_readers_in(const char *path, int descriptor) {
  const int reader = open(path, O_RDONLY | O_CLOEXEC);
  if (reader >= 0 && flock(reader, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) hk_os_unlock(descriptor);
  if (reader >= 0) close(reader);
}

/* ---- folders ---- */

int hk_os_open_folder(const char *path, int *folder) {
  const char *slash = strrchr(path, '/');
  char *name = strndup(path, (size_t)(slash - path) + 1);
  *folder = name ? open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
  free(name);
  return *folder < 0 ? -1 : 0;
}

int hk_os_sync_folder(int folder) {
  const int result = fsync(folder);
  return result != 0 && (errno == EINVAL || errno == ENOTSUP) ? 0 : result;
}

void hk_os_close_folder(int folder) {
  close(folder);
}

int hk_os_rename(const char *from, const char *to, int *older) {
  (void)older;
  return rename(from, to);
}

int hk_os_rename_if_free(const char *from, const char *to) {
#if defined(RENAME_NOREPLACE)
  return renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
#else
  (void)from, (void)to;
  errno = ENOSYS;
  return -1;
#endif
}

int hk_os_link(const char *from, const char *to) {
  if (link(from, to) == 0) return 0;
  const int none = errno == EPERM || errno == ENOTSUP || errno == ENOSYS || errno == EMLINK;
  return none ? rename(from, to) : -1;
}

int hk_os_remove(const char *path) {
  return unlink(path);
}

/* ---- randomness ---- */

int hk_os_random(void *bytes, size_t count) {
  return getentropy(bytes, count);
}
