/* Trajectories: one run in one H5MD file. */
#include "core/handle.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/os/os_file.h"
#include "core/status.h"
#include "hooke/trajectory.h"

#if HOOKE_HAVE_HDF5

#include "io/checkpoint/checkpoint_file.h"
#include "io/file/atomic_file.h"
#include "io/trajectory/file_check_h5.h"
#include "io/file/inputs.h"
#include "io/scene/scene.h"
#include "io/trajectory/trajectory.h"
#include "io/trajectory/trajectory_h5.h"
#include "model/state.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

int32_t hooke_io_own_process(void) {
  if (H5dont_atexit() >= 0) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_CALL, NULL,
                 "HDF5 is already running; hooke_io_own_process() has to be the first call of the process");
}

/* Below this size a frame is cheaper to write than to pass to a thread. */
static const int64_t LEAST_BYTES = 65536;

hooke_trajectory *hk_trajectory_new(void) {
  hooke_trajectory *trajectory = hk_handle_new("hooke_trajectory", sizeof *trajectory);
  if (trajectory == NULL) return NULL;
  trajectory->file = HOOKE_NO_H5_FILE;
  trajectory->writer.file.descriptor = -1;
  trajectory->beyond = -1;
  return trajectory;
}

void hk_trajectory_release(hooke_trajectory *trajectory) {
  hk_h5_file_release(&trajectory->file);
  hk_handle_free(trajectory);
}

/* Closes the file for HDF5; from here on it is written as bytes. */
static int32_t settle(struct hk_h5_guard *guard, hooke_trajectory *made) {
  hk_h5md_find(made->file.id, &made->at);
  if (made->at.status < 0) return hk_h5_fail(guard, made->file.atomic.path, "make room for all frames");
  const int32_t status = hk_h5_file_settle(guard, &made->file);
  made->writer.file.descriptor = made->file.atomic.descriptor;
  return status;
}

static int32_t fill(struct hk_h5_guard *guard, const char *path, const hooke_system *system,
                    const hooke_integrator *integrator, const char *scene_text, hooke_trajectory *made) {
  const hooke_options *options = hooke_integrator_options(integrator);
  const int64_t frames = hooke_integrator_count(integrator, "frames");
  const double text = scene_text ? (double)strlen(scene_text) : 0.0;
  int32_t status = hk_h5_file_create_locked(guard, path, text + hk_trajectory_writer_bytes(system, frames), 0,
                                            &made->file);
  if (status != HOOKE_OK) return status;
  herr_t result =
      hk_h5md_describe(made->file.id, system, hooke_options_text(options, "method"), options, scene_text);
  if (result >= 0) result = hk_h5md_make_room(made->file.id);
  if (result >= 0) result = hk_trajectory_writer_create(made->file.id, system, "all", frames, &made->writer);
  if (result >= 0) result = hk_h5md_connect(made->file.id, system, "all");
  if (result < 0) return hk_h5_fail(guard, path, "make room for all frames");
  status = hk_file_check_description(guard, made->file.id, path, scene_text, &made->description);
  if (status == HOOKE_OK) status = hk_h5md_new_run(made->description, made->run);
  if (status == HOOKE_OK && hk_h5md_write_run(made->file.id, made->run) < 0)
    status = hk_h5_fail(guard, path, "write the name of the run");
  if (status == HOOKE_OK) status = settle(guard, made);
  return status == HOOKE_OK ? hk_h5_file_publish(&made->file) : status;
}

static int32_t create(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                      const char *scene_text, hooke_trajectory **trajectory) {
  hooke_trajectory *made = hk_trajectory_new();
  if (made == NULL) return HOOKE_NO_MEMORY;
  struct hk_h5_guard guard;
  hk_h5_guard_begin(&guard);
  int32_t status = fill(&guard, path, system, integrator, scene_text, made);
  if (status == HOOKE_OK) {
    *trajectory = made;
  } else {
    hk_trajectory_release(made);
  }
  hk_h5_guard_end(&guard);
  return status;
}

