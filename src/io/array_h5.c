/* Reading arrays from HDF5 files that nobody vouches for. */
#include "io/array_h5.h"

#include "core/memory.h"
#include "core/room.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/file_h5.h"
#include "io/object_h5.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* No compression makes numbers more than about a thousand times smaller, so a dataset that claims more is a
 * trap. */
enum { LARGEST_RATIO = 2048 };

struct source {
  struct hooke_h5_guard *guard;
  double memory_limit;
  const char *path, *dataset;
  hid_t file, data;
  int rank;
  hsize_t size[3];
};

static int32_t refuse(const struct source *source, const char *what) {
  return hooke_fail(HOOKE_BAD_VALUE, NULL, "%s: dataset %s %s", source->path, source->dataset, what);
}

static int32_t fail(const struct source *source, const char *what) {
  return hooke_h5_fail(source->guard, source->path, what);
}

static herr_t refuse_link(const char *from_file, const char *from, const char *to_file, const char *to,
                          unsigned *flags, hid_t access, void *ctx) {
  (void)from_file, (void)from, (void)to_file, (void)to, (void)flags, (void)access, (void)ctx;
  return -1;
}

static int32_t open_file(struct source *source) {
  struct stat there;
  if (stat(source->path, &there) == 0 && !S_ISREG(there.st_mode)) {
    return hooke_fail(HOOKE_IO_FAILED, NULL, "%s: is not a regular file", source->path);
  }
  hid_t list = H5Pcreate(H5P_FILE_ACCESS);
  if (list >= 0 && H5Pset_metadata_read_attempts(list, 1) >= 0 &&
      H5Pset_fclose_degree(list, H5F_CLOSE_STRONG) >= 0) {
    source->file = H5Fopen(source->path, H5F_ACC_RDONLY, list);
  }
  int32_t status = source->file < 0 ? fail(source, "open the file as HDF5") : HOOKE_OK;
  hooke_h5_drop(list);
  return status;
}

/* Opens a dataset without following links to other files. */
static hid_t open_dataset(const struct source *source, const char *name) {
  hid_t list = H5Pcreate(H5P_DATASET_ACCESS), data = -1;
  if (list >= 0 && H5Pset_elink_cb(list, refuse_link, NULL) >= 0) data = H5Dopen2(source->file, name, list);
  hooke_h5_drop(list);
  return data;
}

/* Numbers that are stored in this very file, and no more than it can hold. */
static int32_t check_storage(const struct source *source, hid_t data, double count) {
  hid_t list = H5Dget_create_plist(data), type = H5Dget_type(data);
  const H5T_class_t class = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  const H5D_layout_t layout = list < 0 ? H5D_LAYOUT_ERROR : H5Pget_layout(list);
  const int external = list < 0 ? 0 : H5Pget_external_count(list);
  const double bytes = type < 0 ? 0.0 : count * (double)H5Tget_size(type);
  hooke_h5_drop(type);
  hooke_h5_drop(list);
  if (class != H5T_FLOAT && class != H5T_INTEGER) return refuse(source, "is not an array of numbers");
  if (layout == H5D_VIRTUAL || external != 0) {
    return refuse(source, "keeps its numbers in another file; allowed: numbers in the file itself");
  }
  const double stored = (double)H5Dget_storage_size(data);
  if (bytes > LARGEST_RATIO * stored) {
    char text[160];
    snprintf(text, sizeof text, "claims %.0f numbers, but only %.0f bytes are stored for them", count,
             stored);
    return refuse(source, text);
  }
  return HOOKE_OK;
}

static int32_t open_data(struct source *source) {
  source->data = open_dataset(source, source->dataset);
  if (source->data < 0) {
    char what[256];
    snprintf(what, sizeof what, "find the dataset %.200s", source->dataset);
    return fail(source, what);
  }
  hid_t space = H5Dget_space(source->data);
  source->rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
  const int fits = source->rank >= 1 && source->rank <= 3;
  if (fits) H5Sget_simple_extent_dims(space, source->size, NULL);
  hooke_h5_drop(space);
  if (!fits) {
    return refuse(source, "has a wrong number of dimensions; allowed: [rows], [rows][columns] or "
                          "[frames][rows][columns]");
  }
  double count = 1.0;
  for (int k = 0; k < source->rank; k++)
    count *= (double)source->size[k];
  return check_storage(source, source->data, count);
}

/* Frames before the first without a time; all of them if the neighbour `time` is not there for each frame. */
static int32_t count_frames(const struct source *source, int64_t *frames) {
  *frames = (int64_t)source->size[0];
  const char *slash = strrchr(source->dataset, '/');
  const int folder = slash ? (int)(slash - source->dataset) + 1 : 0;
  const int64_t room = folder + 8;
  char *name = hooke_new(room, 1);
  if (name == NULL) return HOOKE_NO_MEMORY;
  snprintf(name, (size_t)room, "%.*stime", folder, source->dataset);
  hid_t data = H5Lexists(source->file, name, H5P_DEFAULT) > 0 ? open_dataset(source, name) : -1;
  hooke_free(name);
  hid_t space = data < 0 ? -1 : H5Dget_space(data);
  hsize_t size = 0;
  int32_t status = HOOKE_OK;
  if (space >= 0 && H5Sget_simple_extent_ndims(space) == 1) H5Sget_simple_extent_dims(space, &size, NULL);
  if (size > 0 && size == source->size[0]) {
    status = check_storage(source, data, (double)size);
    double *time = status == HOOKE_OK ? hooke_new((int64_t)size, sizeof(double)) : NULL;
    if (status == HOOKE_OK && time == NULL) status = HOOKE_NO_MEMORY;
    if (time && H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, time) < 0) {
      status = fail(source, "read the times of the frames");
    }
    for (int64_t k = 0; status == HOOKE_OK && k < *frames; k++) {
      if (isnan(time[k])) *frames = k;
    }
    hooke_free(time);
  }
  hooke_h5_drop(space);
  hooke_h5_drop(data);
  return status;
}

