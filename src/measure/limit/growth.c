#include "integrate/integrator.h"
#include "measure/limit/growth.h"
#include "model/coordinates/coordinates.h"

#include "core/memory.h"
#include "core/random.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

/* Windows of equal length cover a run. Each has the mean logarithm of the amplitude (the root of the energy)
 * over some samples at irregular times, so that no oscillation hides between them. When all are full, pairs
 * of them become one. */
enum { WINDOWS = 96, FIRST_WINDOW = 16, SAMPLES = 4, BLOCKS = 3 };
static const double RANDOM_SHARE = 1e-3;
static const double SCALE_DOWN = 5.0; /* log of the amplitude at which displacements are scaled back */
/* Less than that in the log of the amplitude may be part of a slow oscillation, unless all steps are
 * taken or it is the straight line of a known direction. */
static const double LEAST_CHANGE = 0.3, LEAST_IN_THE_END = 0.01;
/* A straight line: alike from block to block to this share, and so many times above the scatter. */
static const double ALIKE = 0.02, ABOVE_SCATTER = 30.0;
/* Log of the amplitude where less is left than any mode had at first, and rounding is not yet seen. The same
 * for speed, where displacements have little left: particles that have turned about others, which costs no
 * energy, are not quite where linear motion would have them, and what is left may rise slowly. */
static const double NOTHING_LEFT = -12.0, LITTLE_LEFT = -5.0;

struct course {
  double mean[WINDOWS]; /* of full windows */
  int64_t count, length;
  int64_t steps;   /* in the current window, */
  double sum;      /* the sum over its samples, */
  int64_t samples; /* and their number */
  double first;    /* log of the amplitude at the start */
  double offset;   /* decrease of the log of the amplitude by scaling */
  double last;
};

/* ---- evaluation of a course ---- */

static void fill(struct course *course, int64_t steps, double value) {
  course->steps += steps;
  course->sum += value;
  course->samples++;
  course->last = value;
  if (course->steps < course->length) return;
  course->mean[course->count++] = course->sum / (double)course->samples;
  course->steps = course->samples = 0;
  course->sum = 0.0;
  if (course->count < WINDOWS) return;
  for (int64_t w = 0; w < WINDOWS / 2; w++)
    course->mean[w] = 0.5 * (course->mean[2 * w] + course->mean[2 * w + 1]);
  course->count = WINDOWS / 2;
  course->length *= 2;
}

/* The change of the mean from block to block, three of them over the last three quarters, and the scatter of
 * the windows about a straight line. */
struct trend {
  double change[BLOCKS - 1], scatter;
  int steady;   /* the changes are alike, and well above the scatter */
  int straight; /* very much so */
};

static struct trend find_trend(const struct course *course) {
  struct trend trend = {{0.0, 0.0}, INFINITY, 0, 0};
  const int64_t size = course->count / 4, begin = course->count - BLOCKS * size;
  if (size < 4) return trend;
  double mean[BLOCKS] = {0.0, 0.0, 0.0}, square = 0.0;
  for (int64_t w = 0; w < BLOCKS * size; w++)
    mean[w / size] += course->mean[begin + w] / (double)size;
  trend.change[0] = mean[1] - mean[0];
  trend.change[1] = mean[2] - mean[1];
  const double slope = (mean[2] - mean[0]) / (double)(2 * size);
  const double middle = 0.5 * (double)(BLOCKS * size - 1), level = (mean[0] + mean[1] + mean[2]) / 3.0;
  for (int64_t w = 0; w < BLOCKS * size; w++) {
    const double off = course->mean[begin + w] - level - slope * ((double)w - middle);
    square += off * off;
  }
  trend.scatter = sqrt(square / (double)(BLOCKS * size));
  const double total = fabs(trend.change[0] + trend.change[1]);
  const double apart = fabs(trend.change[0] - trend.change[1]);
  trend.steady = apart < 0.2 * total && total > 4.0 * trend.scatter && total > 1e-5;
  trend.straight = trend.steady && apart < ALIKE * total && total > ABOVE_SCATTER * trend.scatter;
  return trend;
}

