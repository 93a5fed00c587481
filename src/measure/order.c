/* The observed order of a method: least squares of log error on log step. */
#include "measure/study.h"

#include "core/print.h"

#include "integrate/method.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_POINTS = 5, FEWEST_POINTS = 3 };
static const double CLEAR_OF_FLOOR = 10.0;      /* times the agreement of the reference */
static const double SMALL = 0.05;               /* errors above this share of the extent are not asymptotic */
static const double BELOW = 0.15, ABOVE = 0.25; /* how far an order may be from the theory without a word */

/* The finest rows that stand clear of the floor, logarithms of step and error; rows of a method go from coarse to fine. */
static int32_t collect(const hooke_study *study, int32_t method, double *x, double *y) {
  const struct hooke_reference *r = &study->reference;
  int32_t count = 0;
  for (int64_t k = study->row_count - 1; k >= 0 && count < MOST_POINTS; k--) {
    const struct hooke_study_row *row = &study->row[k];
    if (row->method != method || !(row->trial.error > 0.0)) continue;
    if (row->trial.error < CLEAR_OF_FLOOR * r->agreement || row->trial.error > SMALL * r->extent) continue;
    x[count] = log(row->value);
    y[count] = log(row->trial.error);
    count++;
  }
  return count;
}

static int32_t reached_floor(const hooke_study *study, int32_t method) {
  for (int64_t k = 0; k < study->row_count; k++) {
    const double error = study->row[k].trial.error;
    if (study->row[k].method == method && error < CLEAR_OF_FLOOR * study->reference.agreement) return 1;
  }
  return 0;
}

static void explain(const hooke_study *study, int32_t method, struct hooke_study_order *order,
                    int32_t points) {
  const int64_t size = (int64_t)sizeof order->note;
  if (points < FEWEST_POINTS) {
    snprintf(order->note, (size_t)size, "%s",
             reached_floor(study, method)
                 ? "too few rows clear of the floor: the error is down to what the reference knows"
                 : "too few rows in the asymptotic range; finer steps would show the order");
    return;
  }
  if (order->order >= order->theory - BELOW && order->order <= order->theory + ABOVE) return;
  if (study->reference.trusted < study->reference.frames.count) {
    hooke_print(order->note, (size_t)size,
                "%.2f instead of %g: the motion is chaotic, errors do not follow the step", order->order,
                order->theory);
  } else if (order->order > order->theory) {
    hooke_print(order->note, (size_t)size,
                "%.2f instead of %g: the steps are not yet small enough for the asymptotic law", order->order,
                order->theory);
  } else {
    hooke_print(
        order->note, (size_t)size,
        "%.2f instead of %g: forces that are not smooth (springs that only pull or pass zero length, a "
        "callback) "
        "or depend on velocity cost order, and so do steps near the limit of stability",
        order->order, order->theory);
  }
}

/* Of Student's t distribution, its quantile 0.975 by degrees of freedom: tan(0.475 pi), 0.95 sqrt(2/0.0975), and t with
 * u/(1 + u^2) + atan(u) = 0.475 pi, u = t/sqrt(3). */
static const double T_QUANTILE[MOST_POINTS - 1] = {NAN, 12.7062047361747, 4.30265272974946, 3.18244630528371};

/* y = offset + slope x; `half` is half the width of the interval that holds the slope at 95 %. */
static void fit_line(int32_t count, const double *x, const double *y, double *slope, double *half) {
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, squares = 0.0;
  for (int32_t k = 0; k < count; k++) {
    mean_x += x[k] / count;
    mean_y += y[k] / count;
  }
  for (int32_t k = 0; k < count; k++) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  *slope = xy / xx;
  for (int32_t k = 0; k < count; k++) {
    const double rest = (y[k] - mean_y) - *slope * (x[k] - mean_x);
    squares += rest * rest;
  }
  *half = T_QUANTILE[count - 2] * sqrt(squares / (count - 2) / xx);
}

void hooke_study_fit_order(hooke_study *study, int32_t method) {
  struct hooke_study_order *order = &study->order[method];
  *order = (struct hooke_study_order){.order = NAN, .low = NAN, .high = NAN, .theory = NAN};
  if (hooke_study_is_adaptive(study, method)) return;
  order->theory = (double)hooke_method_find(study->method[method])->order;
  double x[MOST_POINTS], y[MOST_POINTS];
  const int32_t count = collect(study, method, x, y);
  if (count >= FEWEST_POINTS) {
    double half;
    fit_line(count, x, y, &order->order, &half);
    order->low = order->order - half;
    order->high = order->order + half;
  }
  explain(study, method, order, count);
}
