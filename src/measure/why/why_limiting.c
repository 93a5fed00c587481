/* The springs or the force that determine a violation, and the step that a change of them would allow. */
#include "measure/why/why.h"

#include "measure/limit/limit.h"
#include "measure/spectrum/naming.h"
#include "model/force/spring.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void take_participation(struct hk_inquiry *inquiry, const struct hk_participation *participation) {
  hk_limiting_take(participation, &inquiry->why->limiting);
  inquiry->force = hk_participation_force(participation);
  inquiry->heaviest = participation->heaviest;
  inquiry->group = hk_participation_group(participation);
  inquiry->group_share = inquiry->group < 0 ? 0.0 : participation->group_share[inquiry->group];
  if (inquiry->violation.particle < 0 && participation->particle_count > 0)
    inquiry->violation.particle = participation->particle[0].particle;
}

static int32_t look(struct hk_inquiry *inquiry, struct hk_limit *limit) {
  limit->budget = &inquiry->budget;
  limit->memory = inquiry->memory_limit - inquiry->memory_used;
  const int32_t status = hk_limit_look(limit, inquiry->violation.q, NULL, inquiry->violation.time);
  if (limit->found) take_participation(inquiry, &limit->participation);
  const struct hk_suggestion *suggestion = &limit->suggestion;
  if (status == HOOKE_OK && (suggestion->kind || suggestion->force))
    snprintf(inquiry->suggestion, sizeof inquiry->suggestion, "%s", suggestion->sentence);
  return status;
}

/* By the limiting mode, where the step was first found above the limit. */
static int32_t ask_limit(struct hk_inquiry *inquiry) {
  const hooke_integrator *run = inquiry->run;
  hooke_options *options = NULL;
  hooke_measurement *limit = NULL;
  int32_t status = hk_options_create(hk_limit_kind.options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "methods", run->method->name);
  if (status == HOOKE_OK)
    status = hk_measurement_create(&hk_limit_kind, NULL, inquiry->system, run->options, options, &limit);
  if (status == HOOKE_OK) status = look(inquiry, limit->object);
  hooke_measurement_destroy(limit);
  hooke_options_destroy(options);
  return status;
}

int32_t hk_inquiry_find_limiting(struct hk_inquiry *inquiry) {
  const struct hk_violation *violation = &inquiry->violation;
  int32_t status = HOOKE_OK;
  if (violation->has_participation) take_participation(inquiry, &violation->participation);
  if (!inquiry->large) {
    hk_budget_lend(&inquiry->budget, 0.5);
    status = ask_limit(inquiry);
    hk_inquiry_end_part(inquiry, "what determines the limit");
  }
  if (status == HOOKE_NO_MEMORY) return status;
  /* without a mode, the particle at which the bound showed it */
  if (inquiry->why->limiting.count == 0) {
    const struct hk_force_row *force;
    hk_limiting_add(inquiry->system,
                    hk_naming_heaviest(inquiry->system, &hk_force_springs, violation->particle,
                                       inquiry->run->schedule.step, &force),
                    NAN, &inquiry->why->limiting);
  }
  return HOOKE_OK;
}
