/* Reads arrays from untrusted HDF5 files. */
#include "io/hdf5/array_h5.h"

#include "core/memory.h"
#include "core/memory_limit.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/dataset_h5.h"
#include "io/trajectory/frame_check_h5.h"
#include "io/trajectory/h5md_h5.h"
#include "io/hdf5/object_h5.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct source {
  struct hk_h5_guard *guard;
  double memory_limit;
  const char *path, *dataset;
  hid_t file;
  struct hk_dataset data;
};

static int32_t refuse(const struct source *source, const char *what) {
  return hk_dataset_refuse(source->path, source->dataset, what);
}

static int32_t fail(const struct source *source, const char *what) {
  return hk_h5_fail(source->guard, source->path, what);
}

/* Memory for the numbers of a part of `data`, and for HDF5's own while reading them. */
static int32_t check_space(const struct source *source, const struct hk_dataset *data, const hsize_t *part) {
  double bytes = sizeof(double);
  for (int k = 0; k < data->rank; k++)
    bytes *= (double)part[k];
  char what[192];
  snprintf(what, sizeof what, "dataset %.150s", source->dataset);
  return hk_memory_require(source->memory_limit, bytes + hk_dataset_read_bytes(data, part), what);
}

/* Frames before the first without a time. */
static int32_t count_timed(const struct source *source, const struct hk_dataset *data, int64_t *frames) {
  int32_t status = check_space(source, data, data->size);
  if (status != HOOKE_OK) return status;
  double *time = hk_new(*frames, sizeof(double));
  if (time == NULL) return HOOKE_NO_MEMORY;
  if (H5Dread(data->id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, time) < 0)
    status = fail(source, "read the times of the frames");
  for (int64_t k = 0; status == HOOKE_OK && k < *frames; k++) {
    if (isnan(time[k])) *frames = k;
  }
  hk_free(time);
  return status;
}

/* All frames if the sibling `time` does not have one for each of them, or the run is over. */
static int32_t count_frames(const struct source *source, int64_t *frames) {
  *frames = (int64_t)source->data.size[0];
  const char *slash = strrchr(source->dataset, '/');
  const int folder = slash ? (int)(slash - source->dataset) + 1 : 0;
  const int64_t capacity = folder + 8;
  char *name = hk_new(capacity, 1);
  if (name == NULL) return HOOKE_NO_MEMORY;
  snprintf(name, (size_t)capacity, "%.*stime", folder, source->dataset);
  struct hk_dataset time;
  int32_t status = hk_dataset_find(source->guard, source->file, source->path, name, &time);
  hk_free(name);
  const int each =
      time.rank == 1 && *frames > 0 && time.size[0] == source->data.size[0] && !hk_h5md_is_over(source->file);
  if (status == HOOKE_OK && each) status = count_timed(source, &time, frames);
  hk_h5_drop(time.id);
  return status == HOOKE_BAD_VALUE && !each ? HOOKE_OK : status;
}

static int32_t choose_frame(const struct source *source, int64_t *frame, int32_t has_frame) {
  if (source->data.rank < 3) {
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

static int32_t read_values(const struct source *source, int64_t frame, double **values, int64_t *rows,
                           int64_t *columns) {
  const int framed = source->data.rank == 3;
  const hsize_t *size = source->data.size + framed;
  const hsize_t high = size[0], wide = source->data.rank == 1 ? 1 : size[1];
  if ((double)high * (double)wide > 3.0 * INT32_MAX) {
    return refuse(source, "has more numbers than a system has coordinates (3 x 2147483647)");
  }
  const hsize_t count = high * wide;
  const hsize_t begin[3] = {(hsize_t)frame, 0, 0}, part[3] = {1, high, wide};
  const int32_t capacity = check_space(source, &source->data, part + !framed);
  if (capacity != HOOKE_OK) return capacity;
  *values = hk_new((int64_t)count, sizeof(double));
  if (*values == NULL) return HOOKE_NO_MEMORY;
  hid_t there = H5Dget_space(source->data.id), here = H5Screate_simple(1, &count, NULL);
  herr_t result = there < 0 || here < 0 ? -1 : 0;
  if (result >= 0 && framed) result = H5Sselect_hyperslab(there, H5S_SELECT_SET, begin, NULL, part, NULL);
  if (result >= 0) result = H5Dread(source->data.id, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, *values);
  *rows = (int64_t)high;
  *columns = (int64_t)wide;
  int32_t status = result < 0 ? fail(source, "read the numbers") : HOOKE_OK;
  hk_h5_drop(here);
  hk_h5_drop(there);
  return status;
}

static int32_t read_open(struct source *source, int64_t frame, int32_t has_frame, int32_t check,
                         double **values, int64_t *rows, int64_t *columns) {
  *values = NULL;
  *rows = *columns = 0;
  int32_t status = hk_dataset_open(source->guard, source->file, source->path, source->dataset, &source->data);
  if (status == HOOKE_OK) status = choose_frame(source, &frame, has_frame);
  if (status == HOOKE_OK) status = read_values(source, frame, values, rows, columns);
  if (status == HOOKE_OK && source->data.rank == 3 && check)
    status = hk_frame_check(source->guard, source->file, source->path, source->dataset, frame, *values);
  if (status != HOOKE_OK) {
    hk_free(*values);
    *values = NULL;
  }
  hk_h5_drop(source->data.id);
  return status;
}

int32_t hk_array_read_open(struct hk_h5_guard *guard, hid_t file, const char *path, const char *dataset,
                           int64_t frame, int32_t has_frame, int32_t check, double **values, int64_t *rows,
                           int64_t *columns) {
  struct source source = {.guard = guard, .path = path, .dataset = dataset, .file = file};
  return read_open(&source, frame, has_frame, check, values, rows, columns);
}

int32_t hk_array_read_within(double memory_limit, const char *path, const char *dataset, int64_t frame,
                             int32_t has_frame, double **values, int64_t *rows, int64_t *columns) {
  struct hk_h5_guard guard;
  struct source source = {.guard = &guard, .memory_limit = memory_limit, .path = path, .dataset = dataset};
  *values = NULL;
  *rows = *columns = 0;
  hk_h5_guard_begin(&guard);
  int32_t status = hk_dataset_file(&guard, path, &source.file);
  if (status == HOOKE_OK) status = read_open(&source, frame, has_frame, 1, values, rows, columns);
  if (source.file >= 0) H5Fclose(source.file);
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
