/* Compares every force path of the library with the canonical sum, to the bit. */
#include "canonical.h"
#include "check.h"
#include "hash.h"
#include "lockstep.h"
#include "random.h"
#include "random_scene.h"
#include "run.h"
#include "small.h"
#include "sanitized.h"

#include <math.h>
#include <string.h>

static void compare_acceleration(const struct random_scene *scene, uint64_t seed) {
  const int64_t n = scene->canonical.particle_count;
  owned_doubles *q = new_doubles(3 * n), *v = new_doubles(3 * n), *found = new_doubles(3 * n);
  owned_doubles *expected = new_doubles(3 * n);
  random_scene_shake(scene, seed, q, v);
  memset(found, 0x55, (size_t)(3 * n) * sizeof(double));
  check_ok(hooke_system_acceleration(scene->system, 0.125, q, v, found));
  canonical_acceleration(&scene->canonical, 0.125, q, v, expected);
  assert_true(largest(3 * n, expected) < 1e9);
  check_same_bits(3 * n, found, expected);
}

/* An implicit step takes as long as fifty others. */
static int64_t steps_of(const struct random_scene *scene, const char *method, double step) {
  hooke_integrator *integrator = start_run(scene->system, (struct run){.method = method, .step = step});
  hooke_state *state = start_state(scene->system);
  check_ok(hooke_integrator_step(integrator, state, 1));
  const int solved = hooke_integrator_count(integrator, "linear_iterations") > 0;
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  return solved ? 2 : 10;
}

static void compare_scene(struct random_scene_request request) {
  struct random_scene scene;
  random_scene_create(request, &scene);
  compare_acceleration(&scene, request.seed + 1000);
  const double start = scene.driven_count ? 0.0 : 0.003;
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    const int linear = !(request.medium & (MEDIUM_QUADRATIC | MEDIUM_FLUID));
    if (!is_fixed_step(method) || (!linear && strcmp(method, "shardlow") == 0)) continue;
    /* a step that is no binary fraction: t0 + k h must be rounded in the same way */
    /* the fourth power of a step far too large overflows within ten steps, which Euler's first power does not
     */
    const double step = strcmp(method, "rk4") == 0 ? 0.00009765 : 0.0009765;
    check_lockstep(&scene, method, request.seed % 2 ? 2 : 1, start, step, steps_of(&scene, method, step));
  }
  random_scene_destroy(&scene);
}

/* Two scenes for each of the 256 combinations of features. */
TEST(test_small_scenes) {
  for (int32_t features = 0; features <= SCENE_EVERYTHING; features++) {
    for (uint64_t round = 0; round < 2; round++) {
      if (left_out(2 * features + (int64_t)round, 7)) continue;
      const uint64_t seed = 2 * (uint64_t)features + round + 1;
      compare_scene((struct random_scene_request){.seed = seed,
                                                  .particles = 7 + (int64_t)(seed * 37 % 900),
                                                  .springs = (int64_t)(seed * 53 % 1500),
                                                  .triples = (int64_t)(round * (seed * 71 % 400)),
                                                  .tetrahedra = (int64_t)(round * (seed * 37 % 90)),
                                                  .anchors = (int64_t)(seed * 29 % 3 * 11),
                                                  .loads = (int64_t)(features / 2 % 3 * 3 * (int64_t)round),
                                                  .factors = features % 5 == 3,
                                                  .features = features});
    }
  }
}

TEST(test_large_scenes) {
  const int32_t features[] = {0, SCENE_DAMPING | SCENE_GRAVITY,
                              SCENE_DAMPING | SCENE_PULL_ONLY | SCENE_DRIVEN, SCENE_EVERYTHING};
  const int64_t share = short_of_time() ? 3 : 1;
  for (uint64_t k = 0; k < sizeof features / sizeof features[0]; k++) {
    compare_scene((struct random_scene_request){.seed = 7001 + k,
                                                .particles = 15013 / share,
                                                .springs = 50021 / share,
                                                .triples = 5003 / share,
                                                .tetrahedra = 1501 / share,
                                                .anchors = k % 2 ? 1009 / share : 0,
                                                .loads = k == 1 ? 9 : 0,
                                                .factors = k % 2 == 1,
                                                .features = features[k]});
  }
}

