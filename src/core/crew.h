/* A crew: a fixed number of threads, the caller's among them, that do one piece of work together, as often as
 * they are asked. Between two pieces the others wait, spinning for a moment and then asleep. */
#ifndef HOOKE_CORE_CREW_H
#define HOOKE_CORE_CREW_H

#include <stdint.h>

struct hk_crew;

/* What member 0 (the caller's thread), 1, .. members - 1 each do. No message of a failure crosses: a member
 * that fails says so in ctx, and the caller of hk_crew_run() reports it. */
typedef void hk_crew_work(int32_t member, int32_t members, void *ctx);

/* `members` >= 1; NULL without memory or threads. A crew of 1 has no thread of its own. */
struct hk_crew *hk_crew_create(int32_t members);
/* NULL is allowed. */
void hk_crew_destroy(struct hk_crew *crew);

/* After fork() the threads are those of the parent: a child gets its own here, before anything else is asked
 * of the crew. HOOKE_NO_MEMORY without threads. NULL is allowed. */
int32_t hk_crew_renew(struct hk_crew *crew);

/* How many processors this process may use. */
int32_t hk_crew_processors(void);

/* 1 if crew is NULL. */
int32_t hk_crew_members(const struct hk_crew *crew);

/* Every member does the work; returns when all have. By one thread at a time, and not from within. With crew
 * NULL the caller does it alone. */
void hk_crew_run(struct hk_crew *crew, hk_crew_work *work, void *ctx);

/* From within the work: waits until every member is here. What any wrote before, all see after. */
void hk_crew_meet(struct hk_crew *crew);

/* Member m of `members` has elements hk_crew_share(count, unit, m, members) up to that of m + 1: near equal
 * shares of whole units, which depend on nothing else. */
static inline int64_t hk_crew_share(int64_t count, int64_t unit, int32_t member, int32_t members) {
  const int64_t units = (count + unit - 1) / unit, at = units * member / members * unit;
  return at < count ? at : count;
}

#endif
