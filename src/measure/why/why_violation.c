/* Checks if the step exceeds the limit, the cheapest way first: by the bound, which is one pass over the
 * springs; then by the spectrum or, if that is out of reach, by growing motion. */
#include "measure/why/why.h"

#include "measure/limit/limit_predict.h"
#include "measure/spectrum/step_bound.h"

#include <math.h>
#include <string.h>

static const double LIMIT_ACCURACY = 1e-4, LEAST_RISE = 2e-3;
enum { MOST_TRIES = 12, MOST_TURNS = 60, MORE_TURNS = 12 };

static const char *method_of(const struct hk_inquiry *inquiry) {
  return inquiry->run->method->name;
}

static void take(struct hk_inquiry *inquiry, const double *q, double t, double limit, double at_most,
                 int64_t particle) {
  struct hk_violation *violation = &inquiry->violation;
  violation->found = 1;
  violation->time = t;
  violation->limit = limit;
  violation->at_most = at_most;
  violation->particle = particle;
  memcpy(violation->q, q, (size_t)inquiry->run->size * sizeof(double));
}

/* 0 if budget ends or the numbers overflow: unknown is not above. */
static int32_t by_spectrum(struct hk_inquiry *inquiry, const double *q, const double *v, double t,
                           int64_t particle) {
  double limit = 0.0;
  const hooke_system at = hk_system_at(inquiry->system, t);
  const int32_t status =
      hk_limit_predict_within(&at, q, v, method_of(inquiry), NULL, NULL, LIMIT_ACCURACY,
                              inquiry->memory_limit - inquiry->memory_used, &inquiry->budget, &limit);
  if (status == HOOKE_NO_MEMORY) return status;
  if (status == HOOKE_OK && inquiry->run->schedule.step > limit) take(inquiry, q, t, limit, limit, particle);
  return HOOKE_OK;
}

/* Iterates the motion that dominates the last states towards growing motion. */
static int32_t begin_growing(struct hk_inquiry *inquiry) {
  if (inquiry->growing.x) return HOOKE_OK;
  const double bytes = hk_growing_bytes(inquiry->system);
  if (!hk_inquiry_has_memory(inquiry, bytes, "whether the step is above the limit")) return HOOKE_OK;
  inquiry->memory_used += bytes;
  return hk_growing_create(inquiry->system, hk_recent_state(&inquiry->run->recent, 0, NULL)->v,
                           &inquiry->budget, &inquiry->growing);
}

static int32_t find_growing_participation(struct hk_inquiry *inquiry, double h) {
  struct hk_violation *violation = &inquiry->violation;
  double a = 1.0, b = 0.0, most;
  hk_growing_rule(inquiry->system, method_of(inquiry), h, &a, &b, &most);
  violation->has_participation = 1;
  const hooke_system at = hk_system_at(inquiry->system, violation->time);
  return hk_participation_find(&at, violation->q, NULL, inquiry->growing.x, a, 0.5 * b,
                               &violation->participation);
}

/* `above`: factor by which the quotient exceeds the stable value; infinity if no step is stable. */
static int32_t take_growth(struct hk_inquiry *inquiry, const double *q, double t, int64_t particle,
                           double above) {
  const double h = inquiry->run->schedule.step;
  take(inquiry, q, t, isinf(above) ? 0.0 : (double)NAN, h / sqrt(above), particle);
  return find_growing_participation(inquiry, h);
}

