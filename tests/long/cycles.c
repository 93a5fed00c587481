/* Makes, uses and destroys one kind of object again and again: cycles KIND COUNT [FOLDER]. Every cycle has to come to the same
 * numbers, and after the first ones heap, resident memory, open files and threads have to stay as they are. Without arguments:
 * the kinds, one a line. FOLDER is for the files of kinds that write some; its files are replaced.
 * GLIBC_TUNABLES=glibc.malloc.tcache_count=0 has to be set: what threads keep of released memory would count as held. */
#include "check.h"
#include "hash.h"
#include "run.h"
#include "small.h"

#include <dirent.h>
#include <inttypes.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char trajectory_file[4096], page_file[4096], scene_file[4096];

static const char scene_text[] =
    "{\"hooke\": 1, \"gravity\": [0, -9.81, 0],"
    " \"particles\": {\"position\": [[0, 0, 0], [1, 0, 0.1], [2, 0.2, 0]], \"mass\": [1, 2, 3], \"pinned\": "
    "[0]},"
    " \"springs\": [{\"name\": \"edges\", \"between\": [[0, 1], [1, 2]], \"stiffness\": 100, \"damping\": "
    "0.5}],"
    " \"parts\": [{\"kind\": \"rope\", \"name\": \"rope\", \"from\": [0, 1, 0], \"to\": [1, 1, 0], "
    "\"segments\": 6,"
    " \"mass\": 0.2, \"pinned\": \"start\", \"stretch\": {\"stiffness\": 50, \"damping\": 0.1}}],"
    " \"run\": {\"method\": \"symplectic-euler\", \"step\": 1e-3, \"duration\": 0.02, \"every\": 0.01}}";

static hooke_scene *parsed(void) {
  hooke_scene *scene = NULL;
  check_ok(hooke_scene_parse(scene_text, (int64_t)strlen(scene_text), "scene", NULL, &scene));
  check_ok(hooke_scene_commit(scene));
  return scene;
}

static uint64_t hash_state(hooke_state *state, uint64_t hash) {
  const double t = hooke_state_time(state);
  hash = hash_doubles(1, &t, hash);
  hash = hash_doubles(hooke_state_size(state), hooke_state_position(state), hash);
  if (hooke_state_velocity(state) == NULL) return hash;
  return hash_doubles(hooke_state_size(state), hooke_state_velocity(state), hash);
}

/* ---- one cycle of each kind: what it comes to ---- */

static uint64_t cycle_system(const char *detail) {
  (void)detail;
  hooke_system *system = small_oscillator(2.0);
  hooke_state *state = start_state(system);
  const double energy = hooke_system_energy(system, hooke_state_position(state), hooke_state_velocity(state));
  hooke_state_destroy(state);
  hooke_system_destroy(system);
  return hash_doubles(1, &energy, HASH_START);
}

static uint64_t cycle_scene(const char *detail) {
  (void)detail;
  hooke_scene *scene = parsed(), *again = NULL, *loaded = NULL;
  check_ok(hooke_scene_of_system(hooke_scene_system(scene), "again", hooke_scene_run_options(scene), "again",
                                 NULL, &again));
  check_ok(hooke_scene_write(scene_file, hooke_scene_system(scene), "again", hooke_scene_run_options(scene)));
  check_ok(hooke_scene_load(scene_file, &loaded));
  check_ok(hooke_scene_commit(loaded));
  assert_string_equal(hooke_scene_text(again), hooke_scene_text(loaded));
  hooke_state *state = start_state(hooke_scene_system(loaded));
  const uint64_t hash = hash_state(state, HASH_START);
  hooke_state_destroy(state);
  hooke_scene_destroy(again);
  hooke_scene_destroy(loaded);
  hooke_scene_destroy(scene);
  return hash;
}

