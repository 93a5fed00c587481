/* Trajectories: one run in one H5MD file. */
#include "core/handle.h"
#include "core/memory.h"
#include "core/status.h"
#include "hooke/io.h"

#if HOOKE_HAVE_HDF5

#include "io/file_h5.h"
#include "io/frame_thread.h"
#include "io/h5md_h5.h"
#include "io/place.h"
#include "io/recording_h5.h"

#include <stdio.h>
#include <string.h>

struct hooke_trajectory {
  struct hooke_h5_file file;
  struct hooke_recording recording;
  struct hooke_frame_thread *thread; /* NULL: frames are written as they come */
  int64_t taken;                     /* frames, the one on its way included */
  char failure[512];                 /* of the write that made the file bad; "" while it is good */
};

int32_t hooke_io_own_process(void) {
  if (H5dont_atexit() >= 0) return HOOKE_OK;
  return hooke_fail(
      HOOKE_BAD_CALL, NULL,
      "HDF5 is already running; hooke_io_own_process() has to be the first call of the process");
}

/* A thread costs more than writing a smaller frame. */
static const int64_t LEAST_BYTES = 65536;

static void release(hooke_trajectory *trajectory) {
  hooke_recording_release(&trajectory->recording);
  hooke_h5_file_release(&trajectory->file);
  hooke_handle_free(trajectory);
}

static int32_t fill(struct hooke_h5_guard *guard, const char *path, const hooke_system *system,
                    const hooke_integrator *integrator, const char *scene_text, hooke_trajectory *made) {
  const hooke_options *options = hooke_integrator_options(integrator);
  const int64_t frames = hooke_integrator_frame_count(integrator);
  const double text = scene_text ? (double)strlen(scene_text) : 0.0;
  int32_t status =
      hooke_h5_file_create(guard, path, text + hooke_recording_bytes(system, frames), &made->file);
  if (status != HOOKE_OK) return status;
  herr_t result =
      hooke_h5md_describe(made->file.id, hooke_options_text(options, "method"), options, scene_text);
  if (result >= 0) {
    result = hooke_recording_create(made->file.id, system, "all", frames, &made->recording);
  }
  if (result >= 0) result = hooke_h5md_connect(made->file.id, system, "all");
  if (result < 0) return hooke_h5_fail(guard, path, "make room for all frames");
  return hooke_h5_file_publish(guard, &made->file);
}

int32_t hooke_trajectory_create(const char *path, const hooke_system *system,
                                const hooke_integrator *integrator, const char *scene_text,
                                hooke_trajectory **trajectory) {
  *trajectory = NULL;
  if (!hooke_system_is_committed(system)) {
    return hooke_fail(HOOKE_BAD_CALL, NULL,
                      "the system is not committed yet; call hooke_system_commit() first");
  }
  if (hooke_integrator_frame_count(integrator) < 1) {
    return hooke_fail(HOOKE_BAD_VALUE, "duration",
                      "is missing: a trajectory needs to know how many frames come");
  }
  hooke_trajectory *made = hooke_handle_new("hooke_trajectory", sizeof *made);
  if (made == NULL) return HOOKE_NO_MEMORY;
  hooke_recording_clear(&made->recording);
  struct hooke_h5_guard guard;
  hooke_h5_guard_begin(&guard);
  int32_t status = fill(&guard, path, system, integrator, scene_text, made);
  if (status == HOOKE_OK) {
    *trajectory = made;
  } else {
    release(made);
  }
  hooke_h5_guard_end(&guard);
  return status;
}

static int32_t refuse_bad(const hooke_trajectory *trajectory) {
  return hooke_fail(HOOKE_IO_FAILED, NULL, "%s", trajectory->failure);
}

static void fail_frame(hooke_trajectory *trajectory, int64_t frame, int error) {
  char what[64];
  snprintf(what, sizeof what, "write frame %lld", (long long)frame);
  hooke_place_fail(trajectory->file.path, what, error);
  snprintf(trajectory->failure, sizeof trajectory->failure, "%s", hooke_last_error());
}

