/* The implicit midpoint rule: q' = q + h v_m, v' = v + h a(t + h/2, q_m, v_m) at the mean q_m, v_m of old and
 * new state. Order 2, symplectic, stable at every step. q_m and v_m are one stage (integrate/solve/stage.h)
 * of length h/2 from q and v, beyond which the step goes as far again (Hairer, Lubich and Wanner 2006,
 * II.1.1). */
#include "integrate/solve/stage.h"

/* From the middle on as far again; constrained particles come from the drives. */
static int32_t go_on(hooke_integrator *it, struct hk_span_of_time span) {
  struct hk_stage *stage = it->own;
  struct hk_motion *m = it->motion;
  const double h = span.h;
  for (int a = 0; a < 3; a++) {
    const double *q = stage->start + a * m->n, *v = stage->start + (3 + a) * m->n;
    for (int64_t p = 0; p < m->n; p++) {
      m->q[a][p] = q[p] + h * m->v[a][p];
      m->v[a][p] = 2.0 * m->v[a][p] - v[p];
    }
  }
  hk_body_stage_go_on(stage);
  if (it->system->constrained_count == 0) return HOOKE_OK;
  return hk_integrator_hold(it, span.end);
}

static int32_t stages(hooke_integrator *it, struct hk_span_of_time span) {
  struct hk_stage *stage = it->own;
  const double half = span.h / 2.0;
  const struct hk_equations equations = {span.t + half, half, stage->start, stage->start + it->size, half};
  int32_t status = hk_integrator_drive(it, equations.t);
  if (status == HOOKE_OK) status = hk_stage_solve(stage, &equations);
  return status == HOOKE_OK ? go_on(it, span) : status;
}

const struct hk_method hk_implicit_midpoint = {
    .name = "implicit-midpoint",
    .summary = "fixed step, order 2, implicit; stable at every step, damps nothing that the scene does not",
    .order = 2,
    .checked_by = "tr-bdf2",
    .takes = HOOKE_TAKES_BODIES | HOOKE_TAKES_OVERDAMPED,
    .steps = &hk_implicit_steps,
    .solved = stages,
    .swings = 1,
    .stability = {.kind = HOOKE_STABLE_ALWAYS,
                  .damps_implicitly = 1,
                  .note =
                      "stable at every step where forces are linear; accuracy limits it, and in large steps "
                      "whether the equations can be solved"}};
