#include "io/scene/scene_file.h"

#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/os/os.h"
#include "core/os/os_file.h"
#include "core/print.h"
#include "core/memory_limit.h"
#include "core/status.h"
#include "io/file/atomic_file.h"
#include "io/scene/json.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const int64_t first_piece = 1 << 16;
static const int64_t largest_file = (int64_t)1 << 31;

/* The text twice, and once more while it grows, and its numbers, of two characters at least. */
int32_t hk_scene_require_memory(double limit, int64_t length) {
  return hk_memory_require(limit, 8.0 * (double)length, "this scene");
}

/* Reads to the end; `text` has `capacity` bytes, the last reserved for the NUL. */
static int32_t read_all(FILE *file, const double *memory_limit, char **text, int64_t *length) {
  int64_t capacity = first_piece;
  char reason[HOOKE_ERROR_SIZE];
  *length = 0;
  *text = hk_new(capacity, 1);
  if (*text == NULL) return HOOKE_NO_MEMORY;
  for (;;) {
    errno = 0;
    int64_t got = (int64_t)fread(*text + *length, 1, (size_t)(capacity - *length - 1), file);
    if (got == 0 && ferror(file)) {
      return hk_fail(HOOKE_IO_FAILED, NULL, "reading broke off after %lld bytes: %s", (long long)*length,
                     hk_print_error(errno, reason));
    }
    if (got == 0) break;
    *length += got;
    (*text)[*length] = '\0';
    if (memory_limit && hk_scene_require_memory(*memory_limit, *length)) return HOOKE_NO_MEMORY;
    if (*length > largest_file)
      return hk_fail(HOOKE_BAD_VALUE, NULL, "is larger than 2 GiB; %s",
                     memory_limit ? "keep long arrays in HDF5 files" : "allowed: up to that");
    if (*length < capacity - 1) continue;
    if (memory_limit && hk_json_is_hopeless(*text, *length)) break;
    int32_t status = hk_grow((void **)text, *length, 2 * capacity, 1);
    if (status) return status;
    capacity *= 2;
  }
  (*text)[*length] = '\0';
  return HOOKE_OK;
}

int32_t hk_scene_read_file(const char *path, const double *memory_limit, char **text, int64_t *length) {
  HOOKE_KEEP_ERRNO;
  *text = NULL;
  const int descriptor = hk_file_open(path);
  FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "rb");
  if (file == NULL) {
    const int number = errno;
    if (descriptor >= 0) close(descriptor);
    return hk_file_refuse(HOOKE_BAD_VALUE, number, memory_limit ? "scene or trajectory file" : "file");
  }
  int32_t status = read_all(file, memory_limit, text, length);
  fclose(file);
  if (status) {
    hk_free(*text);
    *text = NULL;
  }
  return status;
}

char *hk_scene_folder(const char *path) {
  const char *slash = hk_os_last_slash(path);
  if (slash == NULL) return hk_copy_text(".");
  if (slash == path) return hk_copy_text("/");
  char *folder = hk_copy_text(path);
  if (folder) folder[slash - path] = '\0';
  return folder;
}

static int climbs(const char *file) {
  for (const char *part = file; part; part = strchr(part, '/')) {
    if (*part == '/') part++;
    if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0')) return 1;
  }
  return 0;
}

static int is_inside(const char *folder, const char *path) {
  size_t length = strlen(folder);
  if (length > 0 && folder[length - 1] == '/') length--;
  return strncmp(folder, path, length) == 0 && path[length] == '/';
}

static char *join(const char *folder, const char *file) {
  const char *base = hk_os_is_absolute(file) ? "" : folder ? folder : ".";
  const size_t capacity = strlen(base) + strlen(file) + 2;
  char *path = hk_new((int64_t)capacity, 1);
  if (path) snprintf(path, capacity, "%s%s%s", base, base[0] ? "/" : "", file);
  return path;
}

int32_t hk_scene_find_file(const char *folder, const char *file, int32_t outside, char **path) {
  HOOKE_KEEP_ERRNO;
  char shown[HOOKE_OPTION_SHOWN], reason[HOOKE_ERROR_SIZE];
  hk_option_show(file, (int64_t)strlen(file), shown);
  *path = outside ? join(folder, file) : NULL;
  if (outside) return *path ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (folder == NULL)
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "\"%s\" is not allowed; this scene has no folder to take files from", shown);
  if (file[0] == '\0' || hk_os_is_absolute(file) || climbs(file))
    return hk_fail(
        HOOKE_BAD_VALUE, NULL,
        "\"%s\" is not allowed; allowed: a path inside the scene's folder, relative and without ..", shown);
  char *joined = join(folder, file);
  if (joined == NULL) return HOOKE_NO_MEMORY;
  int32_t status = HOOKE_OK;
  char *real_folder = hk_os_real_path(folder);
  char *real_file = real_folder ? hk_os_real_path(joined) : NULL;
  if (real_file == NULL && errno == ENOMEM)
    status = hk_fail(HOOKE_NO_MEMORY, NULL, "no memory to find the file");
  else if (real_file == NULL)
    status =
        hk_fail(HOOKE_BAD_VALUE, NULL, "\"%s\" cannot be opened: %s; allowed: a file in the scene's folder",
                shown, hk_print_error(errno, reason));
  else if (!is_inside(real_folder, real_file))
    status = hk_fail(HOOKE_BAD_VALUE, NULL,
                     "\"%s\" leads out of the scene's folder; allowed: a file inside it", shown);
  else if ((*path = hk_copy_text(real_file)) == NULL)
    status = HOOKE_NO_MEMORY;
  hk_os_free(real_folder);
  hk_os_free(real_file);
  hk_free(joined);
  return status;
}
