/* Trajectories: frames and the outcome of a run as bytes in its file. */
#include "io/trajectory/trajectory.h"

#include "core/handle.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/os/os.h"
#include "core/os/os_file.h"
#include "core/status.h"
#include "io/checkpoint/checkpoint_file.h"
#include "io/file/inputs.h"
#include "io/scene/scene.h"
#include "model/state.h"

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* ---- a thread that writes frames ---- */

/* It holds a copy of one frame, and the next frame waits until that is written. */
struct hk_frame_thread {
  const struct hk_frame_file *file;
  hooke_state *state;          /* the queued frame */
  struct hk_energies energies; /* its, where they are known */
  int64_t step, written;
  int32_t busy, ending; /* a frame is queued; no more will come */
  int error;
  pthread_t thread;
  pthread_mutex_t mutex;
  pthread_cond_t changed;
};

static void *work(void *own) {
  struct hk_frame_thread *thread = own;
  pthread_mutex_lock(&thread->mutex);
  for (;;) {
    while (!thread->busy && !thread->ending)
      pthread_cond_wait(&thread->changed, &thread->mutex);
    if (!thread->busy) break;
    pthread_mutex_unlock(&thread->mutex);
    const int error = hk_frame_write(thread->file, thread->written, thread->step, thread->state);
    pthread_mutex_lock(&thread->mutex);
    thread->error = error;
    thread->written += error == 0;
    thread->busy = 0;
    pthread_cond_signal(&thread->changed);
  }
  pthread_mutex_unlock(&thread->mutex);
  return NULL;
}

/* Starts one for frames from `first` on. `file` must outlive it. NULL without memory or threads. */
static struct hk_frame_thread *start_thread(const struct hk_frame_file *file, int64_t first) {
  struct hk_frame_thread *thread = hk_new(1, sizeof *thread);
  if (thread == NULL) return NULL;
  thread->file = file;
  thread->written = first;
  pthread_mutex_init(&thread->mutex, NULL);
  pthread_cond_init(&thread->changed, NULL);
  if (hooke_state_create(file->system, &thread->state) == HOOKE_OK &&
      hk_os_start_thread(&thread->thread, work, thread) == 0)
    return thread;
  pthread_cond_destroy(&thread->changed);
  pthread_mutex_destroy(&thread->mutex);
  hooke_state_destroy(thread->state);
  hk_free(thread);
  return NULL;
}

/* Returns with the mutex locked, and no frame queued. */
static void wait_for_frame(struct hk_frame_thread *thread) {
  pthread_mutex_lock(&thread->mutex);
  while (thread->busy)
    pthread_cond_wait(&thread->changed, &thread->mutex);
}

/* Queues a frame. Returns the errno of an earlier failed write; after one, no frame is accepted. */
static int queue_frame(struct hk_frame_thread *thread, int64_t step, const hooke_state *state) {
  wait_for_frame(thread);
  const int error = thread->error;
  if (error == 0) {
    hooke_state_copy(state, thread->state);
    thread->state->known = NULL;
    if (state->known) {
      thread->energies = *state->known;
      thread->state->known = &thread->energies;
    }
    thread->step = step;
    thread->busy = 1;
    pthread_cond_signal(&thread->changed);
  }
  pthread_mutex_unlock(&thread->mutex);
  return error;
}

/* Waits for the queued frame; returns an errno, as above. */
static int finish_frame(struct hk_frame_thread *thread) {
  wait_for_frame(thread);
  const int error = thread->error;
  pthread_mutex_unlock(&thread->mutex);
  return error;
}

/* Waits for the last frame and ends the thread. Returns the total number of written frames, and the errno of
 * a failure. */
static int stop_thread(struct hk_frame_thread *thread, int64_t *written) {
  wait_for_frame(thread);
  thread->ending = 1;
  pthread_cond_signal(&thread->changed);
  pthread_mutex_unlock(&thread->mutex);
  pthread_join(thread->thread, NULL);
  const int error = thread->error;
  *written = thread->written;
  pthread_cond_destroy(&thread->changed);
  pthread_mutex_destroy(&thread->mutex);
  hooke_state_destroy(thread->state);
  hk_free(thread);
  return error;
}

