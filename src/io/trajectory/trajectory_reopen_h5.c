/* Reopens the file of an unfinished run. It must be, to the last array, the file that the run would have
 * created. */
#include "core/memory.h"
#include "core/status.h"
#include "io/trajectory/trajectory.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/dataset_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/file/atomic_file.h"
#include "io/trajectory/record_h5.h"
#include "io/trajectory/trajectory_h5.h"

#include <stdio.h>
#include <string.h>

/* ---- existing objects ---- */

static int32_t refuse(const hooke_trajectory *old, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: %s; this run cannot go on in it", old->file.atomic.path, what);
}

/* Without memory HDF5 does not find existing objects. */
static int32_t refuse_seen(const struct hk_h5_guard *guard, const hooke_trajectory *old, const char *what) {
  return guard->no_memory ? hk_h5_fail(guard, old->file.atomic.path, "look at what it has")
                          : refuse(old, what);
}

/* One contiguous block of the type, within the file. */
static int is_plain(const struct hk_dataset *data, hid_t type, double file_bytes) {
  hid_t own = H5Dget_type(data->id), list = H5Dget_create_plist(data->id);
  const haddr_t at = H5Dget_offset(data->id);
  const double bytes = (double)H5Dget_storage_size(data->id);
  const int inside = bytes == 0.0 || (at != HADDR_UNDEF && (double)at + bytes <= file_bytes);
  const int plain =
      inside && own >= 0 && list >= 0 && H5Tequal(own, type) > 0 && H5Pget_layout(list) == H5D_CONTIGUOUS;
  hk_h5_drop(list);
  hk_h5_drop(own);
  return plain;
}

static int is_of_size(const struct hk_dataset *data, int array, int64_t frames, int64_t particles) {
  const int64_t numbers = hk_frame_numbers(particles, array);
  if (data->size[0] != (hsize_t)frames) return 0;
  if (array == HOOKE_FRAME_POSITION || array == HOOKE_FRAME_VELOCITY)
    return data->rank == 3 && data->size[1] == (hsize_t)particles && data->size[2] == 3;
  return numbers == 1 ? data->rank == 1 : data->rank == 2 && data->size[1] == (hsize_t)numbers;
}

static int32_t find_array(struct hk_h5_guard *guard, hid_t file, hooke_trajectory *old, int array) {
  char name[HOOKE_WRITER_PATH], what[HOOKE_WRITER_PATH + 64];
  struct hk_dataset data;
  struct hk_trajectory_writer *writer = &old->writer;
  hid_t type = array == HOOKE_FRAME_STEP    ? H5T_NATIVE_INT64
               : array == HOOKE_FRAME_CHECK ? H5T_NATIVE_UINT32
                                            : H5T_NATIVE_DOUBLE;
  hk_trajectory_writer_path("all", array, name);
  int32_t status = hk_dataset_find(guard, file, old->file.atomic.path, name, &data);
  if (status == HOOKE_OK) {
    if (array == 0 && data.id >= 0) writer->frame_count = (int64_t)data.size[0];
    const int fits = data.id >= 0 && is_plain(&data, type, hk_h5_file_bytes(&old->file)) &&
                     is_of_size(&data, array, writer->frame_count, writer->file.particle_count);
    snprintf(what, sizeof what, "%s is not there as a run of this system makes it", name);
    if (fits)
      writer->file.at[array] = (int64_t)H5Dget_offset(data.id);
    else
      status = refuse_seen(guard, old, what);
  }
  hk_h5_drop(data.id);
  return status;
}

static int32_t find_springs(struct hk_h5_guard *guard, hid_t file, const hooke_trajectory *old) {
  struct hk_dataset data;
  int32_t status = hk_dataset_find(guard, file, old->file.atomic.path, "/connectivity/springs", &data);
  if (status == HOOKE_OK &&
      (data.id < 0 || data.size[0] != (hsize_t)hooke_system_count(old->writer.system, "springs")))
    status = refuse_seen(guard, old, "its springs are not those of this system");
  hk_h5_drop(data.id);
  return status;
}

static int32_t find_all(struct hk_h5_guard *guard, hid_t file, hooke_trajectory *old) {
  int32_t status = HOOKE_OK;
  for (int k = 0; status == HOOKE_OK && k < HOOKE_FRAME_ARRAY_COUNT; k++)
    status = find_array(guard, file, old, k);
  if (status == HOOKE_OK) status = find_springs(guard, file, old);
  return status == HOOKE_OK && old->at.status < 0 ? refuse(old, "it is no trajectory of hooke") : status;
}

/* Frames up to which a run goes on from it. */
static int64_t good_frames(const hooke_record *record) {
  const int64_t good = hooke_record_count(record, "good_frames");
  return good < hooke_record_count(record, "frames") ? good : INT64_MAX;
}

