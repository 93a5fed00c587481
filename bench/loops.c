/* Cost of a step in the caller's own time loops, compared with a step of a run: medians over turns, each with
 * one measurement of every variant.
 *
 *   loops [--seconds S] [SCENE ...]
 *
 * S seconds (10) for each scene. */
#include "clock.h"
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WAYS = 3, MOST_TURNS = 1000, LEAST_STEPS = 50 };
static const double TURN = 0.02; /* [s] */

static const char *const usual[] = {"cloth-16", "cloth-128", "cloth-1024"};

struct loop {
  hooke_integrator *integrator;
  hooke_state *state;
  double turn[MOST_TURNS]; /* time of a step [s] */
};

static int32_t run(struct loop *loop, int64_t steps) {
  return hooke_integrator_step(loop->integrator, loop->state, steps);
}

static int32_t step(struct loop *loop, int64_t steps) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < steps && status == HOOKE_OK; k++)
    status = hooke_integrator_step(loop->integrator, loop->state, 1);
  return status;
}

static int32_t advance(struct loop *loop, int64_t steps) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < steps && status == HOOKE_OK; k++)
    status = hooke_integrator_advance(loop->integrator, 1);
  return status;
}

static int32_t (*const way[WAYS])(struct loop *, int64_t) = {run, step, advance};

static int32_t loop_create(const hooke_system *system, struct loop *loop) {
  hooke_options *options = NULL;
  double bound = 0.0;
  int32_t status = hooke_state_create(system, &loop->state);
  if (status == HOOKE_OK)
    status = hooke_step_bound(system, "symplectic-euler", hooke_state_position(loop->state), &bound);
  if (status == HOOKE_OK) status = hooke_options_create("run", &options);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "step", 0.5 * bound);
  if (status == HOOKE_OK) status = hooke_integrator_create(system, options, &loop->integrator);
  hooke_options_destroy(options);
  return status == HOOKE_OK ? run(loop, LEAST_STEPS) : status;
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double median(int count, double *value) {
  qsort(value, (size_t)count, sizeof *value, by_size);
  return 0.5 * (value[(count - 1) / 2] + value[count / 2]);
}

static int32_t take_turn(struct loop *loop, int w, int64_t steps, double *seconds) {
  const double begun = bench_seconds();
  const int32_t status = way[w](loop, steps);
  *seconds = (bench_seconds() - begun) / (double)steps;
  return status;
}

static int32_t race(struct loop loop[WAYS], double seconds, int *turns) {
  double each;
  int32_t status = take_turn(&loop[0], 0, LEAST_STEPS, &each);
  const int64_t steps = (int64_t)fmax(TURN / each, LEAST_STEPS);
  const double end = bench_seconds() + seconds;
  for (*turns = 0; *turns < MOST_TURNS && bench_seconds() < end; ++*turns) {
    for (int w = 0; w < WAYS && status == HOOKE_OK; w++)
      status = take_turn(&loop[w], w, steps, &loop[w].turn[*turns]);
  }
  return status;
}

static void show(const char *name, int turns, struct loop loop[WAYS]) {
  for (int w = WAYS - 1; w > 0; w--) {
    for (int k = 0; k < turns; k++)
      loop[w].turn[k] /= loop[0].turn[k];
  }
  printf("%-20s %12.3f", name, 1e6 * median(turns, loop[0].turn));
  for (int w = 1; w < WAYS; w++)
    printf(" %9.2f", median(turns, loop[w].turn));
  printf(" %7d\n", turns);
}

static int32_t measure(const struct bench_scene *scene, double seconds) {
  hooke_system *system = NULL;
  struct loop *loop = calloc(WAYS, sizeof *loop);
  int turns = 0;
  int32_t status = loop ? bench_scene_create(scene, &system) : HOOKE_NO_MEMORY;
  for (int w = 0; w < WAYS && status == HOOKE_OK; w++)
    status = loop_create(system, &loop[w]);
  if (status == HOOKE_OK) status = race(loop, seconds, &turns);
  if (status == HOOKE_OK)
    show(scene->name, turns, loop);
  else
    fprintf(stderr, "%s: %s: %s\n", scene->name, hooke_status_name(status), hooke_last_error());
  for (int w = 0; w < WAYS && loop; w++) {
    hooke_integrator_destroy(loop[w].integrator);
    hooke_state_destroy(loop[w].state);
  }
  free(loop);
  hooke_system_destroy(system);
  return status;
}

static int is_named(const char *name, int64_t count, const char *const *names) {
  for (int64_t k = 0; k < count; k++) {
    if (strcmp(names[k], name) == 0) return 1;
  }
  return 0;
}

int main(int argc, char **argv) {
  double seconds = 10.0;
  int first = 1, fine = 1;
  if (argc > 2 && strcmp(argv[1], "--seconds") == 0) {
    seconds = strtod(argv[2], NULL);
    first = 3;
  }
  const int given = argc > first;
  printf("%-20s %12s %9s %9s %7s\n", "scene", "run [us]", "step/run", "adv./run", "turns");
  for (int64_t k = 0; bench_scene(k); k++) {
    const char *name = bench_scene(k)->name;
    const int wanted = given ? is_named(name, argc - first, (const char *const *)argv + first)
                             : is_named(name, sizeof usual / sizeof usual[0], usual);
    if (wanted) fine &= measure(bench_scene(k), seconds) == HOOKE_OK;
  }
  return fine ? 0 : 1;
}
