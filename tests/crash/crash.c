/* Kills a process at one of its writes; to be loaded before all libraries (LD_PRELOAD). Every call that
 * changes a regular file or a name is a point. HOOKE_CRASH_AT=n kills at the n-th: before the call or, with
 * HOOKE_CRASH_TORN=1, in the middle of it, when half of the bytes are written, or after it if there are no
 * bytes. With HOOKE_CRASH_ERROR=number the call fails with this errno instead; with HOOKE_CRASH_FROM=1 so
 * does every later call; with HOOKE_CRASH_SIGNAL=number the process gets this signal there, and the call is
 * made. HOOKE_CRASH_LOG names a log file: it gets a line "frame <time>" when the time of a frame is in its
 * file, and at the end "points <count>". HOOKE_CRASH_CALLS names another, which gets a line for every call
 * that has to do with names of files: call, flags, mode and names. Random numbers then come twice each, and
 * the first is 0.
 *
 * System calls are made directly. Streams write through a function defined here, since the C library's own
 * functions cannot be intercepted. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static atomic_long passed;
static long at = -1;
static int torn, failure, from_here_on, number_of_signal, journal = -1, calls = -1;
/* The time is the 8 bytes written right after the 4 of the check value. */
static _Thread_local int after_check;

static long number_of(const char *name, long fallback) {
  const char *text = getenv(name);
  return text ? strtol(text, NULL, 10) : fallback;
}

static int open_log(const char *name) {
  const char *path = getenv(name);
  return path ? (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600)
              : -1;
}

__attribute__((constructor)) static void begin(void) {
  at = number_of("HOOKE_CRASH_AT", -1);
  torn = (int)number_of("HOOKE_CRASH_TORN", 0);
  failure = (int)number_of("HOOKE_CRASH_ERROR", 0);
  from_here_on = (int)number_of("HOOKE_CRASH_FROM", 0);
  number_of_signal = (int)number_of("HOOKE_CRASH_SIGNAL", 0);
  journal = open_log("HOOKE_CRASH_LOG");
  calls = open_log("HOOKE_CRASH_CALLS");
}

static void tell(const char *line, int length) {
  if (journal >= 0) syscall(SYS_write, journal, line, (size_t)length);
}

__attribute__((destructor)) static void end(void) {
  char line[64];
  tell(line, snprintf(line, sizeof line, "points %ld\n", atomic_load(&passed)));
}

static void see(const char *call, int flags, unsigned mode, const char *path, const char *other) {
  char line[2048];
  const int length =
      calls < 0 ? 0 : snprintf(line, sizeof line, "%s\t%d\t%u\t%s\t%s\n", call, flags, mode, path, other);
  if (length > 0) syscall(SYS_write, calls, line, (size_t)length);
}

static void see_descriptor(const char *call, int descriptor, unsigned mode) {
  char link[64], path[1024];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = calls < 0 ? -1 : readlink(link, path, sizeof path - 1);
  if (length < 0) return;
  path[length] = '\0';
  see(call, 0, mode, path, "");
}

static int is_file(int descriptor) {
  struct stat there;
  return fstat(descriptor, &there) == 0 && S_ISREG(there.st_mode);
}

static int is_here(void) {
  const long point = atomic_fetch_add(&passed, 1) + 1;
  if (number_of_signal && point == at) syscall(SYS_kill, getpid(), number_of_signal);
  if (number_of_signal) return 0;
  return point == at || (from_here_on && at > 0 && point > at);
}

static int fail(void) {
  errno = failure;
  return -1;
}

static void die(void) {
  syscall(SYS_kill, getpid(), SIGKILL);
  for (;;)
    pause();
}

static ssize_t write_bytes(int descriptor, const void *bytes, size_t count, off_t place, int has_place) {
  const int here = is_file(descriptor) && is_here();
  if (here && failure) return fail();
  see_descriptor("write", descriptor, 0);
  const size_t some = here ? torn ? count / 2 : 0 : count;
  ssize_t done = 0;
  if (some > 0 || !here)
    done = has_place ? syscall(SYS_pwrite64, descriptor, bytes, some, place)
                     : syscall(SYS_write, descriptor, bytes, some);
  if (here) die();
  return done;
}

static void see_frame(const void *bytes, size_t count) {
  char line[64];
  double time;
  if (after_check && count == sizeof time) {
    memcpy(&time, bytes, sizeof time);
    if (isfinite(time)) tell(line, snprintf(line, sizeof line, "frame %a\n", time)); /* else another number */
  }
  after_check = count == 4;
}