static int32_t choose_frame(const struct source *source, int64_t *frame, int32_t has_frame) {
  if (source->rank < 3) {
    if (!has_frame) return HOOKE_OK;
    return refuse(source, "has no frames; allowed with \"frame\": an array [frames][rows][columns]");
  }
  int64_t frames;
  int32_t status = count_frames(source, &frames);
  if (status != HOOKE_OK) return status;
  const int64_t wanted = has_frame ? *frame : -1;
  if (frames == 0) return refuse(source, "has no frames yet");
  if (wanted < -frames || wanted >= frames) {
    char text[160];
    snprintf(text, sizeof text, "has no frame %lld; allowed: 0 to %lld, or -1 to %lld from the end",
             (long long)wanted, (long long)frames - 1, -(long long)frames);
    return refuse(source, text);
  }
  *frame = wanted < 0 ? frames + wanted : wanted;
  return HOOKE_OK;
}

/* Numbers, and a chunk of the file, which HDF5 takes as a whole however little of it is asked for. */
static int32_t check_room(const struct source *source, double count) {
  hid_t list = H5Dget_create_plist(source->data), type = H5Dget_type(source->data);
  hsize_t chunk[3] = {0, 0, 0};
  double bytes = 0.0;
  if (list >= 0 && type >= 0 && H5Pget_layout(list) == H5D_CHUNKED) {
    const int rank = H5Pget_chunk(list, 3, chunk);
    bytes = (double)H5Tget_size(type);
    for (int k = 0; k < rank && k < 3; k++)
      bytes *= (double)chunk[k];
  }
  hooke_h5_drop(type);
  hooke_h5_drop(list);
  char what[192];
  snprintf(what, sizeof what, "dataset %.150s", source->dataset);
  return hooke_room_require(source->memory_limit, 8.0 * count + bytes, what);
}

static int32_t read_values(const struct source *source, int64_t frame, double **values, int64_t *rows,
                           int64_t *columns) {
  const int framed = source->rank == 3;
  const hsize_t *size = source->size + framed;
  const hsize_t high = size[0], wide = source->rank == 1 ? 1 : size[1];
  if ((double)high * (double)wide > 3.0 * INT32_MAX) {
    return refuse(source, "has more numbers than a system has coordinates (3 x 2147483647)");
  }
  const hsize_t count = high * wide;
  const int32_t room = check_room(source, (double)count);
  if (room != HOOKE_OK) return room;
  const hsize_t begin[3] = {(hsize_t)frame, 0, 0}, part[3] = {1, high, wide};
  *values = hooke_new((int64_t)count, sizeof(double));
  if (*values == NULL) return HOOKE_NO_MEMORY;
  hid_t there = H5Dget_space(source->data), here = H5Screate_simple(1, &count, NULL);
  herr_t result = there < 0 || here < 0 ? -1 : 0;
  if (result >= 0 && framed) result = H5Sselect_hyperslab(there, H5S_SELECT_SET, begin, NULL, part, NULL);
  if (result >= 0) result = H5Dread(source->data, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, *values);
  *rows = (int64_t)high;
  *columns = (int64_t)wide;
  int32_t status = result < 0 ? fail(source, "read the numbers") : HOOKE_OK;
  hooke_h5_drop(here);
  hooke_h5_drop(there);
  return status;
}

int32_t hooke_array_read_within(double memory_limit, const char *path, const char *dataset, int64_t frame,
                                int32_t has_frame, double **values, int64_t *rows, int64_t *columns) {
  struct hooke_h5_guard guard;
  struct source source = {.guard = &guard,
                          .memory_limit = memory_limit,
                          .path = path,
                          .dataset = dataset,
                          .file = -1,
                          .data = -1};
  *values = NULL;
  *rows = *columns = 0;
  hooke_h5_guard_begin(&guard);
  int32_t status = open_file(&source);
  if (status == HOOKE_OK) status = open_data(&source);
  if (status == HOOKE_OK) status = choose_frame(&source, &frame, has_frame);
  if (status == HOOKE_OK) status = read_values(&source, frame, values, rows, columns);
  if (status != HOOKE_OK) {
    hooke_free(*values);
    *values = NULL;
  }
  hooke_h5_drop(source.data);
  if (source.file >= 0) H5Fclose(source.file);
  hooke_h5_guard_end(&guard);
  return status;
}

#else

int32_t hooke_array_read_within(double memory_limit, const char *path, const char *dataset, int64_t frame,
                                int32_t has_frame, double **values, int64_t *rows, int64_t *columns) {
  (void)memory_limit, (void)frame, (void)has_frame;
  *values = NULL;
  *rows = *columns = 0;
  return hooke_fail(HOOKE_NOT_BUILT, NULL,
                    "%s, dataset %s: reading it needs HDF5, which this build is without", path, dataset);
}

#endif

int32_t hooke_array_read(const char *path, const char *dataset, int64_t frame, int32_t has_frame,
                         double **values, int64_t *rows, int64_t *columns) {
  return hooke_array_read_within(0.0, path, dataset, frame, has_frame, values, rows, columns);
}
