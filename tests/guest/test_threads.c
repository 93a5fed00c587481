/* Many threads at once, each with objects of its own and all with one committed system: each gets the bits of
 * a single thread, its own messages, its own files. */
#include "check.h"
#include "hash.h"
#include "random_scene.h"
#include "run.h"
#include "scenarios.h"
#include "small.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { THREADS = 4, PARTICLES = 400 };

static struct random_scene shared; /* shared by all threads, committed */
static hooke_system *chain;        /* likewise */

/* Work whose result is a hash, 0 for a failure. No cmocka assertions: they would jump out of the thread. */
typedef uint64_t job(int thread);

static uint64_t hash_state(hooke_state *state, uint64_t hash) {
  hash = hash_doubles(hooke_state_size(state), hooke_state_position(state), hash);
  return hash_doubles(hooke_state_size(state), hooke_state_velocity(state), hash);
}

static uint64_t run_method(const hooke_system *system, const char *method, int32_t threads, uint64_t hash) {
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  int32_t status = hooke_options_create("run", &options);
  if (status == 0) status = hooke_options_set_text(options, "method", method);
  if (status == 0) status = hooke_options_set_number(options, "step", 1e-3);
  if (status == 0) status = hooke_options_set_number(options, "duration", 8e-3);
  if (status == 0) status = hooke_options_set_number(options, "rtol", 1e-4);
  if (status == 0) status = hooke_options_set_number(options, "atol", 1e-4);
  if (status == 0) status = hooke_options_set_number(options, "threads", threads);
  if (status == 0) status = hooke_integrator_create(system, options, &integrator);
  if (status == 0) status = hooke_state_create(system, &state);
  if (status == 0) status = hooke_integrator_run(integrator, state);
  if (status == 0) hash = hash_state(state, hash);
  if (status != 0) printf("%s: %s\n", method, hooke_last_error());
  if (state) hooke_state_destroy(state);
  if (integrator) hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
  return status == 0 ? hash : 0;
}

static uint64_t methods(int thread) {
  uint64_t hash = HASH_START;
  (void)thread;
  for (int64_t m = 0; m < hooke_method_count() && hash != 0; m++)
    if (hooke_method_is_built(hooke_method_name(m)))
      hash = run_method(shared.system, hooke_method_name(m), 1, hash);
  return hash;
}

static uint64_t crews(int thread) {
  (void)thread;
  const uint64_t hash = run_method(shared.system, "verlet", 2, HASH_START);
  return hash ? run_method(shared.system, "backward-euler", 2, hash) : 0;
}

/* The message of a failure is that of this thread, whatever the others do meanwhile. */
static uint64_t messages(int thread) {
  hooke_options *options = NULL;
  uint64_t wrong = 0;
  if (hooke_options_create("run", &options) != HOOKE_OK) return 0;
  for (int k = 0; k < 300; k++) {
    char value[32];
    snprintf(value, sizeof value, "-%d.5", 1000 * thread + k);
    wrong += hooke_options_set_text(options, "step", value) != HOOKE_BAD_VALUE;
    wrong += strstr(hooke_last_error(), value) == NULL;
  }
  hooke_options_destroy(options);
  return wrong ? 0 : 1;
}

static uint64_t queries(int thread) {
  (void)thread;
  const int64_t n = hooke_system_particle_count(shared.system);
  double *q = calloc((size_t)(9 * n), sizeof *q), *v = q + 3 * n, *f = v + 3 * n;
  uint64_t hash = HASH_START;
  if (q == NULL) return 0;
  for (int64_t k = 0; k < 3 * n; k++)
    q[k] = (double)(k * 7 % 13);
  for (int k = 0; k < 20 && hash != 0; k++) {
    if (hooke_system_force(shared.system, 0.0, q, v, f) != HOOKE_OK) hash = 0;
    if (hash) hash = hash_doubles(3 * n, f, hash);
    const double energy = hooke_system_energy(shared.system, "total", q, v);
    if (hash) hash = hash_doubles(1, &energy, hash);
  }
  free(q);
  return hash;
}