static uint64_t cycle_refused(const char *detail) {
  (void)detail;
  hooke_scene *scene = NULL;
  const char *texts[] = {"{", "{\"hooke\": 1, \"particles\": {\"position\": [[0, 0]]}}", "{\"hooke\": 2}"};
  uint64_t hash = HASH_START;
  for (size_t k = 0; k < sizeof texts / sizeof texts[0]; k++) {
    check_status(hooke_scene_parse(texts[k], (int64_t)strlen(texts[k]), "scene", NULL, &scene),
                 HOOKE_BAD_VALUE);
    const double length = (double)strlen(hooke_last_error());
    hash = hash_doubles(1, &length, hash);
  }
  return hash;
}

static uint64_t cycle_integrator(const char *method) {
  hooke_scene *scene = parsed();
  const int32_t fixed = is_fixed_step(method);
  hooke_integrator *integrator = start_run(hooke_scene_system(scene), (struct run){.method = method,
                                                                                   .step = fixed ? 1e-3 : 0.0,
                                                                                   .duration = 0.01,
                                                                                   .rtol = fixed ? 0.0 : 1e-6,
                                                                                   .atol = fixed ? 0.0 : 1e-6,
                                                                                   .threads = 2});
  hooke_state *state = start_state(hooke_scene_system(scene));
  check_ok(hooke_integrator_run(integrator, state));
  const uint64_t hash = hash_state(state, HASH_START);
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_scene_destroy(scene);
  return hash;
}

static hooke_integrator *diverged(hooke_scene *scene, hooke_state *state) {
  hooke_integrator *integrator = start_run(
      hooke_scene_system(scene), (struct run){.method = "symplectic-euler", .step = 0.5, .duration = 100.0});
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  return integrator;
}

static uint64_t cycle_why(const char *detail) {
  (void)detail;
  hooke_scene *scene = parsed();
  hooke_state *state = start_state(hooke_scene_system(scene));
  hooke_integrator *integrator = diverged(scene, state);
  hooke_why *why = NULL;
  check_ok(hooke_why_create(integrator, &why));
  const double found[] = {(double)hooke_why_advice_count(why), hooke_why_number(why, "time")};
  const uint64_t hash = hash_doubles(2, found, hash_state(state, HASH_START));
  hooke_why_destroy(why);
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  hooke_scene_destroy(scene);
  return hash;
}

static uint64_t cycle_trajectory(const char *detail) {
  hooke_scene *scene = parsed();
  hooke_system *system = hooke_scene_system(scene);
  hooke_integrator *integrator = NULL;
  check_ok(hooke_integrator_create(system, hooke_scene_run_options(scene), &integrator));
  hooke_state *state = start_state(system);
  hooke_trajectory *trajectory = NULL;
  check_ok(
      hooke_trajectory_create(trajectory_file, system, integrator, hooke_scene_text(scene), &trajectory));
  if (detail != NULL) check_ok(hooke_trajectory_write_behind(trajectory));
  for (int64_t k = 0; k < hooke_integrator_frame_count(integrator); k++) {
    check_ok(hooke_trajectory_write(trajectory, 10 * k, state));
    check_ok(hooke_integrator_step(integrator, state, 10));
  }
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
  hooke_record *record = NULL;
  check_ok(hooke_record_open(trajectory_file, &record));
  check_ok(hooke_record_read(record, -1, state));
  const uint64_t hash = hash_state(state, HASH_START);
  check_ok(hooke_record_write_xdmf(record, page_file));
  hooke_record_close(record);
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_scene_destroy(scene);
  return hash;
}

static uint64_t cycle_limit(const char *detail) {
  (void)detail;
  hooke_scene *scene = parsed();
  hooke_state *state = start_state(hooke_scene_system(scene));
  hooke_options *options = NULL;
  hooke_limit *limit = NULL;
  check_ok(hooke_limit_options_create(&options));
  check_ok(hooke_options_set_number(options, "predict", 1.0));
  check_ok(hooke_limit_create(hooke_scene_system(scene), hooke_scene_run_options(scene), options, &limit));
  check_ok(hooke_limit_find(limit, state));
  uint64_t hash = HASH_START;
  for (int64_t k = 0; k < hooke_limit_row_count(limit); k++) {
    const double predicted = hooke_limit_number(limit, k, "predicted");
    hash = hash_doubles(1, &predicted, hash);
  }
  hooke_limit_destroy(limit);
  hooke_options_destroy(options);
  hooke_state_destroy(state);
  hooke_scene_destroy(scene);
  return hash;
}