TEST(test_parts) {
  const int32_t size[] = {2, 3, 4, 5, 8, 9, 16, 17, 33, 64, 70};
  const int32_t sizes = (int32_t)(sizeof size / sizeof size[0]);
  for (int32_t k = 0; k < sizes; k++) {
    for (int32_t m = 0; m < sizes; m++) {
      if (left_out(k * sizes + m, 7)) continue;
      const int32_t features = (k * sizes + m) * 29 & SCENE_EVERYTHING;
      compare_scene((struct random_scene_request){.seed = (uint64_t)(9000 + k * sizes + m),
                                                  .particles = 7 + m,
                                                  .springs = k == m ? 0 : 20,
                                                  .triples = m % 2 ? 5 : 0,
                                                  .tetrahedra = k % 3 == 1 && m % 2 ? 4 : 0,
                                                  .anchors = m % 3 == 1 ? 5 : 0,
                                                  .loads = k % 4 == 1 && m % 3 == 2 ? 4 : 0,
                                                  .features = features,
                                                  .cloth = {size[k], size[m]},
                                                  .rope = 1 + (k * sizes + m) % 70});
    }
  }
}

/* Drag of each particle, a wind, quadratic drag and parts in a fluid, alone and together. */
TEST(test_media) {
  static const int32_t media[] = {1, 2, 3, 6, 8, 13, 15};
  for (size_t k = 0; k < sizeof media / sizeof media[0]; k++) {
    const int32_t medium = media[k];
    const int32_t features[] = {SCENE_DRAG, SCENE_DAMPING | SCENE_GRAVITY | SCENE_PINNED | SCENE_DRIVEN,
                                SCENE_DRAG | SCENE_CALLBACK | SCENE_DAMPING | SCENE_PULL_ONLY};
    compare_scene((struct random_scene_request){.seed = (uint64_t)(13000 + medium),
                                                .particles = 9 + 3 * medium,
                                                .springs = 20,
                                                .features = features[medium % 3],
                                                .anchors = medium % 2 ? 4 : 0,
                                                .medium = medium,
                                                .cloth = {5, 4},
                                                .rope = 6});
  }
}

/* With additional particles and springs, and alone, where its springs form strided batches. */
TEST(test_lattices) {
  static const int32_t size[][3] = {{2, 2, 2},  {3, 2, 4}, {2, 17, 4},  {5, 4, 3},
                                    {16, 3, 5}, {9, 8, 7}, {13, 12, 11}};
  for (uint64_t k = 0; k < sizeof size / sizeof size[0]; k++) {
    const int32_t *n = size[k];
    const int alone = k % 2;
    compare_scene((struct random_scene_request){.seed = 12000 + k,
                                                .particles = alone ? 7 : 40,
                                                .springs = alone ? 0 : 30,
                                                .loads = k == 3 || k == 4 ? 3 : 0,
                                                .factors = k % 3 == 1,
                                                .features = (int32_t)(k * 53) & SCENE_EVERYTHING,
                                                .lattice = {n[0], n[1], n[2]}});
  }
}

/* Springs that follow time: in runs, in strided batches and in a tiled one, of many materials and of one. */
TEST(test_springs_that_follow_time) {
  for (uint64_t seed = 1; seed <= 12; seed++)
    compare_scene(
        (struct random_scene_request){.seed = 20000 + seed,
                                      .particles = 7 + (int64_t)(seed * 97 % 500),
                                      .springs = (int64_t)(seed * 211 % 1900),
                                      .features = SCENE_FOLLOWS | (int32_t)(seed * 29 & SCENE_EVERYTHING),
                                      .rope = (int32_t)(seed % 3 * 30)});
  compare_scene((struct random_scene_request){.seed = 20100,
                                              .particles = 7,
                                              .features = SCENE_FOLLOWS | SCENE_DAMPING | SCENE_GRAVITY,
                                              .cloth = {40, 30}});
  compare_scene((struct random_scene_request){
      .seed = 20101, .particles = 7, .features = SCENE_FOLLOWS | SCENE_PULL_ONLY, .lattice = {9, 8, 7}});
}

