/* Lives of measurements: limits, costs, comparisons, studies, needs, and diagnoses. */
#include "check.h"
#include "hash.h"
#include "lives.h"
#include "run.h"

#include <math.h>
#include <stddef.h>

static hooke_integrator *diverged(hooke_scene *scene, hooke_state *state) {
  hooke_integrator *integrator = start_run(
      hooke_scene_system(scene), (struct run){.method = "symplectic-euler", .step = 0.5, .duration = 5.0});
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  return integrator;
}

static uint64_t live_why(const char *detail) {
  (void)detail;
  hooke_scene *scene = life_scene(SEGMENTS);
  hooke_state *state = start_state(hooke_scene_system(scene));
  hooke_integrator *integrator = diverged(scene, state);
  hooke_measurement *why = NULL;
  check_ok(explain_run(integrator, &why));
  const double found[] = {(double)hooke_measurement_row_count(why, "advice"),
                          hooke_measurement_number(why, "why", 0, "time")};
  const uint64_t hash = hash_doubles(2, found, life_hash(state, HASH_START));
  hooke_measurement_destroy(why);
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  hooke_scene_destroy(scene);
  return hash;
}

static uint64_t live_limit(const char *detail) {
  (void)detail;
  hooke_scene *scene = life_scene(SEGMENTS);
  hooke_state *state = start_state(hooke_scene_system(scene));
  hooke_options *options = NULL;
  hooke_measurement *limit = NULL;
  check_ok(hooke_options_create("limit", &options));
  check_ok(hooke_options_set_number(options, "predict", 1.0));
  check_ok(hooke_measurement_create("limit", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &limit));
  check_ok(hooke_measurement_run(limit, state));
  uint64_t hash = HASH_START;
  for (int64_t k = 0; k < hooke_measurement_row_count(limit, "rows"); k++) {
    const double predicted = hooke_measurement_number(limit, "rows", k, "predicted");
    hash = hash_doubles(1, &predicted, hash);
  }
  hooke_measurement_destroy(limit);
  hooke_options_destroy(options);
  hooke_state_destroy(state);
  hooke_scene_destroy(scene);
  return hash;
}

static uint64_t live_study(const char *detail) {
  (void)detail;
  hooke_scene *scene = life_scene(SEGMENTS);
  hooke_options *options = NULL;
  hooke_measurement *study = NULL;
  check_ok(hooke_options_create("study", &options));
  check_ok(hooke_options_set_text(options, "methods", "verlet,backward-euler,cvode-bdf"));
  check_ok(hooke_options_set_number(options, "want", 1e-6));
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
  hooke_measurement_destroy(study);
  hooke_options_destroy(options);
  hooke_scene_destroy(scene);
  return hash;
}

static uint64_t live_comparison(const char *detail) {
  (void)detail;
  hooke_scene *scene = life_scene(SEGMENTS);
  hooke_measurement *comparison = NULL;
  hooke_options *options = NULL;
  check_ok(hooke_options_create("study", &options));
  check_ok(hooke_options_set_text(options, "methods", "verlet,rk4"));
  check_ok(hooke_options_set_number(options, "once", 1));
  check_ok(hooke_measurement_create("study", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &comparison));
  hooke_options_destroy(options);
  check_ok(hooke_measurement_label(comparison, "scene", hooke_scene_text(scene, "text")));
  check_ok(hooke_measurement_run(comparison, NULL));
  check_ok(hooke_measurement_write(comparison, life_files.trajectory));
  const double error[] = {hooke_measurement_number(comparison, "rows", 0, "error"),
                          hooke_measurement_number(comparison, "rows", 1, "error")};
  hooke_measurement_destroy(comparison);
  hooke_scene_destroy(scene);
  return hash_doubles(2, error, HASH_START);
}

static uint64_t live_needs(const char *detail) {
  (void)detail;
  hooke_scene *scene = life_scene(SEGMENTS);
  hooke_options *options = NULL;
  hooke_measurement *needs = NULL;
  check_ok(hooke_options_create("needs", &options));
  check_ok(hooke_options_set_number(options, "want", 0.02));
  check_ok(hooke_options_set_number(hooke_scene_run_options(scene), "duration", 0.1));
  check_ok(hooke_measurement_create("needs", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &needs));
  check_ok(hooke_measurement_run(needs, NULL));
  const double found[] = {(double)hooke_measurement_row_count(needs, "rows"),
                          hooke_measurement_number(needs, "rows", 0, "error")};
  hooke_measurement_destroy(needs);
  hooke_options_destroy(options);
  hooke_scene_destroy(scene);
  return hash_doubles(2, found, HASH_START);
}

static uint64_t live_cost(const char *detail) {
  (void)detail;
  hooke_scene *scene = life_scene(SEGMENTS);
  hooke_state *state = start_state(hooke_scene_system(scene));
  hooke_options *options = NULL;
  hooke_measurement *cost = NULL;
  check_ok(hooke_options_create("cost", &options));
  check_ok(hooke_options_set_number(options, "predict", 1.0));
  check_ok(hooke_measurement_create("cost", hooke_scene_system(scene), hooke_scene_run_options(scene),
                                    options, &cost));
  check_ok(hooke_measurement_run(cost, state));
  const double found[] = {(double)hooke_measurement_row_count(cost, "rows"),
                          hooke_measurement_number(cost, "cost", 0, "memory_bytes")};
  hooke_measurement_destroy(cost);
  hooke_options_destroy(options);
  hooke_state_destroy(state);
  hooke_scene_destroy(scene);
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
