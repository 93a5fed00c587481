/* Members meet at a barrier before and after each piece of work: the first meeting starts it, the second ends
 * it. Threads have the rounding mode and the treatment of denormals that the thread had that made the crew;
 * where it changes them later, they do not follow. */
#if defined(__linux__)
#define _GNU_SOURCE /* sched_getaffinity() */
#endif
#include "core/crew.h"

#include "core/memory.h"
#include "core/status.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <unistd.h>

/* How often a member that waits looks again before it gives up its processor, some tens of microseconds, and
 * then before it sleeps. */
enum { SPINS = 1000, YIELDS = 4 };

struct seat {
  struct hk_crew *crew;
  int32_t member;
  pthread_t thread;
};

struct hk_crew {
  pid_t process; /* whose threads they are */
  int32_t members, spins;
  hk_crew_work *work; /* NULL: threads end */
  void *ctx;
  struct seat *seat; /* of members 1 .. members - 1 */
  pthread_mutex_t mutex;
  pthread_cond_t woken;
  /* each in a line of its own: whoever waits reads `round` alone */
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

int32_t hk_crew_processors(void) {
#if defined(__linux__)
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return (int32_t)CPU_COUNT(&set);
#endif
  const long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count > 0 ? (int32_t)count : 1;
}

/* ---- the barrier ---- */

static int has_passed(struct hk_crew *crew, unsigned round) {
  return atomic_load_explicit(&crew->round, memory_order_acquire) != round;
}

static void sleep_until_passed(struct hk_crew *crew, unsigned round) {
  pthread_mutex_lock(&crew->mutex);
  /* either this is seen by who ends the round, or the end of the round is seen here: both are sequentially
   * consistent */
  atomic_fetch_add(&crew->sleepers, 1);
  while (atomic_load(&crew->round) == round)
    pthread_cond_wait(&crew->woken, &crew->mutex);
  atomic_fetch_sub(&crew->sleepers, 1);
  pthread_mutex_unlock(&crew->mutex);
}

static void wait_until_passed(struct hk_crew *crew, unsigned round) {
  for (int32_t k = 0; k < crew->spins; k++) {
    if (has_passed(crew, round)) return;
    relax();
  }
  for (int32_t k = 0; k < YIELDS; k++) {
    if (has_passed(crew, round)) return;
    sched_yield();
  }
  sleep_until_passed(crew, round);
}

void hk_crew_meet(struct hk_crew *crew) {
  if (crew == NULL || crew->members == 1) return;
  const unsigned round = atomic_load_explicit(&crew->round, memory_order_relaxed);
  if (atomic_fetch_add_explicit(&crew->arrived, 1, memory_order_acq_rel) + 1 < crew->members) {
    wait_until_passed(crew, round);
    return;
  }
  atomic_store_explicit(&crew->arrived, 0, memory_order_relaxed);
  atomic_store(&crew->round, round + 1);
  if (atomic_load(&crew->sleepers) == 0) return;
  pthread_mutex_lock(&crew->mutex);
  pthread_cond_broadcast(&crew->woken);
  pthread_mutex_unlock(&crew->mutex);
}

/* ---- the threads ---- */

static void *serve(void *arg) {
  const struct seat *seat = arg;
  struct hk_crew *crew = seat->crew;
  pthread_mutex_lock(&crew->mutex); /* until it is known how many there are */
  pthread_mutex_unlock(&crew->mutex);
  for (;;) {
    hk_crew_meet(crew);
    if (crew->work == NULL) return NULL;
    crew->work(seat->member, crew->members, crew->ctx);
    hk_crew_meet(crew);
  }
}

/* Starts threads with all signals blocked, so that handlers run in the threads of the caller; fewer than
 * asked for if there are no more. */
static void start(struct hk_crew *crew, int32_t members) {
  sigset_t all, kept;
  sigfillset(&all);
  pthread_mutex_lock(&crew->mutex);
  pthread_sigmask(SIG_SETMASK, &all, &kept);
  for (crew->members = 1; crew->members < members; crew->members++) {
    struct seat *seat = &crew->seat[crew->members - 1];
    *seat = (struct seat){.crew = crew, .member = crew->members};
    if (pthread_create(&seat->thread, NULL, serve, seat) != 0) break;
  }
  pthread_sigmask(SIG_SETMASK, &kept, NULL);
  crew->spins = crew->members <= hk_crew_processors() ? SPINS : 0;
  pthread_mutex_unlock(&crew->mutex);
}

static void end(struct hk_crew *crew) {
  crew->work = NULL;
  hk_crew_meet(crew);
  for (int32_t k = 1; k < crew->members; k++)
    pthread_join(crew->seat[k - 1].thread, NULL);
  pthread_cond_destroy(&crew->woken);
  pthread_mutex_destroy(&crew->mutex);
  crew->process = 0;
}

/* All threads, or none. */
static int32_t begin(struct hk_crew *crew, int32_t members) {
  pthread_mutex_init(&crew->mutex, NULL);
  pthread_cond_init(&crew->woken, NULL);
  atomic_store(&crew->arrived, 0);
  atomic_store(&crew->round, 0);
  atomic_store(&crew->sleepers, 0);
  crew->process = getpid();
  start(crew, members);
  if (crew->members == members) return HOOKE_OK;
  end(crew);
  crew->members = members;
  return hk_fail(HOOKE_NO_MEMORY, "threads", "this machine has no room for %d threads", (int)members);
}

int32_t hk_crew_renew(struct hk_crew *crew) {
  if (crew == NULL || crew->process == getpid()) return HOOKE_OK;
  return begin(crew, crew->members);
}

struct hk_crew *hk_crew_create(int32_t members) {
  struct hk_crew *crew = hk_new(1, sizeof *crew);
  struct seat *seat = hk_new(members - 1, sizeof *seat);
  if (crew == NULL || seat == NULL) {
    hk_free(crew);
    hk_free(seat);
    return NULL;
  }
  crew->seat = seat;
  if (begin(crew, members) == HOOKE_OK) return crew;
  hk_crew_destroy(crew);
  return NULL;
}

void hk_crew_destroy(struct hk_crew *crew) {
  if (crew == NULL) return;
  if (crew->process == getpid()) end(crew);
  hk_free(crew->seat);
  hk_free(crew);
}

int32_t hk_crew_members(const struct hk_crew *crew) {
  return crew ? crew->members : 1;
}

void hk_crew_run(struct hk_crew *crew, hk_crew_work *work, void *ctx) {
  if (crew == NULL || crew->members == 1) {
    work(0, 1, ctx);
    return;
  }
  crew->work = work;
  crew->ctx = ctx;
  hk_crew_meet(crew);
  work(0, crew->members, ctx);
  hk_crew_meet(crew);
}
