#include "measure/trial/budget.h"

#include "core/clock.h"

#include <math.h>
#include <stddef.h>

static double now_of(const struct hk_budget *p) {
  return p->counted ? p->work : hk_clock_seconds();
}

struct hk_budget hk_budget_of(double seconds, hooke_progress *progress, void *ctx) {
  const double now = hk_clock_seconds();
  return (struct hk_budget){
      .begun = now, .until = now + seconds, .end = now + seconds, .progress = progress, .ctx = ctx};
}

struct hk_budget hk_budget_of_work(double work, hooke_progress *progress, void *ctx) {
  return (struct hk_budget){.counted = 1, .until = work, .end = work, .progress = progress, .ctx = ctx};
}

void hk_budget_spend(struct hk_budget *p, double work) {
  p->work += work;
}

int32_t hk_budget_ends(struct hk_budget *p, const char *what) {
  if (p == NULL) return 0;
  if (p->spent || p->stopped) return 1;
  const double now = now_of(p);
  const double done = isinf(p->end) ? 0.0 : fmin(1.0, (now - p->begun) / (p->end - p->begun));
  p->stopped = p->progress && p->progress(done, what, p->ctx) != 0;
  p->spent = !(now < p->until);
  return p->spent || p->stopped;
}

int32_t hk_budget_watch(double done, const char *what, void *budget) {
  (void)done;
  return hk_budget_ends(budget, what);
}

double hk_budget_left(const struct hk_budget *p) {
  return p->until - now_of(p);
}

int32_t hk_budget_has(struct hk_budget *p, double seconds) {
  if (p == NULL) return 1;
  p->spent |= !(now_of(p) + seconds <= p->until);
  return !p->spent && !p->stopped;
}

void hk_budget_lend(struct hk_budget *p, double fraction) {
  const double now = now_of(p);
  p->until = now + fraction * (p->end - now);
}

int32_t hk_budget_take_back(struct hk_budget *p) {
  const int32_t spent = p->spent;
  p->until = p->end;
  p->spent = !(now_of(p) < p->end);
  return spent;
}
