/* The springs or the force that determine a violation, and the step that a change of them would allow. */
#include "measure/why/why.h"

#include "measure/limit/limit.h"
#include "measure/spectrum/naming.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void hk_inquiry_blame_spring(struct hk_inquiry *inquiry, int64_t spring, double share) {
  struct hk_why *why = inquiry->why;
  if (spring < 0 || why->blame_count == HOOKE_WHY_MOST_BLAME) return;
  const struct hk_spring found = hk_springs_find(&inquiry->system->springs, spring);
  struct hk_why_blame *blame = &why->blame[why->blame_count++];
  *blame = (struct hk_why_blame){
      .spring = spring, .first = found.head, .second = found.tail, .share = share, .force = ""};
  snprintf(blame->group, sizeof blame->group, "%s",
           hk_naming_group(inquiry->system, &hk_force_springs, spring));
}

/* A force first, then springs. */
static void take_blame(struct hk_inquiry *inquiry, const struct hk_blame *blame) {
  struct hk_why *why = inquiry->why;
  why->blame_count = 0;
  inquiry->force = hk_blame_force(blame);
  if (inquiry->force >= 0) {
    why->blame[why->blame_count++] = (struct hk_why_blame){.spring = -1,
                                                           .first = -1,
                                                           .second = -1,
                                                           .share = blame->force_share[inquiry->force],
                                                           .force = hk_blame_force_name(inquiry->force)};
  }
  for (int64_t k = 0; k < blame->spring_count; k++)
    hk_inquiry_blame_spring(inquiry, blame->spring[k].spring, blame->spring[k].share);
}

static int32_t look(struct hk_inquiry *inquiry, struct hk_limit *limit) {
  limit->patience = &inquiry->patience;
  limit->room = inquiry->memory_limit - inquiry->memory_used;
  const int32_t status = hk_limit_look(limit, inquiry->violation.q, inquiry->violation.time);
  if (limit->found) take_blame(inquiry, &limit->blame);
  const struct hk_remedy *remedy = &limit->remedy;
  if (status == HOOKE_OK && (remedy->kind || remedy->force))
    snprintf(inquiry->remedy, sizeof inquiry->remedy, "%s", remedy->sentence);
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

int32_t hk_inquiry_blame(struct hk_inquiry *inquiry) {
  const struct hk_violation *violation = &inquiry->violation;
  int32_t status = HOOKE_OK;
  if (violation->has_blame) take_blame(inquiry, &violation->blame);
  if (!inquiry->large) {
    hk_patience_lend(&inquiry->patience, 0.5);
    status = ask_limit(inquiry);
    hk_inquiry_end_part(inquiry, "what determines the limit");
  }
  if (status == HOOKE_NO_MEMORY) return status;
  /* without a mode, the particle at which the bound showed it */
  if (inquiry->why->blame_count == 0) {
    const struct hk_force_row *force;
    hk_inquiry_blame_spring(inquiry,
                            hk_naming_heaviest(inquiry->system, &hk_force_springs, violation->particle,
                                               inquiry->run->schedule.step, &force),
                            NAN);
  }
  return HOOKE_OK;
}