int32_t hooke_trajectory_create(const char *path, const hooke_system *system,
                                const hooke_integrator *integrator, const char *scene_text,
                                hooke_trajectory **trajectory) {
  *trajectory = NULL;
  if (!hooke_system_is_committed(system)) {
    return hk_fail(HOOKE_BAD_CALL, NULL, "the system is not committed yet; call hooke_system_commit() first");
  }
  if (hooke_integrator_count(integrator, "frames") < 1) {
    return hk_fail(HOOKE_BAD_VALUE, "duration",
                   "is missing: a trajectory needs to know how many frames come");
  }
  char *whole = NULL;
  int32_t status = hk_inputs_refuse(system, path);
  if (status == HOOKE_OK)
    status = hk_scene_make_whole(scene_text, system, hooke_integrator_options(integrator), &whole);
  if (status == HOOKE_OK) status = create(path, system, integrator, whole ? whole : scene_text, trajectory);
  hk_free(whole);
  return status;
}

static int32_t refuse_bad(const hooke_trajectory *trajectory) {
  return hk_fail(HOOKE_IO_FAILED, NULL, "%s", trajectory->failure);
}

/* Marks the file bad. */
static int32_t fail(hooke_trajectory *trajectory, const char *what, int error) {
  const int32_t status = hk_file_fail(trajectory->file.atomic.path, what, error);
  snprintf(trajectory->failure, sizeof trajectory->failure, "%s", hooke_last_error());
  return status;
}

static int32_t fail_frame(hooke_trajectory *trajectory, int64_t frame, int error) {
  char what[64];
  snprintf(what, sizeof what, "write frame %lld", (long long)frame);
  return fail(trajectory, what, error);
}

int32_t hooke_trajectory_write(hooke_trajectory *trajectory, int64_t step, const hooke_state *state) {
  HOOKE_KEEP_ERRNO;
  struct hk_trajectory_writer *writer = &trajectory->writer;
  const int32_t own = hk_atomic_file_require_own(&trajectory->file.atomic);
  if (own != HOOKE_OK) return own;
  if (trajectory->failure[0]) return refuse_bad(trajectory);
  const int32_t fits = hk_state_check(state, 3 * writer->file.particle_count, 1);
  if (fits != HOOKE_OK) return fits;
  if (trajectory->taken == writer->frame_count) {
    return hk_fail(HOOKE_BAD_CALL, NULL, "all %lld frames that this trajectory was made for are written",
                   (long long)writer->frame_count);
  }
  const int error = trajectory->thread ? hk_frame_thread_write(trajectory->thread, step, state)
                                       : hk_trajectory_writer_write(writer, step, state);
  /* errno of the thread's previous frame */
  if (error) return fail_frame(trajectory, trajectory->taken - (trajectory->thread != NULL), error);
  trajectory->taken++;
  return HOOKE_OK;
}

int32_t hooke_trajectory_write_behind(hooke_trajectory *trajectory) {
  const struct hk_trajectory_writer *writer = &trajectory->writer;
  if (trajectory->failure[0]) return refuse_bad(trajectory);
  if (trajectory->thread || 48 * writer->file.particle_count < LEAST_BYTES) return HOOKE_OK;
  trajectory->thread = hk_frame_thread_create(&writer->file, writer->written);
  return trajectory->thread
             ? HOOKE_OK
             : hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for a frame and a thread to write it");
}

/* Waits for the queued frame. */
static void end_thread(hooke_trajectory *trajectory) {
  if (trajectory->thread == NULL) return;
  struct hk_trajectory_writer *writer = &trajectory->writer;
  const int error = hk_frame_thread_end(trajectory->thread, &writer->written);
  trajectory->thread = NULL;
  if (error && trajectory->failure[0] == '\0') fail_frame(trajectory, writer->written, error);
}

const char *hooke_trajectory_text(const hooke_trajectory *trajectory, const char *what) {
  if (strcmp(what, "run") == 0) return trajectory->run;
  return strcmp(what, "origin") == 0 ? trajectory->origin : NULL;
}

