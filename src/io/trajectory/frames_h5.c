/* Frames: arrays created in advance, and found in a file. */
#include "core/crc32.h"
#include "core/memory.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/object_h5.h"
#include "io/trajectory/frames_h5.h"
#include "model/particles.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Type of the numbers of an array: of this machine, since frames are written as bytes. */
static hid_t type_of(int array) {
  return array == HOOKE_FRAME_STEP    ? H5T_NATIVE_INT64
         : array == HOOKE_FRAME_CHECK ? H5T_NATIVE_UINT32
                                      : H5T_NATIVE_DOUBLE;
}

static int is_table(int array) {
  return array == HOOKE_FRAME_POSITION || array == HOOKE_FRAME_VELOCITY;
}

/* ---- creating ---- */

static hid_t new_array(hid_t file, const struct hk_frame_file *frames, int array, const char *path) {
  static const double none = NAN;
  static const int64_t no_step = -1;
  static const uint32_t no_check = 0;
  const hsize_t size[3] = {(hsize_t)frames->frame_count, (hsize_t)frames->particle_count, 3};
  const hsize_t line[2] = {size[0], (hsize_t)hk_frame_numbers(frames->particle_count, array)};
  if (is_table(array)) return hk_h5_array(file, path, H5T_NATIVE_DOUBLE, 3, size, NULL);
  return hk_h5_array(file, path, type_of(array), line[1] > 1 ? 2 : 1, line,
                     array == HOOKE_FRAME_STEP    ? (const void *)&no_step
                     : array == HOOKE_FRAME_CHECK ? (const void *)&no_check
                                                  : &none);
}

/* An element of H5MD has the step and the time beside its value. */
static herr_t share_clock(hid_t file, const char *group, const char *value) {
  herr_t result = 0;
  for (int k = HOOKE_FRAME_STEP; result >= 0 && k <= HOOKE_FRAME_TIME; k++) {
    char clock[HOOKE_FRAME_PATH], own[HOOKE_FRAME_PATH + 8];
    hk_frame_path(group, k, clock);
    snprintf(own, sizeof own, "%.*s%s", (int)(strrchr(value, '/') - value), value, strrchr(clock, '/'));
    result = H5Lcreate_hard(file, clock, file, own, H5P_DEFAULT, H5P_DEFAULT);
  }
  return result;
}

herr_t hk_frame_arrays_make(hid_t file, struct hk_frame_file *frames) {
  herr_t result = 0;
  for (int k = 0; result >= 0 && k < HOOKE_FRAME_ARRAY_COUNT; k++) {
    char path[HOOKE_FRAME_PATH];
    hk_frame_path(frames->group, k, path);
    hid_t array = new_array(file, frames, k, path);
    frames->at[k] =
        hk_h5_place(array, type_of(k), frames->frame_count * hk_frame_bytes(frames->particle_count, k));
    if (frames->at[k] < 0) result = -1;
    if (result >= 0 && k > HOOKE_FRAME_POSITION && k < HOOKE_FRAME_CHECK)
      result = share_clock(file, frames->group, path);
    hk_h5_drop(array);
  }
  return result;
}

static herr_t write_box(hid_t particles) {
  const char *const boundary[] = {"none", "none", "none"};
  const int32_t dimension = 3;
  hid_t box = hk_h5_group(particles, "box");
  herr_t result = hk_h5_attribute(box, "dimension", H5T_NATIVE_INT32, 1, &dimension);
  if (result >= 0) result = hk_h5_text_attributes(box, "boundary", 3, boundary);
  hk_h5_drop(box);
  return result;
}

static herr_t write_particles(hid_t particles, const hooke_system *system) {
  const int64_t count = hooke_system_particle_count(system);
  const hsize_t size = (hsize_t)count;
  int32_t *species = hk_new(count, sizeof(int32_t));
  if (species == NULL) return -1;
  for (int64_t k = 0; k < count; k++) {
    species[k] = system->constrained[k] == HOOKE_IS_PINNED   ? 1
                 : system->constrained[k] == HOOKE_IS_DRIVEN ? 2
                                                             : 0;
  }
  herr_t result = hk_h5_array_of(particles, "species", H5T_STD_I32LE, H5T_NATIVE_INT32, 1, &size, species);
  hk_free(species);
  if (result < 0) return result;
  return hk_h5_array_of(particles, "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &size,
                        hooke_system_mass(system));
}

void hk_frame_arrays_plan(const hooke_system *system, const char *group, int64_t frame_count,
                          struct hk_frame_file *frames) {
  *frames = (struct hk_frame_file){.system = system,
                                   .descriptor = -1,
                                   .particle_count = hooke_system_particle_count(system),
                                   .frame_count = frame_count};
  snprintf(frames->group, sizeof frames->group, "%s", group);
}