/* ---- one run ---- */

static double kinetic(const hooke_system *system, const double *v) {
  double sum = 0.0;
  for (int64_t k = 0; k < 3 * system->particle_count; k++)
    sum += system->constrained[k / 3] ? 0.0 : system->inertia[k / 3] * (v[k] * v[k]);
  return sum;
}

/* Random motion of free particles that springs and drag act on. Particles without forces would drift away, as
 * would a free scene, and turn the springs. */
static void start_randomly(struct hk_growth *growth, double *x, double *v) {
  const hooke_system *system = growth->twin->system;
  for (int64_t k = 0; k < 3 * system->particle_count; k++)
    x[k] = hk_random_uniform(&growth->random) * sqrt(system->inverse_mass[k / 3]);
  hk_twin_push(growth->twin, x, v);
}

/* Displaced by half of what the velocities move in a step, which is at most 1 m, as is motion that turns
 * round in every step of symplectic Euler. In one of Verlet it has no velocity then; one would be a jump
 * where damping is strong. */
static void start(struct hk_growth *growth, double step, int random_only) {
  const hooke_system *system = growth->twin->system;
  double *q = hooke_state_position(growth->state), *v = hooke_state_velocity(growth->state), most = 0.0;
  const int64_t size = 3 * system->particle_count;
  start_randomly(growth, q, v);
  hooke_state_set_time(growth->state, 0.0);
  memcpy(q, growth->twin->origin, (size_t)size * sizeof(double));
  if (growth->has_direction && !random_only) {
    const double have = kinetic(system, v), want = kinetic(system, growth->direction);
    const double fraction = have > 0.0 ? RANDOM_SHARE * sqrt(want / have) : 0.0;
    for (int64_t k = 0; k < size; k++)
      v[k] = system->constrained[k / 3] ? 0.0 : growth->direction[k] + fraction * v[k];
  }
  for (int64_t k = 0; k < size; k++)
    most = fmax(most, fabs(v[k]));
  for (int64_t k = 0; k < size && most > 0.0; k++) {
    v[k] /= most * step;
    q[k] += 0.5 * v[k] * step;
    if (growth->turns_at_rest) v[k] = 0.0;
  }
}

static double log_amplitude(const struct hk_growth *growth) {
  return 0.5 * log(hk_twin_energy(growth->twin, hooke_state_position(growth->state),
                                  hooke_state_velocity(growth->state)));
}

/* Rescales displacements into the linear range of springs. */
static void scale(const struct hk_growth *growth, struct course *course) {
  const double off = course->last - course->offset - course->first, *origin = growth->twin->origin;
  if (!isfinite(off) || off < SCALE_DOWN) return;
  double *q = hooke_state_position(growth->state), *v = hooke_state_velocity(growth->state);
  const double factor = exp(-off);
  for (int64_t k = 0; k < hooke_state_size(growth->state); k++) {
    q[k] = origin[k] + factor * (q[k] - origin[k]);
    v[k] *= factor;
  }
  hk_movers_renew(growth->twin->system, q, v); /* turned back, the velocities of a body are hardly its own */
  course->offset += off;
}

/* The amplitude that no stable motion exceeds: just below the limit the energy of an undamped mode swings by
 * 1/(1 - (h omega/2)^2), and limits closer than a quarter of the accuracy need not be distinguished. */
static double certain_rise(const struct hk_growth *growth) {
  return log(30.0 / sqrt(0.5 * growth->accuracy));
}

/* Four swings of the energy of an undamped mode at such a distance below the limit, pi/sqrt(8 e) steps each.
 * */
static int64_t least_steps(const struct hk_growth *growth) {
  return (int64_t)(10.0 / sqrt(growth->accuracy));
}

static int has_stopped(const struct hk_growth *growth, const struct course *course) {
  const hooke_system *system = growth->twin->system;
  const double speed = kinetic(system, hooke_state_velocity(growth->state));
  return !system->overdamped && 0.5 * log(speed) + course->offset - course->first < NOTHING_LEFT;
}