int32_t hooke_trajectory_sync(hooke_trajectory *trajectory) {
  HOOKE_KEEP_ERRNO;
  const int32_t own = hk_atomic_file_require_own(&trajectory->file.atomic);
  if (own != HOOKE_OK) return own;
  if (trajectory->failure[0]) return refuse_bad(trajectory);
  const int error = trajectory->thread ? hk_frame_thread_wait(trajectory->thread) : 0;
  if (error) return fail_frame(trajectory, trajectory->taken - 1, error);
  /* a second sync does not report data that a failed one lost */
  return hk_os_sync(trajectory->file.atomic.descriptor) == 0
             ? HOOKE_OK
             : fail(trajectory, "bring the data to the disk", errno);
}

int32_t hooke_trajectory_mark_diverged(hooke_trajectory *trajectory) {
  HOOKE_KEEP_ERRNO;
  if (trajectory->beyond >= 0) return HOOKE_OK;
  const int32_t own = hk_atomic_file_require_own(&trajectory->file.atomic);
  if (own != HOOKE_OK) return own;
  if (trajectory->failure[0]) return refuse_bad(trajectory);
  const int error = hk_h5md_write(trajectory->file.atomic.descriptor, trajectory->at.beyond,
                                  sizeof trajectory->taken, &trajectory->taken);
  if (error) return fail(trajectory, "mark the frames after divergence", error);
  trajectory->beyond = trajectory->taken;
  return HOOKE_OK;
}

/* ---- closing ---- */

static herr_t make_again(const hooke_trajectory *trajectory, hid_t old, int64_t frame_count,
                         hooke_trajectory *made, struct hk_h5_copy *copy) {
  herr_t result = hk_h5md_copy(old, made->file.id, copy);
  if (result >= 0)
    result =
        hk_trajectory_writer_copy(&trajectory->writer, old, made->file.id, frame_count, &made->writer, copy);
  return result < 0 ? result : hk_h5md_refer(made->file.id, "all");
}

static int copy_all(const hooke_trajectory *trajectory, const struct hk_h5_copy *copy, int64_t frames,
                    int32_t outcome, const hooke_trajectory *made) {
  int error = hk_h5_copy_bytes(copy, trajectory->file.atomic.descriptor, made->file.atomic.descriptor);
  if (error == 0) error = hk_frame_copy(&trajectory->writer.file, &made->writer.file, frames);
  return error ? error : hk_h5md_write_status(made->file.atomic.descriptor, made->at.status, outcome);
}

int32_t hk_trajectory_remake(struct hk_h5_guard *guard, hooke_trajectory *trajectory, int64_t frame_count,
                             int64_t copied, int32_t outcome, hooke_trajectory *made) {
  const char *path = trajectory->file.atomic.path, *what = "make it again for another number of frames";
  const double bytes = hk_h5_file_bytes(&trajectory->file) -
                       hk_trajectory_writer_bytes_after(&trajectory->writer, frame_count);
  struct hk_h5_copy copy = {.guard = guard};
  hid_t old;
  int32_t status = hk_h5_file_open(guard, &trajectory->file, &old);
  if (status != HOOKE_OK) return status;
  status = hk_h5_file_create_locked(guard, path, bytes, 1, &made->file);
  if (status == HOOKE_OK && make_again(trajectory, old, frame_count, made, &copy) < 0)
    status = hk_h5_fail(guard, path, what);
  H5Fclose(old);
  if (status == HOOKE_OK) status = settle(guard, made);
  const int error = status == HOOKE_OK ? copy_all(trajectory, &copy, copied, outcome, made) : 0;
  hk_h5_copy_release(&copy);
  if (error) return hk_file_fail(path, what, error);
  if (status != HOOKE_OK) return status;
  made->description = trajectory->description;
  made->file.atomic.older = trajectory->file.atomic.descriptor;
  trajectory->file.atomic.descriptor = -1;
  return hk_h5_file_publish(&made->file);
}

/* Replaces the file by one with exactly the written frames. */
static int32_t shorten(hooke_trajectory *trajectory, int64_t frames, int32_t outcome) {
  hooke_trajectory *made = hk_trajectory_new();
  if (made == NULL) return HOOKE_NO_MEMORY;
  struct hk_h5_guard guard;
  hk_h5_guard_begin(&guard);
  int32_t status = hk_trajectory_remake(&guard, trajectory, frames, frames, outcome, made);
  if (status == HOOKE_OK) status = hk_h5_file_close(&made->file);
  hk_trajectory_release(made);
  hk_h5_guard_end(&guard);
  return status;
}