/* Below this size a frame is cheaper to write than to pass to a thread. */
static const int64_t LEAST_BYTES = 65536;

/* ---- a trajectory ---- */

hooke_trajectory *hk_trajectory_new(void) {
  hooke_trajectory *trajectory = hk_handle_new("hooke_trajectory", sizeof *trajectory);
  if (trajectory == NULL) return NULL;
  trajectory->file = HOOKE_NO_ATOMIC_FILE;
  trajectory->beyond = -1;
  return trajectory;
}

void hk_trajectory_release(hooke_trajectory *trajectory) {
  hk_atomic_file_release(&trajectory->file);
  hk_handle_free(trajectory);
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
  hooke_trajectory *made = hk_trajectory_new();
  if (made == NULL) return HOOKE_NO_MEMORY;
  char *whole = NULL;
  int32_t status = hk_inputs_refuse(system, path);
  if (status == HOOKE_OK)
    status = hk_scene_make_whole(scene_text, system, hooke_integrator_options(integrator), &whole);
  if (status == HOOKE_OK)
    status = hk_trajectory_make(path, system, integrator, whole ? whole : scene_text, made);
  hk_free(whole);
  return HOOKE_HAND_OVER(status, made, trajectory, hk_trajectory_release);
}

static int32_t refuse_bad(const hooke_trajectory *trajectory) {
  return hk_fail(HOOKE_IO_FAILED, NULL, "%s", trajectory->failure);
}

static int32_t require_good(const hooke_trajectory *trajectory) {
  const int32_t status = hk_atomic_file_require_own(&trajectory->file);
  return status == HOOKE_OK && trajectory->failure[0] ? refuse_bad(trajectory) : status;
}

/* Marks the file bad. */
static int32_t fail(hooke_trajectory *trajectory, const char *what, int error) {
  const int32_t status = hk_file_fail(trajectory->file.path, what, error);
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
  struct hk_frame_file *frames = &trajectory->frames;
  int32_t status = require_good(trajectory);
  if (status == HOOKE_OK) status = hk_state_check(state, 3 * frames->particle_count, 1);
  if (status != HOOKE_OK) return status;
  if (trajectory->taken == frames->frame_count) {
    return hk_fail(HOOKE_BAD_CALL, NULL, "all %lld frames that this trajectory was made for are written",
                   (long long)frames->frame_count);
  }
  const int error = trajectory->thread ? queue_frame(trajectory->thread, step, state)
                                       : hk_frame_write(frames, frames->written, step, state);
  /* errno of the thread's previous frame */
  if (error) return fail_frame(trajectory, trajectory->taken - (trajectory->thread != NULL), error);
  trajectory->taken++;
  frames->written += trajectory->thread == NULL;
  return HOOKE_OK;
}

int32_t hooke_trajectory_write_behind(hooke_trajectory *trajectory) {
  const struct hk_frame_file *frames = &trajectory->frames;
  if (trajectory->failure[0]) return refuse_bad(trajectory);
  if (trajectory->thread || 48 * frames->particle_count < LEAST_BYTES) return HOOKE_OK;
  trajectory->thread = start_thread(frames, frames->written);
  return trajectory->thread
             ? HOOKE_OK
             : hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for a frame and a thread to write it");
}

/* Waits for the queued frame. */
static void end_thread(hooke_trajectory *trajectory) {
  if (trajectory->thread == NULL) return;
  const int error = stop_thread(trajectory->thread, &trajectory->frames.written);
  trajectory->thread = NULL;
  if (error && trajectory->failure[0] == '\0') fail_frame(trajectory, trajectory->frames.written, error);
}

