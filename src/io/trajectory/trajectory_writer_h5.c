/* Frames: arrays created in advance, written in place, the time last. */
#include "core/memory.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/object_h5.h"
#include "io/trajectory/trajectory_writer_h5.h"
#include "model/particles.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- creating ---- */

static double frame_bytes(int64_t particle_count) {
  double bytes = 0.0;
  for (int k = 0; k < HOOKE_FRAME_ARRAY_COUNT; k++)
    bytes += (double)hk_frame_bytes(particle_count, k);
  return bytes;
}

double hk_trajectory_writer_bytes(const hooke_system *system, int64_t frame_count) {
  const int64_t n = hooke_system_particle_count(system);
  const double groups = 32768.0,
               fixed = 12.0 * (double)n + 16.0 * (double)hooke_system_count(system, "springs");
  return groups + fixed + frame_bytes(n) * (double)frame_count;
}

double hk_trajectory_writer_bytes_after(const struct hk_trajectory_writer *writer, int64_t first) {
  return frame_bytes(writer->file.particle_count) * (double)(writer->frame_count - first);
}

void hk_trajectory_writer_path(const char *group, int array, char path[HOOKE_WRITER_PATH]) {
  const int all = strcmp(group, "all") == 0;
  const char *slash = all ? "" : "/", *folder = all ? "" : group;
  switch (array) {
  case HOOKE_FRAME_STEP:
  case HOOKE_FRAME_TIME:
    snprintf(path, HOOKE_WRITER_PATH, "/particles/%s/position/%s", group,
             array == HOOKE_FRAME_STEP ? "step" : "time");
    return;
  case HOOKE_FRAME_POSITION:
  case HOOKE_FRAME_VELOCITY:
    snprintf(path, HOOKE_WRITER_PATH, "/particles/%s/%s/value", group,
             array == HOOKE_FRAME_POSITION ? "position" : "velocity");
    return;
  case HOOKE_FRAME_CHECK:
    snprintf(path, HOOKE_WRITER_PATH, "/hooke%s%s/frame_check", slash, folder);
    return;
  default:
    snprintf(path, HOOKE_WRITER_PATH, "/observables%s%s/%s/value", slash, folder,
             hk_observables[array - HOOKE_FRAME_OBSERVABLE].name);
  }
}

/* Working data of creation. */
struct arrays {
  const struct hk_trajectory_writer *writer;
  hid_t id[HOOKE_FRAME_ARRAY_COUNT];
};

/* An array of numbers for all frames, `rows` x `columns` each. Numbers have the machine's byte order, since
 * frames are written as bytes. */
static hid_t new_frames(const struct arrays *arrays, hid_t where, int64_t rows, int32_t columns) {
  const double fill = NAN;
  const hsize_t frames = (hsize_t)arrays->writer->frame_count;
  const hsize_t table[3] = {frames, (hsize_t)rows, (hsize_t)columns};
  const hsize_t line[2] = {frames, (hsize_t)columns};
  if (rows > 0) return hk_h5_room(where, "value", H5T_NATIVE_DOUBLE, 3, table);
  return hk_h5_array(where, "value", H5T_NATIVE_DOUBLE, columns > 1 ? 2 : 1, line, &fill);
}

/* step and time: created with the first element, shared by the others. */
static herr_t add_clock(struct arrays *arrays, hid_t element) {
  hid_t *step = &arrays->id[HOOKE_FRAME_STEP], *time = &arrays->id[HOOKE_FRAME_TIME];
  if (*time >= 0) {
    herr_t result = H5Lcreate_hard(*time, ".", element, "time", H5P_DEFAULT, H5P_DEFAULT);
    return result < 0 ? result : H5Lcreate_hard(*step, ".", element, "step", H5P_DEFAULT, H5P_DEFAULT);
  }
  const hsize_t size = (hsize_t)arrays->writer->frame_count;
  const double no_time = NAN;
  const int64_t no_step = -1;
  *step = hk_h5_array(element, "step", H5T_NATIVE_INT64, 1, &size, &no_step);
  if (*step < 0) return -1;
  *time = hk_h5_array(element, "time", H5T_NATIVE_DOUBLE, 1, &size, &no_time);
  return *time < 0 ? -1 : 0;
}

