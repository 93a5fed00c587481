/* Frames: arrays made in advance, written in place, the time last. */
#include "core/memory.h"

#if HOOKE_HAVE_HDF5

#include "io/object_h5.h"
#include "io/recording_h5.h"
#include "model/system.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- making ---- */

static double frame_bytes(int64_t particle_count) {
  int32_t numbers = 2; /* step and time */
  for (int k = 0; k < HOOKE_OBSERVABLE_COUNT; k++)
    numbers += hooke_observables[k].columns;
  return 8.0 * (6.0 * (double)particle_count + numbers);
}

double hooke_recording_bytes(const hooke_system *system, int64_t frame_count) {
  const int64_t n = hooke_system_particle_count(system);
  const double groups = 32768.0, fixed = 12.0 * (double)n + 16.0 * (double)hooke_system_spring_count(system);
  return groups + fixed + frame_bytes(n) * (double)frame_count;
}

double hooke_recording_unused_bytes(const struct hooke_recording *recording) {
  return frame_bytes(recording->particle_count) * (double)(recording->frame_count - recording->written);
}

/* An array of numbers for all frames, `rows` x `columns` each. Numbers have the machine's order of bytes, since frames are
 * written as bytes. */
static hid_t new_frames(const struct hooke_recording *recording, hid_t where, int64_t rows, int32_t columns) {
  const double fill = NAN;
  const hsize_t frames = (hsize_t)recording->frame_count;
  const hsize_t table[3] = {frames, (hsize_t)rows, (hsize_t)columns};
  const hsize_t line[2] = {frames, (hsize_t)columns};
  if (rows > 0) return hooke_h5_room(where, "value", H5T_NATIVE_DOUBLE, 3, table);
  return hooke_h5_array(where, "value", H5T_NATIVE_DOUBLE, columns > 1 ? 2 : 1, line, &fill);
}

/* step and time: made with the first element, shared by the others. */
static herr_t add_clock(struct hooke_recording *recording, hid_t element) {
  if (recording->time >= 0) {
    herr_t result = H5Lcreate_hard(recording->time, ".", element, "time", H5P_DEFAULT, H5P_DEFAULT);
    return result < 0 ? result
                      : H5Lcreate_hard(recording->step, ".", element, "step", H5P_DEFAULT, H5P_DEFAULT);
  }
  const hsize_t size = (hsize_t)recording->frame_count;
  const double no_time = NAN;
  const int64_t no_step = -1;
  recording->step = hooke_h5_array(element, "step", H5T_NATIVE_INT64, 1, &size, &no_step);
  if (recording->step < 0) return -1;
  recording->time = hooke_h5_array(element, "time", H5T_NATIVE_DOUBLE, 1, &size, &no_time);
  return recording->time < 0 ? -1 : 0;
}

