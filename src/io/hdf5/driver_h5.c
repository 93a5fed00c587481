/* An HDF5 driver that records failures and never reports them to HDF5. */
#include "core/memory.h"

#if HOOKE_HAVE_HDF5

#include "io/file/bytes.h"
#include "core/os/os_file.h"
#include "io/hdf5/driver_h5.h"

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

#include <errno.h>
#include <string.h>

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

hid_t hk_h5_access_list(int descriptor, int *error) {
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

#else
typedef int hk_driver_is_not_built;
#endif