static uint64_t cycle_study(const char *detail) {
  (void)detail;
  hooke_scene *scene = parsed();
  hooke_study *study = NULL;
  check_ok(hooke_study_create(hooke_scene_system(scene), hooke_scene_run_options(scene), NULL, &study));
  check_ok(hooke_study_run(study));
  uint64_t hash = HASH_START;
  for (int64_t k = 0; k < hooke_study_row_count(study); k++) {
    const double error = hooke_study_number(study, k, "error");
    hash = hash_doubles(1, &error, hash);
  }
  check_ok(hooke_study_write_csv(study, page_file));
  check_ok(hooke_study_write_h5(study, trajectory_file, hooke_scene_text(scene), HOOKE_OK));
  hooke_study_destroy(study);
  hooke_scene_destroy(scene);
  return hash;
}

static uint64_t cycle_comparison(const char *detail) {
  (void)detail;
  hooke_scene *scene = parsed();
  hooke_comparison *comparison = NULL;
  hooke_comparison_file *file = NULL;
  check_ok(hooke_comparison_create(hooke_scene_system(scene), hooke_scene_run_options(scene), &comparison));
  check_ok(hooke_comparison_add(comparison, "verlet"));
  check_ok(hooke_comparison_add(comparison, "rk4"));
  check_ok(hooke_comparison_file_create(trajectory_file, hooke_scene_system(scene), comparison,
                                        hooke_scene_text(scene), &file));
  check_ok(hooke_comparison_run(comparison));
  const double error[] = {hooke_comparison_number(comparison, 0, "error"),
                          hooke_comparison_number(comparison, 1, "error")};
  check_ok(hooke_comparison_file_close(file));
  hooke_comparison_destroy(comparison);
  hooke_scene_destroy(scene);
  return hash_doubles(2, error, HASH_START);
}

static uint64_t cycle_needs(const char *detail) {
  (void)detail;
  hooke_scene *scene = parsed();
  hooke_options *options = NULL;
  hooke_needs *needs = NULL;
  check_ok(hooke_needs_options_create(&options));
  check_ok(hooke_options_set_number(options, "want", 0.02));
  check_ok(hooke_options_set_number(hooke_scene_run_options(scene), "duration", 0.5));
  check_ok(hooke_needs_create(hooke_scene_system(scene), hooke_scene_run_options(scene), options, &needs));
  check_ok(hooke_needs_find(needs));
  const double found[] = {(double)hooke_needs_row_count(needs), hooke_needs_number(needs, 0, "error")};
  hooke_needs_destroy(needs);
  hooke_options_destroy(options);
  hooke_scene_destroy(scene);
  return hash_doubles(2, found, HASH_START);
}

static uint64_t cycle_cost(const char *detail) {
  (void)detail;
  hooke_scene *scene = parsed();
  hooke_state *state = start_state(hooke_scene_system(scene));
  hooke_options *options = NULL;
  hooke_cost *cost = NULL;
  check_ok(hooke_cost_options_create(&options));
  check_ok(hooke_options_set_number(options, "predict", 1.0));
  check_ok(hooke_cost_create(hooke_scene_system(scene), hooke_scene_run_options(scene), options, &cost));
  check_ok(hooke_cost_find(cost, state));
  const double found[] = {(double)hooke_cost_row_count(cost), hooke_cost_figure(cost, "memory_bytes")};
  hooke_cost_destroy(cost);
  hooke_options_destroy(options);
  hooke_state_destroy(state);
  hooke_scene_destroy(scene);
  return hash_doubles(2, found, HASH_START);
}

