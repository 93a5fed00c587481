/* Backward Euler: v' = v + h a(t + h, q', v'), q' = q + h v'. Order 1, stable at every step: one stage
 * (integrate/solve/stage.h) from q and v. Its one iteration is that of Baraff and Witkin (1998). */
#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/stage.h"

struct own {
  struct hk_stage stage;
  double *start; /* q and v at the start of the step, 6 components of n */
};

static int32_t create(hooke_integrator *it) {
  struct own *own = hk_new(1, sizeof *own);
  if (own == NULL) return HOOKE_NO_MEMORY;
  it->own = own;
  own->start = hk_new(2 * it->size, sizeof(double));
  if (own->start == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += 2 * it->size * (int64_t)sizeof(double);
  return hk_stage_create(it, &own->stage);
}

static void destroy(hooke_integrator *it) {
  struct own *own = it->own;
  hk_stage_release(&own->stage);
  hk_free(own->start);
  hk_free(own);
  it->own = NULL;
}

static int32_t stages(hooke_integrator *it, struct hk_span_of_time span) {
  struct own *own = it->own;
  const struct hk_equations equations = {span.end, span.h, own->start, own->start + it->size, span.h};
  return hk_stage_solve(&own->stage, &equations);
}

static int32_t step(hooke_integrator *it) {
  struct own *own = it->own;
  return hk_stage_step(&own->stage, own->start, stages);
}

const struct hk_method hk_backward_euler = {
    .name = "backward-euler",
    .summary = "fixed step, order 1, implicit; stable at every step, damps everything",
    .built = 1,
    .order = 1,
    .second_order = 1,
    .implicit = 1,
    .stability = {.kind = HOOKE_STABLE_ALWAYS,
                  .damps_implicitly = 1,
                  .note = "stable at every step; accuracy limits it, and in large steps whether the "
                          "equations can be solved"},
    .no_first_order = "solves its step with the derivative of the forces, and x' = phi(t, x) brings none",
    .create = create,
    .destroy = destroy,
    .begin = hk_fixed_begin,
    .step = step,
    .store = hk_fixed_store};
