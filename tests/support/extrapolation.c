#include "extrapolation.h"

#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 14, FEWEST = 3, FIRST = 7 };

struct work {
  long double *rate, *before, *now, *slope, *scale; /* size each */
  long double *row[ROWS];                           /* of the Aitken-Neville scheme, by its last members */
  long double *result;                              /* its corner */
};

static long double *new_numbers(int64_t count) {
  return new_block(count, (int64_t)sizeof(long double));
}

static void open_work(struct work *work, int64_t size) {
  long double **each[] = {&work->rate, &work->before, &work->now, &work->slope, &work->scale, &work->result};
  for (size_t k = 0; k < sizeof each / sizeof each[0]; k++)
    *each[k] = new_numbers(size);
  for (int k = 0; k < ROWS; k++)
    work->row[k] = new_numbers(size);
}

static void close_work(struct work *work) {
  long double *each[] = {work->rate, work->before, work->now, work->slope, work->scale, work->result};
  for (size_t k = 0; k < sizeof each / sizeof each[0]; k++)
    free(each[k]);
  for (int k = 0; k < ROWS; k++)
    free(work->row[k]);
}

static int substeps(int row) {
  return 2 * (row + 1);
}

/* Evaluations for the rows up to this one. */
static long double cost(int row) {
  return 1.0L + (long double)((row + 1) * (row + 2));
}

static void evaluate(struct extrapolation *problem, long double t, long double *y, long double *f) {
  problem->rate(t, y, f, problem->ctx);
  problem->evaluations++;
}

/* The midpoint rule from y over a step of length h, smoothed at its end, into `result`. */
static void midpoint(struct extrapolation *problem, struct work *work, long double t, long double h,
                     int count, const long double *y) {
  const int64_t size = problem->size;
  const long double s = h / (long double)count;
  for (int64_t i = 0; i < size; i++) {
    work->before[i] = y[i];
    work->now[i] = y[i] + s * work->rate[i];
  }
  for (int k = 1; k < count; k++) {
    evaluate(problem, t + (long double)k * s, work->now, work->slope);
    for (int64_t i = 0; i < size; i++) {
      const long double next = work->before[i] + 2.0L * s * work->slope[i];
      work->before[i] = work->now[i];
      work->now[i] = next;
    }
  }
  evaluate(problem, t + h, work->now, work->slope);
  for (int64_t i = 0; i < size; i++)
    work->result[i] = 0.5L * (work->before[i] + work->now[i] + s * work->slope[i]);
}

/* Adds a row to the scheme, whose error expands in even powers of the substep; returns the error in units of
 * the tolerance. */
static long double extend(const struct extrapolation *problem, struct work *work, int row) {
  long double worst = 0.0L, ratio[ROWS];
  for (int j = 1; j <= row; j++) {
    const long double quotient = (long double)substeps(row) / (long double)substeps(row - j);
    ratio[j] = 1.0L / (quotient * quotient - 1.0L);
  }
  for (int64_t i = 0; i < problem->size; i++) {
    long double value = work->result[i], change = 0.0L;
    for (int j = 1; j <= row; j++) {
      const long double old = work->row[j - 1][i];
      work->row[j - 1][i] = value;
      change = (value - old) * ratio[j];
      value += change;
    }
    work->row[row][i] = value;
    const long double error = fabsl(change) / work->scale[i];
    if (!(error <= worst)) worst = isnan(error) ? INFINITY : error;
    work->result[i] = value;
  }
  return worst / problem->tolerance;
}

struct plan {
  long double step;
  int row; /* in which it should converge */
};

static long double fitting(long double h, long double error, int row) {
  const long double factor = powl(0.5L / fmaxl(error, 1e-12L), 1.0L / (long double)(2 * row + 1));
  return h * fminl(0.9L * factor, 8.0L);
}

/* The row with the most time per cost. */
static struct plan plan_next(long double h, const long double *error, int last, int converged) {
  struct plan best = {0.0L, FEWEST};
  for (int row = FEWEST; row <= last; row++) {
    const long double step = fitting(h, error[row], row);
    if (step / cost(row) > best.step / cost(best.row)) best = (struct plan){step, row};
  }
  if (converged && best.row == last && last + 1 < ROWS - 1) {
    best.row++;
    best.step *= cost(last + 1) / cost(last);
  }
  return best;
}

/* Tries a step of length h; true if it converged. */
static int try_step(struct extrapolation *problem, struct work *work, long double t, long double h,
                    const long double *y, struct plan *plan) {
  long double error[ROWS];
  int row = 0, converged = 0, last = plan->row + 1 < ROWS ? plan->row + 1 : ROWS - 1;
  for (;; row++) {
    midpoint(problem, work, t, h, substeps(row), y);
    error[row] = extend(problem, work, row);
    converged = row >= FEWEST && error[row] <= 1.0L;
    const int hopeless = !(error[row] < 1e30L) || (row > FEWEST && error[row] > 1e3L * error[row - 1]);
    if (converged || row == last || (row >= FEWEST && hopeless)) break;
  }
  *plan = plan_next(h, error, row, converged);
  return converged;
}

int32_t extrapolate(struct extrapolation *problem, long double t, long double end, long double *step,
                    long double *y) {
  struct work work;
  struct plan plan = {*step, FIRST};
  int failures = 0;
  int32_t result = 0;
  open_work(&work, problem->size);
  while (t < end) {
    const int last = t + plan.step * 1.0000001L >= end;
    const long double h = last ? end - t : plan.step, asked = plan.step;
    if (problem->evaluations > problem->most_evaluations || t + h == t) {
      result = -1;
      break;
    }
    evaluate(problem, t, y, work.rate);
    problem->scale(y, work.rate, work.scale, problem->ctx);
    if (try_step(problem, &work, t, h, y, &plan)) {
      memcpy(y, work.result, (size_t)problem->size * sizeof *y);
      t = last ? end : t + h;
      if (last) plan.step = fmaxl(plan.step, asked);
      failures = 0;
      problem->steps++;
    } else { /* where f or its derivative jumps no order helps, and steps shrink towards the jump */
      plan.step = fminl(plan.step, (++failures > 1 ? 0.1L : 0.5L) * h);
      if (!(plan.step > 0.0L)) plan.step = 0.1L * h;
      problem->rejected++;
    }
  }
  evaluate(problem, t, y, work.rate);
  *step = plan.step;
  close_work(&work);
  return result;
}
