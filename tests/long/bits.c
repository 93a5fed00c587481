/* Prints a hash of the results of every method for each of many random scenes, and of their forces and
 * energies: one line "<scene> <method> <threads> <kind> <hash>". Two builds compute the same when they print
 * the same lines. The kind gives the scope: "fixed" on every machine, "library" on one machine with one set
 * of libraries. */
#include "check.h"
#include "hash.h"
#include "random_scene.h"
#include "run.h"

#include <inttypes.h>
#include <stdio.h>

enum { STEPS = 50, BIG_STEPS = 4, THREADS = 3 };

static const struct scene {
  const char *name;
  struct random_scene_request request;
  int32_t steps;
} scenes[] = {
    {"springs", {.seed = 1, .particles = 40, .springs = 90}, STEPS},
    {"gravity", {.seed = 2, .particles = 40, .springs = 90, .features = SCENE_GRAVITY | SCENE_PINNED}, STEPS},
    {"drag", {.seed = 3, .particles = 40, .springs = 90, .features = SCENE_DRAG}, STEPS},
    {"damping", {.seed = 4, .particles = 40, .springs = 90, .features = SCENE_DAMPING}, STEPS},
    {"pull-only", {.seed = 5, .particles = 40, .springs = 90, .features = SCENE_PULL_ONLY}, STEPS},
    {"driven", {.seed = 6, .particles = 40, .springs = 90, .features = SCENE_DRIVEN}, STEPS},
    {"callback", {.seed = 7, .particles = 40, .springs = 90, .features = SCENE_CALLBACK}, STEPS},
    {"coincident", {.seed = 8, .particles = 40, .springs = 90, .features = SCENE_COINCIDENT}, STEPS},
    {"bending", {.seed = 9, .particles = 40, .springs = 60, .triples = 80, .features = SCENE_GRAVITY}, STEPS},
    {"altitude",
     {.seed = 10, .particles = 40, .springs = 60, .tetrahedra = 20, .features = SCENE_DAMPING},
     STEPS},
    {"rope", {.seed = 11, .particles = 1, .features = SCENE_GRAVITY | SCENE_DAMPING, .rope = 60}, STEPS},
    {"cloth",
     {.seed = 12, .particles = 1, .features = SCENE_GRAVITY | SCENE_DAMPING, .cloth = {30, 23}},
     STEPS},
    {"lattice", {.seed = 13, .particles = 1, .features = SCENE_GRAVITY, .lattice = {7, 6, 5}}, STEPS},
    {"all",
     {.seed = 14,
      .particles = 300,
      .springs = 1200,
      .triples = 100,
      .tetrahedra = 30,
      .features = SCENE_EVERYTHING,
      .cloth = {20, 20},
      .rope = 40},
     STEPS},
    {"big-cloth",
     {.seed = 15, .particles = 1, .features = SCENE_GRAVITY | SCENE_DAMPING | SCENE_DRAG, .cloth = {90, 90}},
     BIG_STEPS},
    {"big-net",
     {.seed = 16,
      .particles = 3000,
      .springs = 40000,
      .features = SCENE_GRAVITY | SCENE_DAMPING | SCENE_PINNED},
     BIG_STEPS},
};

static void tell(const struct scene *scene, const char *method, int32_t threads, const char *kind,
                 uint64_t hash) {
  printf("%s %s %d %s %016" PRIx64 "\n", scene->name, method, (int)threads, kind, hash);
}

static void run_method(const struct scene *scene, const hooke_system *system, const char *method,
                       int32_t threads) {
  const double step = 1e-4, tolerance = 1e-5;
  const int32_t fixed = is_fixed_step(method);
  const int64_t size = 3 * hooke_system_particle_count(system);
  owned_run(integrator, state, system, .method = method, .step = fixed ? step : 0.0,
            .duration = scene->steps * step, .every = fixed ? 0.0 : scene->steps * step,
            .rtol = fixed ? 0.0 : tolerance, .atol = fixed ? 0.0 : tolerance, .threads = threads);
  check_ok(hooke_integrator_run(integrator, state));
  uint64_t hash = hash_doubles(size, hooke_state_position(state), HASH_START);
  hash = hash_doubles(size, hooke_state_velocity(state), hash);
  tell(scene, method, threads, fixed ? "fixed" : "library", hash);
}

static void tell_forces(const struct scene *scene, const struct random_scene *made) {
  const int64_t size = 3 * hooke_system_particle_count(made->system);
  owned_doubles *q = new_doubles(size), *v = new_doubles(size), *force = new_doubles(size);
  random_scene_shake(made, 99, q, v);
  check_ok(hooke_system_force(made->system, 0.003, q, v, force));
  tell(scene, "force", 1, "fixed", hash_doubles(size, force, HASH_START));
  const double energy[] = {hooke_system_energy(made->system, "kinetic", NULL, v),
                           hooke_system_energy(made->system, "potential", q, NULL),
                           hooke_system_dissipated_power(made->system, q, v)};
  tell(scene, "energy", 1, "fixed", hash_doubles(3, energy, HASH_START));
  check_ok(hooke_system_derivative_product(made->system, 0.003, q, v, v, q, force));
  tell(scene, "derivative-product", 1, "fixed", hash_doubles(size, force, HASH_START));
}

static void test_print(void **unused) {
  (void)unused;
  for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
    const struct scene *scene = &scenes[k];
    struct random_scene made;
    random_scene_create(scene->request, &made);
    tell_forces(scene, &made);
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      if (hooke_method_is_built(hooke_method_name(m)) != 1) continue;
      for (int32_t threads = 1; threads <= THREADS; threads++)
        run_method(scene, made.system, hooke_method_name(m), threads);
    }
    random_scene_destroy(&made);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_print)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
