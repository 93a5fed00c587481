/* Many threads at once, each with objects of its own and all with one committed system: each gets the bits of
 * a single thread, its own messages, its own files. */
#include "check.h"
#include "hash.h"
#include "random_scene.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { THREADS = 4, PARTICLES = 400 };

static struct random_scene shared;       /* shared by all threads, committed */
static hooke_system *oscillator, *chain; /* likewise */

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

#if HOOKE_HAVE_LAPACK

static uint64_t find_limit(const hooke_system *system) {
  hooke_options *options = NULL;
  hooke_measurement *limit = NULL;
  hooke_state *state = NULL;
  uint64_t hash = 0;
  int32_t status = hooke_options_create("limit", &options);
  if (status == 0) status = hooke_options_set_text(options, "methods", "verlet");
  if (status == 0) status = hooke_measurement_create("limit", system, NULL, options, &limit);
  if (status == 0) status = hooke_state_create(system, &state);
  if (status == 0) status = hooke_measurement_run(limit, state);
  if (status == 0) {
    const double value = hooke_measurement_number(limit, "rows", 0, "predicted");
    hash = hash_doubles(1, &value, HASH_START);
  } else {
    printf("limit: %s\n", hooke_last_error());
  }
  if (state) hooke_state_destroy(state);
  if (limit) hooke_measurement_destroy(limit);
  hooke_options_destroy(options);
  return hash;
}

static uint64_t limits(int thread) {
  (void)thread;
  return find_limit(oscillator);
}

/* Large enough for ARPACK, which only one thread at a time may use. */
static uint64_t top_modes(int thread) {
  (void)thread;
  return find_limit(chain);
}

static uint64_t explanations(int thread) {
  (void)thread;
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  hooke_measurement *why = NULL;
  uint64_t hash = 0;
  int32_t status = hooke_options_create("run", &options);
  if (status == 0) status = hooke_options_set_text(options, "method", "forward-euler");
  if (status == 0) status = hooke_options_set_number(options, "step", 0.5);
  if (status == 0) status = hooke_options_set_number(options, "duration", 500);
  if (status == 0) status = hooke_integrator_create(oscillator, options, &integrator);
  if (status == 0) status = hooke_state_create(oscillator, &state);
  if (status == 0 && hooke_integrator_run(integrator, state) != HOOKE_DIVERGED) status = -1;
  if (status == 0) status = hooke_why_create(integrator, NULL, &why);
  if (status == 0) status = hooke_measurement_run(why, NULL);
  if (status == 0) {
    const double limit = hooke_measurement_number(why, "why", 0, "limit");
    hash = hash_doubles(1, &limit, HASH_START);
  }
  if (why) hooke_measurement_destroy(why);
  if (state) hooke_state_destroy(state);
  if (integrator) hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
  return hash;
}

#endif

static const char scene_text[] =
    "{\"hooke\": 1, \"gravity\": [0, -9.81, 0], \"parts\": [{\"kind\": \"cloth\", \"size\": [6, 6], "
    "\"edges\":"
    " [[1, 0, 0], [0, 0, 1.125]], \"mass\": 0.25, \"pinned\": \"top-corners\","
    " \"structural\": {\"stiffness\": 50.5, \"damping\": 1e-2}}],"
    " \"run\": {\"method\": \"verlet\", \"step\": 1e-3, \"duration\": 0.02, \"every\": 0.01}}";

static uint64_t scenes(int thread) {
  (void)thread;
  hooke_scene *scene = NULL, *bad = NULL;
  if (hooke_scene_parse("{\"hooke\": 1, \"gravity\": [0, -9.81]}", 35, "bad", NULL, NULL, &bad) !=
          HOOKE_BAD_VALUE ||
      strstr(hooke_last_error(), "bad:1:") == NULL)
    return 0;
  int32_t status = hooke_scene_parse(scene_text, (int64_t)strlen(scene_text), "scene", NULL, NULL, &scene);
  if (status == 0) status = hooke_scene_commit(scene);
  const uint64_t hash = status == 0 ? run_method(hooke_scene_system(scene), "rk4", 1, HASH_START) : 0;
  hooke_scene_destroy(scene);
  return hash;
}

