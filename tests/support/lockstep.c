#include "lockstep.h"

#include "check.h"
#include "run.h"

#include <stdlib.h>
#include <string.h>

/* An observer that takes each step itself and compares. */
struct companion {
  const struct random_scene *scene;
  const hooke_integrator *integrator;
  const char *method;
  double start, h;
  double *q, *v;
  int64_t steps, splits;
};

/* 1 if the integrator has just taken its step in parts, whose equations are not those of the step. */
static int was_split(struct companion *companion) {
  const int64_t before = companion->splits;
  companion->splits = hooke_integrator_count(companion->integrator, "nonlinear_failures");
  return companion->splits > before;
}

static int32_t follow(int64_t step, const hooke_state *state, void *ctx) {
  struct companion *companion = ctx;
  hooke_state *seen = (hooke_state *)(uintptr_t)state; /* read only */
  const double *q = hooke_state_position(seen), *v = hooke_state_velocity(seen);
  const struct random_scene *scene = companion->scene;
  const int64_t n = scene->canonical.particle_count;
  companion->steps++;
  assert_int_equal(step, companion->steps);
  const double before = companion->start + (double)(step - 1) * companion->h;
  const double end = companion->start + (double)step * companion->h;
  const int32_t result = canonical_step(&scene->canonical, companion->method, before, end, companion->h,
                                        companion->q, companion->v);
  if (result == CANONICAL_UNKNOWN) {
    check_failed("%s has no canonical step: add one to tests/support/canonical.c", companion->method);
  }
  if (result == CANONICAL_SOLVED) {
    const double defect = canonical_defect(&scene->canonical, companion->method, before, end, companion->h,
                                           companion->q, companion->v, q, v);
    if (!was_split(companion) && !(defect <= 1.0)) {
      check_failed("%s, step %lld: the equations are off by %.3g times what is allowed", companion->method,
                   (long long)step, defect);
    }
    memcpy(companion->q, q, (size_t)(3 * n) * sizeof(double));
    memcpy(companion->v, v, (size_t)(3 * n) * sizeof(double));
  }
  const double time = hooke_state_time(state);
  check_same_bits(1, &time, &end);
  check_same_bits(3 * n, q, companion->q);
  check_same_bits(3 * n, v, companion->v);
  return 0;
}

static hooke_state *state_at(const struct random_scene *scene, double start) {
  hooke_state *state = start_state(scene->system);
  hooke_state_set_time(state, start);
  return state;
}

/* In springs that only pull and are damped, damping sets in with a jump where they begin to pull: there the
 * equations of a step may have no solution. */
static int may_fail(const struct random_scene *scene, const char *method) {
  const struct canonical *canonical = &scene->canonical;
  int jumps = 0;
  for (int64_t k = 0; k < canonical->spring_count; k++)
    jumps |= canonical->pull_only[k] && canonical->gamma[k] != 0.0;
  return jumps && is_implicit(method);
}

/* Steps that succeed, or end like the first of these runs. */
static void advance(hooke_integrator *integrator, hooke_state *state, int64_t steps, int32_t expected) {
  check_status(hooke_integrator_step(integrator, state, steps), expected);
  if (expected == HOOKE_SOLVER_FAILED) check_message("no solution");
}

/* The same in calls of one step each; and, if nothing depends on time, by a new integrator for each step: a
 * step is defined by t, q and v alone. */
static void check_one_by_one(const struct random_scene *scene, struct run run, int32_t status,
                             const struct companion *expected) {
  const int64_t n = scene->canonical.particle_count;
  int anew = scene->canonical.force == NULL && scene->driven_count == 0 && scene->canonical.load_count == 0;
  for (int64_t k = 0; k < scene->canonical.spring_count; k++)
    anew &= !scene->canonical.follows[k];
  for (int renew = 0; renew <= anew; renew++) {
    owned_state *state = state_at(scene, expected->start);
    hooke_integrator *integrator = start_run(scene->system, run);
    for (int64_t k = 0; k < expected->steps + (status != HOOKE_OK); k++) {
      advance(integrator, state, 1, k < expected->steps ? HOOKE_OK : status);
      if (!renew) continue;
      hooke_integrator_destroy(integrator);
      integrator = start_run(scene->system, run);
    }
    check_same_bits(3 * n, hooke_state_position(state), expected->q);
    check_same_bits(3 * n, hooke_state_velocity(state), expected->v);
    hooke_integrator_destroy(integrator);
  }
}

void check_lockstep(const struct random_scene *scene, const char *method, int32_t threads, double start,
                    double step, int64_t steps) {
  const int64_t n = scene->canonical.particle_count;
  const size_t size = (size_t)(3 * n) * sizeof(double);
  struct companion companion = {.scene = scene,
                                .method = method,
                                .start = start,
                                .h = step,
                                .q = new_doubles(3 * n),
                                .v = new_doubles(3 * n)};
  const struct run run = {.method = method, .step = step, .threads = threads};
  hooke_state *watched = state_at(scene, start), *alone = state_at(scene, start);
  memcpy(companion.q, hooke_state_position(watched), size);
  memcpy(companion.v, hooke_state_velocity(watched), size);

  hooke_integrator *integrator = start_run(scene->system, run);
  companion.integrator = integrator;
  check_ok(hooke_integrator_on_step(integrator, 1, follow, &companion));
  const int32_t found = hooke_integrator_step(integrator, watched, steps);
  const int32_t status = found == HOOKE_SOLVER_FAILED && may_fail(scene, method) ? found : HOOKE_OK;
  check_status(found, status);
  hooke_integrator_destroy(integrator);
  assert_in_range(companion.steps, status == HOOKE_OK ? steps : 0, steps);

  integrator = start_run(scene->system, run);
  advance(integrator, alone, steps, status);
  hooke_integrator_destroy(integrator);
  check_one_by_one(scene, run, status, &companion);

  check_same_bits(3 * n, hooke_state_position(watched), companion.q);
  check_same_bits(3 * n, hooke_state_velocity(watched), companion.v);
  check_same_bits(3 * n, hooke_state_position(alone), companion.q);
  check_same_bits(3 * n, hooke_state_velocity(alone), companion.v);
  hooke_state_destroy(watched);
  hooke_state_destroy(alone);
  free(companion.q);
  free(companion.v);
}
