#include "io/place.h"

#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "io/bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int32_t hooke_place_fail(const char *path, const char *what, int error) {
  char reason[HOOKE_ERROR_SIZE];
  return hooke_fail(error == ENOMEM ? HOOKE_NO_MEMORY : HOOKE_IO_FAILED, NULL, "%s: could not %s: %s", path,
                    what, hooke_print_error(error, reason));
}

static int32_t find(const char *path, char **place) {
  struct stat there;
  if (stat(path, &there) == 0) {
    if (!S_ISREG(there.st_mode)) {
      return hooke_fail(HOOKE_IO_FAILED, NULL,
                        "%s: is not a regular file, and only such are replaced; name another", path);
    }
    char *real = realpath(path, NULL);
    if (real == NULL) return hooke_place_fail(path, "follow the path", errno);
    *place = hooke_copy_text(real);
    free(real);
  } else if (path[0] == '/') {
    *place = hooke_copy_text(path);
  } else {
    char folder[PATH_MAX];
    if (getcwd(folder, sizeof folder) == NULL)
      return hooke_place_fail(path, "find the working folder", errno);
    const size_t room = strlen(folder) + strlen(path) + 2;
    *place = hooke_new((int64_t)room, 1);
    if (*place) snprintf(*place, room, "%s/%s", folder, path);
  }
  return *place ? HOOKE_OK : HOOKE_NO_MEMORY;
}

int32_t hooke_place_find(const char *path, char **place, char **temporary) {
  HOOKE_KEEP_ERRNO;
  *place = NULL;
  *temporary = NULL;
  const int32_t status = find(path, place);
  if (status != HOOKE_OK) return status;
  const size_t room = strlen(*place) + 32;
  *temporary = hooke_new((int64_t)room, 1);
  if (*temporary == NULL) return HOOKE_NO_MEMORY;
  snprintf(*temporary, room, "%s.%ld.part", *place, (long)getpid());
  return HOOKE_OK;
}

/* Asked of what was opened, so that nothing can be put in its place in between. */
int hooke_place_open(const char *path) {
  const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  struct stat there;
  if (descriptor < 0) return -1;
  if (fstat(descriptor, &there) == 0 && S_ISREG(there.st_mode)) return descriptor;
  close(descriptor);
  errno = S_ISDIR(there.st_mode) ? EISDIR : EINVAL;
  return -1;
}

static int sync_path(const char *path) {
  int descriptor = open(path, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return -1;
  int result = fsync(descriptor);
  int error = errno;
  close(descriptor);
  errno = error;
  return result;
}

static int32_t compare(const char *path, const struct stat *there, int descriptor) {
  struct stat ours;
  if (fstat(descriptor, &ours) != 0) return hooke_place_fail(path, "look at the file", errno);
  if (there->st_dev == ours.st_dev && there->st_ino == ours.st_ino) return HOOKE_OK;
  return hooke_fail(HOOKE_IO_FAILED, NULL,
                    "%s: another file has taken this name since it was written; it is left as it is", path);
}

int32_t hooke_place_same(const char *path, int descriptor, int other) {
  struct stat there;
  if (fstat(descriptor, &there) != 0) return hooke_place_fail(path, "look at the file", errno);
  return compare(path, &there, other);
}

int32_t hooke_place_is(const char *path, int descriptor) {
  struct stat there;
  if (stat(path, &there) != 0) return hooke_place_fail(path, "find the file that was written", errno);
  return compare(path, &there, descriptor);
}

static int open_folder_of(const char *path) {
  const char *slash = strrchr(path, '/');
  char *folder = hooke_new(slash - path + 2, 1);
  if (folder == NULL) {
    errno = ENOMEM;
    return -1;
  }
  memcpy(folder, path, (size_t)(slash - path) + 1);
  const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  hooke_free(folder);
  return descriptor;
}

/* The names of a folder's files are data of the folder. */
static int sync_folder(int folder) {
  const int result = fsync(folder);
  /* some file systems cannot do this for a folder; the rename is then as durable as they make it */
  return result != 0 && (errno == EINVAL || errno == ENOTSUP) ? 0 : result;
}

int32_t hooke_place_beside(const char *path, const char *ending, char **beside) {
  const size_t room = strlen(path) + strlen(ending) + 1;
  *beside = hooke_new((int64_t)room, 1);
  if (*beside == NULL) return HOOKE_NO_MEMORY;
  snprintf(*beside, room, "%s%s", path, ending);
  return HOOKE_OK;
}

int32_t hooke_place_take(const char *place, char **temporary) {
  return hooke_place_take_and_keep(place, NULL, temporary);
}

static int32_t take(const char *place, const char *previous, char **temporary, int folder) {
  /* a folder that cannot do this is found out before anything is replaced */
  if (sync_folder(folder) != 0) return hooke_place_fail(place, "bring the name to the disk", errno);
  if (previous && rename(place, previous) != 0 && errno != ENOENT)
    return hooke_place_fail(place, "keep the file that was there", errno);
  if (rename(*temporary, place) != 0) return hooke_place_fail(place, "take this name", errno);
  hooke_free(*temporary);
  *temporary = NULL;
  if (sync_folder(folder) == 0) return HOOKE_OK;
  return hooke_place_fail(place, "bring the name to the disk, though the new file is in place", errno);
}

int32_t hooke_place_take_and_keep(const char *place, const char *previous, char **temporary) {
  HOOKE_KEEP_ERRNO;
  if (sync_path(*temporary) != 0) return hooke_place_fail(place, "bring the data to the disk", errno);
  /* opened once, so that nothing but the disk can fail when the file has its name */
  const int folder = open_folder_of(place);
  if (folder < 0) return hooke_place_fail(place, "open its folder", errno);
  const int32_t status = take(place, previous, temporary, folder);
  close(folder);
  return status;
}

static int32_t write_bytes(const char *path, const char *temporary, const char *bytes, int64_t length) {
  unlink(temporary);
  const int descriptor = open(temporary, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) return hooke_place_fail(path, "create the file", errno);
  int error = hooke_bytes_write(descriptor, 0, length, bytes);
  if (close(descriptor) != 0 && error == 0) error = errno;
  return error ? hooke_place_fail(path, "write", error) : HOOKE_OK;
}

int32_t hooke_place_write(const char *path, const char *bytes, int64_t length) {
  HOOKE_KEEP_ERRNO;
  char *place = NULL, *temporary = NULL;
  int32_t status = hooke_place_find(path, &place, &temporary);
  if (status == HOOKE_OK) status = write_bytes(path, temporary, bytes, length);
  if (status == HOOKE_OK) status = hooke_place_take(place, &temporary);
  if (temporary) unlink(temporary);
  hooke_free(temporary);
  hooke_free(place);
  return status;
}