static int32_t finish(hooke_trajectory *trajectory, int32_t outcome) {
  const struct hk_trajectory_writer *writer = &trajectory->writer;
  const int64_t frames = writer->written > trajectory->there ? writer->written : trajectory->there;
  if (trajectory->failure[0]) {
    /* the message goes to anybody who can open the file, as well */
    hk_h5md_write_status(trajectory->file.atomic.descriptor, trajectory->at.status, HOOKE_IO_FAILED);
    return refuse_bad(trajectory);
  }
  /* a run that was gone on with marks its own, and has another error */
  const int descriptor = trajectory->file.atomic.descriptor;
  const uint32_t check =
      hk_file_check_outcome(trajectory->description, hk_h5md_word(outcome), trajectory->beyond, frames);
  int unmarked =
      hk_h5md_write(descriptor, trajectory->at.beyond, sizeof trajectory->beyond, &trajectory->beyond);
  if (unmarked == 0) unmarked = hk_h5md_write(descriptor, trajectory->at.check, sizeof check, &check);
  if (unmarked) return fail(trajectory, "mark the frames after divergence", unmarked);
  if (frames < writer->frame_count) return shorten(trajectory, frames, outcome);
  /* the outcome is written after all that it refers to is on the disk */
  const int32_t synced = hooke_trajectory_sync(trajectory);
  const int error = hk_h5md_write_status(trajectory->file.atomic.descriptor, trajectory->at.status,
                                         synced == HOOKE_OK ? outcome : HOOKE_IO_FAILED);
  if (synced != HOOKE_OK) return refuse_bad(trajectory);
  return error ? hk_file_fail(trajectory->file.atomic.path, "write the outcome", error)
               : hk_h5_file_close(&trajectory->file);
}

static void drop_checkpoint(const char *path) {
  char *checkpoint = NULL;
  if (hk_file_beside(path, HOOKE_CHECKPOINT_ENDING, &checkpoint) == HOOKE_OK)
    hk_checkpoint_remove(checkpoint);
  hk_free(checkpoint);
}

int32_t hooke_trajectory_close(hooke_trajectory *trajectory, int32_t outcome) {
  if (trajectory == NULL) return HOOKE_OK;
  HOOKE_KEEP_ERRNO;
  int32_t status = hk_atomic_file_require_own(&trajectory->file.atomic);
  if (status == HOOKE_OK) { /* a forked process has no such thread, and leaves the file alone */
    end_thread(trajectory);
    status = finish(trajectory, outcome);
  }
  if (status == HOOKE_OK && outcome == HOOKE_OK) drop_checkpoint(trajectory->file.atomic.path);
  hk_trajectory_release(trajectory);
  return status;
}

#else

static int32_t not_built(void) {
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "trajectories need HDF5, and this build of the library is without it");
}

int32_t hooke_io_own_process(void) {
  return HOOKE_OK;
}

int32_t hooke_trajectory_create(const char *path, const hooke_system *system,
                                const hooke_integrator *integrator, const char *scene_text,
                                hooke_trajectory **trajectory) {
  (void)path, (void)system, (void)integrator, (void)scene_text;
  *trajectory = NULL;
  return not_built();
}

int32_t hooke_trajectory_write(hooke_trajectory *trajectory, int64_t step, const hooke_state *state) {
  (void)trajectory, (void)step, (void)state;
  return not_built();
}

int32_t hooke_trajectory_write_behind(hooke_trajectory *trajectory) {
  (void)trajectory;
  return not_built();
}

const char *hooke_trajectory_text(const hooke_trajectory *trajectory, const char *what) {
  (void)trajectory, (void)what;
  return "";
}

int32_t hooke_trajectory_mark_diverged(hooke_trajectory *trajectory) {
  (void)trajectory;
  return not_built();
}

int32_t hooke_trajectory_sync(hooke_trajectory *trajectory) {
  (void)trajectory;
  return not_built();
}

int32_t hooke_trajectory_close(hooke_trajectory *trajectory, int32_t outcome) {
  (void)outcome;
  return trajectory ? not_built() : HOOKE_OK;
}

#endif