/* A chain whose springs each have a stiffness, which is a strided batch, and springs of one material in no
 * order, which are a tiled one of shared numbers. */
TEST(test_batches_that_follow_time) {
  enum { N = 300 };
  for (int scattered = 0; scattered < 2; scattered++) {
    struct random_source source = {21000};
    double place[3 * N], v[3 * N] = {0}, stiffness[N], found[3 * N], expected[3 * N];
    int64_t ends[2 * N];
    for (int k = 0; k < N; k++) {
      for (int a = 0; a < 3; a++)
        place[3 * k + a] = random_between(&source, a == 0 ? k : 0.0, a == 0 ? k + 0.9 : 0.9);
      stiffness[k] = random_between(&source, 5.0, 9.0);
      ends[2 * k] = scattered ? random_whole(&source, 0, N - 10) : k % (N - 1);
      ends[2 * k + 1] = ends[2 * k] + (scattered ? random_whole(&source, 1, 9) : 1);
    }
    owned_system *system = small_system(N, place, NULL, 1.0, 0);
    owned_options *options = options_with("springs", "law=length stiffness=7 damping=0.2 rest_length=0.7");
    if (!scattered) check_ok(hooke_options_set_numbers(options, "stiffness", N - 1, stiffness));
    canonical_follow(options, "");
    check_ok(hooke_system_add_springs(system, "follows", scattered ? N : N - 1, ends, options));
    check_ok(hooke_system_commit(system));
    owned_canonical canonical;
    canonical_create(system, &canonical);
    check_ok(hooke_system_acceleration(system, 0.004, place, v, found));
    canonical_acceleration(&canonical, 0.004, place, v, expected);
    check_same_bits((int64_t)3 * N, found, expected);
  }
}

/* A scene listed spring by spring is summed like the same scene made of parts. */
TEST(test_parts_are_springs) {
  owned_random_scene parts;
  random_scene_create((struct random_scene_request){.seed = 3,
                                                    .particles = 7,
                                                    .springs = 12,
                                                    .features = SCENE_DAMPING | SCENE_GRAVITY,
                                                    .cloth = {23, 40},
                                                    .rope = 31},
                      &parts);
  const struct canonical *c = &parts.canonical;
  const int64_t n = c->particle_count, m = c->spring_count;
  owned_doubles *q = new_doubles(3 * n), *v = new_doubles(3 * n), *found = new_doubles(3 * n);
  owned_doubles *expected = new_doubles(3 * n);
  random_scene_shake(&parts, 4, q, v);

  hooke_system *listed = new_system();
  check_ok(hooke_system_add_particles(listed, n, q, v, n, hooke_system_mass(parts.system), NULL));
  hooke_options *options = options_with("springs", "law=length");
  check_ok(hooke_options_set_numbers(options, "stiffness", m, c->kappa));
  check_ok(hooke_options_set_numbers(options, "damping", m, c->gamma));
  check_ok(hooke_options_set_numbers(options, "rest_length", m, c->rest_length));
  check_ok(hooke_system_add_springs(listed, NULL, m, c->ends, options));
  check_ok(hooke_system_set_gravity(listed, parts.gravity));
  check_ok(hooke_system_commit(listed));
  hooke_options_destroy(options);

  check_ok(hooke_system_acceleration(parts.system, 0.0, q, v, expected));
  check_ok(hooke_system_acceleration(listed, 0.0, q, v, found));
  check_same_bits(3 * n, found, expected);
  hooke_system_destroy(listed);
}