static int judge(const struct hk_growth *growth, const struct course *course, int64_t taken, int thorough,
                 enum hk_verdict *verdict) {
  const double rise = course->last - course->first;
  const int grows = rise > certain_rise(growth);
  if (grows || rise < NOTHING_LEFT || (rise < LITTLE_LEFT && has_stopped(growth, course))) {
    *verdict = grows ? HOOKE_GROWS : HOOKE_HOLDS;
    return 1;
  }
  if (course->steps > 0 || course->count < 16 || taken < least_steps(growth)) return 0;
  const struct trend trend = find_trend(course);
  if (growth->is_convex && fmin(trend.change[0], trend.change[1]) > LEAST_IN_THE_END) {
    *verdict = HOOKE_GROWS;
    return 1;
  }
  const int direct = trend.straight && growth->is_named && growth->has_direction && !thorough;
  const double least = direct ? LEAST_IN_THE_END : LEAST_CHANGE;
  if (!trend.steady || fabs(trend.change[0] + trend.change[1]) < least) return 0;
  if (trend.change[0] > 0.0 && rise < LITTLE_LEFT) return 0;
  *verdict = trend.change[0] > 0.0 ? HOOKE_GROWS : HOOKE_HOLDS;
  return *verdict == HOOKE_GROWS || (!thorough && growth->has_direction);
}

/* Verdict on a run that has taken all its steps. */
static enum hk_verdict last_word(const struct course *course) {
  const struct trend trend = find_trend(course);
  if (trend.change[0] > 0.0 && course->last - course->first < LITTLE_LEFT) return HOOKE_STEADY;
  if (trend.steady && fabs(trend.change[0] + trend.change[1]) > LEAST_IN_THE_END)
    return trend.change[0] > 0.0 ? HOOKE_GROWS : HOOKE_HOLDS;
  if (trend.change[0] > 0.0 && trend.change[1] > 1.0) return HOOKE_GROWS;
  return HOOKE_STEADY;
}

/* `count` steps. The integrator looks for numbers that are not finite, and for no rise of energy: so far none
 * was looked for, in the 900 steps at most since it began, and from here on none is too much. */
static int32_t take(struct hk_growth *growth, hooke_integrator *integrator, int64_t count,
                    enum hk_verdict *verdict, int *ended) {
  const int32_t status = hooke_integrator_step(integrator, growth->state, count);
  integrator->scale0 = INFINITY;
  growth->steps_run += count;
  *ended = status != HOOKE_OK;
  if (status == HOOKE_STOPPED && growth->budget->stopped)
    return hk_fail(status, NULL, "the progress callback asked to stop while a limit was measured");
  if (status != HOOKE_DIVERGED && status != HOOKE_SOLVER_FAILED && status != HOOKE_STOPPED) return status;
  *verdict = status == HOOKE_DIVERGED  ? HOOKE_GROWS
             : status == HOOKE_STOPPED ? HOOKE_OUT_OF_TIME
                                       : HOOKE_UNSOLVED;
  return HOOKE_OK;
}

static int32_t go(struct hk_growth *growth, hooke_integrator *integrator, int thorough, int64_t most_steps,
                  enum hk_verdict *verdict) {
  struct course course = {.length = FIRST_WINDOW};
  course.first = course.last = log_amplitude(growth);
  *verdict = HOOKE_HOLDS;
  if (!isfinite(course.first)) return HOOKE_OK; /* nothing can move */
  int64_t taken = 0, longest = 1;
  while (taken < most_steps) {
    const int64_t samples = thorough ? SAMPLES : FIRST_WINDOW;
    const int64_t twice_the_mean = course.length > samples ? 2 * course.length / samples : 0;
    int64_t count = 1 + (int64_t)(0.5 * (hk_random_uniform(&growth->random) + 1.0) * (double)twice_the_mean);
    count = count < longest ? count : longest;
    count = count < course.length - course.steps ? count : course.length - course.steps;
    int ended;
    const int32_t status = take(growth, integrator, count, verdict, &ended);
    if (ended) return status;
    const double before = course.last, now = log_amplitude(growth) + course.offset;
    taken += count;
    if (!isfinite(now)) { /* overflow, or zero amplitude */
      *verdict = now < 0.0 ? HOOKE_HOLDS : HOOKE_GROWS;
      return HOOKE_OK;
    }
    longest = fabs(now - before) > 2.0 ? (longest + 1) / 2 : longest < 900 ? longest + 1 : longest;
    fill(&course, count, now);
    scale(growth, &course);
    if (judge(growth, &course, taken, thorough, verdict)) return HOOKE_OK;
  }
  *verdict = last_word(&course);
  return HOOKE_OK;
}