static const struct kind {
  const char *name, *detail;
  uint64_t (*cycle)(const char *detail);
} kinds[] = {
    {"system", NULL, cycle_system},
    {"scene", NULL, cycle_scene},
    {"refused", NULL, cycle_refused},
    {"forward-euler", "forward-euler", cycle_integrator},
    {"symplectic-euler", "symplectic-euler", cycle_integrator},
    {"verlet", "verlet", cycle_integrator},
    {"rk4", "rk4", cycle_integrator},
    {"backward-euler", "backward-euler", cycle_integrator},
    {"cvode-bdf", "cvode-bdf", cycle_integrator},
    {"cvode-adams", "cvode-adams", cycle_integrator},
    {"rk8pd", "rk8pd", cycle_integrator},
    {"arkode-esdirk", "arkode-esdirk", cycle_integrator},
    {"why", NULL, cycle_why},
    {"trajectory", NULL, cycle_trajectory},
    {"write-behind", "behind", cycle_trajectory},
    {"limit", NULL, cycle_limit},
    {"cost", NULL, cycle_cost},
    {"comparison", NULL, cycle_comparison},
    {"study", NULL, cycle_study},
    {"needs", NULL, cycle_needs},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* ---- what has to stay ---- */

struct held {
  int64_t heap, resident, files, threads;
};

static int64_t entries(const char *folder) {
  int64_t count = 0;
  DIR *directory = opendir(folder);
  assert_non_null(directory);
  while (readdir(directory) != NULL)
    count++;
  closedir(directory);
  return count;
}

static struct held held_now(void) {
  long long pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  assert_non_null(file);
  assert_int_equal(fscanf(file, "%*d %lld", &pages), 1);
  fclose(file);
  return (struct held){.heap = (int64_t)mallinfo2().uordblks,
                       .resident = pages * sysconf(_SC_PAGESIZE),
                       .files = entries("/proc/self/fd"),
                       .threads = entries("/proc/self/task")};
}

static const struct kind *asked;
static int64_t cycles;

/* Caches of libraries fill in the first twentieth; from then on the heap may not grow by a byte. */
static void test_cycles(void **unused) {
  (void)unused;
  const int64_t warm = cycles / 20 + 10;
  uint64_t first = 0;
  struct held start = {0}, now = {0};
  for (int64_t k = 0; k < cycles; k++) {
    const uint64_t hash = asked->cycle(asked->detail);
    if (k == 0) first = hash;
    if (hash != first)
      check_failed("cycle %" PRId64 " comes to %016" PRIx64 ", the first to %016" PRIx64, k, hash, first);
    if (k == warm) start = held_now();
  }
  now = held_now();
  printf("%s: %" PRId64 " cycles, hash %016" PRIx64 ", heap %" PRId64 " -> %" PRId64
         " bytes, resident %" PRId64 " -> %" PRId64 " KiB, files %" PRId64 ", threads %" PRId64 "\n",
         asked->name, cycles, first, start.heap, now.heap, start.resident / 1024, now.resident / 1024,
         now.files, now.threads);
  if (now.heap > start.heap) check_failed("the heap has grown");
  if (now.resident - start.resident > 1 << 20) check_failed("the process has grown");
  assert_int_equal(now.files, start.files);
  assert_int_equal(now.threads, start.threads);
}

int main(int argc, char **argv) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_cycles)};
  for (int k = 0; k < KINDS; k++) {
    if (argc < 3) puts(kinds[k].name);
    if (argc >= 3 && strcmp(argv[1], kinds[k].name) == 0) asked = &kinds[k];
  }
  if (argc < 3) return 0;
  if (asked == NULL) return fprintf(stderr, "no kind is called %s\n", argv[1]), 2;
  cycles = strtoll(argv[2], NULL, 10);
  if (cycles < 100) return fprintf(stderr, "at least 100 cycles\n"), 2;
  const char *folder = argc > 3 ? argv[3] : ".";
  snprintf(trajectory_file, sizeof trajectory_file, "%s/%s.h5", folder, asked->name);
  snprintf(page_file, sizeof page_file, "%s/%s.xdmf", folder, asked->name);
  snprintf(scene_file, sizeof scene_file, "%s/%s.json", folder, asked->name);
  return cmocka_run_group_tests(tests, NULL, NULL);
}
