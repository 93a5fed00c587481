/* Some particles of a system as a system of their own: a particle on which nothing else acts has the bits of
 * its force in the whole. */
#include "check.h"
#include "owned.h"
#include "random.h"
#include "random_scene.h"

#include <string.h>

enum { SCENES = 12, PARTICLES = 60 };

static int same_place(const double *a, const double *b) {
  return !memcmp(a, b, 3 * sizeof *a);
}

static struct random_scene_request drawn(uint64_t seed) {
  return (struct random_scene_request){
      .seed = seed,
      .particles = PARTICLES,
      .springs = 70,
      .triples = seed % 3 ? 0 : 20,
      .tetrahedra = seed % 3 == 1 ? 10 : 0,
      .anchors = 9,
      .loads = 6,
      .factors = seed % 2,
      .features = (SCENE_EVERYTHING & ~(SCENE_DRIVEN | SCENE_CALLBACK)) | (seed % 2 ? SCENE_FOLLOWS : 0),
      .cloth = {6, 5},
      .medium = MEDIUM_DRAG | (seed % 2 ? MEDIUM_WIND | MEDIUM_QUADRATIC : 0)};
}

/* About three quarters of the particles, ascending; returns their number. */
static int64_t choose(int64_t n, struct random_source *source, int64_t *chosen) {
  int64_t count = 0;
  for (int64_t p = 0; p < n; p++)
    if (random_between(source, 0.0, 1.0) < 0.75) chosen[count++] = p;
  return count;
}

/* The force on every particle, and that where all that were not chosen are elsewhere. */
static void forces(const hooke_system *system, int64_t count, const int64_t *chosen, double *q, double *v,
                   double *force, double *elsewhere) {
  const int64_t n = hooke_system_particle_count(system);
  owned_doubles *moved = new_doubles(3 * n);
  for (int64_t k = 0; k < 3 * n; k++)
    moved[k] = 1.25 * q[k] + 3.0;
  for (int64_t k = 0; k < count; k++)
    memcpy(moved + 3 * chosen[k], q + 3 * chosen[k], 3 * sizeof *q);
  check_ok(hooke_system_force(system, 0.013, q, v, force));
  check_ok(hooke_system_force(system, 0.013, moved, v, elsewhere));
}

/* Adds how many chosen particles feel no other one, and how many do. */
static void check_taken(uint64_t seed, int64_t *inner, int64_t *outer) {
  owned_random_scene scene;
  random_scene_create(drawn(seed), &scene);
  const int64_t n = hooke_system_particle_count(scene.system);
  struct random_source source = {seed};
  owned_wholes *chosen = new_block(n, sizeof *chosen);
  const int64_t count = choose(n, &source, chosen);
  double *q = new_doubles(3 * n), *v = new_doubles(3 * n), *force = new_doubles(3 * n);
  double *elsewhere = new_doubles(3 * n), *part = new_doubles(3 * count);
  random_scene_shake(&scene, seed, q, v);
  forces(scene.system, count, chosen, q, v, force, elsewhere);
  owned_system *taken = NULL;
  check_ok(hooke_system_take(scene.system, count, chosen, &taken));
  for (int64_t k = 0; k < count; k++) {
    memcpy(q + 3 * k, q + 3 * chosen[k], 3 * sizeof *q);
    memcpy(v + 3 * k, v + 3 * chosen[k], 3 * sizeof *v);
  }
  check_ok(hooke_system_force(taken, 0.013, q, v, part));
  for (int64_t k = 0; k < count; k++) {
    const int feels = !same_place(force + 3 * chosen[k], elsewhere + 3 * chosen[k]);
    *(feels ? outer : inner) += 1;
    if (!feels) check_same_bits(3, part + 3 * k, force + 3 * chosen[k]);
  }
  double *all[] = {q, v, force, elsewhere, part};
  for (int k = 0; k < 5; k++)
    free(all[k]);
}

TEST(test_forces_of_what_was_taken) {
  int64_t inner = 0, outer = 0;
  for (uint64_t seed = 1; seed <= SCENES; seed++)
    check_taken(seed, &inner, &outer);
  assert_true(inner > 10 * SCENES && outer > 10 * SCENES);
}
