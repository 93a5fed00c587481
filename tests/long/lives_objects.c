/* Lives of systems, scenes and runs. */
#include "check.h"
#include "hash.h"
#include "lives.h"
#include "run.h"
#include "small.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct life_files life_files;

static const char scene_format[] =
    "{\"hooke\": 1, \"gravity\": [0, -9.81, 0],"
    " \"particles\": {\"position\": [[0, 0, 0], [1, 0, 0.1], [2, 0.2, 0]], \"mass\": [1, 2, 3], \"pinned\": "
    "[0]},"
    " \"springs\": [{\"name\": \"edges\", \"between\": [[0, 1], [1, 2]], \"stiffness\": 100, \"damping\": "
    "0.5}],"
    " \"parts\": [{\"kind\": \"rope\", \"name\": \"rope\", \"from\": [0, 1, 0], \"to\": [1, 1, 0], "
    "\"segments\": %d,"
    " \"mass\": 0.2, \"pinned\": \"start\", \"stretch\": {\"stiffness\": %g, \"damping\": %g}}],"
    " \"run\": {\"method\": \"symplectic-euler\", \"step\": 1e-3, \"duration\": 0.02, \"every\": 0.01}}";

hooke_scene *life_scene(int32_t segments) {
  hooke_scene *scene = NULL;
  char text[1024];
  const double softer = (double)(SEGMENTS * SEGMENTS) / (segments * segments); /* for the step to be stable */
  const int length = snprintf(text, sizeof text, scene_format, segments, 50 * softer, 0.1 * softer);
  assert_true(length > 0 && (size_t)length < sizeof text);
  check_ok(hooke_scene_parse(text, length, "scene", NULL, NULL, &scene));
  check_ok(hooke_scene_commit(scene));
  return scene;
}

uint64_t life_hash(hooke_state *state, uint64_t hash) {
  const double t = hooke_state_time(state);
  hash = hash_doubles(1, &t, hash);
  hash = hash_doubles(hooke_state_size(state), hooke_state_position(state), hash);
  if (hooke_state_velocity(state) == NULL) return hash;
  return hash_doubles(hooke_state_size(state), hooke_state_velocity(state), hash);
}

static uint64_t live_system(const char *detail) {
  (void)detail;
  owned_system *system = small_oscillator(2.0);
  owned_state *state = start_state(system);
  const double energy =
      hooke_system_energy(system, "total", hooke_state_position(state), hooke_state_velocity(state));
  return hash_doubles(1, &energy, HASH_START);
}

static uint64_t live_scene(const char *detail) {
  (void)detail;
  owned_scene *scene = life_scene(SEGMENTS), *again = NULL, *loaded = NULL;
  check_ok(hooke_scene_of_system(hooke_scene_system(scene), "again", hooke_scene_run_options(scene), "again",
                                 NULL, &again));
  check_ok(hooke_scene_write(life_files.scene, hooke_scene_system(scene), "again",
                             hooke_scene_run_options(scene)));
  check_ok(hooke_scene_load(life_files.scene, NULL, &loaded));
  check_ok(hooke_scene_commit(loaded));
  assert_string_equal(hooke_scene_text(again, "text"), hooke_scene_text(loaded, "text"));
  owned_state *state = start_state(hooke_scene_system(loaded));
  const uint64_t hash = life_hash(state, HASH_START);
  return hash;
}

static uint64_t live_refused(const char *detail) {
  (void)detail;
  hooke_scene *scene = NULL;
  const char *texts[] = {"{", "{\"hooke\": 1, \"particles\": {\"position\": [[0, 0]]}}", "{\"hooke\": 2}"};
  uint64_t hash = HASH_START;
  for (size_t k = 0; k < sizeof texts / sizeof texts[0]; k++) {
    check_status(hooke_scene_parse(texts[k], (int64_t)strlen(texts[k]), "scene", NULL, NULL, &scene),
                 HOOKE_BAD_VALUE);
    const double length = (double)strlen(hooke_last_error());
    hash = hash_doubles(1, &length, hash);
  }
  return hash;
}

