/* What a cost says of its results. */
#include "core/print.h"
#include "measure/cost/cost.h"

#include <math.h>

static const double RAISES = 1.05; /* a limit that is higher by less is that of the whole scene */

static void tell_whole(const struct hk_cost *cost, struct hk_claims *claims) {
  if (isnan(cost->memory))
    hk_claim(claims, "cost", HOOKE_OF_UNKNOWN, "clock", "stopped before a step of the scene was taken");
  else if (isnan(cost->nanoseconds))
    hk_claim(claims, "cost", HOOKE_OF_WHOLE, "count", "a step of %s, %.6g s, without its time", cost->method,
             cost->step);
  else
    hk_claim(claims, "cost", HOOKE_OF_WHOLE, "clock", "a step of %s, %.6g s, takes %.3g us on this machine",
             cost->method, cost->step, 1e-3 * cost->nanoseconds);
}

/* The ingredient without which the step could be largest. */
static void tell_limit(const struct hk_cost *cost, struct hk_claims *claims) {
  const struct hk_cost_row *most = NULL;
  double limit = RAISES * cost->limit;
  for (int64_t k = 0; k < cost->row_count; k++) {
    if (!(cost->row[k].limit > limit)) continue;
    most = &cost->row[k];
    limit = most->limit;
  }
  if (most == NULL) return;
  const char *name = hk_cost_row_name(cost, most);
  char without[64] = "at any step";
  if (isfinite(limit)) hk_print(without, sizeof without, "up to %.6g s", limit);
  char now[64] = "at no step";
  if (cost->limit > 0.0) hk_print(now, sizeof now, "up to %.6g s", cost->limit);
  hk_claim(claims, "limit", HOOKE_OF_PART, "prediction",
           "at the state of the cost, %s is stable %s, and without %s %s", cost->method, now,
           name[0] ? name : most->kind, without);
}

void hk_cost_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_cost *cost = measurement->object;
  long long unknown = 0;
  for (int64_t k = 0; k < cost->row_count; k++)
    unknown += isnan(cost->row[k].memory);
  tell_whole(cost, claims);
  tell_limit(cost, claims);
  if (unknown > 0)
    hk_claim(claims, "left-out", HOOKE_OF_UNKNOWN, "options", "%lld %s not looked at", unknown,
             unknown == 1 ? "ingredient was" : "ingredients were");
}
