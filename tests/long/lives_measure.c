/* Lives of measurements: limits, costs, comparisons, studies, needs, and diagnoses. */
#include "check.h"
#include "hash.h"
#include "lives.h"
#include "run.h"
#include "small.h"

#include <stddef.h>

static hooke_integrator *diverged(hooke_scene *scene, hooke_state *state) {
  hooke_integrator *integrator = start_run(
      hooke_scene_system(scene), (struct run){.method = "symplectic-euler", .step = 0.5, .duration = 5.0});
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  return integrator;
}

static uint64_t live_why(const char *detail) {
  (void)detail;
  owned_scene *scene = life_scene(SEGMENTS);
  owned_state *state = start_state(hooke_scene_system(scene));
  owned_integrator *integrator = diverged(scene, state);
  owned_measurement *why = NULL;
  check_ok(explain_run(integrator, &why));
  const double found[] = {(double)hooke_measurement_row_count(why, "advice"),
                          hooke_measurement_number(why, "why", 0, "time")};
  const uint64_t hash = hash_doubles(2, found, life_hash(state, HASH_START));
  return hash;
}

static uint64_t live_limit(const char *detail) {
  (void)detail;
  owned_scene *scene = life_scene(SEGMENTS);
  owned_state *state = start_state(hooke_scene_system(scene));
  owned_measurement *limit = NULL;
  owned_options *options = options_with("limit", "predict=1");
  check_ok(hooke_measurement_create("limit", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &limit));
  check_ok(hooke_measurement_run(limit, state));
  uint64_t hash = HASH_START;
  for (int64_t k = 0; k < hooke_measurement_row_count(limit, "rows"); k++) {
    const double predicted = hooke_measurement_number(limit, "rows", k, "predicted");
    hash = hash_doubles(1, &predicted, hash);
  }
  return hash;
}

static uint64_t live_study(const char *detail) {
  (void)detail;
  owned_scene *scene = life_scene(SEGMENTS);
  owned_measurement *study = NULL;
  owned_options *options = options_with("study", "methods=verlet,backward-euler,cvode-bdf want=1e-6");
  check_ok(hooke_options_set_number(hooke_scene_run_options(scene), "duration", 0.01));
  check_ok(hooke_measurement_create("study", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &study));
  check_ok(hooke_measurement_run(study, NULL));
  uint64_t hash = HASH_START;
  for (int64_t k = 0; k < hooke_measurement_row_count(study, "rows"); k++) {
    const double error = hooke_measurement_number(study, "rows", k, "error");
    hash = hash_doubles(1, &error, hash);
  }
  check_ok(hooke_measurement_write(study, life_files.page));
  check_ok(hooke_measurement_label(study, "scene", hooke_scene_text(scene, "text")));
  check_ok(hooke_measurement_write(study, life_files.trajectory));
  return hash;
}

static uint64_t live_comparison(const char *detail) {
  (void)detail;
  owned_scene *scene = life_scene(SEGMENTS);
  owned_measurement *comparison = NULL;
  owned_options *options = options_with("study", "methods=verlet,rk4 once=1");
  check_ok(hooke_measurement_create("study", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &comparison));
  check_ok(hooke_measurement_label(comparison, "scene", hooke_scene_text(scene, "text")));
  check_ok(hooke_measurement_run(comparison, NULL));
  check_ok(hooke_measurement_write(comparison, life_files.trajectory));
  const double error[] = {hooke_measurement_number(comparison, "rows", 0, "error"),
                          hooke_measurement_number(comparison, "rows", 1, "error")};
  return hash_doubles(2, error, HASH_START);
}

static uint64_t live_needs(const char *detail) {
  (void)detail;
  owned_scene *scene = life_scene(SEGMENTS);
  owned_measurement *needs = NULL;
  owned_options *options = options_with("needs", "want=0.02");
  check_ok(hooke_options_set_number(hooke_scene_run_options(scene), "duration", 0.1));
  check_ok(hooke_measurement_create("needs", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &needs));
  check_ok(hooke_measurement_run(needs, NULL));
  const double found[] = {(double)hooke_measurement_row_count(needs, "rows"),
                          hooke_measurement_number(needs, "rows", 0, "error")};
  return hash_doubles(2, found, HASH_START);
}

static uint64_t live_cost(const char *detail) {
  (void)detail;
  owned_scene *scene = life_scene(SEGMENTS);
  owned_state *state = start_state(hooke_scene_system(scene));
  owned_measurement *cost = NULL;
  owned_options *options = options_with("cost", "predict=1");
  check_ok(hooke_measurement_create("cost", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &cost));
  check_ok(hooke_measurement_run(cost, state));
  const double found[] = {(double)hooke_measurement_row_count(cost, "rows"),
                          hooke_measurement_number(cost, "cost", 0, "memory_bytes")};
  return hash_doubles(2, found, HASH_START);
}

const struct life measure_lives[] = {
    {"why", NULL, live_why, 0},
    {"limit", NULL, live_limit, 0},
    {"cost", NULL, live_cost, 0},
    {"needs", NULL, live_needs, 0},
    {"comparison", NULL, live_comparison, HDF5_KEEPS},
    {"study", NULL, live_study, HDF5_KEEPS},
    {NULL, NULL, NULL, 0},
};
