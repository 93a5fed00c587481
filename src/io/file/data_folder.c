#define _GNU_SOURCE /* dladdr */
#include "io/file/data_folder.h"

#include "core/keep_errno.h"
#include "core/print.h"
#include "core/status.h"

#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

/* Paths relative to the folder of the library or, if it is linked statically, of the program: the build tree
 * and the Python package, an installation (CMake knows where its libraries are), a program beside lib. An
 * installation may be moved. */
static const char *const near_library[] = {"share/hooke", HOOKE_DATA_FROM_LIBRARY, "../share/hooke"};
enum { NEAR_COUNT = sizeof near_library / sizeof near_library[0] };

/* The folder that this code was loaded from; "." if it was started by a bare name. */
static void find_own_folder(char *folder, size_t size) {
  static const char here = 0;
  Dl_info info;
  const char *file = dladdr(&here, &info) != 0 && info.dli_fname ? info.dli_fname : "";
  const char *slash = strrchr(file, '/');
  snprintf(folder, size, "%.*s", slash ? (int)(slash - file) : 1, slash ? file : ".");
}

static FILE *open_data(const char *name) {
  char folder[PATH_MAX], path[2 * PATH_MAX];
  find_own_folder(folder, sizeof folder);
  for (int k = 0; k < NEAR_COUNT; k++) {
    snprintf(path, sizeof path, "%s/%s/%s", folder, near_library[k], name);
    FILE *file = fopen(path, "rb");
    if (file || errno == ENOMEM) return file;
  }
  snprintf(path, sizeof path, "%s/%s", HOOKE_DATA_INSTALLED, name);
  return fopen(path, "rb");
}

int32_t hk_data_folder_read(const char *name, struct hk_text *text) {
  HOOKE_KEEP_ERRNO;
  FILE *file = open_data(name);
  if (file == NULL && errno == ENOMEM)
    return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory to open share/hooke/%s", name);
  if (file == NULL) {
    return hk_fail(
        HOOKE_NOT_BUILT, NULL,
        "share/hooke/%s is not where this library looks for it: beside it, or in %s; install hooke "
        "with all its files",
        name, HOOKE_DATA_INSTALLED);
  }
  char piece[1 << 14];
  size_t got;
  while ((got = fread(piece, 1, sizeof piece, file)) > 0)
    hk_text_add(text, piece, (int64_t)got);
  const int error = ferror(file) ? errno : 0;
  fclose(file);
  char reason[HOOKE_ERROR_SIZE];
  if (error) return hk_fail(HOOKE_IO_FAILED, NULL, "share/hooke/%s: %s", name, hk_print_error(error, reason));
  return text->status;
}
