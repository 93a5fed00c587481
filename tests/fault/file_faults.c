#define _GNU_SOURCE /* RTLD_NEXT, open64() and its like */
#include "file_faults.h"

#include "plan.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_DESCRIPTORS = 1024 };

static const char *folder = "";
static char is_ours[MOST_DESCRIPTORS];
static int error_number, cuts_first, only_cuts;
static _Thread_local int has_cut;

void file_faults_in(const char *path) {
  folder = path;
}

void file_faults_are(int error, int32_t short_first) {
  error_number = error;
  cuts_first = short_first;
  has_cut = 0;
}

void file_faults_only_shorten(int32_t only) {
  only_cuts = only;
}

static void *next(const char *name) {
  return dlsym(RTLD_NEXT, name);
}

static int concerns(const char *path) {
  const size_t length = strlen(folder);
  return length > 0 && strncmp(path, folder, length) == 0;
}

static int is_one(int descriptor) {
  return descriptor >= 0 && descriptor < MOST_DESCRIPTORS && is_ours[descriptor];
}

/* Returns 1, and sets errno, if this call has to fail. */
static int fails(int concerned) {
  if (!concerned || only_cuts || !fault_strikes()) return 0;
  errno = error_number;
  return 1;
}

/* ---- opening and closing ---- */

static int open_by(const char *name, const char *path, int flags, mode_t mode) {
  const int ours = concerns(path) && (flags & O_ACCMODE) != O_RDONLY;
  if (fails(ours)) return -1;
  const int descriptor = ((int (*)(const char *, int, mode_t))next(name))(path, flags, mode);
  /* a synced file may be open for reading only */
  if (descriptor >= 0 && descriptor < MOST_DESCRIPTORS) is_ours[descriptor] = (char)concerns(path);
  return descriptor;
}

int open(const char *path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open_by("open", path, flags, mode);
}

int open64(const char *path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open_by("open64", path, flags, mode);
}

/* A failed close() closes all the same, as on Linux. */
int close(int descriptor) {
  int (*const real)(int) = next("close");
  const int ours = is_one(descriptor) && (fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY,
            failed = fails(ours);
  const int number = errno;
  if (descriptor >= 0 && descriptor < MOST_DESCRIPTORS) is_ours[descriptor] = 0;
  const int result = real(descriptor);
  if (!failed) return result;
  errno = number;
  return -1;
}

/* ---- writing ---- */

/* Number of bytes to write, fewer if the write is cut; -1 to fail. */
static ssize_t room_for(int descriptor, size_t count) {
  if (!is_one(descriptor)) return (ssize_t)count;
  if (!fault_strikes()) return (ssize_t)count;
  if ((only_cuts || (cuts_first && !has_cut)) && count > 1) {
    has_cut = 1;
    return (ssize_t)(count / 2);
  }
  if (only_cuts) return (ssize_t)count;
  errno = error_number;
  return -1;
}

ssize_t write(int descriptor, const void *bytes, size_t count) {
  ssize_t (*const real)(int, const void *, size_t) = next("write");
  const ssize_t room = room_for(descriptor, count);
  return room < 0 ? room : real(descriptor, bytes, (size_t)room);
}

ssize_t pwrite(int descriptor, const void *bytes, size_t count, off_t at) {
  ssize_t (*const real)(int, const void *, size_t, off_t) = next("pwrite");
  const ssize_t room = room_for(descriptor, count);
  return room < 0 ? room : real(descriptor, bytes, (size_t)room, at);
}

ssize_t pwrite64(int descriptor, const void *bytes, size_t count, off64_t at) {
  ssize_t (*const real)(int, const void *, size_t, off64_t) = next("pwrite64");
  const ssize_t room = room_for(descriptor, count);
  return room < 0 ? room : real(descriptor, bytes, (size_t)room, at);
}

/* ---- size, disk and name ---- */

int ftruncate(int descriptor, off_t size) {
  return fails(is_one(descriptor)) ? -1 : ((int (*)(int, off_t))next("ftruncate"))(descriptor, size);
}

int ftruncate64(int descriptor, off64_t size) {
  return fails(is_one(descriptor)) ? -1 : ((int (*)(int, off64_t))next("ftruncate64"))(descriptor, size);
}

int posix_fallocate(int descriptor, off_t from, off_t count) {
  if (fails(is_one(descriptor))) return error_number;
  return ((int (*)(int, off_t, off_t))next("posix_fallocate"))(descriptor, from, count);
}

/* Syncs do nothing: no power failures are simulated here. */
int fsync(int descriptor) {
  return fails(is_one(descriptor)) ? -1 : 0;
}

int fdatasync(int descriptor) {
  return fails(is_one(descriptor)) ? -1 : 0;
}

int rename(const char *from, const char *to) {
  return fails(concerns(to)) ? -1 : ((int (*)(const char *, const char *))next("rename"))(from, to);
}

int link(const char *from, const char *to) {
  return fails(concerns(to)) ? -1 : ((int (*)(const char *, const char *))next("link"))(from, to);
}

int renameat2(int from_folder, const char *from, int to_folder, const char *to, unsigned flags) {
  if (fails(concerns(to))) return -1;
  return ((int (*)(int, const char *, int, const char *, unsigned))next("renameat2"))(from_folder, from,
                                                                                      to_folder, to, flags);
}