static void take_direction(struct hk_growth *growth) {
  const double *q = hooke_state_position(growth->state), *v = hooke_state_velocity(growth->state),
               *origin = growth->twin->origin;
  double sum = 0.0;
  for (int64_t k = 0; k < hooke_state_size(growth->state); k++)
    sum += growth->turns_at_rest ? fabs(q[k] - origin[k]) : fabs(v[k]);
  if (!isfinite(sum) || !(sum > 0.0)) return;
  for (int64_t k = 0; k < hooke_state_size(growth->state); k++)
    growth->direction[k] = growth->turns_at_rest ? q[k] - origin[k] : v[k];
  growth->has_direction = 1;
}

int32_t hk_growth_see(struct hk_growth *growth, double step, int32_t thorough, int64_t most_steps,
                      enum hk_verdict *verdict) {
  hooke_integrator *integrator = NULL;
  int32_t status = hooke_options_set_number(growth->run, "step", step);
  if (status == HOOKE_OK) status = hooke_integrator_create(growth->twin->system, growth->run, &integrator);
  if (status != HOOKE_OK) return status;
  integrator->exactly = 1;
  hooke_integrator_on_progress(integrator, 0.0, hk_budget_watch, growth->budget);
  start(growth, step, thorough);
  status = go(growth, integrator, thorough, most_steps, verdict);
  hooke_integrator_destroy(integrator);
  if (status == HOOKE_OK && *verdict == HOOKE_GROWS && (thorough || !growth->has_direction))
    take_direction(growth);
  return status;
}

/* ---- creating ---- */

int32_t hk_growth_create(struct hk_twin *twin, const hooke_options *run, const char *method,
                         const double *mode, double accuracy, struct hk_budget *budget,
                         struct hk_growth *growth) {
  const int64_t size = 3 * twin->system->particle_count;
  *growth = (struct hk_growth){.twin = twin, .accuracy = accuracy, .budget = budget, .random = 1};
  int32_t status =
      run ? hooke_options_copy(run, &growth->run) : hk_options_create(&hk_run_options, &growth->run);
  if (status == HOOKE_OK) status = hooke_options_set_text(growth->run, "method", method);
  if (status == HOOKE_OK) status = hooke_options_unset(growth->run, "duration");
  if (status == HOOKE_OK) status = hooke_options_unset(growth->run, "every");
  /* the twin is linear: one iteration solves its step */
  if (status == HOOKE_OK) status = hooke_options_set_text(growth->run, "newton", "one-iteration");
  if (status == HOOKE_OK) status = hooke_state_create(twin->system, &growth->state);
  if (status == HOOKE_OK) {
    growth->direction = hk_new(size, sizeof(double));
    if (growth->direction == NULL) status = HOOKE_NO_MEMORY;
  }
  if (status == HOOKE_OK && mode) {
    memcpy(growth->direction, mode, (size_t)size * sizeof(double));
    const double sum = kinetic(twin->system, mode);
    growth->has_direction = isfinite(sum) && sum > 0.0;
  }
  if (status != HOOKE_OK) hk_growth_release(growth);
  return status;
}

void hk_growth_release(struct hk_growth *growth) {
  hooke_options_destroy(growth->run);
  hooke_state_destroy(growth->state);
  hk_free(growth->direction);
  memset(growth, 0, sizeof *growth);
}