const char *hooke_trajectory_text(const hooke_trajectory *trajectory, const char *what) {
  if (strcmp(what, "run") == 0) return trajectory->run;
  return strcmp(what, "origin") == 0 ? trajectory->origin : NULL;
}

int32_t hooke_trajectory_sync(hooke_trajectory *trajectory) {
  HOOKE_KEEP_ERRNO;
  const int32_t status = require_good(trajectory);
  if (status != HOOKE_OK) return status;
  const int error = trajectory->thread ? finish_frame(trajectory->thread) : 0;
  if (error) return fail_frame(trajectory, trajectory->taken - 1, error);
  /* a second sync does not report data that a failed one lost */
  return hk_os_sync(trajectory->file.descriptor) == 0 ? HOOKE_OK
                                                      : fail(trajectory, "bring the data to the disk", errno);
}

int32_t hooke_trajectory_mark_diverged(hooke_trajectory *trajectory) {
  HOOKE_KEEP_ERRNO;
  if (trajectory->beyond >= 0) return HOOKE_OK;
  const int32_t status = require_good(trajectory);
  if (status != HOOKE_OK) return status;
  const int error =
      hk_outcome_write(trajectory->file.descriptor, trajectory->at, HOOKE_PART_BEYOND, &trajectory->taken);
  if (error) return fail(trajectory, "mark the frames after divergence", error);
  trajectory->beyond = trajectory->taken;
  return HOOKE_OK;
}

/* ---- closing ---- */

/* Marks what is known of the run once it is over. Its check value covers all that it refers to. */
static int mark(const hooke_trajectory *trajectory, int64_t frames, int32_t outcome) {
  const int descriptor = trajectory->file.descriptor;
  const uint32_t check =
      hk_outcome_check(trajectory->description, hk_outcome_word(outcome), trajectory->beyond, frames);
  const int error = hk_outcome_write(descriptor, trajectory->at, HOOKE_PART_BEYOND, &trajectory->beyond);
  return error ? error : hk_outcome_write(descriptor, trajectory->at, HOOKE_PART_CHECK, &check);
}

/* A file with more room is made again with exactly the written frames, and takes its name at the end. */
static int32_t finish(hooke_trajectory *trajectory, int32_t outcome) {
  const int64_t written = trajectory->frames.written, there = trajectory->there;
  const int64_t frames = written > there ? written : there;
  if (trajectory->failure[0]) {
    /* the message goes to anybody who can open the file, as well */
    hk_outcome_write_status(trajectory->file.descriptor, trajectory->at, HOOKE_IO_FAILED);
    return refuse_bad(trajectory);
  }
  int32_t status =
      frames < trajectory->frames.frame_count ? hk_trajectory_remake(trajectory, frames, frames) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  /* a run that was gone on with marks its own, and has another error */
  int error = mark(trajectory, frames, outcome);
  if (error) return fail(trajectory, "mark the frames after divergence", error);
  /* the outcome is written after all that it refers to is on the disk */
  const int32_t synced = hooke_trajectory_sync(trajectory);
  error = hk_outcome_write_status(trajectory->file.descriptor, trajectory->at,
                                  synced == HOOKE_OK ? outcome : HOOKE_IO_FAILED);
  if (synced != HOOKE_OK) return refuse_bad(trajectory);
  if (error) return hk_file_fail(trajectory->file.path, "write the outcome", error);
  if (trajectory->file.temporary) status = hk_atomic_file_commit(&trajectory->file, NULL);
  return status == HOOKE_OK ? hk_atomic_file_finish(&trajectory->file) : status;
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
  int32_t status = hk_atomic_file_require_own(&trajectory->file);
  if (status == HOOKE_OK) { /* a forked process has no such thread, and leaves the file alone */
    end_thread(trajectory);
    status = finish(trajectory, outcome);
  }
  if (status == HOOKE_OK && outcome == HOOKE_OK) drop_checkpoint(trajectory->file.path);
  hk_trajectory_release(trajectory);
  return status;
}
