/* Reads arrays from untrusted HDF5 files. */
#include "io/hdf5/array_h5.h"

#include "core/memory.h"
#include "core/memory_limit.h"
#include "core/print.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/dataset_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/trajectory/h5md_h5.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* No compression makes numbers more than about a thousand times smaller, so a dataset that claims more is
 * malicious. The [bytes] exceed slightly what HDF5 1.10 allocates while reading, for each chunk that it
 * visits, written or not: 6.6 kB. */
enum { LARGEST_RATIO = 2048, BYTES_OF_CHUNK = 8192 };

static const char not_numbers[] = "is not an array of numbers";

int32_t hk_dataset_refuse(const struct hk_dataset *data, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: dataset %s %s", data->guard->path, data->name, what);
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
static int32_t check_storage(const struct hk_dataset *data, double count) {
  hid_t list = H5Dget_create_plist(data->id), type = H5Dget_type(data->id);
  const H5T_class_t class = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  const H5D_layout_t layout = list < 0 ? H5D_LAYOUT_ERROR : H5Pget_layout(list);
  const double bytes = type < 0 ? 0.0 : count * (double)H5Tget_size(type);
  hk_h5_drop(type);
  hk_h5_drop(list);
  if (class != H5T_FLOAT && class != H5T_INTEGER) return hk_dataset_refuse(data, not_numbers);
  const double stored = stored_bytes(data->id);
  /* HDF5 reads past the end of contiguous numbers */
  const int beyond = layout != H5D_CHUNKED && bytes > (double)H5Dget_storage_size(data->id);
  if (beyond || bytes > LARGEST_RATIO * stored) {
    char text[160];
    hk_print(text, sizeof text, "claims %.0f numbers, but only %.0f bytes are stored for them", count,
             stored);
    return hk_dataset_refuse(data, text);
  }
  return HOOKE_OK;
}

/* Bytes that HDF5 allocates, besides the numbers, to read `part` along each dimension: whole chunks even for
 * a part of one, and its bookkeeping for each. */
static double read_bytes(const struct hk_dataset *data, const hsize_t *part) {
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
static int32_t open_by(hid_t list, struct hk_dataset *data) {
  const struct hk_h5_guard *guard = data->guard;
  if (list >= 0) data->id = H5Oopen(guard->file, data->name, list);
  if (data->id < 0) {
    char what[256];
    snprintf(what, sizeof what, "find the dataset %.200s", data->name);
    return hk_h5_fail(guard, what);
  }
  if (H5Iget_type(data->id) != H5I_DATASET) return hk_dataset_refuse(data, not_numbers);
  const char *foreign = hk_h5_foreign(data->id);
  if (guard->no_memory) return hk_h5_fail(guard, "look at a dataset");
  if (foreign) return hk_dataset_refuse(data, foreign);
  hid_t space = H5Dget_space(data->id);
  data->rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
  const int fits = data->rank >= 1 && data->rank <= 3;
  if (fits) H5Sget_simple_extent_dims(space, data->size, NULL);
  hk_h5_drop(space);
  if (!fits) {
    return hk_dataset_refuse(data, "has a wrong number of dimensions; allowed: "
                                   "[rows], [rows][columns] or [frames][rows][columns]");
  }
  double count = 1.0;
  for (int k = 0; k < data->rank; k++)
    count *= (double)data->size[k];
  return check_storage(data, count);
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

int32_t hk_dataset_open(struct hk_h5_guard *guard, const char *name, int32_t optional,
                        struct hk_dataset *data) {
  hid_t list = hk_h5_own_links(guard);
  const htri_t there = !optional ? 1 : list < 0 ? -1 : is_there(list, guard->file, name);
  int32_t status = HOOKE_OK;
  *data = (struct hk_dataset){.guard = guard, .name = name, .id = -1};
  if (there > 0)
    status = open_by(list, data);
  else if (there < 0)
    status = hk_h5_fail(guard, "look which arrays it has");
  else /* an answer, not a failure */
    guard->reason[0] = '\0', guard->no_memory = 0;
  hk_h5_drop(list);
  return status;
}

/* ---- reading ---- */

/* Memory for the numbers of a part of `data`, and for HDF5's own while reading them. */
static int32_t check_space(const struct hk_dataset *data, const hsize_t *part) {
  double bytes = sizeof(double);
  for (int k = 0; k < data->rank; k++)
    bytes *= (double)part[k];
  char what[192];
  snprintf(what, sizeof what, "dataset %.150s", data->name);
  return hk_memory_require(data->guard->memory_limit, bytes + read_bytes(data, part), what);
}

/* Frames before the first without a time. */
static int32_t count_timed(const struct hk_dataset *data, int64_t *frames) {
  int32_t status = check_space(data, data->size);
  if (status != HOOKE_OK) return status;
  double *time = hk_new(*frames, sizeof(double));
  if (time == NULL) return HOOKE_NO_MEMORY;
  if (H5Dread(data->id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, time) < 0)
    status = hk_h5_fail(data->guard, "read the times of the frames");
  for (int64_t k = 0; status == HOOKE_OK && k < *frames; k++) {
    if (isnan(time[k])) *frames = k;
  }
  hk_free(time);
  return status;
}

/* All frames if the sibling `time` does not have one for each of them, or the run is over. */
static int32_t count_frames(const struct hk_dataset *data, int64_t *frames) {
  *frames = (int64_t)data->size[0];
  const char *slash = strrchr(data->name, '/');
  const int folder = slash ? (int)(slash - data->name) + 1 : 0;
  const int64_t capacity = folder + 8;
  char *name = hk_new(capacity, 1);
  if (name == NULL) return HOOKE_NO_MEMORY;
  snprintf(name, (size_t)capacity, "%.*stime", folder, data->name);
  struct hk_dataset time;
  int32_t status = hk_dataset_open(data->guard, name, 1, &time);
  hk_free(name);
  time.name = data->name; /* for messages */
  const int each =
      time.rank == 1 && *frames > 0 && time.size[0] == data->size[0] && !hk_h5md_is_over(data->guard->file);
  if (status == HOOKE_OK && each) status = count_timed(&time, frames);
  hk_h5_drop(time.id);
  return status == HOOKE_BAD_VALUE && !each ? HOOKE_OK : status;
}

static int32_t choose_frame(const struct hk_dataset *data, int64_t *frame, int32_t has_frame) {
  if (data->rank < 3) {
    if (!has_frame) return HOOKE_OK;
    return hk_dataset_refuse(data, "has no frames; allowed with \"frame\": an array [frames][rows][columns]");
  }
  int64_t frames;
  int32_t status = count_frames(data, &frames);
  if (status != HOOKE_OK) return status;
  const int64_t wanted = has_frame ? *frame : -1;
  if (frames == 0) return hk_dataset_refuse(data, "has no frames yet");
  if (wanted < -frames || wanted >= frames) {
    char text[160];
    snprintf(text, sizeof text, "has no frame %lld; allowed: 0 to %lld, or -1 to %lld from the end",
             (long long)wanted, (long long)frames - 1, -(long long)frames);
    return hk_dataset_refuse(data, text);
  }
  *frame = wanted < 0 ? frames + wanted : wanted;
  return HOOKE_OK;
}

static int32_t read_values(const struct hk_dataset *data, int64_t frame, double **values, int64_t *rows,
                           int64_t *columns) {
  const int framed = data->rank == 3;
  const hsize_t *size = data->size + framed;
  const hsize_t high = size[0], wide = data->rank == 1 ? 1 : size[1];
  if ((double)high * (double)wide > 3.0 * INT32_MAX) {
    return hk_dataset_refuse(data, "has more numbers than a system has coordinates (3 x 2147483647)");
  }
  const hsize_t count = high * wide;
  const hsize_t begin[3] = {(hsize_t)frame, 0, 0}, part[3] = {1, high, wide};
  const int32_t capacity = check_space(data, part + !framed);
  if (capacity != HOOKE_OK) return capacity;
  *values = hk_new((int64_t)count, sizeof(double));
  if (*values == NULL) return HOOKE_NO_MEMORY;
  hid_t there = H5Dget_space(data->id), here = H5Screate_simple(1, &count, NULL);
  herr_t result = there < 0 || here < 0 ? -1 : 0;
  if (result >= 0 && framed) result = H5Sselect_hyperslab(there, H5S_SELECT_SET, begin, NULL, part, NULL);
  if (result >= 0) result = H5Dread(data->id, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, *values);
  *rows = (int64_t)high;
  *columns = (int64_t)wide;
  int32_t status = result < 0 ? hk_h5_fail(data->guard, "read the numbers") : HOOKE_OK;
  hk_h5_drop(here);
  hk_h5_drop(there);
  return status;
}

int32_t hk_array_read_open(struct hk_h5_guard *guard, const char *dataset, int64_t frame, int32_t has_frame,
                           int32_t check, double **values, int64_t *rows, int64_t *columns) {
  struct hk_dataset data;
  *values = NULL;
  *rows = *columns = 0;
  int32_t status = hk_dataset_open(guard, dataset, 0, &data);
  if (status == HOOKE_OK) status = choose_frame(&data, &frame, has_frame);
  if (status == HOOKE_OK) status = read_values(&data, frame, values, rows, columns);
  if (status == HOOKE_OK && data.rank == 3 && check) status = hk_frame_check(guard, dataset, frame, *values);
  if (status != HOOKE_OK) {
    hk_free(*values);
    *values = NULL;
  }
  hk_h5_drop(data.id);
  return status;
}

int32_t hk_array_read_within(double memory_limit, const char *path, const char *dataset, int64_t frame,
                             int32_t has_frame, double **values, int64_t *rows, int64_t *columns) {
  struct hk_h5_guard guard;
  *values = NULL;
  *rows = *columns = 0;
  int32_t status = hk_h5_guard_read(&guard, path);
  guard.memory_limit = memory_limit;
  if (status == HOOKE_OK)
    status = hk_array_read_open(&guard, dataset, frame, has_frame, 1, values, rows, columns);
  hk_h5_guard_end(&guard);
  return status;
}

#else

int32_t hk_array_read_within(double memory_limit, const char *path, const char *dataset, int64_t frame,
                             int32_t has_frame, double **values, int64_t *rows, int64_t *columns) {
  (void)memory_limit, (void)frame, (void)has_frame;
  *values = NULL;
  *rows = *columns = 0;
  return hk_fail(HOOKE_NOT_BUILT, NULL, "%s, dataset %s: reading it needs HDF5, which this build is without",
                 path, dataset);
}

#endif

int32_t hk_array_read(const char *path, const char *dataset, int64_t frame, int32_t has_frame,
                      double **values, int64_t *rows, int64_t *columns) {
  return hk_array_read_within(0.0, path, dataset, frame, has_frame, values, rows, columns);
}