herr_t hk_frame_arrays_create(hid_t file, struct hk_frame_file *frames) {
  char path[HOOKE_FRAME_PATH];
  snprintf(path, sizeof path, "particles/%s", frames->group);
  herr_t result = hk_frame_arrays_make(file, frames);
  hid_t particles = result < 0 ? -1 : hk_h5_group(file, path);
  if (result >= 0) result = write_box(particles);
  if (result >= 0) result = write_particles(particles, frames->system);
  hk_h5_drop(particles);
  return result;
}

/* ---- finding ---- */

/* Opens an array of a file, whose `id` is -1 if it is not there or not of the form that hooke gives it. The
 * first array tells the number of frames, if that is -1, and positions that of particles. */
static int32_t open_array(struct hk_h5_guard *guard, struct hk_frame_file *frames, int array,
                          struct hk_dataset *data) {
  char name[HOOKE_FRAME_PATH];
  hk_frame_path(frames->group, array, name);
  const int32_t status = hk_dataset_open(guard, name, 1, data);
  if (status != HOOKE_OK || data->id < 0) return status;
  if (frames->frame_count < 0) frames->frame_count = (int64_t)data->size[0];
  if (frames->particle_count < 0 && array == HOOKE_FRAME_POSITION)
    frames->particle_count = (int64_t)data->size[1];
  const hsize_t rows = is_table(array) ? (hsize_t)frames->particle_count : 1,
                numbers = is_table(array) ? 3 : (hsize_t)hk_frame_numbers(0, array);
  const int fits = data->size[0] == (hsize_t)frames->frame_count &&
                   (is_table(array) ? data->rank == 3 && data->size[1] == rows && data->size[2] == numbers
                    : numbers == 1  ? data->rank == 1
                                    : data->rank == 2 && data->size[1] == numbers);
  if (fits) return HOOKE_OK;
  hk_h5_drop(data->id);
  data->id = -1;
  return HOOKE_OK;
}

int32_t hk_frame_arrays_find(struct hk_h5_guard *guard, struct hk_frame_file *frames) {
  int32_t status = HOOKE_OK;
  *frames = (struct hk_frame_file){.group = "all", .descriptor = -1, .particle_count = -1, .frame_count = -1};
  for (int k = 0; status != HOOKE_NO_MEMORY && k < HOOKE_FRAME_ARRAY_COUNT; k++) {
    struct hk_dataset data;
    status = open_array(guard, frames, k, &data);
    const int64_t bytes = frames->frame_count * hk_frame_bytes(frames->particle_count, k);
    frames->at[k] = status == HOOKE_OK && data.id >= 0 ? hk_h5_place(data.id, type_of(k), bytes) : -1;
    hk_h5_drop(data.id);
  }
  return status == HOOKE_NO_MEMORY ? status : HOOKE_OK;
}

/* ---- the check value of a frame ---- */

/* Numbers read at a time. */
enum { BLOCK = 3 * 8192 };

struct check {
  struct hk_h5_guard *guard;
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
                 check->guard->path, why);
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
  int32_t status = open_array(check->guard, &check->frames, array, &data);
  if (status == HOOKE_OK && data.id < 0) status = damaged(check, "its arrays do not belong together");
  const int is_known = status == HOOKE_OK && check->known && array == check->known_array;
  const hsize_t rows = data.rank == 3 ? data.size[1] : 1;
  if (is_known) check->value = hk_crc32(check->value, check->known, (int64_t)(8 * 3 * rows));
  for (hsize_t k = 0; status == HOOKE_OK && !is_known && k < rows; k += BLOCK / 3) {
    const hsize_t most = rows - k < BLOCK / 3 ? rows - k : BLOCK / 3;
    const hssize_t count = read_rows(check, &data, type_of(array), k, most, check->block);
    if (count < 0) status = hk_h5_fail(check->guard, "read the frame");
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
    return hk_h5_fail(check->guard, "read the check value of a frame");
  if (stored == check->value) return HOOKE_OK;
  return damaged(check, "its numbers are not those that were written, by the "
                        "check value beside them; other frames may be whole");
}

int32_t hk_frame_check(struct hk_h5_guard *guard, const char *dataset, int64_t frame, const double *known) {
  struct check check = {.guard = guard, .frame = frame, .known = known};
  check.frames.particle_count = check.frames.frame_count = -1;
  struct hk_dataset data;
  char name[HOOKE_FRAME_PATH];
  if (!is_moving(dataset, &check)) return HOOKE_OK;
  hk_frame_path(check.frames.group, HOOKE_FRAME_CHECK, name);
  int32_t status = hk_dataset_open(guard, name, 1, &data);
  if (status == HOOKE_OK && data.id >= 0) {
    check.block = hk_reserve(BLOCK, sizeof(double));
    status = check.block ? compare(&check, &data) : HOOKE_NO_MEMORY;
    hk_free(check.block);
  }
  hk_h5_drop(data.id);
  return status;
}

#endif