int32_t hooke_trajectory_write(hooke_trajectory *trajectory, int64_t step, const hooke_state *state) {
  struct hooke_recording *recording = &trajectory->recording;
  if (trajectory->failure[0]) return refuse_bad(trajectory);
  if (hooke_state_size(state) != 3 * recording->particle_count) {
    return hooke_fail(HOOKE_BAD_VALUE, NULL, "the state has %lld numbers in q; this trajectory takes %lld",
                      (long long)hooke_state_size(state), (long long)(3 * recording->particle_count));
  }
  if (trajectory->taken == recording->frame_count) {
    return hooke_fail(HOOKE_BAD_CALL, NULL, "all %lld frames that this trajectory was made for are written",
                      (long long)recording->frame_count);
  }
  const int error = trajectory->thread ? hooke_frame_thread_write(trajectory->thread, step, state)
                                       : hooke_recording_write(recording, step, state);
  if (error) {
    /* of the thread, that of the frame before */
    fail_frame(trajectory, trajectory->thread ? trajectory->taken - 1 : trajectory->taken, error);
    return HOOKE_IO_FAILED;
  }
  trajectory->taken++;
  return HOOKE_OK;
}

int32_t hooke_trajectory_write_behind(hooke_trajectory *trajectory) {
  const struct hooke_recording *recording = &trajectory->recording;
  if (trajectory->failure[0]) return refuse_bad(trajectory);
  if (trajectory->thread || 48 * recording->particle_count < LEAST_BYTES) return HOOKE_OK;
  trajectory->thread = hooke_frame_thread_create(&recording->file, recording->written);
  return trajectory->thread
             ? HOOKE_OK
             : hooke_fail(HOOKE_NO_MEMORY, NULL, "no memory for a frame and a thread to write it");
}

/* Waits for the frame on its way. */
static void end_thread(hooke_trajectory *trajectory) {
  if (trajectory->thread == NULL) return;
  struct hooke_recording *recording = &trajectory->recording;
  const int error = hooke_frame_thread_end(trajectory->thread, &recording->written);
  trajectory->thread = NULL;
  if (error && trajectory->failure[0] == '\0') fail_frame(trajectory, recording->written, error);
}

/* A new file with exactly the frames that are there takes the place of ours. */
static int32_t rewrite(struct hooke_h5_guard *guard, const hooke_trajectory *trajectory, int32_t outcome) {
  const double bytes =
      hooke_h5_file_bytes(&trajectory->file) - hooke_recording_unused_bytes(&trajectory->recording);
  struct hooke_h5_file shorter;
  struct hooke_recording recording;
  hooke_recording_clear(&recording);
  int32_t status = hooke_h5_file_create(guard, trajectory->file.path, bytes, &shorter);
  if (status == HOOKE_OK) {
    herr_t result = hooke_recording_copy(&trajectory->recording, shorter.id, &recording);
    if (result >= 0) result = hooke_h5md_copy(trajectory->file.id, shorter.id, "all");
    if (result >= 0) result = hooke_h5md_write_status(shorter.id, outcome);
    if (result < 0)
      status = hooke_h5_fail(guard, trajectory->file.path, "shorten the file to the frames it has");
  }
  hooke_recording_release(&recording);
  if (status == HOOKE_OK) status = hooke_h5_file_finish(guard, &shorter);
  hooke_h5_file_release(&shorter);
  return status;
}

int32_t hooke_trajectory_close(hooke_trajectory *trajectory, int32_t outcome) {
  if (trajectory == NULL) return HOOKE_OK;
  end_thread(trajectory);
  struct hooke_h5_guard guard;
  hooke_h5_guard_begin(&guard);
  int32_t status = HOOKE_OK;
  if (trajectory->failure[0]) {
    status = refuse_bad(trajectory);
  } else if (trajectory->recording.written < trajectory->recording.frame_count) {
    status = rewrite(&guard, trajectory, outcome);
  } else {
    if (hooke_h5md_write_status(trajectory->file.id, outcome) < 0) {
      status = hooke_h5_fail(&guard, trajectory->file.path, "write the outcome");
    }
    hooke_recording_release(&trajectory->recording);
    if (status == HOOKE_OK) status = hooke_h5_file_finish(&guard, &trajectory->file);
  }
  release(trajectory);
  hooke_h5_guard_end(&guard);
  return status;
}

#else

static int32_t not_built(void) {
  return hooke_fail(HOOKE_NOT_BUILT, NULL,
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

int32_t hooke_trajectory_close(hooke_trajectory *trajectory, int32_t outcome) {
  (void)outcome;
  return trajectory ? not_built() : HOOKE_OK;
}

#endif