/* An H5MD element: a group with value, step and time. */
static herr_t new_element(struct arrays *arrays, int array, hid_t where, const char *name, int64_t rows,
                          int32_t columns) {
  hid_t element = H5Gcreate2(where, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (element < 0) return -1;
  if (add_clock(arrays, element) >= 0) arrays->id[array] = new_frames(arrays, element, rows, columns);
  hk_h5_drop(element);
  return arrays->id[array] < 0 ? -1 : 0;
}

static herr_t write_box(hid_t where) {
  const char *const boundary[] = {"none", "none", "none"};
  const int32_t dimension = 3;
  hid_t box = H5Gcreate2(where, "box", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  herr_t result = box < 0 ? -1 : hk_h5_integer_attribute(box, "dimension", 1, &dimension);
  if (result >= 0) result = hk_h5_text_attributes(box, "boundary", 3, boundary);
  hk_h5_drop(box);
  return result;
}

static herr_t write_particles(const struct hk_trajectory_writer *writer, hid_t where) {
  const hooke_system *system = writer->system;
  const int64_t count = writer->file.particle_count;
  const hsize_t size = (hsize_t)count;
  int32_t *species = hk_new(count, sizeof(int32_t));
  if (species == NULL) return -1;
  for (int64_t k = 0; k < count; k++) {
    species[k] = system->constrained[k] == HOOKE_IS_PINNED   ? 1
                 : system->constrained[k] == HOOKE_IS_DRIVEN ? 2
                                                             : 0;
  }
  herr_t result = hk_h5_array_of(where, "species", H5T_STD_I32LE, H5T_NATIVE_INT32, 1, &size, species);
  hk_free(species);
  if (result < 0) return result;
  return hk_h5_array_of(where, "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &size,
                        hooke_system_mass(system));
}

/* Opens a group, creating it if needed. */
static hid_t group_in(hid_t where, const char *name) {
  return H5Lexists(where, name, H5P_DEFAULT) > 0
             ? H5Gopen2(where, name, H5P_DEFAULT)
             : H5Gcreate2(where, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

static hid_t group_at(hid_t file, const char *folder, const char *name) {
  hid_t outer = group_in(file, folder), inner = outer < 0 ? -1 : group_in(outer, name);
  hk_h5_drop(outer);
  return inner;
}

/* `folder` is the folder of the group `all`; the others have a subfolder in it. */
static hid_t folder_of(hid_t file, const char *folder, const char *group) {
  return strcmp(group, "all") == 0 ? group_in(file, folder) : group_at(file, folder, group);
}

static herr_t make_particles(hid_t file, struct arrays *arrays, int32_t copied) {
  const struct hk_trajectory_writer *writer = arrays->writer;
  hid_t particles = group_at(file, "particles", writer->group);
  const int64_t n = writer->file.particle_count;
  herr_t result = particles < 0 ? -1 : new_element(arrays, HOOKE_FRAME_POSITION, particles, "position", n, 3);
  if (result >= 0) result = new_element(arrays, HOOKE_FRAME_VELOCITY, particles, "velocity", n, 3);
  if (result >= 0 && !copied) result = write_box(particles);
  if (result >= 0 && !copied) result = write_particles(writer, particles);
  hk_h5_drop(particles);
  return result;
}

static herr_t make_observables(hid_t file, struct arrays *arrays) {
  hid_t group = folder_of(file, "observables", arrays->writer->group);
  herr_t result = group < 0 ? -1 : 0;
  for (int k = 0; result >= 0 && k < HOOKE_OBSERVABLE_COUNT; k++)
    result = new_element(arrays, HOOKE_FRAME_OBSERVABLE + k, group, hk_observables[k].name, 0,
                         hk_observables[k].columns);
  hk_h5_drop(group);
  return result;
}

static herr_t make_check(hid_t file, struct arrays *arrays) {
  const hsize_t size = (hsize_t)arrays->writer->frame_count;
  hid_t group = folder_of(file, "hooke", arrays->writer->group);
  hid_t *check = &arrays->id[HOOKE_FRAME_CHECK];
  if (group >= 0) *check = hk_h5_array(group, "frame_check", H5T_NATIVE_UINT32, 1, &size, NULL);
  hk_h5_drop(group);
  return *check < 0 ? -1 : 0;
}

/* Creates all arrays and records their offsets. */
static herr_t make_arrays(hid_t file, struct hk_trajectory_writer *writer, int32_t copied) {
  struct arrays arrays = {.writer = writer};
  for (int k = 0; k < HOOKE_FRAME_ARRAY_COUNT; k++)
    arrays.id[k] = -1;
  herr_t result = make_particles(file, &arrays, copied);
  if (result >= 0) result = make_observables(file, &arrays);
  if (result >= 0) result = make_check(file, &arrays);
  for (int k = 0; k < HOOKE_FRAME_ARRAY_COUNT; k++) {
    const haddr_t first = result >= 0 ? H5Dget_offset(arrays.id[k]) : HADDR_UNDEF;
    const int empty = result >= 0 && H5Dget_storage_size(arrays.id[k]) == 0;
    if (first == HADDR_UNDEF && !empty) result = -1;
    writer->file.at[k] = empty ? 0 : (int64_t)first;
    hk_h5_drop(arrays.id[k]);
  }
  return result;
}

static void start(struct hk_trajectory_writer *writer, const hooke_system *system, const char *group,
                  int64_t n, int64_t frame_count) {
  *writer = (struct hk_trajectory_writer){.system = system, .frame_count = frame_count};
  writer->file = (struct hk_frame_file){.system = system, .descriptor = -1, .particle_count = n};
  snprintf(writer->group, sizeof writer->group, "%s", group);
}

herr_t hk_trajectory_writer_create(hid_t file, const hooke_system *system, const char *group,
                                   int64_t frame_count, struct hk_trajectory_writer *writer) {
  start(writer, system, group, hooke_system_particle_count(system), frame_count);
  return make_arrays(file, writer, 0);
}

/* ---- frames ---- */

int hk_trajectory_writer_write(struct hk_trajectory_writer *writer, int64_t step, const hooke_state *state) {
  const int error = hk_frame_write(&writer->file, writer->written, step, state);
  writer->written += error == 0;
  return error;
}

/* ---- copying ---- */

herr_t hk_trajectory_writer_copy(const struct hk_trajectory_writer *from, hid_t from_file, hid_t file,
                                 int64_t frame_count, struct hk_trajectory_writer *to,
                                 struct hk_h5_copy *copy) {
  const char *const names[] = {"box", "species", "mass"};
  start(to, from->system, from->group, from->file.particle_count, frame_count);
  herr_t result = make_arrays(file, to, 1);
  for (int k = 0; result >= 0 && k < 3; k++) {
    char path[96];
    snprintf(path, sizeof path, "particles/%s/%s", from->group, names[k]);
    result = hk_h5_copy(from_file, file, path, NULL, copy);
  }
  return result;
}

#endif
