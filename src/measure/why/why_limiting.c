/* The springs or the force that determine a violation, and the step that a change of them would allow. */
#include "measure/why/why.h"

#include "measure/limit/limit.h"
#include "measure/spectrum/naming.h"
#include "model/force/spring.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void hk_inquiry_add_limiting(struct hk_inquiry *inquiry, int64_t spring, double share) {
  struct hk_why *why = inquiry->why;
  if (spring < 0 || why->limiting_count == HOOKE_WHY_MOST_LIMITING) return;
  const struct hk_spring found = hk_springs_find(inquiry->system->springs, spring);
  struct hk_why_limiting *limiting = &why->limiting[why->limiting_count++];
  *limiting = (struct hk_why_limiting){
      .spring = spring, .first = found.head, .second = found.tail, .share = share, .force = ""};
  snprintf(limiting->group, sizeof limiting->group, "%s",
           hk_naming_group(inquiry->system, &hk_force_springs, spring));
}

/* A force first, then springs. */
static void take_participation(struct hk_inquiry *inquiry, const struct hk_participation *participation) {
  struct hk_why *why = inquiry->why;
  why->limiting_count = 0;
  inquiry->force = hk_participation_force(participation);
  inquiry->heaviest = participation->heaviest;
  inquiry->group = hk_participation_group(participation);
  inquiry->group_share = inquiry->group < 0 ? 0.0 : participation->group_share[inquiry->group];
  if (inquiry->violation.particle < 0 && participation->particle_count > 0)
    inquiry->violation.particle = participation->particle[0].particle;
  if (inquiry->force >= 0) {
    why->limiting[why->limiting_count++] =
        (struct hk_why_limiting){.spring = -1,
                                 .first = -1,
                                 .second = -1,
                                 .share = participation->force_share[inquiry->force],
                                 .force = hk_participation_force_name(inquiry->force)};
  }
  for (int64_t k = 0; k < participation->spring_count; k++)
    hk_inquiry_add_limiting(inquiry, participation->spring[k].spring, participation->spring[k].share);
}

static int32_t look(struct hk_inquiry *inquiry, struct hk_limit *limit) {
  limit->patience = &inquiry->patience;
  limit->room = inquiry->memory_limit - inquiry->memory_used;
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
    hk_patience_lend(&inquiry->patience, 0.5);
    status = ask_limit(inquiry);
    hk_inquiry_end_part(inquiry, "what determines the limit");
  }
  if (status == HOOKE_NO_MEMORY) return status;
  /* without a mode, the particle at which the bound showed it */
  if (inquiry->why->limiting_count == 0) {
    const struct hk_force_row *force;
    hk_inquiry_add_limiting(inquiry,
                            hk_naming_heaviest(inquiry->system, &hk_force_springs, violation->particle,
                                               inquiry->run->schedule.step, &force),
                            NAN);
  }
  return HOOKE_OK;
}
