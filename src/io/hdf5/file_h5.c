/* HDF5 files that are published when complete, and HDF5 errors in words. */
#include "core/print.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/driver_h5.h"
#include "core/os/os_file.h"
#include "io/hdf5/file_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/file/atomic_file.h"

#include "core/memory.h"

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* ---- errors ---- */

/* The innermost entry of HDF5's error stack is the cause. */
static herr_t keep_innermost(unsigned n, const H5E_error2_t *entry, void *ctx) {
  struct hk_h5_guard *guard = ctx;
  if (n > 0 || entry->desc == NULL) return 0;
  const char *text = entry->desc, *mark = "error message = '";
  const char *system_text = strstr(text, mark);
  size_t length = strlen(text);
  if (system_text) {
    text = system_text + strlen(mark);
    length = strcspn(text, "'");
  }
  snprintf(guard->reason, sizeof guard->reason, "%.*s", (int)length, text);
  /* some parts of HDF5 give a description only */
  guard->no_memory = entry->maj_num == H5E_RESOURCE || entry->min_num == H5E_CANTALLOC ||
                     strstr(entry->desc, "memory allocation failed") != NULL;
  return 0;
}

/* Called by HDF5 when one of its functions fails; the first failure causes the others. */
static herr_t on_error(hid_t stack, void *ctx) {
  struct hk_h5_guard *guard = ctx;
  if (guard->reason[0] == '\0') H5Ewalk2(stack, H5E_WALK_UPWARD, keep_innermost, guard);
  return 0;
}

/* HDF5 keeps its open files, and more, in global variables. */
static pthread_mutex_t alone = PTHREAD_MUTEX_INITIALIZER;
static _Thread_local int32_t guards; /* active in this thread */

void hk_h5_guard_begin(struct hk_h5_guard *guard) {
  *guard = (struct hk_h5_guard){.second_version = 1, .error = errno, .failures = hk_fail_count()};
  if (guards++ == 0) pthread_mutex_lock(&alone);
  H5Eauto_is_v2(H5E_DEFAULT, &guard->second_version);
  if (guard->second_version) {
    H5E_auto2_t handler = NULL;
    H5Eget_auto2(H5E_DEFAULT, &handler, &guard->data);
    guard->handler = (void (*)(void))handler;
  } else {
    H5E_auto1_t handler = NULL;
    H5Eget_auto1(&handler, &guard->data);
    guard->handler = (void (*)(void))handler;
  }
  H5Eset_auto2(H5E_DEFAULT, on_error, guard);
  H5PLget_loading_state(&guard->plugins);
  H5PLset_loading_state(0);
}

void hk_h5_guard_end(const struct hk_h5_guard *guard) {
  H5PLset_loading_state(guard->plugins);
  H5Eclear2(H5E_DEFAULT);
  if (guard->second_version) {
    H5Eset_auto2(H5E_DEFAULT, (H5E_auto2_t)guard->handler, guard->data);
  } else {
    H5Eset_auto1((H5E_auto1_t)guard->handler, guard->data);
  }
  if (--guards == 0) pthread_mutex_unlock(&alone);
  errno = guard->error;
}

/* HDF5 was out of memory, or the library was when HDF5 called it. */
static int was_without_memory(const struct hk_h5_guard *guard) {
  return guard->no_memory || (hk_fail_count() > guard->failures && hk_fail_status() == HOOKE_NO_MEMORY);
}

int32_t hk_h5_fail(const struct hk_h5_guard *guard, const char *path, const char *what) {
  if (was_without_memory(guard)) return hk_fail(HOOKE_NO_MEMORY, NULL, "%s: no memory to %s", path, what);
  return hk_fail(HOOKE_IO_FAILED, NULL, "%s: could not %s%s%s", path, what, guard->reason[0] ? ": " : "",
                 guard->reason);
}

/* ---- a file ---- */

static int32_t reserve(const struct hk_atomic_file *atomic, double bytes) {
  char what[64];
  hk_print(what, sizeof what, "make room for %.3g MB", bytes / 1e6);
  const int error = bytes < 9e18 ? hk_os_reserve_disk(atomic->descriptor, (int64_t)bytes) : EFBIG;
  return error ? hk_file_fail(atomic->path, what, error) : HOOKE_OK;
}

int32_t hk_h5_file_create(struct hk_h5_guard *guard, double bytes, const struct hk_atomic_file *atomic,
                          struct hk_h5_file *file) {
  *file = (struct hk_h5_file){.id = -1, .list = -1, .atomic = atomic};
  const int32_t status = reserve(atomic, bytes);
  if (status != HOOKE_OK) return status;
  file->list = hk_h5_access_list(atomic->descriptor, &file->error);
  if (file->list >= 0) file->id = H5Fcreate(atomic->temporary, H5F_ACC_TRUNC, H5P_DEFAULT, file->list);
  return file->id >= 0 ? HOOKE_OK : hk_h5_fail(guard, atomic->path, "create the file");
}

int32_t hk_h5_file_settle(struct hk_h5_guard *guard, struct hk_h5_file *file, int32_t status) {
  const struct hk_atomic_file *atomic = file->atomic;
  hsize_t bytes = 0;
  if (file->id >= 0) H5Fget_filesize(file->id, &bytes);
  if (status == HOOKE_OK && file->error == 0) status = reserve(atomic, (double)bytes);
  if (status != HOOKE_OK && file->error == 0) file->error = ECANCELED;
  const herr_t result = file->id >= 0 ? H5Fclose(file->id) : 0;
  hk_h5_drop(file->list);
  if (file->error == ECANCELED || status == HOOKE_NO_MEMORY) return status;
  if (file->error) return hk_file_fail(atomic->path, "write", file->error);
  return result < 0 ? hk_h5_fail(guard, atomic->path, "close the file") : HOOKE_OK;
}

#endif
