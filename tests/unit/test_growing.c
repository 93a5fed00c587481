/* The growing direction compared with the spectrum: never above the largest eigenvalue, and soon near it;
 * with every force. */
#include "measure/why/growing.h"
#include "measure/spectrum/eigen/dominant_mode.h"

#include "check.h"
#include "random_scene.h"

#include <math.h>
#include <stdlib.h>

enum { SCENES = 20, TURNS = 400 };

static struct random_scene build(uint64_t seed) {
  struct random_scene scene;
  random_scene_with(&scene, .seed = seed, .particles = 40, .springs = 120, .triples = seed % 2 ? 20 : 0,
                    .tetrahedra = seed % 3 ? 12 : 0, .anchors = (int64_t)(seed % 5),
                    .features = SCENE_GRAVITY | SCENE_DRAG | SCENE_DAMPING | SCENE_PULL_ONLY | SCENE_PINNED);
  return scene;
}

/* Largest eigenvalue of M^-1 (a K + b C). */
static double largest(const hooke_system *system, double a, double b) {
  owned(hk_linearised_release) struct hk_linearised lin;
  double value = 0.0, *mode = calloc((size_t)(3 * system->particle_count), sizeof *mode);
  check_ok(hk_linearised_create(system, system->position, NULL, NULL, NULL, &lin));
  const int32_t status =
      hk_dominant_mode(&lin, a * lin.rate * lin.rate, b * lin.rate, NULL, 1e-9, &value, mode);
  free(mode);
  if (status == HOOKE_NOT_BUILT) skip();
  check_ok(status);
  return value;
}

TEST(a_quotient_is_below_the_largest_eigenvalue_and_comes_near) {
  for (uint64_t seed = 1; seed <= SCENES; seed++) {
    owned_random_scene scene = build(seed);
    const hooke_system *system = scene.system;
    owned_doubles *still = calloc((size_t)(3 * system->particle_count), sizeof *still);
    for (int with_damping = 0; with_damping <= 1; with_damping++) {
      const double b = with_damping ? 0.02 : 0.0, most = largest(system, 1e-4, b);
      owned(hk_growing_release) struct hk_growing growing;
      check_ok(hk_growing_create(system, still, NULL, &growing));
      double before = hk_growing_quotient(&growing, system->position, 1e-4, b);
      for (int turn = 0; turn < 5; turn++) {
        const double quotient = hk_growing_turn(&growing, system->position, 1e-4, b, INFINITY, -1.0, 1);
        check_between(quotient, (1.0 - 1e-9) * before, (1.0 + 1e-9) * most);
        before = quotient;
      }
      check_between(hk_growing_turn(&growing, system->position, 1e-4, b, INFINITY, -1.0, TURNS), 0.97 * most,
                    (1.0 + 1e-9) * most);
    }
  }
}

/* It ends at the first iteration that proves a step too large, and when budget is over. */
static int32_t refuse(double done, const char *what, void *ctx) {
  (void)done, (void)what;
  return --*(int *)ctx < 0;
}

TEST(turns_end) {
  owned_random_scene scene = build(5);
  const hooke_system *system = scene.system;
  int calls = 3;
  struct hk_budget budget = hk_budget_of(INFINITY, refuse, &calls);
  owned(hk_growing_release) struct hk_growing growing;
  owned_doubles *still = calloc((size_t)(3 * system->particle_count), sizeof *still);
  check_ok(hk_growing_create(system, still, &budget, &growing));
  hk_growing_turn(&growing, system->position, 1e-4, 0.0, INFINITY, -1.0, 1000000);
  assert_true(budget.stopped && calls == -1);
  const double half = 0.5 * hk_growing_quotient(&growing, system->position, 1e-4, 0.0);
  assert_true(hk_growing_turn(&growing, system->position, 1e-4, 0.0, half, -1.0, 1000000) > half);
}
