/* Makes the file of a trajectory: one run in one H5MD file. */
#include "core/status.h"
#include "io/trajectory/trajectory.h"

#include <string.h>

#if HOOKE_HAVE_HDF5

#include "io/hdf5/object_h5.h"
#include "io/trajectory/h5md_h5.h"

int32_t hooke_io_own_process(void) {
  if (H5dont_atexit() >= 0) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_CALL, NULL,
                 "HDF5 is already running; hooke_io_own_process() has to be the first call of the process");
}

static herr_t write_run(hid_t file, const char *run) {
  hid_t group = hk_h5_group(file, "hooke");
  const herr_t result = hk_h5_text_attribute(group, "run", run);
  hk_h5_drop(group);
  return result;
}

static int32_t describe(struct hk_h5_guard *guard, const hooke_system *system,
                        const hooke_integrator *integrator, const char *scene_text, hooke_trajectory *made) {
  const hooke_options *options = hooke_integrator_options(integrator);
  const hid_t file = guard->file;
  herr_t result = hk_h5md_describe(file, system, hooke_options_text(options, "method"), options, scene_text);
  if (result >= 0) result = hk_h5md_make_room(file);
  if (result >= 0) result = hk_frame_arrays_create(file, &made->frames);
  if (result >= 0) result = hk_h5md_connect(file, system, "all");
  if (result < 0) return hk_h5_fail(guard, "make room for all frames");
  int32_t status = hk_file_check_description(guard, scene_text, &made->description);
  if (status == HOOKE_OK) status = hk_outcome_new_run(made->description, made->run);
  if (status == HOOKE_OK && write_run(file, made->run) < 0)
    status = hk_h5_fail(guard, "write the name of the run");
  return status;
}

/* Finds what is written later, and closes the file for HDF5. */
static int32_t settle(struct hk_h5_file *file, int32_t status, struct hk_frame_file *frames,
                      int64_t at[HOOKE_PART_COUNT]) {
  frames->descriptor = file->atomic->descriptor;
  if (status == HOOKE_OK) hk_h5md_find(file->guard.file, at);
  if (status == HOOKE_OK && at[HOOKE_PART_STATUS] < 0)
    status = hk_h5_fail(&file->guard, "make room for all frames");
  return hk_h5_file_settle(file, status);
}

int32_t hk_trajectory_make(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                           const char *scene_text, hooke_trajectory *made) {
  struct hk_h5_file file;
  int32_t status = hk_atomic_file_make_locked(path, 0, &made->file);
  if (status != HOOKE_OK) return status;
  hk_frame_arrays_plan(system, "all", hooke_integrator_count(integrator, "frames"), &made->frames);
  status = hk_h5_file_create(hk_frame_all_bytes(&made->frames), &made->file, &file);
  if (status == HOOKE_OK) status = describe(&file.guard, system, integrator, scene_text, made);
  status = settle(&file, status, &made->frames, made->at);
  return status == HOOKE_OK ? hk_atomic_file_commit(&made->file, NULL) : status;
}

/* ---- again ---- */

static const char again[] = "make it again for another number of frames";

static int32_t copy_description(const struct hk_atomic_file *made, struct hk_frame_file *frames,
                                int64_t at[HOOKE_PART_COUNT]) {
  struct hk_h5_file file;
  hid_t from = -1;
  int32_t status = hk_h5_file_create(hk_frame_all_bytes(frames), made, &file);
  if (status == HOOKE_OK) status = hk_h5_open(&file.guard, &from);
  if (status == HOOKE_OK && hk_h5md_copy(from, file.guard.file, frames) < 0)
    status = hk_h5_fail(&file.guard, again);
  if (from >= 0) H5Fclose(from);
  return settle(&file, status, frames, at);
}

int32_t hk_trajectory_remake(hooke_trajectory *trajectory, int64_t frame_count, int64_t copied) {
  struct hk_atomic_file made = HOOKE_NO_ATOMIC_FILE;
  struct hk_frame_file frames = trajectory->frames;
  int64_t at[HOOKE_PART_COUNT];
  frames.frame_count = frame_count;
  int32_t status = hk_file_is(trajectory->file.path, trajectory->file.descriptor);
  if (status == HOOKE_OK) status = hk_atomic_file_make_locked(trajectory->file.path, 1, &made);
  if (status == HOOKE_OK) status = copy_description(&made, &frames, at);
  const int error = status == HOOKE_OK ? hk_frame_copy(&trajectory->frames, &frames, copied) : 0;
  if (error) status = hk_file_fail(trajectory->file.path, again, error);
  if (status != HOOKE_OK) {
    hk_atomic_file_release(&made);
    return status;
  }
  made.older = trajectory->file.descriptor;
  trajectory->file.descriptor = -1;
  hk_atomic_file_release(&trajectory->file);
  trajectory->file = made;
  trajectory->frames = frames;
  memcpy(trajectory->at, at, sizeof at);
  return HOOKE_OK;
}

#else

static int32_t not_built(void) {
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "trajectories need HDF5, and this build of the library is without it");
}

int32_t hooke_io_own_process(void) {
  return HOOKE_OK;
}

int32_t hk_trajectory_make(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                           const char *scene_text, hooke_trajectory *made) {
  (void)path, (void)system, (void)integrator, (void)scene_text, (void)made;
  return not_built();
}

int32_t hk_trajectory_remake(hooke_trajectory *trajectory, int64_t frame_count, int64_t copied) {
  (void)trajectory, (void)frame_count, (void)copied;
  return not_built();
}

#endif
