#include "measure/trial/side_by_side.h"

#include "core/status.h"
#include "core/thread_pool.h"
#include "model/callbacks.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <time.h>

struct hk_trials {
  int64_t count;
  hk_trial_work *work;
  int32_t (*tell)(double done, void *ctx);
  void *ctx, *tell_ctx;
  atomic_llong next, finished, failed; /* trial to begin, number that ended, first that failed */
  atomic_int stop, idle;
  pthread_mutex_t mutex; /* of the first failure: messages belong to the thread that failed */
  int32_t status;
  char message[1024];
};

int32_t hk_turn_tell(double fraction, void *ctx) {
  const struct hk_turn *turn = ctx;
  struct hk_trials *trials = turn->trials;
  if (turn->worker == 0 && !atomic_load(&trials->stop)) {
    const double done = ((double)atomic_load(&trials->finished) + fraction) / (double)trials->count;
    if (trials->tell(fmin(1.0, done), trials->tell_ctx) != 0) atomic_store(&trials->stop, 1);
  }
  return atomic_load(&trials->stop) || turn->number > atomic_load(&trials->failed);
}

static void note_failure(struct hk_trials *trials, int64_t number, int32_t status) {
  pthread_mutex_lock(&trials->mutex);
  if (number < atomic_load(&trials->failed)) {
    atomic_store(&trials->failed, number);
    trials->status = status;
    snprintf(trials->message, sizeof trials->message, "%s", hooke_last_error());
  }
  pthread_mutex_unlock(&trials->mutex);
}

static void take_turns(int32_t worker, int32_t workers, void *ctx) {
  struct hk_trials *trials = ctx;
  const struct timespec moment = {0, 1000000};
  struct hk_turn turn = {.trials = trials, .worker = worker, .serial = workers > 1};
  while (!atomic_load(&trials->stop)) {
    turn.number = atomic_fetch_add(&trials->next, 1);
    if (turn.number >= trials->count || turn.number > atomic_load(&trials->failed)) break;
    const int32_t status = trials->work(&turn, trials->ctx);
    if (status != HOOKE_OK) note_failure(trials, turn.number, status);
    atomic_fetch_add(&trials->finished, 1);
  }
  atomic_fetch_add(&trials->idle, 1);
  while (worker == 0 && atomic_load(&trials->idle) < workers) {
    nanosleep(&moment, NULL);
    (void)hk_turn_tell(0.0, &turn);
  }
}

int32_t hk_run_side_by_side(const hooke_measurement *m, int32_t alone, int64_t count, hk_trial_work *work,
                            void *ctx, int32_t (*tell)(double done, void *ctx), void *tell_ctx) {
  alone |= hk_system_calls_back(m->system);
  const double threads = alone ? 1.0 : hooke_options_number(m->run, "threads");
  const int32_t workers = (int32_t)fmin(threads, (double)count);
  struct hk_trials trials = {
      .count = count, .work = work, .tell = tell, .ctx = ctx, .tell_ctx = tell_ctx, .failed = INT64_MAX};
  struct hk_pool *pool = workers > 1 ? hk_pool_create(workers) : NULL; /* without threads: by this one */
  pthread_mutex_init(&trials.mutex, NULL);
  hk_pool_run(pool, take_turns, &trials);
  hk_pool_destroy(pool);
  pthread_mutex_destroy(&trials.mutex);
  if (trials.status != HOOKE_OK) return hk_fail(trials.status, NULL, "%s", trials.message);
  return trials.stop ? hk_fail(HOOKE_STOPPED, NULL, "the progress callback asked to stop") : HOOKE_OK;
}