/* The run that it is of, and the places of everything. */
static int32_t read_description(struct hk_h5_guard *guard, hooke_trajectory *old) {
  hooke_record *record;
  hid_t file;
  int32_t status = hooke_record_open(old->file.atomic.path, &record);
  if (status == HOOKE_OK) {
    old->good = good_frames(record);
    old->at = record->at;
    old->description = record->description;
    snprintf(old->run, sizeof old->run, "%s", record->run);
  }
  if (status == HOOKE_OK && strcmp(hooke_record_text(record, "status"), "finished") == 0)
    status = refuse(old, "another run has just finished it");
  hooke_record_close(record);
  if (status == HOOKE_OK) status = hk_h5_file_open(guard, &old->file, &file);
  if (status != HOOKE_OK) return status;
  status = find_all(guard, file, old);
  H5Fclose(file);
  return status;
}

/* ---- frames ---- */

static int32_t look(hooke_trajectory *old, int64_t frames_kept) {
  const int64_t frames = old->writer.frame_count < old->good ? old->writer.frame_count : old->good;
  int32_t whole = 1;
  if (frames < frames_kept) return refuse(old, "it has fewer frames than the run had written");
  while (whole && old->there < frames) {
    const int error = hk_frame_look(&old->writer.file, old->there, &whole);
    if (error) return hk_file_fail(old->file.atomic.path, "read its frames", error);
    old->there += whole;
  }
  if (old->there >= frames_kept) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "frame %lld of %s is damaged or not there, and the "
                 "run had written %lld; it cannot go on in this file",
                 (long long)old->there, old->file.atomic.path, (long long)frames_kept);
}

/* ---- continuing ---- */

static int32_t begin(const char *path, const hooke_system *system, hooke_trajectory *old) {
  struct hk_trajectory_writer *writer = &old->writer;
  const int32_t status = hk_atomic_file_lock(path, &old->file.atomic);
  if (status != HOOKE_OK) return status;
  writer->system = writer->file.system = system;
  snprintf(writer->group, sizeof writer->group, "all");
  writer->file.particle_count = hooke_system_particle_count(system);
  writer->file.descriptor = old->file.atomic.descriptor;
  return HOOKE_OK;
}

static int32_t set_running(hooke_trajectory *old) {
  const int error = hk_h5md_write_status(old->file.atomic.descriptor, old->at.status, HOOKE_H5MD_RUNNING);
  return error ? hk_file_fail(old->file.atomic.path, "write that it is running again", error) : HOOKE_OK;
}

static int32_t go_on(struct hk_h5_guard *guard, hooke_trajectory **trajectory, int64_t planned,
                     int64_t frames_kept) {
  hooke_trajectory *old = *trajectory;
  const int64_t frames = old->writer.frame_count;
  int32_t status = HOOKE_OK;
  if (frames > planned) return refuse(old, "it was made for more frames");
  if (frames == planned) {
    status = set_running(old);
  } else {
    hooke_trajectory *made = hk_trajectory_new();
    if (made == NULL) return HOOKE_NO_MEMORY;
    status = hk_trajectory_remake(guard, old, planned, old->there, HOOKE_H5MD_RUNNING, made);
    memcpy(made->run, old->run, sizeof made->run);
    made->there = old->there;
    *trajectory = made;
    hk_trajectory_release(old);
  }
  hk_trajectory_keep(*trajectory, frames_kept);
  return status;
}

int32_t hk_trajectory_reopen(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                             int64_t frames_kept, hooke_trajectory **trajectory) {
  *trajectory = NULL;
  hooke_trajectory *made = hk_trajectory_new();
  if (made == NULL) return HOOKE_NO_MEMORY;
  struct hk_h5_guard guard;
  hk_h5_guard_begin(&guard);
  int32_t status = begin(path, system, made);
  if (status == HOOKE_OK) status = read_description(&guard, made);
  if (status == HOOKE_OK) status = look(made, frames_kept);
  if (status == HOOKE_OK)
    status = go_on(&guard, &made, hooke_integrator_count(integrator, "frames"), frames_kept);
  if (status == HOOKE_OK)
    *trajectory = made;
  else
    hk_trajectory_release(made);
  hk_h5_guard_end(&guard);
  return status;
}

int64_t hk_trajectory_there(const hooke_trajectory *trajectory) {
  return trajectory->there;
}

void hk_trajectory_keep(hooke_trajectory *trajectory, int64_t frames) {
  trajectory->writer.written = trajectory->taken = frames;
}

const char *hk_trajectory_path(const hooke_trajectory *trajectory) {
  return trajectory->file.atomic.path;
}

void hk_trajectory_set_origin(hooke_trajectory *trajectory, const char *words) {
  snprintf(trajectory->origin, sizeof trajectory->origin, "%s", words);
}

#else

int32_t hk_trajectory_reopen(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                             int64_t frames_kept, hooke_trajectory **trajectory) {
  (void)path, (void)system, (void)integrator, (void)frames_kept;
  *trajectory = NULL;
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "trajectories need HDF5, and this build of the library is without it");
}

int64_t hk_trajectory_there(const hooke_trajectory *trajectory) {
  (void)trajectory;
  return 0;
}

void hk_trajectory_keep(hooke_trajectory *trajectory, int64_t frames) {
  (void)trajectory, (void)frames;
}

const char *hk_trajectory_path(const hooke_trajectory *trajectory) {
  (void)trajectory;
  return "";
}

void hk_trajectory_set_origin(hooke_trajectory *trajectory, const char *words) {
  (void)trajectory, (void)words;
}

#endif
