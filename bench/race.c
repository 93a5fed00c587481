#include "race.h"

#include "baseline.h"
#include "clock.h"
#include "draw.h"
#include "entrant.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { LEAST_TURNS = 3, CHECKED_STEPS = 20 };
static const double TURN = 0.02; /* [s] */

struct race {
  hooke_system *system;
  hooke_state *start;
  int is_damped, count;
  struct entrant *entrant[2 * MOST_ROWS];
  int own[MOST_ROWS], plain[MOST_ROWS]; /* entrants compared in a row; -1: none */
};

/* ---- initial state ---- */

/* The shortest rest length, and whether there is damping. */
static int32_t read_springs(struct race *race, double *shortest) {
  const int64_t m = hooke_system_count(race->system, "springs");
  double *material = malloc((size_t)(3 * m) * sizeof *material);
  if (material == NULL) return HOOKE_NO_MEMORY;
  const int32_t status =
      hooke_system_members(race->system, "springs", NULL, material, material + m, material + 2 * m);
  *shortest = INFINITY;
  for (int64_t s = 0; status == HOOKE_OK && s < m; s++) {
    race->is_damped |= material[m + s] != 0.0;
    *shortest = fmin(*shortest, material[2 * m + s]);
  }
  free(material);
  return status;
}

/* Scenes are built at their rest lengths, where motions agree whatever the springs do. So free particles are
 * displaced by up to a hundredth of the shortest rest length. */
static int32_t shake(struct race *race) {
  double shortest;
  const int32_t status = read_springs(race, &shortest);
  if (status != HOOKE_OK) return status;
  double *q = hooke_state_position(race->start);
  const double *w = hooke_system_inverse_mass(race->system);
  uint64_t seed = 3;
  for (int64_t k = 0; k < hooke_state_size(race->start); k++) {
    if (w[k / 3] != 0.0) q[k] += 0.01 * shortest * (2.0 * bench_draw_unit(&seed) - 1.0);
  }
  return HOOKE_OK;
}

/* Half of the certainly stable step; if nothing limits the method, the step of symplectic Euler. 0: no step
 * is stable. */
static int32_t choose_step(const struct race *race, const char *method, double *step) {
  const double *q = hooke_state_position(race->start);
  double bound = 0.0;
  int32_t status = hooke_step_bound(race->system, method, q, &bound);
  if (status == HOOKE_OK && !isfinite(bound)) {
    status = hooke_step_bound(race->system, "symplectic-euler", q, &bound);
  }
  *step = 0.5 * bound;
  return status;
}

/* ---- entrants ---- */

static int32_t add_rows(struct race *race, const struct race_request *request, struct race_row sample,
                        struct race_row *row, int *count) {
  int plain = -1;
  int32_t status = choose_step(race, sample.method, &sample.step);
  if (status != HOOKE_OK || sample.step == 0.0) return status;
  if (baseline_has(sample.method, race->is_damped)) {
    plain = race->count++;
    status =
        entrant_create_plain(race->system, race->start, sample.method, sample.step, &race->entrant[plain]);
  }
  for (int k = 0; status == HOOKE_OK && k < request->thread_count; k++) {
    race->own[*count] = race->count++;
    race->plain[*count] = plain;
    row[*count] = sample;
    row[*count].threads = request->threads[k];
    status = entrant_create(race->system, race->start, sample.method, request->threads[k], sample.step,
                            &race->entrant[race->own[*count]]);
    ++*count;
  }
  return status;
}

static int32_t prepare(struct race *race, const struct bench_scene *scene, const struct race_request *request,
                       struct race_row *row, int *count) {
  int32_t status = bench_scene_create(scene, &race->system);
  if (status == HOOKE_OK) status = hooke_state_create(race->system, &race->start);
  if (status == HOOKE_OK) status = shake(race);
  for (int k = 0; status == HOOKE_OK && k < request->method_count; k++) {
    const struct race_row sample = {.scene = scene,
                                    .method = request->method[k],
                                    .is_damped = race->is_damped,
                                    .particles = hooke_system_particle_count(race->system),
                                    .springs = hooke_system_count(race->system, "springs")};
    status = add_rows(race, request, sample, row, count);
  }
  return status;
}

