/* Observed order of a method: least-squares fit of log error against log step. */
#include "measure/study/study.h"

#include "core/print.h"
#include "measure/recommend/soundness.h"
#include "model/callbacks.h"
#include "model/force/curve.h"
#include "model/force/drive.h"
#include "model/force/force.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_POINTS = 5, FEWEST_POINTS = 3 };
static const double SMALL = 0.05; /* larger errors, as a fraction of the extent, are not asymptotic */
static const double BELOW = 0.15, ABOVE = 0.25; /* deviation of an order from the theory without a remark */

/* The finest rows that are clear of the floor, as logarithms of step and error, or error of one step; rows of
 * a method go from coarse to fine. */
static int32_t collect(const struct hk_study *study, int32_t method, int32_t of_step, double *x, double *y) {
  const struct hk_reference *r = &study->reference;
  int32_t count = 0;
  for (int64_t k = study->row_count - 1; k >= 0 && count < (of_step ? FEWEST_POINTS : MOST_POINTS); k--) {
    const struct hk_study_row *row = &study->row[k];
    const double error = of_step ? row->error_step : row->trial.error;
    if (row->method != method || !(error > 0.0) || error > SMALL * r->extent) continue;
    if (!of_step && hk_study_is_near_floor(study, row)) continue;
    x[count] = log(row->value);
    y[count] = log(error);
    count++;
  }
  return count;
}

static int32_t reached_floor(const struct hk_study *study, int32_t method) {
  for (int64_t k = 0; k < study->row_count; k++) {
    if (study->row[k].method == method && hk_study_is_near_floor(study, &study->row[k])) return 1;
  }
  return 0;
}

/* ---- features of the scene that reduce orders ---- */

/* 1 if the coarsest row of the fit takes half the safe step or more, and so is near the limit. */
static int near_limit(const struct hk_study *study, int32_t method, double coarsest) {
  return coarsest >= 0.5 * study->safe_step[method] && study->safe_step[method] < study->unit;
}

static void list_causes(const struct hk_study *study, int32_t method, double coarsest, char *list,
                        size_t size) {
  const hooke_system *system = study->m->system;
  int pulls = 0, curved = 0, tabled = 0;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    pulls |= group->pull_only && group->count > group->dropped;
    curved |= group->curve && group->curve->samples > 0;
  }
  for (int64_t d = 0; d < system->drive_count; d++)
    tabled |= system->drive[d].course.samples > 0;
  const struct {
    int applies;
    const char *cause;
  } rows[] = {
      {pulls, "springs that only pull have a kink"},
      {hk_system_groups_of(system, &hk_force_altitude) > 0, "altitude springs jump between altitudes"},
      {hk_forces_do_work(system), "a force that changes in time may not be smooth enough"},
      {system->force != NULL, "the force callback may not be smooth enough"},
      {curved, "curves by tables bend at their samples"},
      {tabled, "a drive by a table bends at its samples"},
      {hk_system_calls_back(system) & HOOKE_CALLS_DRIVE, "the drive callback may not be smooth enough"},
      {hk_force_is_present(system, &hk_force_obstacles), "contacts begin and end within steps"},
      {near_limit(study, method, coarsest), "steps are near the limit of stability"},
      {1, "steps do not resolve the motion yet"},
  };
  list[0] = '\0';
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++)
    if (rows[k].applies) hk_append(list, size, "%s%s", list[0] ? ", or " : "", rows[k].cause);
}

static void explain(const struct hk_study *study, int32_t method, struct hk_study_order *order,
                    int32_t points, double coarsest) {
  char causes[sizeof order->note - 32];
  if (points < FEWEST_POINTS) {
    snprintf(order->note, sizeof order->note, "%s",
             study->reference.trusted < 2 ? "no error is known: the reference is not trusted beyond the start"
             : isnan(hk_study_ladder(study, method, 0))
                 ? "no rows: even its largest step would mean over 1e8 steps"
             : reached_floor(study, method)
                 ? "too few rows clear of the floor: the error is down to what the reference knows"
                 : "too few rows in the asymptotic range; finer steps would show the order");
    return;
  }
  if (order->order >= order->theory - BELOW && order->order <= order->theory + ABOVE) return;
  if (order->order > order->theory)
    snprintf(causes, sizeof causes, "steps do not resolve the motion yet");
  else
    list_causes(study, method, coarsest, causes, sizeof causes);
  hk_print(order->note, sizeof order->note, "%.2f instead of %g: %s", order->order, order->theory, causes);
}

/* The 0.975 quantile of Student's t distribution by degrees of freedom: tan(0.475 pi), 0.95 sqrt(2/0.0975),
 * and t with u/(1 + u^2) + atan(u) = 0.475 pi, u = t/sqrt(3). */
static const double T_QUANTILE[MOST_POINTS - 1] = {NAN, 12.7062047361747, 4.30265272974946, 3.18244630528371};

void hk_study_fit_order(struct hk_study *study, int32_t method) {
  struct hk_study_order *order = &study->order[method];
  *order = (struct hk_study_order){NAN, NAN, NAN, NAN, NAN, ""};
  if (hk_study_is_adaptive(study, method)) return;
  order->theory = (double)hk_method_find(study->method[method])->order;
  double x[MOST_POINTS], y[MOST_POINTS];
  double error;
  const int32_t steps = collect(study, method, 1, x, y);
  if (steps >= FEWEST_POINTS) order->order_step = hk_fit_slope(steps, x, y, &error);
  const int32_t count = collect(study, method, 0, x, y);
  if (count >= FEWEST_POINTS) {
    order->order = hk_fit_slope(count, x, y, &error);
    const double half = T_QUANTILE[count - 2] * error;
    order->low = order->order - half;
    order->high = order->order + half;
  }
  explain(study, method, order, count, count > 0 ? exp(x[count - 1]) : NAN);
}