static uint64_t run_life(int32_t segments, struct run run) {
  owned_scene *scene = life_scene(segments);
  owned_integrator *integrator = start_run(hooke_scene_system(scene), run);
  owned_state *state = start_state(hooke_scene_system(scene));
  check_ok(hooke_integrator_run(integrator, state));
  const uint64_t hash = life_hash(state, HASH_START);
  return hash;
}

static uint64_t live_integrator(const char *method) {
  const int32_t fixed = is_fixed_step(method);
  return run_life(SEGMENTS, (struct run){.method = method,
                                         .step = fixed ? 1e-3 : 0.0,
                                         .duration = 0.01,
                                         .rtol = fixed ? 0.0 : 1e-6,
                                         .atol = fixed ? 0.0 : 1e-6,
                                         .threads = 2});
}

/* Large enough for its threads to be started. */
static uint64_t live_threads(const char *method) {
  return run_life(MANY, (struct run){.method = method, .step = 1e-3, .duration = 0.01, .threads = 2});
}

static int32_t stop_halfway(int64_t step, const hooke_state *state, void *ctx) {
  (void)step, (void)ctx;
  return hooke_state_time(state) >= 0.012;
}

static hooke_integrator *checkpointed(hooke_scene *scene, const char *method) {
  const int32_t fixed = is_fixed_step(method);
  return start_run(hooke_scene_system(scene), (struct run){.method = method,
                                                           .step = fixed ? 1e-3 : 0.0,
                                                           .duration = 0.02,
                                                           .every = 0.005,
                                                           .checkpoint = 0.005,
                                                           .rtol = fixed ? 0.0 : 1e-6,
                                                           .atol = fixed ? 0.0 : 1e-6});
}

/* Stopped, saved as a checkpoint, and continued by other objects from the file; from the previous one if it
 * is damaged. */
static uint64_t live_checkpoint(const char *method) {
  owned_scene *scene = life_scene(SEGMENTS);
  hooke_integrator *stopped = checkpointed(scene, method);
  hooke_state *state = start_state(hooke_scene_system(scene));
  check_ok(hooke_integrator_on_step(stopped, 1, stop_halfway, NULL));
  check_status(hooke_integrator_run(stopped, state), HOOKE_STOPPED);
  for (int k = 0; k < 2; k++)
    check_ok(hooke_checkpoint_write(life_files.checkpoint, stopped, state, "life"));
  hooke_state_destroy(state);
  hooke_integrator_destroy(stopped);
  uint64_t hash = HASH_START;
  for (int damaged = 0; damaged < 2; damaged++) {
    if (damaged) assert_int_equal(truncate(life_files.checkpoint, 100), 0);
    owned_integrator *integrator = checkpointed(scene, method);
    state = start_state(hooke_scene_system(scene));
    check_status(hooke_checkpoint_read(life_files.checkpoint, "another", integrator, state), HOOKE_BAD_VALUE);
    check_ok(hooke_checkpoint_read(life_files.checkpoint, "life", integrator, state));
    check_ok(hooke_integrator_resume(integrator, state));
    hash = life_hash(state, hash);
    hooke_state_destroy(state);
  }
  return hash;
}

const struct life object_lives[] = {
    {"system", NULL, live_system, 0},
    {"scene", NULL, live_scene, 0},
    {"refused", NULL, live_refused, 0},
    {"forward-euler", "forward-euler", live_integrator, 0},
    {"symplectic-euler", "symplectic-euler", live_integrator, 0},
    {"verlet", "verlet", live_integrator, 0},
    {"rk4", "rk4", live_integrator, 0},
    {"backward-euler", "backward-euler", live_integrator, 0},
    {"cvode-bdf", "cvode-bdf", live_integrator, 0},
    {"cvode-adams", "cvode-adams", live_integrator, 0},
    {"rk8pd", "rk8pd", live_integrator, 0},
    {"arkode-esdirk", "arkode-esdirk", live_integrator, 0},
    {"threads", "verlet", live_threads, 0},
    {"threads-solved", "backward-euler", live_threads, 0},
    {"checkpoint", "verlet", live_checkpoint, 0},
    {"checkpoint-cvode", "cvode-bdf", live_checkpoint, 0},
    {NULL, NULL, NULL, 0},
};
