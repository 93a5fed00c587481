#include "measure/trial/patience.h"

#include "core/clock.h"

#include <math.h>
#include <stddef.h>

static double now_of(const struct hk_patience *p) {
  return p->counted ? p->work : hk_clock_seconds();
}

struct hk_patience hk_patience_of(double seconds, hooke_progress *progress, void *ctx) {
  const double now = hk_clock_seconds();
  return (struct hk_patience){
      .begun = now, .until = now + seconds, .end = now + seconds, .progress = progress, .ctx = ctx};
}

struct hk_patience hk_patience_of_work(double work, hooke_progress *progress, void *ctx) {
  return (struct hk_patience){.counted = 1, .until = work, .end = work, .progress = progress, .ctx = ctx};
}

void hk_patience_spend(struct hk_patience *p, double work) {
  p->work += work;
}

double hk_patience_left(const struct hk_patience *p) {
  return p ? fmax(0.0, p->until - now_of(p)) : INFINITY;
}

int32_t hk_patience_ends(struct hk_patience *p, const char *what) {
  if (p == NULL) return 0;
  if (p->spent || p->stopped) return 1;
  const double now = now_of(p);
  const double done = isinf(p->end) ? 0.0 : fmin(1.0, (now - p->begun) / (p->end - p->begun));
  p->stopped = p->progress && p->progress(done, what, p->ctx) != 0;
  p->spent = !(now < p->until);
  return p->spent || p->stopped;
}

int32_t hk_patience_has(struct hk_patience *p, double seconds) {
  if (p == NULL) return 1;
  p->spent |= !(now_of(p) + seconds <= p->until);
  return !p->spent && !p->stopped;
}

void hk_patience_lend(struct hk_patience *p, double share) {
  const double now = now_of(p);
  p->until = now + share * (p->end - now);
}

int32_t hk_patience_take_back(struct hk_patience *p) {
  const int32_t spent = p->spent;
  p->until = p->end;
  p->spent = !(now_of(p) < p->end);
  return spent;
}
