#include "io/page/form.h"

#include "core/keep_errno.h"
#include "core/os/os.h"
#include "core/os/os_file.h"
#include "core/print.h"
#include "core/status.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* Paths relative to the folder of the library or, if it is linked statically, of the program: the build tree
 * and the Python package, an installation (CMake knows where its libraries are), a program beside lib. An
 * installation may be moved. */
static const char *const near_library[] = {"share/hooke", HOOKE_DATA_FROM_LIBRARY, "../share/hooke"};
enum { NEAR_COUNT = sizeof near_library / sizeof near_library[0], PATH_SIZE = 4096 };

/* The folder that this code was loaded from is "" if it was started by a bare name. */
static FILE *open_data(const char *name) {
  char own[PATH_SIZE], path[2 * PATH_SIZE];
  hk_os_own_file(own, sizeof own);
  const char *slash = hk_os_last_slash(own);
  const int length = slash ? (int)(slash - own) + 1 : 0;
  for (int k = 0; k < NEAR_COUNT; k++) {
    snprintf(path, sizeof path, "%.*s%s/%s", length, own, near_library[k], name);
    FILE *file = hk_os_fopen(path);
    if (file || errno == ENOMEM) return file;
  }
  snprintf(path, sizeof path, "%s/%s", HOOKE_DATA_INSTALLED, name);
  return hk_os_fopen(path);
}

int32_t hk_data_folder_read(const char *name, struct hk_text *text) {
  HOOKE_KEEP_ERRNO;
  FILE *file = open_data(name);
  if (file == NULL && errno == ENOMEM)
    return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory to open share/hooke/%s", name);
  if (file == NULL) {
    return hk_fail(HOOKE_NOT_BUILT, NULL,
                   "share/hooke/%s is not where this library looks for it: "
                   "beside it, or in %s; install hooke with all its files",
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

/* ---- forms ---- */

static int32_t fill(const char *from, hk_form_part add, void *ctx, struct hk_text *page) {
  const char *mark;
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK && (mark = strstr(from, "{{")) != NULL) {
    char name[64];
    hk_text_add(page, from, mark - from);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(mark + 2, "}"), mark + 2);
    if (strchr(name, '.'))
      status = hk_data_folder_read(name, page);
    else if (add)
      status = add(name, page, ctx);
    from = mark + strcspn(mark, "}");
    from += strspn(from, "}");
  }
  if (status == HOOKE_OK) hk_text_say(page, from);
  return status == HOOKE_OK ? page->status : status;
}

int32_t hk_form_fill(const char *form, hk_form_part add, void *ctx, struct hk_text *page) {
  struct hk_text text = {.bytes = NULL};
  int32_t status = hk_data_folder_read(form, &text);
  hk_text_add(&text, "", 1); /* ends it */
  if (status == HOOKE_OK) status = text.status;
  if (status == HOOKE_OK) status = fill(text.bytes, add, ctx, page);
  hk_text_release(&text);
  return status;
}
