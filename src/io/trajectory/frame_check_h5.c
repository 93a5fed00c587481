#include "core/memory.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "core/crc32.h"
#include "io/trajectory/frame_check_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/trajectory/frames_h5.h"

#include <stdio.h>
#include <string.h>

/* Numbers read at a time. */
enum { BLOCK = 3 * 8192 };

struct check {
  struct hk_h5_guard *guard;
  hid_t file;
  const char *path;
  struct hk_frame_file frames;
  int64_t frame;
  int known_array;
  const double *known;
  void *block;
  uint32_t value;
};

/* True if a dataset is the position or the velocity of a run; tells which. */
static int is_moving(const char *dataset, struct check *check) {
  char name[16] = "", rest[16] = "", more = 0;
  const int parts = sscanf(dataset[0] == '/' ? dataset + 1 : dataset, "particles/%47[^/]/%15[^/]/%15[^/]%c",
                           check->frames.group, name, rest, &more);
  if (parts != 3 || strcmp(rest, "value") != 0) return 0;
  check->known_array = strcmp(name, "position") == 0   ? HOOKE_FRAME_POSITION
                       : strcmp(name, "velocity") == 0 ? HOOKE_FRAME_VELOCITY
                                                       : -1;
  return check->known_array >= 0;
}

static int32_t damaged(const struct check *check, const char *why) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "frame %lld of %s is damaged: %s", (long long)check->frame,
                 check->path, why);
}

/* Reads `count` rows of the frame, from `first` on, or the numbers of an array without rows; returns how many
 * numbers, negative on failure. */
static hssize_t read_rows(const struct check *check, const struct hk_dataset *data, hid_t type, hsize_t first,
                          hsize_t count, void *numbers) {
  const int table = data->rank == 3;
  const hsize_t begin[3] = {(hsize_t)check->frame, first, 0};
  const hsize_t size[3] = {1, table ? count : data->size[1], data->size[2]};
  const hsize_t line = table ? count * data->size[2] : data->rank == 2 ? data->size[1] : 1;
  hid_t there = H5Dget_space(data->id), here = H5Screate_simple(1, &line, NULL);
  herr_t result = there < 0 || here < 0 ? -1 : 0;
  if (result >= 0) result = H5Sselect_hyperslab(there, H5S_SELECT_SET, begin, NULL, size, NULL);
  if (result >= 0) result = H5Dread(data->id, type, here, there, H5P_DEFAULT, numbers);
  hk_h5_drop(here);
  hk_h5_drop(there);
  return result < 0 ? -1 : (hssize_t)line;
}

static int32_t add_array(struct check *check, int array) {
  struct hk_dataset data;
  int32_t status = hk_frame_arrays_open(check->guard, check->file, check->path, &check->frames, array, &data);
  if (status == HOOKE_OK && data.id < 0) status = damaged(check, "its arrays do not belong together");
  const int is_known = status == HOOKE_OK && check->known && array == check->known_array;
  const hsize_t rows = data.rank == 3 ? data.size[1] : 1;
  if (is_known) check->value = hk_crc32(check->value, check->known, (int64_t)(8 * 3 * rows));
  for (hsize_t k = 0; status == HOOKE_OK && !is_known && k < rows; k += BLOCK / 3) {
    const hsize_t most = rows - k < BLOCK / 3 ? rows - k : BLOCK / 3;
    const hssize_t count = read_rows(check, &data, hk_frame_arrays_type(array), k, most, check->block);
    if (count < 0) status = hk_h5_fail(check->guard, check->path, "read the frame");
    if (count >= 0) check->value = hk_crc32(check->value, check->block, 8 * count);
  }
  hk_h5_drop(data.id);
  return status;
}

static int32_t compare(struct check *check, const struct hk_dataset *data) {
  uint32_t stored = 0;
  int32_t status = HOOKE_OK;
  check->frames.frame_count = (int64_t)data->size[0];
  if (data->rank != 1 || check->frame < 0 || check->frame >= check->frames.frame_count)
    return damaged(check, "it has no check value");
  for (int k = 0; status == HOOKE_OK && k < HOOKE_FRAME_CHECK; k++)
    status = add_array(check, k);
  if (status != HOOKE_OK) return status;
  if (read_rows(check, data, H5T_NATIVE_UINT32, 0, 1, &stored) < 0)
    return hk_h5_fail(check->guard, check->path, "read the check value of a frame");
  if (stored == check->value) return HOOKE_OK;
  return damaged(check, "its numbers are not those that were written, by the "
                        "check value beside them; other frames may be whole");
}

int32_t hk_frame_check(struct hk_h5_guard *guard, hid_t file, const char *path, const char *dataset,
                       int64_t frame, const double *known) {
  struct check check = {.guard = guard, .file = file, .path = path, .frame = frame, .known = known};
  check.frames.particle_count = check.frames.frame_count = -1;
  struct hk_dataset data;
  char name[HOOKE_FRAME_PATH];
  if (!is_moving(dataset, &check)) return HOOKE_OK;
  hk_frame_path(check.frames.group, HOOKE_FRAME_CHECK, name);
  int32_t status = hk_dataset_find(guard, file, path, name, &data);
  if (status == HOOKE_OK && data.id >= 0) {
    check.block = hk_reserve(BLOCK, sizeof(double));
    status = check.block ? compare(&check, &data) : HOOKE_NO_MEMORY;
    hk_free(check.block);
  }
  hk_h5_drop(data.id);
  return status;
}

#endif
