#include "measure/trial/side_by_side.h"

#include "core/status.h"
#include "core/thread_pool.h"
#include "model/callbacks.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <time.h>

struct hk_turns {
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
  struct hk_turns *turns = turn->turns;
  if (turn->worker == 0 && !atomic_load(&turns->stop)) {
    const double done = ((double)atomic_load(&turns->finished) + fraction) / (double)turns->count;
    if (turns->tell(fmin(1.0, done), turns->tell_ctx) != 0) atomic_store(&turns->stop, 1);
  }
  return atomic_load(&turns->stop) || turn->number > atomic_load(&turns->failed);
}

static void note_failure(struct hk_turns *turns, int64_t number, int32_t status) {
  pthread_mutex_lock(&turns->mutex);
  if (number < atomic_load(&turns->failed)) {
    atomic_store(&turns->failed, number);
    turns->status = status;
    snprintf(turns->message, sizeof turns->message, "%s", hooke_last_error());
  }
  pthread_mutex_unlock(&turns->mutex);
}

static void take_turns(int32_t worker, int32_t workers, void *ctx) {
  struct hk_turns *turns = ctx;
  const struct timespec moment = {0, 1000000};
  struct hk_turn turn = {.turns = turns, .worker = worker, .serial = workers > 1};
  while (!atomic_load(&turns->stop)) {
    turn.number = atomic_fetch_add(&turns->next, 1);
    if (turn.number >= turns->count || turn.number > atomic_load(&turns->failed)) break;
    const int32_t status = turns->work(&turn, turns->ctx);
    if (status != HOOKE_OK) note_failure(turns, turn.number, status);
    atomic_fetch_add(&turns->finished, 1);
  }
  atomic_fetch_add(&turns->idle, 1);
  while (worker == 0 && atomic_load(&turns->idle) < workers) {
    nanosleep(&moment, NULL);
    (void)hk_turn_tell(0.0, &turn);
  }
}

int32_t hk_run_side_by_side(const hooke_measurement *m, int32_t alone, int64_t count, hk_trial_work *work,
                            void *ctx, int32_t (*tell)(double done, void *ctx), void *tell_ctx) {
  alone |= hk_system_calls_back(m->system);
  const double threads = alone ? 1.0 : hooke_options_number(m->run, "threads");
  const int32_t workers = (int32_t)fmin(threads, (double)count);
  struct hk_turns turns = {
      .count = count, .work = work, .tell = tell, .ctx = ctx, .tell_ctx = tell_ctx, .failed = INT64_MAX};
  struct hk_pool *pool = workers > 1 ? hk_pool_create(workers) : NULL; /* without threads: by this one */
  pthread_mutex_init(&turns.mutex, NULL);
  hk_pool_run(pool, take_turns, &turns);
  hk_pool_destroy(pool);
  pthread_mutex_destroy(&turns.mutex);
  if (turns.status != HOOKE_OK) return hk_fail(turns.status, NULL, "%s", turns.message);
  return turns.stop ? hk_fail(HOOKE_STOPPED, NULL, "the progress callback asked to stop") : HOOKE_OK;
}
