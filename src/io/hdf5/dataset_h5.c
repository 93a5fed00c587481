#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/dataset_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/file/atomic_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* No compression makes numbers more than about a thousand times smaller, so a dataset that claims more is
 * malicious. The [bytes] exceed slightly what HDF5 1.10 allocates while reading, for each chunk that it
 * visits, written or not: 6.6 kB. */
enum { LARGEST_RATIO = 2048, BYTES_OF_CHUNK = 8192 };

static const char not_numbers[] = "is not an array of numbers";

int32_t hk_dataset_refuse(const char *path, const char *name, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: dataset %s %s", path, name, what);
}

int32_t hk_dataset_file(struct hk_h5_guard *guard, const char *path, hid_t *file) {
  const int descriptor = hk_file_open(path);
  *file = -1;
  /* HDF5 would wait for a writer of a pipe */
  if (descriptor < 0 && (errno == EINVAL || errno == EISDIR))
    return hk_fail_before(hk_file_refuse(HOOKE_IO_FAILED, errno, "file of HDF5"), "%s: ", path);
  if (descriptor >= 0) close(descriptor);
  hid_t list = H5Pcreate(H5P_FILE_ACCESS);
  if (list >= 0 && H5Pset_metadata_read_attempts(list, 1) >= 0 &&
      H5Pset_fclose_degree(list, H5F_CLOSE_STRONG) >= 0) {
    *file = H5Fopen(path, H5F_ACC_RDONLY, list);
  }
  const int32_t status = *file < 0 ? hk_h5_fail(guard, path, "open the file as HDF5") : HOOKE_OK;
  hk_h5_drop(list);
  return status;
}

/* An array may claim more bytes than its file has. */
static double stored_bytes(hid_t data) {
  hid_t file = H5Iget_file_id(data);
  hsize_t whole = 0;
  const double stored = (double)H5Dget_storage_size(data);
  if (file >= 0 && H5Fget_filesize(file, &whole) < 0) whole = 0;
  hk_h5_drop(file);
  return stored < (double)whole ? stored : (double)whole;
}

/* Refuses arrays that are not numbers or claim more than the file can hold. */
static int32_t check_storage(const char *path, const char *name, hid_t data, double count) {
  hid_t list = H5Dget_create_plist(data), type = H5Dget_type(data);
  const H5T_class_t class = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  const H5D_layout_t layout = list < 0 ? H5D_LAYOUT_ERROR : H5Pget_layout(list);
  const double bytes = type < 0 ? 0.0 : count * (double)H5Tget_size(type);
  hk_h5_drop(type);
  hk_h5_drop(list);
  if (class != H5T_FLOAT && class != H5T_INTEGER) return hk_dataset_refuse(path, name, not_numbers);
  const double stored = stored_bytes(data);
  /* HDF5 reads past the end of contiguous numbers */
  const int beyond = layout != H5D_CHUNKED && bytes > (double)H5Dget_storage_size(data);
  if (beyond || bytes > LARGEST_RATIO * stored) {
    char text[160];
    hk_print(text, sizeof text, "claims %.0f numbers, but only %.0f bytes are stored for them", count,
             stored);
    return hk_dataset_refuse(path, name, text);
  }
  return HOOKE_OK;
}

double hk_dataset_read_bytes(const struct hk_dataset *data, const hsize_t *part) {
  hid_t list = H5Dget_create_plist(data->id), type = H5Dget_type(data->id);
  hsize_t chunk[3];
  const int rank = list >= 0 && H5Pget_layout(list) == H5D_CHUNKED ? H5Pget_chunk(list, 3, chunk) : 0;
  double chunks = 1.0, bytes = type < 0 ? 0.0 : (double)H5Tget_size(type);
  for (int k = 0; k < rank && k < data->rank; k++) {
    chunks *= ceil((double)part[k] / (double)chunk[k]);
    bytes *= (double)chunk[k];
  }
  hk_h5_drop(type);
  hk_h5_drop(list);
  return rank > 0 ? bytes + chunks * BYTES_OF_CHUNK : 0.0;
}

/* `list`: from hk_h5_own_links(), or negative. */
static int32_t open_by(hid_t list, struct hk_h5_guard *guard, hid_t file, const char *path, const char *name,
                       struct hk_dataset *data) {
  *data = (struct hk_dataset){.id = -1};
  if (list >= 0) data->id = H5Oopen(file, name, list);
  if (data->id < 0) {
    char what[256];
    snprintf(what, sizeof what, "find the dataset %.200s", name);
    return hk_h5_fail(guard, path, what);
  }
  if (H5Iget_type(data->id) != H5I_DATASET) return hk_dataset_refuse(path, name, not_numbers);
  const char *foreign = hk_h5_foreign(data->id);
  if (guard->no_memory) return hk_h5_fail(guard, path, "look at a dataset");
  if (foreign) return hk_dataset_refuse(path, name, foreign);
  hid_t space = H5Dget_space(data->id);
  data->rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
  const int fits = data->rank >= 1 && data->rank <= 3;
  if (fits) H5Sget_simple_extent_dims(space, data->size, NULL);
  hk_h5_drop(space);
  if (!fits) {
    return hk_dataset_refuse(path, name,
                             "has a wrong number of dimensions; allowed: "
                             "[rows], [rows][columns] or [frames][rows][columns]");
  }
  double count = 1.0;
  for (int k = 0; k < data->rank; k++)
    count *= (double)data->size[k];
  return check_storage(path, name, data->id, count);
}

int32_t hk_dataset_open(struct hk_h5_guard *guard, hid_t file, const char *path, const char *name,
                        struct hk_dataset *data) {
  hid_t list = hk_h5_own_links(guard);
  const int32_t status = open_by(list, guard, file, path, name, data);
  hk_h5_drop(list);
  return status;
}

/* 0 also if a group on the path does not exist; negative if HDF5 cannot tell. */
static htri_t is_there(hid_t list, hid_t file, const char *name) {
  htri_t there = H5Lexists(file, name, list);
  char *part = there < 0 ? hk_copy_text(name) : NULL;
  for (char *end = part ? strchr(part + 1, '/') : NULL; end && there < 0; end = strchr(end + 1, '/')) {
    *end = '\0';
    if (H5Lexists(file, part, list) == 0) there = 0;
    *end = '/';
  }
  hk_free(part);
  return there;
}

int32_t hk_dataset_find(struct hk_h5_guard *guard, hid_t file, const char *path, const char *name,
                        struct hk_dataset *data) {
  hid_t list = hk_h5_own_links(guard);
  const htri_t there = list < 0 ? -1 : is_there(list, file, name);
  int32_t status = HOOKE_OK;
  *data = (struct hk_dataset){.id = -1};
  if (there > 0)
    status = open_by(list, guard, file, path, name, data);
  else if (there < 0)
    status = hk_h5_fail(guard, path, "look which arrays it has");
  else /* an answer, not a failure */
    guard->reason[0] = '\0', guard->no_memory = 0;
  hk_h5_drop(list);
  return status;
}

#endif