/* The extreme eigenvalues of a chain. */
static uint64_t top_modes(int thread) {
  (void)thread;
  hooke_options *options = NULL;
  hooke_measurement *limit = NULL;
  uint64_t hash = 0;
  int32_t status = hooke_options_create("limit", &options);
  if (status == 0) status = hooke_options_set_text(options, "methods", "verlet");
  if (status == 0) status = hooke_measurement_create("limit", chain, NULL, options, &limit);
  if (status == 0) status = hooke_measurement_run(limit, NULL);
  if (status == 0) {
    const double value = hooke_measurement_number(limit, "rows", 0, "predicted");
    hash = hash_doubles(1, &value, HASH_START);
  }
  if (limit) hooke_measurement_destroy(limit);
  hooke_options_destroy(options);
  return status == HOOKE_NOT_BUILT ? HASH_START : hash;
}

/* The quick scenarios of tests/fault, whose results do not depend on the clock: each thread has a folder of
 * its own. */
static char folder[THREADS + 1][128];

static uint64_t scenarios(int thread) {
  uint64_t hash = HASH_START;
  const struct scenario *scenario;
  for (int32_t k = 0; (scenario = scenario_at(k)) != NULL; k++) {
    if (scenario->share > 4) continue;
    struct attempt a = scenario_attempt(folder[thread]);
    scenario->run(&a, scenario->with);
    if (a.wrong[0]) {
      printf("%s: %s\n", scenario->name, a.wrong);
      return 0;
    }
    const double part = (double)a.hash;
    hash = hash_doubles(1, &part, hash);
  }
  return hash;
}

static job *const jobs[] = {methods, crews, messages, queries, top_modes, scenarios};
enum { JOBS = sizeof jobs / sizeof jobs[0] };

struct worker {
  int number;
  uint64_t result[JOBS];
  pthread_t thread;
};

/* Each thread begins with another job, so that different ones run together; twice, so that equal ones do,
 * too. */
static void *work(void *arg) {
  struct worker *worker = arg;
  for (int k = 0; k < JOBS; k++) {
    const int j = (k + 2 * worker->number) % JOBS;
    worker->result[j] = jobs[j](worker->number);
  }
  for (int j = 0; j < JOBS; j++)
    if (jobs[j](worker->number) != worker->result[j]) worker->result[j] = 0;
  return NULL;
}

enum { LINKS = 60 };

static hooke_system *make_chain(void) {
  double q[3 * (LINKS + 1)] = {0};
  int64_t ends[2 * LINKS];
  for (int k = 0; k < LINKS; k++) {
    q[3 * k + 3] = k + 1.0;
    ends[2 * k] = k;
    ends[2 * k + 1] = k + 1;
  }
  hooke_system *system = small_system(LINKS + 1, q, NULL, 1.0, 1);
  small_springs(system, LINKS, ends, (struct springs){.stiffness = 10.0, .rest_length = -1.0});
  check_ok(hooke_system_commit(system));
  return system;
}

TEST(test_threads_get_what_one_gets) {
  random_scene_create((struct random_scene_request){.seed = 31,
                                                    .particles = PARTICLES,
                                                    .springs = 3 * PARTICLES,
                                                    .cloth = {8, 8},
                                                    .features = SCENE_EVERYTHING & ~SCENE_COINCIDENT,
                                                    .with_product = 1},
                      &shared);
  chain = make_chain();
  for (int t = 0; t <= THREADS; t++)
    assert_int_equal(open_folder(folder[t]), 0);
  uint64_t alone[JOBS];
  struct worker worker[THREADS];
  for (int j = 0; j < JOBS; j++) {
    alone[j] = jobs[j](THREADS);
    if (alone[j] == 0) check_failed("job %d fails alone", j);
  }
  for (int t = 0; t < THREADS; t++) {
    worker[t] = (struct worker){.number = t};
    assert_int_equal(pthread_create(&worker[t].thread, NULL, work, &worker[t]), 0);
  }
  for (int t = 0; t < THREADS; t++)
    pthread_join(worker[t].thread, NULL);
  for (int t = 0; t < THREADS; t++)
    for (int j = 0; j < JOBS; j++)
      if (worker[t].result[j] != alone[j]) check_failed("thread %d has other bits in job %d", t, j);
  for (int t = 0; t <= THREADS; t++)
    close_folder(folder[t]);
  hooke_system_destroy(chain);
  random_scene_destroy(&shared);
}