/* ---- agreement of motions ---- */

static double largest_distance(const struct race *race, const double *a, const double *b) {
  double most = 0.0;
  for (int64_t k = 0; k < hooke_state_size(race->start); k++) {
    most = fmax(most, fabs(a[k] - b[k]));
    if (isnan(a[k]) || isnan(b[k])) return INFINITY;
  }
  return most;
}

/* A stable step adds some units in the last place of a coordinate, to positions and, in units of the
 * displacement of a step, to velocities, which the next steps accumulate. */
static double rounding(const struct race *race, const double *q) {
  double largest = 0.0;
  for (int64_t k = 0; k < hooke_state_size(race->start); k++)
    largest = fmax(largest, fabs(q[k]));
  return 4.0 * CHECKED_STEPS * CHECKED_STEPS * DBL_EPSILON * largest;
}

static int32_t check_motion(struct race *race, struct race_row *row, int count) {
  int32_t status = HOOKE_OK;
  for (int k = 0; k < race->count && status == HOOKE_OK; k++)
    status = entrant_step(race->entrant[k], CHECKED_STEPS);
  for (int k = 0; k < count && status == HOOKE_OK; k++) {
    const double *own = entrant_position(race->entrant[race->own[k]]);
    row[k].allowed = rounding(race, own);
    row[k].distance = race->plain[k] < 0
                          ? (double)NAN
                          : largest_distance(race, own, entrant_position(race->entrant[race->plain[k]]));
  }
  return status;
}

static int32_t stays_finite(const struct race *race) {
  for (int e = 0; e < race->count; e++) {
    const double *q = entrant_position(race->entrant[e]);
    for (int64_t k = 0; k < hooke_state_size(race->start); k++) {
      if (!isfinite(q[k])) return HOOKE_DIVERGED;
    }
  }
  return HOOKE_OK;
}

/* ---- turns ---- */

static int32_t take_turns(struct race *race, double seconds) {
  int32_t status = HOOKE_OK;
  for (int k = 0; k < race->count && status == HOOKE_OK; k++)
    status = entrant_warm_up(race->entrant[k], TURN);
  const double begun = bench_seconds();
  for (int turn = 0; turn < MOST_TURNS && status == HOOKE_OK; turn++) {
    if (turn >= LEAST_TURNS && bench_seconds() - begun > seconds) break;
    for (int k = 0; k < race->count && status == HOOKE_OK; k++)
      status = entrant_turn(race->entrant[k]);
  }
  return status == HOOKE_OK ? stays_finite(race) : status;
}

static struct race_time time_of(const struct entrant *entrant) {
  return (struct race_time){entrant_least(entrant), entrant_median(entrant)};
}

int32_t race_run(const struct bench_scene *scene, const struct race_request *request, struct race_row *row,
                 int *count) {
  struct race race = {0};
  *count = 0;
  int32_t status = prepare(&race, scene, request, row, count);
  if (status == HOOKE_OK) status = check_motion(&race, row, *count);
  if (status == HOOKE_OK) status = take_turns(&race, request->seconds * *count);
  for (int k = 0; k < *count && status == HOOKE_OK; k++) {
    const struct entrant *own = race.entrant[race.own[k]];
    row[k].turns = entrant_turns(own);
    row[k].evaluations = entrant_evaluations(own);
    row[k].own = time_of(own);
    row[k].plain = race.plain[k] < 0 ? (struct race_time){NAN, NAN} : time_of(race.entrant[race.plain[k]]);
  }
  for (int k = 0; k < race.count; k++)
    entrant_destroy(race.entrant[k]);
  hooke_state_destroy(race.start);
  hooke_system_destroy(race.system);
  return status;
}