/* The comparison itself: one unit in the last place, and another order of the springs, must be detected. */
TEST(test_planted_faults) {
  owned_random_scene scene;
  random_scene_create(
      (struct random_scene_request){
          .seed = 11, .particles = 200, .springs = 2000, .features = SCENE_DAMPING | SCENE_GRAVITY},
      &scene);
  struct canonical *c = &scene.canonical;
  const int64_t n = c->particle_count, m = c->spring_count;
  owned_doubles *q = new_doubles(3 * n), *v = new_doubles(3 * n), *a = new_doubles(3 * n);
  owned_doubles *b = new_doubles(3 * n);
  random_scene_shake(&scene, 12, q, v);
  canonical_acceleration(c, 0.0, q, v, a);

  memcpy(b, a, (size_t)(3 * n) * sizeof(double));
  assert_int_equal(first_difference(3 * n, a, b), -1);
  assert_true(hash_doubles(3 * n, a, HASH_START) == hash_doubles(3 * n, b, HASH_START));
  b[3 * n - 1] = nextafter(b[3 * n - 1], INFINITY);
  assert_int_equal(first_difference(3 * n, a, b), 3 * n - 1);
  assert_true(hash_doubles(3 * n, a, HASH_START) != hash_doubles(3 * n, b, HASH_START));

  for (int64_t low = 0, high = m - 1; low < high; low++, high--) {
    for (int end = 0; end < 2; end++) {
      const int64_t keep = c->ends[2 * low + end];
      c->ends[2 * low + end] = c->ends[2 * high + end];
      c->ends[2 * high + end] = keep;
    }
    double *const material[] = {c->kappa, c->gamma, c->rest_length};
    for (int k = 0; k < 3; k++) {
      const double keep = material[k][low];
      material[k][low] = material[k][high];
      material[k][high] = keep;
    }
  }
  canonical_acceleration(c, 0.0, q, v, b);
  assert_true(first_difference(3 * n, a, b) >= 0);
  assert_true(largest_difference(3 * n, a, b) <
              1e-9 * largest(3 * n, a)); /* the same physics in another order */
}

/* Triples in another order must be detected. */
TEST(test_planted_bending) {
  owned_random_scene scene;
  random_scene_create((struct random_scene_request){.seed = 31, .particles = 200, .triples = 900}, &scene);
  struct canonical *c = &scene.canonical;
  const int64_t n = c->particle_count, m = c->triple_count;
  assert_true(m > 500);
  owned_doubles *q = new_doubles(3 * n), *v = new_doubles(3 * n), *a = new_doubles(3 * n);
  owned_doubles *b = new_doubles(3 * n);
  random_scene_shake(&scene, 32, q, v);
  canonical_acceleration(c, 0.0, q, v, a);
  check_ok(hooke_system_acceleration(scene.system, 0.0, q, v, b));
  check_same_bits(3 * n, b, a);
  for (int64_t low = 0, high = m - 1; low < high; low++, high--) {
    for (int e = 0; e < 3; e++) {
      const int64_t keep = c->triples[3 * low + e];
      c->triples[3 * low + e] = c->triples[3 * high + e];
      c->triples[3 * high + e] = keep;
    }
    const double keep = c->coefficient[low];
    c->coefficient[low] = c->coefficient[high];
    c->coefficient[high] = keep;
  }
  canonical_acceleration(c, 0.0, q, v, b);
  assert_true(first_difference(3 * n, a, b) >= 0);
  assert_true(largest_difference(3 * n, a, b) < 1e-9 * largest(3 * n, a));
}

/* Tetrahedra in another order, or with two corners exchanged, must be detected. */
TEST(test_planted_altitude) {
  owned_random_scene scene;
  random_scene_create((struct random_scene_request){.seed = 41, .particles = 60, .tetrahedra = 400}, &scene);
  struct canonical *c = &scene.canonical;
  const int64_t n = c->particle_count, m = c->tetrahedron_count;
  assert_true(m > 200);
  owned_doubles *q = new_doubles(3 * n), *v = new_doubles(3 * n), *a = new_doubles(3 * n);
  owned_doubles *b = new_doubles(3 * n);
  random_scene_shake(&scene, 42, q, v);
  canonical_acceleration(c, 0.0, q, v, a);
  check_ok(hooke_system_acceleration(scene.system, 0.0, q, v, b));
  check_same_bits(3 * n, b, a);
  for (int64_t low = 0, high = m - 1; low < high; low++, high--) {
    for (int e = 0; e < 4; e++) {
      const int64_t keep = c->corners[4 * low + e];
      c->corners[4 * low + e] = c->corners[4 * high + e];
      c->corners[4 * high + e] = keep;
    }
    for (int k = 0; k < 9; k++) {
      double *numbers = c->altitude[k < 2 ? k : 2];
      const int64_t i = k < 2 ? low : 7 * low + k - 2, j = k < 2 ? high : 7 * high + k - 2;
      const double keep = numbers[i];
      numbers[i] = numbers[j];
      numbers[j] = keep;
    }
  }
  canonical_acceleration(c, 0.0, q, v, b);
  assert_true(first_difference(3 * n, a, b) >= 0);
  assert_true(largest_difference(3 * n, a, b) < 1e-9 * largest(3 * n, a));
  /* with two corners exchanged rest lengths are those of other altitudes */
  canonical_acceleration(c, 0.0, q, v, a);
  for (int64_t k = 0; k < m; k++) {
    const int64_t keep = c->corners[4 * k];
    c->corners[4 * k] = c->corners[4 * k + 1];
    c->corners[4 * k + 1] = keep;
  }
  canonical_acceleration(c, 0.0, q, v, b);
  assert_true(largest_difference(3 * n, a, b) > 1e-3 * largest(3 * n, a));
}

