/* Springs that pass through length zero: those that turn by more than a right angle within a step, as
 * their ends went through each other. A motion that turns a spring in several steps goes by.
 *
 * Springs are looked at while one of them is shorter than half its rest length, which the loops of forces
 * notice in passing. That may be in the step after the one in which it passed, so the first look goes two
 * steps back. */
#include "integrate/loop/run_loop.h"

#include "core/print.h"
#include "model/force/force.h"

#include <math.h>
#include <stdio.h>

void hk_passages_begin(hooke_integrator *it, double t) {
  it->passages.follows = 0;
  it->passages.until = t;
  if (it->motion) it->motion->near_zero = 0;
}

static int32_t make_space(hooke_integrator *it) {
  struct hk_passages *p = &it->passages;
  const int64_t numbers = hk_integrator_numbers(it);
  int32_t status = p->before ? HOOKE_OK : hk_state_create_sized(numbers, 1, &p->before);
  if (status == HOOKE_OK && p->now == NULL) status = hk_state_create_sized(numbers, 1, &p->now);
  return status;
}

static void tell(hooke_integrator *it, int64_t passed, const int64_t ends[2], double t) {
  struct hk_passages *p = &it->passages;
  if (p->seen == 0 && ends[1] < 0)
    hk_print(p->first, sizeof p->first, "of particle %lld and its anchor at t = %.6g s", (long long)ends[0],
             t);
  else if (p->seen == 0)
    hk_print(p->first, sizeof p->first, "of particles %lld and %lld at t = %.6g s", (long long)ends[0],
             (long long)ends[1], t);
  p->seen += passed;
  if (it->count.zero_passages >= 0) it->count.zero_passages += passed;
  const char *least = it->count.zero_passages < 0 ? "at least " : "", *plural = p->seen == 1 ? "" : "s";
  snprintf(
      p->told, sizeof p->told,
      "springs passed through length zero %s%lld time%s, first that %s: beyond it the force of such a "
      "spring turns round with it, while that of a textbook, k (x - rest length) along a line, does not; "
      "for that one put the wall farther away by some length and make the rest length longer by the same",
      least, (long long)p->seen, plural, p->first);
}

static void count(hooke_integrator *it, const double *before, const double *now, double t) {
  for (int32_t r = 0; r < it->system->force_row_count; r++) {
    int64_t ends[2];
    const struct hk_force_row *row = it->system->force_row[r];
    const int64_t passed = row->passed ? row->passed(it->system, before, now, ends) : 0;
    if (passed > 0) tell(it, passed, ends, t);
  }
}

/* Where the step began: at a state that was kept, or a step back on a straight way. Counts one step more. */
static void look_back(hooke_integrator *it, double from, double to) {
  const struct hk_passages *p = &it->passages;
  const hooke_state *kept = hk_recent_state(&it->recent, 0, NULL);
  double *earlier = p->before->v, *before = p->before->q;
  const int begins = kept && *kept->t == from && p->until == from;
  const double back = fmin(2.0 * (to - from), to - p->until);
  for (int64_t k = 0; k < it->size; k++) {
    before[k] = begins ? kept->q[k] : p->now->q[k] - (to - from) * p->now->v[k];
    earlier[k] = p->now->q[k] - back * p->now->v[k];
  }
  if (p->until < from) count(it, earlier, before, from);
}

int32_t hk_passages_count(hooke_integrator *it, double from, double to) {
  struct hk_passages *p = &it->passages;
  if (it->motion == NULL || !(it->motion->near_zero || p->follows)) return HOOKE_OK;
  if (make_space(it) != HOOKE_OK) { /* the run goes on without the count */
    it->count.zero_passages = -1;
    return HOOKE_OK;
  }
  const int32_t status = it->method->steps->store(it, to, p->now);
  if (status != HOOKE_OK) return status;
  if (!p->follows) look_back(it, from, to);
  count(it, p->before->q, p->now->q, to);
  hooke_state *now = p->now;
  p->now = p->before;
  p->before = now;
  p->until = to;
  p->follows = it->motion->near_zero;
  it->motion->near_zero = 0;
  return HOOKE_OK;
}
