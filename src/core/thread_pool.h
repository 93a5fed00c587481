/* A thread pool: a fixed number of threads, the caller's among them, that do one piece of work together, as
 * often as they are asked. Between two pieces the others wait, spinning for a moment and then asleep. */
#ifndef HOOKE_CORE_THREAD_POOL_H
#define HOOKE_CORE_THREAD_POOL_H

#include <stdint.h>

struct hk_pool;

/* What worker 0 (the caller's thread), 1, .. workers - 1 each do. No message of a failure crosses: a worker
 * that fails says so in ctx, and the caller of hk_pool_run() reports it. */
typedef void hk_pool_work(int32_t worker, int32_t workers, void *ctx);

/* `workers` >= 1; NULL without memory or threads. A thread pool of 1 has no thread of its own. */
struct hk_pool *hk_pool_create(int32_t workers);
/* NULL is allowed. */
void hk_pool_destroy(struct hk_pool *pool);

/* After fork() the threads are those of the parent: a child gets its own here, before anything else is asked
 * of the thread pool. HOOKE_NO_MEMORY without threads. NULL is allowed. */
int32_t hk_pool_renew(struct hk_pool *pool);

/* How many processors this process may use. */
int32_t hk_pool_processors(void);

/* 1 if pool is NULL. */
int32_t hk_pool_members(const struct hk_pool *pool);

/* Every worker does the work; returns when all have. By one thread at a time, and not from within. With pool
 * NULL the caller does it alone. */
void hk_pool_run(struct hk_pool *pool, hk_pool_work *work, void *ctx);

/* From within the work: waits until every worker is here. What any wrote before, all see after. */
void hk_pool_barrier(struct hk_pool *pool);

/* Member m of `workers` has elements hk_pool_share(count, unit, m, workers) up to that of m + 1: near equal
 * shares of whole units, which depend on nothing else. */
static inline int64_t hk_pool_share(int64_t count, int64_t unit, int32_t worker, int32_t workers) {
  const int64_t units = (count + unit - 1) / unit, at = units * worker / workers * unit;
  return at < count ? at : count;
}

#endif
