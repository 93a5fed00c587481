/* A thread pool: a fixed number of threads, including the caller's, that run one task together, any number of
 * times. Between tasks the others wait, spinning briefly and then asleep. */
#pragma once

#include <stdint.h>

struct hk_pool;

/* The task of worker 0 (the caller's thread), 1, .. workers - 1. Error messages are per thread and do not
 * cross: a worker that fails records it in ctx, and the caller of hk_pool_run() reports it. */
typedef void hk_pool_work(int32_t worker, int32_t workers, void *ctx);

/* Creates a pool of `workers` >= 1; NULL without memory or threads. A pool of 1 has no thread of its own. */
struct hk_pool *hk_pool_create(int32_t workers);
/* NULL is allowed. */
void hk_pool_destroy(struct hk_pool *pool);

/* Call first in a child after fork(), whose threads remain with the parent: starts new ones there.
 * HOOKE_NO_MEMORY without threads. NULL is allowed. */
int32_t hk_pool_renew(struct hk_pool *pool);

/* Number of processors available to this process. */
int32_t hk_pool_processors(void);

/* 1 if `pool` is NULL. */
int32_t hk_pool_members(const struct hk_pool *pool);

/* Runs the task on every worker and returns when all are done. One caller at a time, and not from within a
 * task. With `pool` NULL the caller runs it alone. */
void hk_pool_run(struct hk_pool *pool, hk_pool_work *work, void *ctx);

/* Barrier within a task: waits until every worker is here. Afterwards all see what any wrote before. */
void hk_pool_barrier(struct hk_pool *pool);

/* Worker m of `workers` has elements hk_pool_share(count, unit, m, workers) up to that of m + 1: nearly equal
 * partitions in whole units, which depend on nothing else. */
static inline int64_t hk_pool_share(int64_t count, int64_t unit, int32_t worker, int32_t workers) {
  const int64_t units = (count + unit - 1) / unit, at = units * worker / workers * unit;
  return at < count ? at : count;
}