#if HOOKE_HAVE_HDF5

/* A trajectory and its record: files of this thread alone. */
static uint64_t files(int thread) {
  char path[64];
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  hooke_trajectory *trajectory = NULL;
  hooke_record *record = NULL;
  uint64_t hash = HASH_START;
  snprintf(path, sizeof path, "guest_threads_%d.h5", thread);
  int32_t status = hooke_options_create("run", &options);
  if (status == 0) status = hooke_options_set_text(options, "method", "verlet");
  if (status == 0) status = hooke_options_set_number(options, "step", 1e-3);
  if (status == 0) status = hooke_options_set_number(options, "duration", 4e-3);
  if (status == 0) status = hooke_options_set_number(options, "every", 1e-3);
  if (status == 0) status = hooke_integrator_create(shared.system, options, &integrator);
  if (status == 0) status = hooke_state_create(shared.system, &state);
  if (status == 0) status = hooke_trajectory_create(path, shared.system, integrator, NULL, &trajectory);
  if (status == 0) status = hooke_trajectory_write_behind(trajectory);
  for (int k = 0; k < 5 && status == 0; k++) {
    status = hooke_trajectory_write(trajectory, k, state);
    if (status == 0) status = hooke_integrator_step(integrator, state, 1);
  }
  if (trajectory && hooke_trajectory_close(trajectory, HOOKE_OK) != HOOKE_OK) status = -1;
  if (status == 0) status = hooke_record_open(path, &record);
  for (int k = 0; k < 5 && status == 0; k++) {
    status = hooke_record_read(record, k, state);
    hash = hash_state(state, hash);
  }
  if (status != 0) printf("files: %s\n", hooke_last_error());
  if (record) hooke_record_close(record);
  if (state) hooke_state_destroy(state);
  if (integrator) hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
  remove(path);
  return status == 0 ? hash : 0;
}

#endif

#if HOOKE_HAVE_SUNDIALS

static uint64_t studies(int thread) {
  (void)thread;
  hooke_options *run = NULL, *options = NULL;
  hooke_measurement *study = NULL;
  uint64_t hash = HASH_START;
  int32_t status = hooke_options_create("run", &run);
  if (status == 0) status = hooke_options_set_number(run, "duration", 0.1);
  if (status == 0) status = hooke_options_set_number(run, "every", 0.01);
  if (status == 0) status = hooke_options_create("study", &options);
  if (status == 0) status = hooke_options_set_text(options, "methods", "verlet,rk4");
  if (status == 0) status = hooke_options_set_text(options, "steps", "0.002,0.001");
  if (status == 0) status = hooke_measurement_create("study", oscillator, run, options, &study);
  if (status == 0) status = hooke_measurement_run(study, NULL);
  for (int64_t row = 0; status == 0 && row < hooke_measurement_row_count(study, "rows"); row++) {
    const double error = hooke_measurement_number(study, "rows", row, "error");
    hash = hash_doubles(1, &error, hash);
  }
  if (status != 0) printf("study: %s\n", hooke_last_error());
  if (study) hooke_measurement_destroy(study);
  if (options) hooke_options_destroy(options);
  hooke_options_destroy(run);
  return status == 0 ? hash : 0;
}

#endif

static job *const jobs[] = {
    methods, crews,     messages,     queries,
#if HOOKE_HAVE_LAPACK
    limits,  top_modes, explanations,
#endif
    scenes,
#if HOOKE_HAVE_HDF5
    files,
#endif
#if HOOKE_HAVE_SUNDIALS
    studies,
#endif
};
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
  oscillator = small_oscillator(100.0);
  chain = make_chain();
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
  hooke_system_destroy(chain);
  hooke_system_destroy(oscillator);
  random_scene_destroy(&shared);
}