/* Steps that are solved for: a velocity off by 1e-7 of the largest change, or 1e-3 with Verlet, which solves
 * no better than its order needs, and a position off by a bit, or by 1e-10 m where it goes through those of
 * stages, have to show. */
TEST(test_planted_defects) {
  const char *methods[] = {"verlet", "backward-euler", "tr-bdf2", "implicit-midpoint"};
  const double start = 0.003, h = 0.0009765;
  owned_random_scene scene;
  random_scene_create((struct random_scene_request){.seed = 21,
                                                    .particles = 200,
                                                    .springs = 600,
                                                    .features = SCENE_DAMPING | SCENE_GRAVITY | SCENE_DRAG},
                      &scene);
  const int64_t size = 3 * scene.canonical.particle_count;
  owned_doubles *q = new_doubles(size), *v = new_doubles(size);
  random_scene_shake(&scene, 22, q, v);
  for (int m = 0; m < 4; m++) {
    owned_state *state = start_state(scene.system);
    double *q1 = hooke_state_position(state), *v1 = hooke_state_velocity(state);
    memcpy(q1, q, (size_t)size * sizeof(double));
    memcpy(v1, v, (size_t)size * sizeof(double));
    hooke_state_set_time(state, start);
    hooke_integrator *integrator =
        start_run(scene.system, (struct run){.method = methods[m], .step = h, .verlet_damping = "implicit"});
    check_ok(hooke_integrator_step(integrator, state, 1));
    hooke_integrator_destroy(integrator);
    const struct canonical *c = &scene.canonical;
    const double end = start + h;
    check_between(canonical_defect(c, methods[m], start, end, h, q, v, q1, v1), 0.0, 1.0);
    const double keep = q1[17], wrong = (m == 0 ? 1e-3 : 1e-7) * largest_difference(size, v, v1);
    q1[17] = m < 2 ? nextafter(keep, INFINITY) : keep + 1e-10;
    const double found = canonical_defect(c, methods[m], start, end, h, q, v, q1, v1);
    assert_true(m == 2 ? found > 1.0 : isinf(found));
    q1[17] = keep;
    v1[17] += wrong;
    if (m == 1) q1[17] = q[17] + h * v1[17];
    if (m == 3) q1[17] = q[17] + h * ((v[17] + v1[17]) / 2.0);
    assert_true(canonical_defect(c, methods[m], start, end, h, q, v, q1, v1) > 1.0);
  }
}

/* FNV-1a of known bytes: 0.0 is eight zero bytes, and the bytes of 1.0 end in f0 3f. */
TEST(test_hash) {
  const double zero = 0.0, one = 1.0, minus_zero = -0.0;
  assert_true(hash_doubles(0, &zero, HASH_START) == HASH_START);
  uint64_t expected = HASH_START;
  for (int k = 0; k < 8; k++)
    expected *= UINT64_C(0x100000001b3);
  assert_true(hash_doubles(1, &zero, HASH_START) == expected);
  assert_true(hash_doubles(1, &one, HASH_START) != expected);
  assert_int_equal(first_difference(1, &zero, &minus_zero), 0);
}
