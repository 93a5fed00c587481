/* Thread pools: every worker does its share once, all see its results after a barrier, and neither more
 * workers than processors nor work of unequal length causes long waits. */
#include "check.h"

#include "core/thread_pool.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 16, COUNT = 4096 };
static const int32_t sizes[] = {1, 2, 3, 8, 16};

struct sums {
  struct hk_pool *pool;
  int32_t rounds, calls[MOST], wrong[MOST];
  int64_t part[MOST], value[COUNT];
};

/* In each round workers sum their shares, wait at the barrier, sum the results of the others, wait, and write
 * new values into the share of the next worker. */
static void add_up(int32_t worker, int32_t workers, void *ctx) {
  struct sums *sums = ctx;
  const int64_t expected = (int64_t)COUNT * (COUNT - 1) / 2;
  sums->calls[worker]++;
  for (int32_t round = 0; round < sums->rounds; round++) {
    const int64_t from = hk_pool_share(COUNT, 8, worker, workers),
                  to = hk_pool_share(COUNT, 8, worker + 1, workers);
    int64_t part = 0;
    for (int64_t k = from; k < to; k++)
      part += sums->value[k];
    sums->part[worker] = part;
    hk_pool_barrier(sums->pool);
    int64_t total = 0;
    for (int32_t m = 0; m < workers; m++)
      total += sums->part[m];
    sums->wrong[worker] += total != expected + (int64_t)COUNT * round;
    hk_pool_barrier(sums->pool);
    const int32_t next = (worker + 1) % workers;
    for (int64_t k = hk_pool_share(COUNT, 8, next, workers); k < hk_pool_share(COUNT, 8, next + 1, workers);
         k++)
      sums->value[k]++;
    hk_pool_barrier(sums->pool);
  }
}

TEST(test_sums) {
  for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
    struct sums *sums = new_block(1, (int64_t)sizeof *sums);
    sums->pool = hk_pool_create(sizes[s]);
    assert_non_null(sums->pool);
    assert_int_equal(hk_pool_members(sums->pool), sizes[s]);
    sums->rounds = sizes[s] <= 3 ? 1000 : 100;
    for (int32_t run = 0; run < 3; run++) {
      for (int64_t k = 0; k < COUNT; k++)
        sums->value[k] = k;
      hk_pool_run(sums->pool, add_up, sums);
      for (int32_t m = 0; m < MOST; m++) {
        assert_int_equal(sums->calls[m], m < sizes[s] ? run + 1 : 0);
        assert_int_equal(sums->wrong[m], 0);
      }
      for (int64_t k = 0; k < COUNT; k++)
        assert_int_equal(sums->value[k], k + sums->rounds);
    }
    hk_pool_destroy(sums->pool);
    free(sums);
  }
}

struct steps {
  struct hk_pool *pool;
  int64_t done[MOST];
};

static void count_step(int32_t worker, int32_t workers, void *ctx) {
  (void)workers;
  struct steps *steps = ctx;
  steps->done[worker]++;
}

/* Many short tasks. */
TEST(test_short_runs) {
  for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
    struct steps steps = {.pool = hk_pool_create(sizes[s])};
    const int64_t runs = sizes[s] <= 3 ? 5000 : 300;
    for (int64_t k = 1; k <= runs; k++) {
      hk_pool_run(steps.pool, count_step, &steps);
      for (int32_t m = 0; m < sizes[s]; m++)
        assert_int_equal(steps.done[m], k);
    }
    hk_pool_destroy(steps.pool);
  }
}

static void nap(int64_t microseconds) {
  const struct timespec time = {0, (long)(1000 * microseconds)};
  nanosleep(&time, NULL);
}

/* Each worker in turn comes so late that the others sleep. */
static void come_late(int32_t worker, int32_t workers, void *ctx) {
  struct steps *steps = ctx;
  for (int32_t late = 0; late < workers; late++) {
    if (worker == late) {
      nap(500);
      for (int32_t m = 0; m < workers; m++)
        steps->done[m]++;
    }
    hk_pool_barrier(steps->pool);
    if (steps->done[worker] != late + 1) steps->done[worker] = -1000;
    hk_pool_barrier(steps->pool);
  }
}

TEST(test_unequal_work) {
  for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
    struct steps steps = {.pool = hk_pool_create(sizes[s])};
    for (int32_t run = 0; run < 4; run++) {
      memset(steps.done, 0, sizeof steps.done);
      nap(run * 300); /* the thread pool sleeps */
      hk_pool_run(steps.pool, come_late, &steps);
      for (int32_t m = 0; m < sizes[s]; m++)
        assert_int_equal(steps.done[m], sizes[s]);
    }
    hk_pool_destroy(steps.pool);
  }
}

TEST(test_alone) {
  struct steps steps = {0};
  assert_int_equal(hk_pool_members(NULL), 1);
  hk_pool_run(NULL, count_step, &steps);
  hk_pool_barrier(NULL);
  hk_pool_destroy(NULL);
  assert_int_equal(steps.done[0], 1);
}

TEST(test_shares) {
  for (int64_t count = 0; count < 700; count += 13) {
    for (int32_t workers = 1; workers <= MOST; workers++) {
      assert_int_equal(hk_pool_share(count, 64, 0, workers), 0);
      assert_int_equal(hk_pool_share(count, 64, workers, workers), count);
      for (int32_t m = 0; m < workers; m++) {
        const int64_t from = hk_pool_share(count, 64, m, workers),
                      to = hk_pool_share(count, 64, m + 1, workers);
        assert_true(from <= to && to - from <= 64 * ((count + 63) / 64 / workers + 1));
        assert_true(from % 64 == 0 || from == count);
      }
    }
  }
}

static void look_at_signals(int32_t worker, int32_t workers, void *ctx) {
  (void)workers;
  int *blocked = ctx;
  sigset_t set;
  pthread_sigmask(SIG_SETMASK, NULL, &set);
  blocked[worker] = sigismember(&set, SIGINT) && sigismember(&set, SIGUSR1);
}

/* The caller handles signals as before, the threads none. */
TEST(test_signals) {
  int blocked[3] = {-1, -1, -1};
  struct hk_pool *pool = hk_pool_create(3);
  hk_pool_run(pool, look_at_signals, blocked);
  hk_pool_destroy(pool);
  assert_int_equal(blocked[0], 0);
  assert_int_equal(blocked[1], 1);
  assert_int_equal(blocked[2], 1);
}
