/* Compares the step of a run with the safe bound, at a cost of about a hundredth of the stepping. */
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "core/utf8.h"
#include "integrate/integrator.h"
#include "measure/limit/explicit_step.h"
#include "measure/spectrum/naming.h"
#include "measure/spectrum/step_bound.h"

#include <stdio.h>

static const double MARGIN = 0.05;
enum {
  EVALUATIONS = 5000
}; /* of forces from one check to the next, which takes as long as some 40 of them */

enum kind { NEAR_LIMIT, ABOVE_LIMIT, NEVER_STABLE, KINDS };
static const char *const kinds[KINDS] = {"near-limit", "above-limit", "never-stable"};

struct warner {
  struct hk_node_blocks blocks;
  hooke_warning *warning;
  void *ctx;
  int32_t told[KINDS];
  int64_t next; /* evaluations of forces at which it is checked again */
};

static void release(void *own) {
  struct warner *warner = own;
  hk_node_blocks_release(&warner->blocks);
  hk_free(warner);
}

static int32_t tell(struct warner *warner, const hooke_integrator *it, const hooke_state *state,
                    int64_t particle, double limit) {
  const hooke_system *system = it->system;
  const char *method = it->method->name;
  const double h = it->schedule.step;
  char where[HOOKE_NAMING_SIZE] = "", sentence[640];
  const enum kind kind = limit == 0.0 ? NEVER_STABLE : h > limit ? ABOVE_LIMIT : NEAR_LIMIT;
  if (warner->told[kind]) return 0;
  warner->told[kind] = 1;
  const int64_t spring = hk_naming_heaviest_words(system, particle, h, where);
  if (kind == NEVER_STABLE) {
    hk_print(sentence, sizeof sentence,
             "at t = %.6g s %s is stable at no step, and takes %.6g s: some motion has no damping and grows "
             "slowly, such as that at particle %lld%s%s",
             *state->t, method, h, (long long)particle, where[0] ? " on " : "", where);
  } else {
    hk_print(sentence, sizeof sentence,
             "at t = %.6g s the step %.6g s is %s %.6g s, up to which %s is certain to be stable; it is "
             "determined by particle %lld%s%s",
             *state->t, h, kind == ABOVE_LIMIT ? "above" : "within 5 % of", limit, method,
             (long long)particle, where[0] ? " and " : "", where);
  }
  hk_utf8_make_plain(sentence);
  return warner->warning(kinds[kind], sentence, *state->t, limit, spring, particle, warner->ctx);
}

static int32_t look(const hooke_integrator *it, const hooke_state *state, void *own) {
  struct warner *warner = own;
  if (it->k == 0) {
    for (int k = 0; k < KINDS; k++)
      warner->told[k] = 0;
  } else if (it->count.force_evaluations < warner->next) {
    return 0; /* not yet earned by stepping */
  }
  warner->next = it->count.force_evaluations + EVALUATIONS;
  if (warner->told[ABOVE_LIMIT] || warner->told[NEVER_STABLE]) return 0;
  const double margin = warner->told[NEAR_LIMIT] ? 0.0 : MARGIN, most = it->schedule.step / (1.0 - margin);
  int64_t particle;
  hk_node_blocks_fill(&warner->blocks, *state->t, state->q, state->v);
  const double limit =
      hk_step_bound_of(&warner->blocks, hk_step_limited_as(it->system, it->options), most, &particle);
  return limit < most ? tell(warner, it, state, particle, limit) : 0;
}

int32_t hooke_integrator_on_warning(hooke_integrator *it, hooke_warning *warning, void *ctx) {
  hk_integrator_set_checker(it, (struct hk_checker){.look = NULL});
  int32_t status = hk_integrator_require_particles(it, NULL, "has no springs to bound its step by");
  if (status != HOOKE_OK) return status;
  if (warning) status = hooke_system_warnings(it->system, warning, ctx);
  if (status != HOOKE_OK) return status;
  if (warning == NULL || !hk_step_is_bounded(it->method->name) || it->system->mover_count > 0)
    return HOOKE_OK;
  struct warner *warner = hk_new(1, sizeof *warner);
  if (warner == NULL) return HOOKE_NO_MEMORY;
  status = hk_node_blocks_begin(it->system, &warner->blocks);
  if (status != HOOKE_OK) {
    hk_free(warner);
    return status;
  }
  warner->warning = warning;
  warner->ctx = ctx;
  const int64_t bytes = (int64_t)sizeof *warner + 12 * it->system->particle_count * (int64_t)sizeof(double);
  hk_integrator_set_checker(it, (struct hk_checker){look, release, warner, bytes});
  return HOOKE_OK;
}
