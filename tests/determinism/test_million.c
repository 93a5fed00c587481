/* A million springs of every kind, with a callback and driven particles, give the same bits every time; a
 * tenth of them for methods that solve. */
#include "check.h"
#include "hash.h"
#include "lockstep.h"
#include "random_scene.h"
#include "run.h"
#include "sanitized.h"

#include <pthread.h>
#include <stdlib.h>

enum { SPRINGS = 1000000, PARTICLES = 300000, SHARE = 20, SOLVED_SHARE = 10 };
/* Implicit steps cost a hundred others. */
enum { STEPS = 5, SOLVED_STEPS = 2 };

struct task {
  const hooke_system *system;
  const char *method;
  int32_t threads;
  int64_t steps, linear_iterations;
  uint64_t hash;
  int32_t status;
};

/* No assertions in threads: they belong to the main thread. */
static void *run_task(void *argument) {
  struct task *task = argument;
  owned_options *options = NULL;
  owned_integrator *integrator = NULL;
  owned_state *state = NULL;
  int32_t status = hooke_options_create("run", &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", task->method);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "step", 1e-4);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "threads", task->threads);
  if (status == HOOKE_OK) status = hooke_integrator_create(task->system, options, &integrator);
  if (status == HOOKE_OK) status = hooke_state_create(task->system, &state);
  if (status == HOOKE_OK) status = hooke_integrator_step(integrator, state, task->steps);
  if (status == HOOKE_OK) {
    const int64_t size = hooke_state_size(state);
    task->hash = hash_doubles(size, hooke_state_position(state), HASH_START);
    task->hash = hash_doubles(size, hooke_state_velocity(state), task->hash);
    task->linear_iterations = hooke_integrator_count(integrator, "linear_iterations");
  }
  task->status = status;
  return NULL;
}

static struct task new_task(const struct random_scene *scene, const char *method, int32_t threads,
                            int64_t steps) {
  return (struct task){
      .system = scene->system, .method = method, .threads = threads, .steps = steps, .status = -1};
}

static struct task run_here(const struct random_scene *scene, const char *method, int32_t threads,
                            int64_t steps) {
  struct task task = new_task(scene, method, threads, steps);
  run_task(&task);
  check_status(task.status, HOOKE_OK);
  return task;
}

static void create_scene(int64_t share, struct random_scene *scene) {
  const int64_t springs = SPRINGS / share;
  random_scene_with(scene, .seed = 20240607, .particles = PARTICLES / share, .springs = springs,
                    .features = SCENE_EVERYTHING);
  /* except the few without strength */
  assert_int_equal(hooke_system_count(scene->system, "springs"), scene->canonical.spring_count);
  check_between((double)scene->canonical.spring_count, 0.95 * (double)springs, (double)springs);
}

static void check_method(const struct random_scene *scene, const char *method, int64_t steps) {
  struct task task[2];
  const uint64_t first = run_here(scene, method, 1, steps).hash;
  if (run_here(scene, method, 2, steps).hash != first)
    check_failed("%s: two threads differ from one", method);
  pthread_t thread[2];
  for (int k = 0; k < 2; k++) {
    task[k] = new_task(scene, method, 1, steps);
    assert_int_equal(pthread_create(&thread[k], NULL, run_task, &task[k]), 0);
  }
  for (int k = 0; k < 2; k++)
    assert_int_equal(pthread_join(thread[k], NULL), 0);
  for (int k = 0; k < 2; k++) {
    check_status(task[k].status, HOOKE_OK);
    if (task[k].hash != first) check_failed("%s: runs at the same time on one system differ", method);
  }
}

TEST(test_same_bits) {
  const int64_t share = short_of_time() ? SHARE : 1;
  struct random_scene all, some;
  create_scene(share, &all);
  create_scene(SOLVED_SHARE * share, &some);
  for (const char *method = NULL; (method = next_method(method, is_fixed_step));) {
    const int solves = run_here(&some, method, 1, 1).linear_iterations > 0;
    check_method(solves ? &some : &all, method, solves ? SOLVED_STEPS : STEPS);
    check_lockstep(solves ? &some : &all, method, 2, 0.0, 1e-4, solves ? 1 : 3);
  }
  random_scene_destroy(&all);
  random_scene_destroy(&some);
}

/* Another seed is another scene: a constant hash would prove nothing. */
TEST(test_seeds_differ) {
  uint64_t hash[2];
  for (uint64_t k = 0; k < 2; k++) {
    owned_random_scene scene;
    random_scene_with(&scene, .seed = 5 + k, .particles = 100, .springs = 300, .features = SCENE_EVERYTHING);
    hash[k] = run_here(&scene, "symplectic-euler", 1, STEPS).hash;
  }
  assert_true(hash[0] != hash[1]);
}
