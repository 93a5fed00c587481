#include "io/file/atomic_file.h"

#include "core/crc32.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/os/os.h"
#include "core/os/os_file.h"
#include "core/print.h"
#include "core/status.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int32_t hk_file_fail(const char *path, const char *what, int error) {
  char reason[HOOKE_ERROR_SIZE];
  return hk_fail(error == ENOMEM ? HOOKE_NO_MEMORY : HOOKE_IO_FAILED, NULL, "%s: could not %s: %s", path,
                 what, hk_print_error(error, reason));
}

/* ---- names ---- */

int32_t hk_file_resolve(const char *path, char **resolved) {
  HOOKE_KEEP_ERRNO;
  struct hk_os_file there;
  const int is_new = hk_os_look(path, &there) != 0;
  *resolved = NULL;
  if (!is_new && !there.is_regular) {
    return hk_fail(HOOKE_IO_FAILED, NULL,
                   "%s: is not a regular file, and only such are replaced; name another", path);
  }
  char *whole = is_new ? hk_os_new_path(path) : hk_os_real_path(path);
  if (whole == NULL) return hk_file_fail(path, "follow the path", errno);
  *resolved = hk_copy_text(whole);
  hk_os_free(whole);
  return *resolved ? HOOKE_OK : HOOKE_NO_MEMORY;
}

int hk_file_ends_in(const char *path, const char *ending) {
  const size_t length = strlen(path), end = strlen(ending);
  return length > end && strcmp(path + length - end, ending) == 0;
}

int32_t hk_file_beside(const char *path, const char *ending, char **beside) {
  const char *slash = hk_os_last_slash(path), *name = slash ? slash + 1 : path;
  const size_t length = strlen(name), more = strlen(ending), capacity = strlen(path) + more + 16;
  *beside = hk_new((int64_t)capacity, 1);
  if (*beside == NULL) return HOOKE_NO_MEMORY;
  if (length + more <= HOOKE_OS_NAME_MAX) {
    snprintf(*beside, capacity, "%s%s", path, ending);
  } else {
    const int kept = (int)(name - path) + (int)(HOOKE_OS_NAME_MAX - more - 9);
    snprintf(*beside, capacity, "%.*s~%08x%s", kept, path, hk_crc32(0, name, (int64_t)length), ending);
  }
  return HOOKE_OK;
}

/* ---- existing files ---- */

/* Checks the open descriptor, so that the file cannot be swapped meanwhile. */
int hk_file_open(const char *path) {
  const int descriptor = hk_os_open(path);
  struct hk_os_file there = {.is_regular = 0};
  if (descriptor < 0) return -1;
  if (hk_os_look_open(descriptor, &there) == 0 && there.is_regular) return descriptor;
  close(descriptor);
  errno = there.is_folder ? EISDIR : EINVAL;
  return -1;
}

int32_t hk_file_refuse(int32_t status, int error, const char *kind) {
  if (error == ENOMEM) return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory to open the file");
  if (error == EINVAL)
    return hk_fail(status, NULL, "is not a regular file; allowed: a %s, no pipe and no device", kind);
  if (error == EISDIR) return hk_fail(status, NULL, "is a directory; allowed: a %s", kind);
  char reason[HOOKE_ERROR_SIZE];
  return hk_fail(status, NULL, "cannot be opened: %s; allowed: a %s that can be read",
                 hk_print_error(error, reason), kind);
}

int32_t hk_file_is(const char *path, int descriptor) {
  struct hk_os_file there, ours;
  if (hk_os_look(path, &there) != 0) return hk_file_fail(path, "find the file that was written", errno);
  if (hk_os_look_open(descriptor, &ours) != 0) return hk_file_fail(path, "look at the file", errno);
  if (hk_os_is_same(&there, &ours)) return HOOKE_OK;
  return hk_fail(HOOKE_IO_FAILED, NULL,
                 "%s: another file has taken this name since it was written; it is left as it is", path);
}
