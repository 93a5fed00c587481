#include "io/file/atomic_file.h"

#include "core/crc32.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_LINKS = 40 }; /* maximum depth of links, as in Linux */

int32_t hk_file_fail(const char *path, const char *what, int error) {
  char reason[HOOKE_ERROR_SIZE];
  return hk_fail(error == ENOMEM ? HOOKE_NO_MEMORY : HOOKE_IO_FAILED, NULL, "%s: could not %s: %s", path,
                 what, hk_print_error(error, reason));
}

/* ---- names ---- */

/* Puts `name` in the folder of `path`, unless it is absolute. */
static int join(const char *path, const char *name, char joined[PATH_MAX]) {
  const char *slash = name[0] == '/' ? NULL : strrchr(path, '/');
  const int folder = slash ? (int)(slash - path + 1) : 0;
  return snprintf(joined, PATH_MAX, "%.*s%s", folder, path, name) < PATH_MAX ? 0 : ENAMETOOLONG;
}

/* For a dangling link: the name that it points to. */
static int follow(const char *path, char name[PATH_MAX]) {
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

static int32_t find_new(const char *path, char **resolved) {
  char name[PATH_MAX], folder[PATH_MAX] = "";
  const int error = follow(path, name);
  if (error) return hk_file_fail(path, "follow the path", error);
  if (name[0] != '/' && getcwd(folder, sizeof folder) == NULL)
    return hk_file_fail(path, "find the working folder", errno);
  const size_t room = strlen(folder) + strlen(name) + 2;
  *resolved = hk_new((int64_t)room, 1);
  if (*resolved == NULL) return HOOKE_NO_MEMORY;
  snprintf(*resolved, room, "%s%s%s", folder, folder[0] ? "/" : "", name);
  return HOOKE_OK;
}

int32_t hk_file_resolve(const char *path, char **resolved) {
  HOOKE_KEEP_ERRNO;
  struct stat there;
  *resolved = NULL;
  if (stat(path, &there) != 0) return find_new(path, resolved);
  if (!S_ISREG(there.st_mode)) {
    return hk_fail(HOOKE_IO_FAILED, NULL,
                   "%s: is not a regular file, and only such are replaced; name another", path);
  }
  char *real = realpath(path, NULL);
  if (real == NULL) return hk_file_fail(path, "follow the path", errno);
  *resolved = hk_copy_text(real);
  free(real);
  return *resolved ? HOOKE_OK : HOOKE_NO_MEMORY;
}

int32_t hk_file_beside(const char *path, const char *ending, char **beside) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  const size_t length = strlen(name), more = strlen(ending), room = strlen(path) + more + 16;
  *beside = hk_new((int64_t)room, 1);
  if (*beside == NULL) return HOOKE_NO_MEMORY;
  if (length + more <= NAME_MAX) {
    snprintf(*beside, room, "%s%s", path, ending);
  } else {
    const int kept = (int)(name - path) + (int)(NAME_MAX - more - 9);
    snprintf(*beside, room, "%.*s~%08x%s", kept, path, hk_crc32(0, name, (int64_t)length), ending);
  }
  return HOOKE_OK;
}

/* ---- existing files ---- */

/* Checks the open descriptor, so that the file cannot be swapped meanwhile. */
int hk_file_open(const char *path) {
  const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  struct stat there;
  if (descriptor < 0) return -1;
  if (fstat(descriptor, &there) == 0 && S_ISREG(there.st_mode)) return descriptor;
  close(descriptor);
  errno = S_ISDIR(there.st_mode) ? EISDIR : EINVAL;
  return -1;
}

static int32_t compare(const char *path, const struct stat *there, int descriptor) {
  struct stat ours;
  if (fstat(descriptor, &ours) != 0) return hk_file_fail(path, "look at the file", errno);
  if (there->st_dev == ours.st_dev && there->st_ino == ours.st_ino) return HOOKE_OK;
  return hk_fail(HOOKE_IO_FAILED, NULL,
                 "%s: another file has taken this name since it was written; it is left as it is", path);
}

int32_t hk_file_same(const char *path, int descriptor, int other) {
  struct stat there;
  if (fstat(descriptor, &there) != 0) return hk_file_fail(path, "look at the file", errno);
  return compare(path, &there, other);
}

int32_t hk_file_is(const char *path, int descriptor) {
  struct stat there;
  if (stat(path, &there) != 0) return hk_file_fail(path, "find the file that was written", errno);
  return compare(path, &there, descriptor);
}
