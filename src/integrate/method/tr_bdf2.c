/* TR-BDF2 (Bank and others 1985; Hosea and Shampine 1996): the trapezoidal rule to t + c h, then the second
 * order backward difference from there, with c = 2 - sqrt 2, for which both have the same length a = c h/2:
 *   q_c = q + a (v + v_c),                v_c = v + a (a(t, q, v) + a(t + c h, q_c, v_c))
 *   q' = q_c + d (q_c - q) + a v',        v' = v_c + d (v_c - v) + a a(t + h, q', v'),   d = (sqrt 2 - 1)/2
 * Order 2, stable at every step, and what no step resolves dies out (L-stable). Each of the two is a stage
 * (integrate/solve/stage.h), the first begun at the start of the step, the second at q_c and v_c. */
#include "integrate/solve/stage.h"

/* As numbers, so that they are the same everywhere. */
static const double MIDDLE = 0.58578643762690495120, BACK = 0.20710678118654752440;

/* Where the trapezoidal rule starts from: q + a v and v + a a(t, q, v). */
static int32_t begin_trapezoid(hooke_integrator *it, double t, double a) {
  struct hk_stage *stage = it->own;
  const hooke_system *system = it->system;
  const struct hk_motion *m = it->motion;
  const int32_t status = hk_integrator_forces(it, t);
  for (int c = 0; c < 3; c++) {
    const double *q = stage->start + c * m->n, *v = stage->start + (3 + c) * m->n;
    double *place = stage->others + c * m->n, *speed = stage->others + (3 + c) * m->n;
    for (int64_t p = 0; p < m->n; p++) {
      const double w = system->inverse_mass[p];
      place[p] = q[p] + a * v[p];
      speed[p] = v[p] + a * (w * m->f[c][p] + (w == 0.0 ? 0.0 : hk_fall(system, p, c)));
    }
  }
  hk_body_stage_explicit(stage, a, stage->others + 2 * it->size);
  return status;
}

/* Where the backward difference does. What rests stays where it is to the bit. */
static void begin_difference(hooke_integrator *it) {
  const struct hk_stage *stage = it->own;
  hk_stage_save(stage, stage->others);
  for (int64_t k = 0; k < stage->state_size; k++)
    stage->others[k] += BACK * (stage->others[k] - stage->start[k]);
}

static int32_t stages(hooke_integrator *it, struct hk_span_of_time span) {
  struct hk_stage *stage = it->own;
  const double a = MIDDLE / 2.0 * span.h;
  const struct hk_equations trapezoid = {span.t + MIDDLE * span.h, a, stage->others, stage->others + it->size,
                                         2.0 * a},
                            difference = {span.end, a, stage->others, stage->others + it->size,
                                          (1.0 - MIDDLE) * span.h};
  int32_t status = begin_trapezoid(it, span.t, a);
  if (status == HOOKE_OK) status = hk_integrator_drive(it, trapezoid.t);
  if (status == HOOKE_OK) status = hk_stage_solve(stage, &trapezoid);
  if (status == HOOKE_OK) status = hk_integrator_drive(it, span.end);
  if (status != HOOKE_OK) return status;
  begin_difference(it);
  return hk_stage_solve(stage, &difference);
}

const struct hk_method hk_tr_bdf2 = {
    .name = "tr-bdf2",
    .summary = "fixed step, order 2, implicit; stable at every step, damps what the step does not resolve",
    .order = 2,
    .judge = "implicit-midpoint",
    .takes = HOOKE_TAKES_BODIES | HOOKE_TAKES_OVERDAMPED,
    .steps = &hk_implicit_steps,
    .solved = stages,
    .states = 1, /* the place and the speed of its equations */
    .stability = {.kind = HOOKE_STABLE_ALWAYS,
                  .damps_implicitly = 1,
                  .note = "stable at every step; accuracy limits it, and in "
                          "large steps whether the equations can be solved"}};