/* An H5MD element: a group with value, step and time. The value's array, or a negative number. */
static hid_t new_element(struct hooke_recording *recording, hid_t where, const char *name, int64_t rows,
                         int32_t columns) {
  hid_t element = H5Gcreate2(where, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (element < 0) return -1;
  hid_t value = add_clock(recording, element) < 0 ? -1 : new_frames(recording, element, rows, columns);
  hooke_h5_drop(element);
  return value;
}

static herr_t write_box(hid_t where) {
  const char *const boundary[] = {"none", "none", "none"};
  const int32_t dimension = 3;
  hid_t box = H5Gcreate2(where, "box", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  herr_t result = box < 0 ? -1 : hooke_h5_integer_attribute(box, "dimension", 1, &dimension);
  if (result >= 0) result = hooke_h5_text_attributes(box, "boundary", 3, boundary);
  hooke_h5_drop(box);
  return result;
}

static herr_t write_particles(const struct hooke_recording *recording, hid_t where) {
  const hooke_system *system = recording->system;
  const hsize_t size = (hsize_t)recording->particle_count;
  int32_t *species = hooke_new(recording->particle_count, sizeof(int32_t));
  if (species == NULL) return -1;
  for (int64_t k = 0; k < recording->particle_count; k++) {
    species[k] = system->held[k] == HOOKE_HELD_PINNED ? 1 : system->held[k] == HOOKE_HELD_DRIVEN ? 2 : 0;
  }
  herr_t result = hooke_h5_array_of(where, "species", H5T_STD_I32LE, H5T_NATIVE_INT32, 1, &size, species);
  hooke_free(species);
  if (result < 0) return result;
  return hooke_h5_array_of(where, "mass", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &size,
                           hooke_system_mass(system));
}

/* A group, and those above it. */
static hid_t group_at(hid_t file, const char *path) {
  hid_t links = H5Pcreate(H5P_LINK_CREATE);
  hid_t group = links < 0 || H5Pset_create_intermediate_group(links, 1) < 0
                    ? -1
                    : H5Gcreate2(file, path, links, H5P_DEFAULT, H5P_DEFAULT);
  hooke_h5_drop(links);
  return group;
}

static herr_t make_arrays(hid_t file, struct hooke_recording *recording, int32_t copied) {
  char path[80];
  snprintf(path, sizeof path, "particles/%s", recording->group);
  hid_t particles = group_at(file, path);
  if (particles < 0) return -1;
  recording->position = new_element(recording, particles, "position", recording->particle_count, 3);
  if (recording->position >= 0) {
    recording->velocity = new_element(recording, particles, "velocity", recording->particle_count, 3);
  }
  herr_t result = recording->velocity < 0 ? -1 : 0;
  if (result >= 0 && !copied) result = write_box(particles);
  if (result >= 0 && !copied) result = write_particles(recording, particles);
  hooke_h5_drop(particles);
  if (result < 0) return result;

  const int32_t all = strcmp(recording->group, "all") == 0;
  snprintf(path, sizeof path, "observables%s%s", all ? "" : "/", all ? "" : recording->group);
  hid_t group = group_at(file, path);
  if (group < 0) return -1;
  for (int k = 0; result >= 0 && k < HOOKE_OBSERVABLE_COUNT; k++) {
    recording->observable[k] =
        new_element(recording, group, hooke_observables[k].name, 0, hooke_observables[k].columns);
    if (recording->observable[k] < 0) result = -1;
  }
  hooke_h5_drop(group);
  return result;
}

/* Where the arrays begin, and a descriptor of the file that is ours. */
static herr_t find_bytes(hid_t file, struct hooke_recording *recording) {
  const hid_t array[] = {recording->time, recording->step, recording->position, recording->velocity};
  struct hooke_frame_file *bytes = &recording->file;
  int64_t *const at[] = {&bytes->time, &bytes->step, &bytes->position, &bytes->velocity};
  herr_t result = 0;
  for (int k = 0; k < 4 + HOOKE_OBSERVABLE_COUNT; k++) {
    const haddr_t first = H5Dget_offset(k < 4 ? array[k] : recording->observable[k - 4]);
    if (first == HADDR_UNDEF) result = -1;
    *(k < 4 ? at[k] : &bytes->observable[k - 4]) = (int64_t)first;
  }
  void *handle = NULL;
  if (result >= 0) result = H5Fget_vfd_handle(file, H5P_DEFAULT, &handle);
  if (result < 0) return result;
  bytes->system = recording->system;
  bytes->descriptor = fcntl(*(const int *)handle, F_DUPFD_CLOEXEC, 0);
  return bytes->descriptor < 0 ? -1 : 0;
}

void hooke_recording_clear(struct hooke_recording *recording) {
  *recording = (struct hooke_recording){
      .time = -1, .step = -1, .position = -1, .velocity = -1, .file = {.descriptor = -1}};
  for (int k = 0; k < HOOKE_OBSERVABLE_COUNT; k++)
    recording->observable[k] = -1;
}

static void start(struct hooke_recording *recording, const hooke_system *system, const char *group, int64_t n,
                  int64_t frame_count) {
  hooke_recording_clear(recording);
  recording->system = system;
  recording->particle_count = n;
  recording->frame_count = frame_count;
  snprintf(recording->group, sizeof recording->group, "%s", group);
}

herr_t hooke_recording_create(hid_t file, const hooke_system *system, const char *group, int64_t frame_count,
                              struct hooke_recording *recording) {
  start(recording, system, group, hooke_system_particle_count(system), frame_count);
  const herr_t result = make_arrays(file, recording, 0);
  return result < 0 ? result : find_bytes(file, recording);
}

void hooke_recording_release(struct hooke_recording *recording) {
  if (recording->file.descriptor >= 0) close(recording->file.descriptor);
  for (int k = 0; k < HOOKE_OBSERVABLE_COUNT; k++)
    hooke_h5_drop(recording->observable[k]);
  hooke_h5_drop(recording->velocity);
  hooke_h5_drop(recording->position);
  hooke_h5_drop(recording->step);
  hooke_h5_drop(recording->time);
  hooke_recording_clear(recording);
}

/* ---- frames ---- */

/* Reads or writes frame `frame` of an array, `count` numbers. */
static herr_t transfer(hid_t dataset, hid_t memory, int64_t frame, int64_t count, const void *out, void *in) {
  hsize_t size[3] = {0}, begin[3] = {(hsize_t)frame, 0, 0};
  const hsize_t line = (hsize_t)count;
  hid_t space = H5Dget_space(dataset), here = H5Screate_simple(1, &line, NULL);
  herr_t result = space < 0 || here < 0 ? -1 : H5Sget_simple_extent_dims(space, size, NULL);
  size[0] = 1;
  if (result >= 0) result = H5Sselect_hyperslab(space, H5S_SELECT_SET, begin, NULL, size, NULL);
  if (result >= 0) {
    result = out ? H5Dwrite(dataset, memory, here, space, H5P_DEFAULT, out)
                 : H5Dread(dataset, memory, here, space, H5P_DEFAULT, in);
  }
  hooke_h5_drop(here);
  hooke_h5_drop(space);
  return result;
}

static herr_t write_row(hid_t dataset, int64_t frame, int64_t count, const double *value) {
  return transfer(dataset, H5T_NATIVE_DOUBLE, frame, count, value, NULL);
}

static herr_t write_clock(const struct hooke_recording *recording, int64_t frame, int64_t step, double time) {
  herr_t result = transfer(recording->step, H5T_NATIVE_INT64, frame, 1, &step, NULL);
  return result < 0 ? result : write_row(recording->time, frame, 1, &time);
}

int hooke_recording_write(struct hooke_recording *recording, int64_t step, const hooke_state *state) {
  const int error = hooke_frame_write(&recording->file, recording->written, step, state);
  recording->written += error == 0;
  return error;
}

/* ---- copying ---- */

static herr_t copy_row(hid_t from, hid_t to, int64_t frame, int64_t count, double *scratch) {
  herr_t result = transfer(from, H5T_NATIVE_DOUBLE, frame, count, NULL, scratch);
  return result < 0 ? result : write_row(to, frame, count, scratch);
}

static herr_t copy_frame(const struct hooke_recording *from, const struct hooke_recording *to, int64_t frame,
                         double *scratch) {
  const int64_t numbers = 3 * from->particle_count;
  int64_t step = -1;
  herr_t result = copy_row(from->position, to->position, frame, numbers, scratch);
  if (result >= 0) result = copy_row(from->velocity, to->velocity, frame, numbers, scratch);
  for (int k = 0; result >= 0 && k < HOOKE_OBSERVABLE_COUNT; k++) {
    result = copy_row(from->observable[k], to->observable[k], frame, hooke_observables[k].columns, scratch);
  }
  if (result >= 0) result = transfer(from->step, H5T_NATIVE_INT64, frame, 1, NULL, &step);
  if (result >= 0) result = transfer(from->time, H5T_NATIVE_DOUBLE, frame, 1, NULL, scratch);
  return result < 0 ? result : write_clock(to, frame, step, scratch[0]);
}

static herr_t copy_object(hid_t from, hid_t to, const char *group, const char *name) {
  char path[96];
  snprintf(path, sizeof path, "/particles/%s/%s", group, name);
  return H5Ocopy(from, path, to, path, H5P_DEFAULT, H5P_DEFAULT);
}

herr_t hooke_recording_copy(const struct hooke_recording *from, hid_t file, struct hooke_recording *to) {
  start(to, from->system, from->group, from->particle_count, from->written);
  herr_t result = make_arrays(file, to, 1);
  if (result >= 0) result = copy_object(from->position, file, from->group, "box");
  if (result >= 0) result = copy_object(from->position, file, from->group, "species");
  if (result >= 0) result = copy_object(from->position, file, from->group, "mass");
  double *scratch = hooke_new(3 * from->particle_count, sizeof(double));
  if (scratch == NULL) result = -1;
  for (int64_t k = 0; result >= 0 && k < from->written; k++)
    result = copy_frame(from, to, k, scratch);
  if (result >= 0) to->written = from->written;
  hooke_free(scratch);
  return result;
}

#endif
