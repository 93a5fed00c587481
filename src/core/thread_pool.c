/* Workers meet at a barrier before and after each task: the first one starts it, the second ends it. Threads
 * inherit the rounding mode and the treatment of denormals of the thread that creates the pool; later changes
 * there do not affect them. */
#include "core/thread_pool.h"

#include "core/memory.h"
#include "core/os/os.h"
#include "core/status.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

/* Number of polls by a waiting worker before it yields its processor (some tens of microseconds), and then
 * before it sleeps. */
enum { SPINS = 1000, YIELDS = 4 };

struct seat {
  struct hk_pool *pool;
  int32_t worker;
  pthread_t thread;
};

struct hk_pool {
  pid_t process; /* process that owns the threads */
  int32_t workers, spins;
  hk_pool_work *work; /* NULL: threads end */
  void *ctx;
  struct seat *seat; /* of workers 1 .. workers - 1 */
  pthread_mutex_t mutex;
  pthread_cond_t woken;
  /* on separate cache lines: waiting workers read `round` alone */
  _Alignas(64) atomic_int arrived;
  _Alignas(64) atomic_uint round;
  _Alignas(64) atomic_int sleepers;
};

static inline void relax(void) {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ __volatile__("yield");
#endif
}

int32_t hk_pool_processors(void) {
  return hk_os_processors();
}

/* ---- the barrier ---- */

static int has_passed(struct hk_pool *pool, unsigned round) {
  return atomic_load_explicit(&pool->round, memory_order_acquire) != round;
}

static void sleep_until_passed(struct hk_pool *pool, unsigned round) {
  pthread_mutex_lock(&pool->mutex);
  /* either the thread that ends the round sees this, or this thread sees the end of the round: both are
   * sequentially consistent */
  atomic_fetch_add(&pool->sleepers, 1);
  while (atomic_load(&pool->round) == round)
    pthread_cond_wait(&pool->woken, &pool->mutex);
  atomic_fetch_sub(&pool->sleepers, 1);
  pthread_mutex_unlock(&pool->mutex);
}

static void wait_until_passed(struct hk_pool *pool, unsigned round) {
  for (int32_t k = 0; k < pool->spins; k++) {
    if (has_passed(pool, round)) return;
    relax();
  }
  for (int32_t k = 0; k < YIELDS; k++) {
    if (has_passed(pool, round)) return;
    sched_yield();
  }
  sleep_until_passed(pool, round);
}

void hk_pool_barrier(struct hk_pool *pool) {
  if (pool == NULL || pool->workers == 1) return;
  const unsigned round = atomic_load_explicit(&pool->round, memory_order_relaxed);
  if (atomic_fetch_add_explicit(&pool->arrived, 1, memory_order_acq_rel) + 1 < pool->workers) {
    wait_until_passed(pool, round);
    return;
  }
  atomic_store_explicit(&pool->arrived, 0, memory_order_relaxed);
  atomic_store(&pool->round, round + 1);
  if (atomic_load(&pool->sleepers) == 0) return;
  pthread_mutex_lock(&pool->mutex);
  pthread_cond_broadcast(&pool->woken);
  pthread_mutex_unlock(&pool->mutex);
}

/* ---- the threads ---- */

static void *serve(void *arg) {
  const struct seat *seat = arg;
  struct hk_pool *pool = seat->pool;
  pthread_mutex_lock(&pool->mutex); /* until their number is known */
  pthread_mutex_unlock(&pool->mutex);
  for (;;) {
    hk_pool_barrier(pool);
    if (pool->work == NULL) return NULL;
    pool->work(seat->worker, pool->workers, pool->ctx);
    hk_pool_barrier(pool);
  }
}

/* Starts fewer threads than requested if the system has no more. */
static void start(struct hk_pool *pool, int32_t workers) {
  pthread_mutex_lock(&pool->mutex);
  for (pool->workers = 1; pool->workers < workers; pool->workers++) {
    struct seat *seat = &pool->seat[pool->workers - 1];
    *seat = (struct seat){.pool = pool, .worker = pool->workers};
    if (hk_os_start_thread(&seat->thread, serve, seat) != 0) break;
  }
  pool->spins = pool->workers <= hk_pool_processors() ? SPINS : 0;
  pthread_mutex_unlock(&pool->mutex);
}

static void end(struct hk_pool *pool) {
  pool->work = NULL;
  hk_pool_barrier(pool);
  for (int32_t k = 1; k < pool->workers; k++)
    pthread_join(pool->seat[k - 1].thread, NULL);
  pthread_cond_destroy(&pool->woken);
  pthread_mutex_destroy(&pool->mutex);
  pool->process = 0;
}

/* Starts all threads, or none. */
static int32_t begin(struct hk_pool *pool, int32_t workers) {
  pthread_mutex_init(&pool->mutex, NULL);
  pthread_cond_init(&pool->woken, NULL);
  atomic_store(&pool->arrived, 0);
  atomic_store(&pool->round, 0);
  atomic_store(&pool->sleepers, 0);
  pool->process = getpid();
  start(pool, workers);
  if (pool->workers == workers) return HOOKE_OK;
  end(pool);
  pool->workers = workers;
  return hk_fail(HOOKE_NO_MEMORY, "threads", "this machine has no room for %d threads", (int)workers);
}

int32_t hk_pool_renew(struct hk_pool *pool) {
  if (pool == NULL || pool->process == getpid()) return HOOKE_OK;
  return begin(pool, pool->workers);
}

struct hk_pool *hk_pool_create(int32_t workers) {
  struct hk_pool *pool = hk_new(1, sizeof *pool);
  struct seat *seat = hk_new(workers - 1, sizeof *seat);
  if (pool == NULL || seat == NULL) {
    hk_free(pool);
    hk_free(seat);
    return NULL;
  }
  pool->seat = seat;
  if (begin(pool, workers) == HOOKE_OK) return pool;
  hk_pool_destroy(pool);
  return NULL;
}

void hk_pool_destroy(struct hk_pool *pool) {
  if (pool == NULL) return;
  if (pool->process == getpid()) end(pool);
  hk_free(pool->seat);
  hk_free(pool);
}

int32_t hk_pool_members(const struct hk_pool *pool) {
  return pool ? pool->workers : 1;
}

void hk_pool_run(struct hk_pool *pool, hk_pool_work *work, void *ctx) {
  if (pool == NULL || pool->workers == 1) {
    work(0, 1, ctx);
    return;
  }
  pool->work = work;
  pool->ctx = ctx;
  hk_pool_barrier(pool);
  work(0, pool->workers, ctx);
  hk_pool_barrier(pool);
}