static int32_t by_growth(struct hk_inquiry *inquiry, const double *q, double t, int64_t particle) {
  struct hk_growing *growing = &inquiry->growing;
  double a = 1.0, b = 0.0, most;
  const int never = hk_method_needs_damping(method_of(inquiry)) && !hk_system_is_damped(inquiry->system, 0);
  if (!hk_growing_rule(inquiry->system, method_of(inquiry), inquiry->run->schedule.step, &a, &b, &most) &&
      !never)
    return HOOKE_OK;
  if (never) most = 0.0;
  const int32_t status = begin_growing(inquiry);
  if (status != HOOKE_OK || growing->x == NULL) return status;
  growing->t = t;
  double quotient = hk_growing_turn(growing, q, a, b, most, LEAST_RISE, MOST_TURNS);
  if (!(quotient > most)) return HOOKE_OK;
  quotient = fmax(quotient, hk_growing_turn(growing, q, a, b, INFINITY, LEAST_RISE, MORE_TURNS));
  return take_growth(inquiry, q, t, particle, quotient / most);
}

int32_t hk_inquiry_consider(struct hk_inquiry *inquiry, struct hk_node_blocks *blocks,
                            const hooke_state *state) {
  const double *q = state->q, t = *state->t;
  struct hk_violation *violation = &inquiry->violation;
  int64_t particle = -1;
  if (violation->found || violation->tries >= MOST_TRIES || !hk_step_is_bounded(method_of(inquiry)))
    return HOOKE_OK;
  if (!hk_all_finite(inquiry->run->size, q)) return HOOKE_OK;
  hk_node_blocks_fill(blocks, t, q, state->v);
  if (hk_budget_ends(&inquiry->budget, "bounds")) return HOOKE_OK;
  const int32_t bodies = inquiry->system->mover_count > 0; /* without a bound, nor growing motion */
  if (bodies && inquiry->large) return HOOKE_OK;
  const double step = inquiry->run->schedule.step,
               bound = hk_step_bound_of(blocks, method_of(inquiry), step, &particle);
  if (!bodies && !(bound < step)) return HOOKE_OK;
  if (violation->pause-- > 0) return HOOKE_OK;
  violation->pause = violation->tries++;
  if (isnan(violation->bound)) violation->bound = bound;
  return inquiry->large ? by_growth(inquiry, q, t, particle) : by_spectrum(inquiry, q, state->v, t, particle);
}

/* Earlier states first, so that the time at which the step became too large is the earliest known. */
static int32_t survey_small(struct hk_inquiry *inquiry, struct hk_node_blocks *blocks) {
  const struct hk_recent *recent = &inquiry->run->recent;
  int32_t status = HOOKE_OK;
  if (recent->first) status = hk_inquiry_consider(inquiry, blocks, recent->first);
  for (int64_t k = recent->count - 1; k >= 0 && status == HOOKE_OK; k--) {
    status = hk_inquiry_consider(inquiry, blocks, hk_recent_state(recent, k, NULL));
  }
  return status;
}

/* The newest first, which contains most of the growing motion; its direction is then tested at the start. */
static int32_t survey_large(struct hk_inquiry *inquiry, struct hk_node_blocks *blocks) {
  const hooke_integrator *run = inquiry->run;
  const hooke_state *newest = hk_recent_state(&run->recent, 0, NULL), *first = run->recent.first;
  int32_t status = hk_inquiry_consider(inquiry, blocks, newest);
  const double *q = first ? first->q : run->t0 == 0.0 ? inquiry->system->position : NULL;
  double a = 1.0, b = 0.0, most;
  if (status != HOOKE_OK || !inquiry->violation.found || inquiry->growing.x == NULL || q == NULL)
    return status;
  if (!hk_growing_rule(inquiry->system, method_of(inquiry), run->schedule.step, &a, &b, &most)) return status;
  inquiry->growing.t = run->t0;
  const double above = hk_growing_quotient(&inquiry->growing, q, a, b) / most;
  if (!(above > 1.0)) return HOOKE_OK;
  hk_participation_release(&inquiry->violation.participation);
  return take_growth(inquiry, q, run->t0, inquiry->violation.particle, above);
}

int32_t hk_inquiry_survey(struct hk_inquiry *inquiry, struct hk_node_blocks *blocks) {
  return inquiry->large ? survey_large(inquiry, blocks) : survey_small(inquiry, blocks);
}
