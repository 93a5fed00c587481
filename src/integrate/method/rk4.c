/* The classical Runge-Kutta method (Kutta 1901), order 4: four rates a step, at t, twice at t + h/2, and at t
 * + h. */
#include "integrate/method/stages.h"
#include "kernel/step_loops.h"

static void move(int stage, int64_t n, double h, const double *rate, const double *start, double *sum,
                 double *x) {
  if (stage == 0)
    hk_first_stage(n, h / 2.0, rate, sum, x);
  else if (stage < 3)
    hk_middle_stage(n, stage == 1 ? h / 2.0 : h, rate, start, sum, x);
  else
    hk_last_stage(n, h / 6.0, rate, start, sum, x);
}

static int32_t create(hooke_integrator *it) {
  static const struct hk_stages stages = {4, {0.0, 0.5, 0.5, 1.0}, move};
  return hk_stages_create(it, &stages);
}

const struct hk_method hk_rk4 = {
    .name = "rk4",
    .summary = "fixed step, order 4, four force evaluations a step",
    .built = 1,
    .order = 4,
    .first_order = 1,
    .second_order = 1,
    .stability = {.kind = HOOKE_STABLE_BY_POLYNOMIAL, .degree = 4, .axis = 8.0, .half_disc = 2.6156},
    .create = create,
    .destroy = hk_stages_destroy,
    .begin = hk_fixed_begin,
    .step = hk_stages_step,
    .store = hk_fixed_store};
