#include "io/trajectory/frame_thread.h"

#include "core/memory.h"
#include "core/os/os.h"
#include "model/state.h"

#include <pthread.h>

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

struct hk_frame_thread *hk_frame_thread_create(const struct hk_frame_file *file, int64_t first) {
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

int hk_frame_thread_write(struct hk_frame_thread *thread, int64_t step, const hooke_state *state) {
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

int hk_frame_thread_wait(struct hk_frame_thread *thread) {
  wait_for_frame(thread);
  const int error = thread->error;
  pthread_mutex_unlock(&thread->mutex);
  return error;
}

int hk_frame_thread_end(struct hk_frame_thread *thread, int64_t *written) {
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