ssize_t pwrite(int descriptor, const void *bytes, size_t count, off_t place) {
  const ssize_t done = write_bytes(descriptor, bytes, count, place, 1);
  if (done == (ssize_t)count) see_frame(bytes, count);
  return done;
}

ssize_t pwrite64(int descriptor, const void *bytes, size_t count, off_t place) {
  return write_bytes(descriptor, bytes, count, place, 1);
}

ssize_t write(int descriptor, const void *bytes, size_t count) {
  return write_bytes(descriptor, bytes, count, 0, 0);
}

/* A call without bytes: torn, it has no effect or its whole effect. */
#define CALL(counts, call)                                                                                   \
  const int here = (counts) && is_here();                                                                    \
  if (here && failure) return fail();                                                                        \
  if (here && !torn) die();                                                                                  \
  const int result = (int)(call);                                                                            \
  if (here) die();                                                                                           \
  return result

int ftruncate(int descriptor, off_t length) {
  CALL(is_file(descriptor), syscall(SYS_ftruncate, descriptor, length));
}

int ftruncate64(int descriptor, off_t length) {
  CALL(is_file(descriptor), syscall(SYS_ftruncate, descriptor, length));
}

int truncate(const char *path, off_t length) {
  CALL(1, syscall(SYS_truncate, path, length));
}

static int fallocate_here(int descriptor, off_t first, off_t length) {
  CALL(1, syscall(SYS_fallocate, descriptor, 0, first, length));
}

int posix_fallocate(int descriptor, off_t first, off_t length) {
  return fallocate_here(descriptor, first, length) == 0 ? 0 : errno;
}

int fsync(int descriptor) {
  see_descriptor("fsync", descriptor, 0);
  CALL(1, syscall(SYS_fsync, descriptor));
}

int fdatasync(int descriptor) {
  see_descriptor("fsync", descriptor, 0);
  CALL(1, syscall(SYS_fdatasync, descriptor));
}

int rename(const char *from, const char *to) {
  see("rename", 0, 0, from, to);
  CALL(1, syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to));
}

int renameat2(int from_folder, const char *from, int to_folder, const char *to, unsigned flags) {
  see("rename", 0, 0, from, to);
  CALL(1, syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

int fchmod(int descriptor, mode_t mode) {
  see_descriptor("fchmod", descriptor, mode);
  return (int)syscall(SYS_fchmod, descriptor, mode);
}

int open(const char *path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
  va_end(more);
  if ((flags & O_ACCMODE) != O_RDONLY) see("open", flags, mode, path, "");
  return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

int getentropy(void *bytes, size_t count) {
  static atomic_long numbers;
  if (calls < 0) return syscall(SYS_getrandom, bytes, count, 0) == (long)count ? 0 : -1;
  const long number = atomic_fetch_add(&numbers, 1) / 2;
  memset(bytes, 0, count);
  memcpy(bytes, &number, count < sizeof number ? count : sizeof number);
  return 0;
}

int link(const char *from, const char *to) {
  CALL(1, syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int unlink(const char *path) {
  CALL(1, syscall(SYS_unlinkat, AT_FDCWD, path, 0));
}

/* A failed close() closes all the same, as on Linux. */
int close(int descriptor) {
  const int counts = is_file(descriptor) && (fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY;
  const int here = counts && is_here();
  if (here && !failure && !torn) die();
  const int result = (int)syscall(SYS_close, descriptor);
  if (here && failure) return fail();
  if (here) die();
  return result;
}

/* ---- streams ---- */

static ssize_t write_stream(void *stream, const char *bytes, size_t count) {
  return write((int)(intptr_t)stream, bytes, count);
}

static int close_stream(void *stream) {
  return close((int)(intptr_t)stream);
}

FILE *fopen(const char *path, const char *mode) {
  FILE *(*ours)(const char *, const char *);
  void *symbol = dlsym(RTLD_NEXT, "fopen");
  memcpy(&ours, &symbol, sizeof ours);
  struct stat there;
  if (mode[0] != 'w' || (stat(path, &there) == 0 && !S_ISREG(there.st_mode))) return ours(path, mode);
  const int fresh = strchr(mode, 'x') != NULL;
  const int descriptor = open(path, O_WRONLY | O_CREAT | O_CLOEXEC | (fresh ? O_EXCL : O_TRUNC), 0666);
  if (descriptor < 0) return NULL;
  return fopencookie((void *)(intptr_t)descriptor, "w",
                     (cookie_io_functions_t){.write = write_stream, .close = close_stream});
}
