/* HDF5 files that are published when complete, and HDF5 errors in words. */
#include "core/print.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "core/memory.h"
#include "core/os/os_file.h"
#include "io/file/bytes.h"
#include "io/hdf5/file_h5.h"
#include "io/hdf5/object_h5.h"

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

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

static void begin(struct hk_h5_guard *guard, const char *path) {
  *guard = (struct hk_h5_guard){
      .path = path, .file = -1, .second_version = 1, .error = errno, .failures = hk_fail_count()};
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

int32_t hk_h5_guard_read(struct hk_h5_guard *guard, const char *path) {
  begin(guard, path);
  return hk_h5_open(guard, &guard->file);
}

void hk_h5_guard_end(const struct hk_h5_guard *guard) {
  if (guard->file >= 0) H5Fclose(guard->file);
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

int32_t hk_h5_fail(const struct hk_h5_guard *guard, const char *what) {
  if (was_without_memory(guard))
    return hk_fail(HOOKE_NO_MEMORY, NULL, "%s: no memory to %s", guard->path, what);
  return hk_fail(HOOKE_IO_FAILED, NULL, "%s: could not %s%s%s", guard->path, what,
                 guard->reason[0] ? ": " : "", guard->reason);
}

int32_t hk_h5_open(struct hk_h5_guard *guard, hid_t *file) {
  const int descriptor = hk_file_open(guard->path);
  *file = -1;
  /* HDF5 would wait for a writer of a pipe */
  if (descriptor < 0 && (errno == EINVAL || errno == EISDIR))
    return hk_fail_before(hk_file_refuse(HOOKE_IO_FAILED, errno, "file of HDF5"), "%s: ", guard->path);
  if (descriptor >= 0) close(descriptor);
  hid_t list = H5Pcreate(H5P_FILE_ACCESS);
  if (list >= 0 && H5Pset_metadata_read_attempts(list, 1) >= 0 &&
      H5Pset_fclose_degree(list, H5F_CLOSE_STRONG) >= 0) {
    *file = H5Fopen(guard->path, H5F_ACC_RDONLY, list);
  }
  const int32_t status = *file < 0 ? hk_h5_fail(guard, "open the file as HDF5") : HOOKE_OK;
  hk_h5_drop(list);
  return status;
}

/* ---- the driver ---- */

/* HDF5 does not survive a failed write: in 1.10 a file that could not be closed crashes the process when it
 * is closed again, or at exit. So with this driver no write ever fails as HDF5 sees it: after the first
 * failure it ignores the others, and the creator of the file reads the error after HDF5 has closed it. */
struct driven {
  H5FD_t pub; /* must be first, by HDF5's rules */
  int descriptor;
  int *error;
  haddr_t end, size; /* of the allocated range; of the file, as if all writes had succeeded */
};

struct setting {
  int descriptor;
  int *error;
};

static void keep(struct driven *f, int error) {
  if (*f->error == 0) *f->error = error;
}

/* Whatever room the new file was given, HDF5 finds it empty. */
static H5FD_t *open_file(const char *name, unsigned flags, hid_t list, haddr_t longest) {
  const struct setting *setting = H5Pget_driver_info(list);
  struct driven *f = setting ? hk_new(1, sizeof *f) : NULL;
  (void)name, (void)flags, (void)longest;
  if (f == NULL) return NULL;
  f->error = setting->error;
  f->descriptor = setting->descriptor;
  return &f->pub;
}

static herr_t close_file(H5FD_t *file) {
  hk_free(file);
  return 0;
}

/* Like HDF5's own driver of plain files, so that the layout of files is the same. */
static herr_t tell_features(const H5FD_t *file, unsigned long *flags) {
  (void)file;
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

static haddr_t end_of_taken(const H5FD_t *file, H5FD_mem_t type) {
  (void)type;
  return ((const struct driven *)file)->end;
}

static herr_t take_until(H5FD_t *file, H5FD_mem_t type, haddr_t end) {
  (void)type;
  ((struct driven *)file)->end = end;
  return 0;
}

static haddr_t end_of_file(const H5FD_t *file, H5FD_mem_t type) {
  (void)type;
  return ((const struct driven *)file)->size;
}

/* Missing data are read as zeros. */
static herr_t read_file(H5FD_t *file, H5FD_mem_t type, hid_t list, haddr_t at, size_t count, void *bytes) {
  struct driven *f = (struct driven *)file;
  (void)type, (void)list;
  memset(bytes, 0, count);
  const haddr_t there = at < f->size ? f->size - at : 0;
  if (there == 0 || *f->error != 0) return 0;
  const int error =
      hk_bytes_read(f->descriptor, (int64_t)at, (int64_t)(there < count ? there : count), bytes);
  if (error) keep(f, error);
  return 0;
}

static herr_t write_file(H5FD_t *file, H5FD_mem_t type, hid_t list, haddr_t at, size_t count,
                         const void *bytes) {
  struct driven *f = (struct driven *)file;
  (void)type, (void)list;
  if (at + count > f->size) f->size = at + count;
  const int error = *f->error ? 0 : hk_bytes_write(f->descriptor, (int64_t)at, (int64_t)count, bytes);
  if (error) keep(f, error);
  return 0;
}

static herr_t cut_file(H5FD_t *file, hid_t list, hbool_t closing) {
  struct driven *f = (struct driven *)file;
  (void)list, (void)closing;
  if (*f->error == 0 && hk_os_set_length(f->descriptor, (int64_t)f->end) != 0) keep(f, errno);
  f->size = f->end;
  return 0;
}

static const H5FD_class_t driver = {
#ifdef H5FD_CLASS_VERSION
    .version = H5FD_CLASS_VERSION,
    .value = 687,
#endif
    .name = "hooke",
    .maxaddr = INT64_MAX,
    .fc_degree = H5F_CLOSE_WEAK,
    .fapl_size = sizeof(struct setting),
    .open = open_file,
    .close = close_file,
    .query = tell_features,
    .get_eoa = end_of_taken,
    .set_eoa = take_until,
    .get_eof = end_of_file,
    .read = read_file,
    .write = write_file,
    .truncate = cut_file,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

/* An access list for the new file of `descriptor`, with this driver, for any name given to HDF5. The
 * caller keeps the descriptor; `error` receives the errno of the first failure; both must outlive the open
 * file. So must the list: the driver, which H5Fclose() still uses, is released with the last of its lists.
 * Set `error` to any number to suppress all further writes. Negative on failure. */
static hid_t access_list(int descriptor, int *error) {
  const struct setting setting = {descriptor, error};
  hid_t list = H5Pcreate(H5P_FILE_ACCESS), id = list < 0 ? -1 : H5FDregister(&driver);
  herr_t result = id < 0 ? -1 : H5Pset_driver(list, id, &setting);
  if (id >= 0) H5FDunregister(id); /* owned by the list */
  if (result >= 0) result = H5Pset_sieve_buf_size(list, 0);
  if (result >= 0) result = H5Pset_alignment(list, 1, 16);
  if (result >= 0) result = H5Pset_fclose_degree(list, H5F_CLOSE_STRONG);
  if (result >= 0) return list;
  if (list >= 0) H5Pclose(list);
  return -1;
}

/* ---- a file ---- */

static int32_t reserve(const struct hk_atomic_file *atomic, double bytes) {
  char what[64];
  hk_print(what, sizeof what, "make room for %.3g MB", bytes / 1e6);
  const int error = bytes < 9e18 ? hk_os_reserve_disk(atomic->descriptor, (int64_t)bytes) : EFBIG;
  return error ? hk_file_fail(atomic->path, what, error) : HOOKE_OK;
}

int32_t hk_h5_file_create(double bytes, const struct hk_atomic_file *atomic, struct hk_h5_file *file) {
  *file = (struct hk_h5_file){.list = -1, .atomic = atomic};
  begin(&file->guard, atomic->path);
  const int32_t status = reserve(atomic, bytes);
  if (status != HOOKE_OK) return status;
  file->list = access_list(atomic->descriptor, &file->error);
  if (file->list >= 0)
    file->guard.file = H5Fcreate(atomic->temporary, H5F_ACC_TRUNC, H5P_DEFAULT, file->list);
  return file->guard.file >= 0 ? HOOKE_OK : hk_h5_fail(&file->guard, "create the file");
}

/* Also where it was not created. */
static int32_t close_written(struct hk_h5_file *file, int32_t status) {
  const struct hk_atomic_file *atomic = file->atomic;
  const hid_t id = file->guard.file;
  hsize_t bytes = 0;
  if (id >= 0) H5Fget_filesize(id, &bytes);
  if (status == HOOKE_OK && file->error == 0) status = reserve(atomic, (double)bytes);
  if (status != HOOKE_OK && file->error == 0) file->error = ECANCELED;
  const herr_t result = id >= 0 ? H5Fclose(id) : 0;
  file->guard.file = -1;
  hk_h5_drop(file->list);
  if (file->error == ECANCELED || status == HOOKE_NO_MEMORY) return status;
  if (file->error) return hk_file_fail(atomic->path, "write", file->error);
  return result < 0 ? hk_h5_fail(&file->guard, "close the file") : HOOKE_OK;
}

int32_t hk_h5_file_settle(struct hk_h5_file *file, int32_t status) {
  status = close_written(file, status);
  hk_h5_guard_end(&file->guard);
  return status;
}

#endif
