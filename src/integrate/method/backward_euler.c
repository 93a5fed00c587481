/* Backward Euler: v' = v + h a(t + h, q', v'), q' = q + h v'. Order 1, stable at every step: one stage
 * (integrate/solve/stage.h) from q and v. Its one iteration is that of Baraff and Witkin (1998). */
#include "integrate/solve/stage.h"

static int32_t stages(hooke_integrator *it, struct hk_span_of_time span) {
  struct hk_stage *stage = it->own;
  const struct hk_equations equations = {span.end, span.h, stage->start, stage->start + it->size, span.h};
  return hk_stage_solve(stage, &equations);
}

const struct hk_method hk_backward_euler = {
    .name = "backward-euler",
    .summary = "fixed step, order 1, implicit; stable at every step, damps everything",
    .order = 1,
    .judge = "implicit-midpoint",
    .takes = HOOKE_TAKES_BODIES | HOOKE_TAKES_OVERDAMPED,
    .steps = &hk_implicit_steps,
    .solved = stages,
    .stability = {.kind = HOOKE_STABLE_ALWAYS,
                  .damps_implicitly = 1,
                  .note = "stable at every step; accuracy limits it, and in "
                          "large steps whether the equations can be solved"}};
