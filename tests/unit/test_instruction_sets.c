/* Runs of every fixed-step method have the bits listed here, with the loops of every instruction set of this
 * machine, at any optimisation of the build, for any number of threads. */
#include "check.h"
#include "hash.h"
#include "loops.h"
#include "lockstep.h"
#include "random_scene.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include "kernel/spring/spring_loops.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

static const struct scene {
  const char *name;
  struct random_scene_request request;
  double step;
} scenes[] = {
    {"cloth",
     {.seed = 1, .particles = 1, .features = SCENE_GRAVITY | SCENE_DAMPING | SCENE_DRAG, .cloth = {90, 90}},
     1e-4},
    {"net",
     {.seed = 2,
      .particles = 3000,
      .springs = 40000,
      .features = SCENE_GRAVITY | SCENE_DAMPING | SCENE_PINNED},
     1e-4},
    {"all",
     {.seed = 3,
      .particles = 300,
      .springs = 1200,
      .triples = 100,
      .features = SCENE_EVERYTHING,
      .cloth = {20, 20},
      .rope = 40},
     1e-4},
};
enum { SCENES = sizeof scenes / sizeof scenes[0], STEPS = 4 };

static uint64_t hash_of(const hooke_system *system, const char *method, double step, int32_t threads) {
  const int64_t size = 3 * hooke_system_particle_count(system);
  double *state = new_doubles(2 * size);
  run_to_end(system,
             (struct run){.method = method, .step = step, .duration = STEPS * step, .threads = threads},
             state, state + size);
  const uint64_t hash = hash_doubles(2 * size, state, HASH_START);
  free(state);
  return hash;
}

static const struct {
  const char *method;
  uint64_t hash[SCENES];
} expected[] = {
    {"forward-euler",
     {UINT64_C(0x76ddfbc6a6939e0d), UINT64_C(0xca37f17291f7188d), UINT64_C(0xf22573fbb183d3c6)}},
    {"symplectic-euler",
     {UINT64_C(0xeac4ff2c1ebde768), UINT64_C(0xe3e810384e798ed5), UINT64_C(0x997d0a425d34f29c)}},
    {"verlet", {UINT64_C(0x0c0b17ae8c5959c0), UINT64_C(0x9d733436c6da30dd), UINT64_C(0x404e888043926249)}},
    {"shardlow", {UINT64_C(0xebcac08d04ca37a0), UINT64_C(0x9a9e3e7cdc2eed33), UINT64_C(0x93271bf4281ec0c4)}},
    {"heun", {UINT64_C(0xbd5fd30434383e2e), UINT64_C(0x9d3f88b7dd489b5a), UINT64_C(0x05ad1f0526069e11)}},
    {"rk4", {UINT64_C(0xe4f21c7b4e25fe9d), UINT64_C(0xb8480818853f53d7), UINT64_C(0x05ad6ef5f38ebbdf)}},
    {"backward-euler",
     {UINT64_C(0xa69bc72a494afc8c), UINT64_C(0x5b62b4e3fa9964d7), UINT64_C(0x6a9c94e09b632e50)}},
    {"tr-bdf2", {UINT64_C(0x3e367e67c5530e37), UINT64_C(0xd2cbd729435376b2), UINT64_C(0xb8299f1144272fec)}},
    {"implicit-midpoint",
     {UINT64_C(0xaccb65f8579c529e), UINT64_C(0x7a6322e0405a0f21), UINT64_C(0xce555daea0bd3162)}},
};

static void check_scene(const struct scene *scene, int k) {
  for (int32_t set = 0; use_loops(set); set++) {
    struct random_scene made;
    random_scene_create(scene->request, &made); /* runs take their loops when a system is committed */
    for (size_t m = 0; m < sizeof expected / sizeof expected[0]; m++) {
      for (int32_t threads = 1; threads <= 3; threads++) {
        if (left_out(3 * (int64_t)m + threads + set, 4)) continue;
        const uint64_t hash = hash_of(made.system, expected[m].method, scene->step, threads);
        if (hash == expected[m].hash[k]) continue;
        check_failed("%s, %s, loops for %s, %d threads: hash %016" PRIx64 ", expected %016" PRIx64,
                     scene->name, expected[m].method, hk_spring_set(0)->name, (int)threads, hash,
                     expected[m].hash[k]);
      }
    }
    random_scene_destroy(&made);
  }
}

TEST(test_same_bits) {
  for (int k = 0; k < SCENES; k++)
    check_scene(&scenes[k], k);
}

/* Accelerations and steps are those of the plain loops, whatever a scene has. */
TEST(test_plain_loops) {
  for (int32_t set = 0; use_loops(set); set++) {
    for (uint64_t seed = 1; seed <= 12; seed++) {
      owned_random_scene scene;
      random_scene_create((struct random_scene_request){.seed = seed,
                                                        .particles = 7 + (int64_t)(seed * 37 % 900),
                                                        .springs = (int64_t)(seed * 53 % 1500),
                                                        .triples = (int64_t)(seed % 2 * (seed * 71 % 400)),
                                                        .tetrahedra = (int64_t)(seed % 3 * (seed * 37 % 90)),
                                                        .features = (int32_t)(seed * 29) & SCENE_EVERYTHING,
                                                        .cloth = {(int32_t)(seed % 4 * 7), 9},
                                                        .rope = (int32_t)(seed % 70)},
                          &scene);
      const double step = 0.00009765;
      for (size_t m = 0; m < sizeof expected / sizeof expected[0]; m++) {
        if (!is_implicit(expected[m].method))
          check_lockstep(&scene, expected[m].method, 1, scene.driven_count ? 0.0 : 0.003, step, 3);
      }
    }
  }
}

/* Springs that only pull, apart from each other, of lengths about that at rest: one that is slack has no
 * derivative. */
TEST(test_slack_springs_have_no_derivative) {
  enum { SPRINGS = 80 };
  owned_doubles *q = new_doubles(6 * SPRINGS), *v = new_doubles(6 * SPRINGS),
                *moved = new_doubles(6 * SPRINGS);
  owned_doubles *product = new_doubles(6 * SPRINGS);
  int64_t ends[2 * SPRINGS];
  for (int64_t k = 0; k < SPRINGS; k++) {
    ends[2 * k] = 2 * k, ends[2 * k + 1] = 2 * k + 1;
    q[6 * k + 3] = 0.61 + 0.01 * (double)k;
    q[6 * k + 1] = q[6 * k + 4] = (double)k;
    v[6 * k + 3] = 10.0; /* the damper alone would pull */
    moved[6 * k + 3] = 1.0;
  }
  for (int32_t set = 0; use_loops(set); set++) {
    owned_system *system = small_system(2 * SPRINGS, q, NULL, 1.0, 0);
    small_group(system, "springs", NULL, SPRINGS, ends,
                "law=length stiffness=20 damping=3 rest_length=1.005 compression=false");
    check_ok(hooke_system_commit(system));
    check_ok(hooke_system_derivative_product(system, 0.0, q, v, moved, moved, product));
    for (int64_t k = 0; k < SPRINGS; k++) {
      const double found = product[6 * k + 3], due = q[6 * k + 3] > 1.005 ? -23.0 : 0.0;
      if (fabs(found - due) > 1e-12)
        check_failed("loops for %s, length %g: %.17g, expected %g", hk_spring_set(0)->name, q[6 * k + 3],
                     found, due);
    }
  }
}

/* The compiler's own library, where it has one, knows the processor as well. */
TEST(test_best_set) {
#if defined(__x86_64__) && defined(__GNUC__)
  const int avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                     __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  const char *best = avx512 ? "avx512" : __builtin_cpu_supports("avx2") ? "avx2" : "baseline";
  assert_string_equal(hk_spring_set(0)->name, best);
#endif
  assert_string_equal(hk_spring_set(0)->name, hooke_build_fact("instructions"));
  assert_null(hk_spring_set(-1));
  int32_t last = 0;
  while (hk_spring_set(last + 1) != NULL)
    last++;
  assert_string_equal(hk_spring_set(last)->name, "baseline");
}

/* A new method needs its row. */
TEST(test_methods_are_complete) {
  int64_t rows = 0;
  for (int64_t m = 0; m < hooke_method_count(); m++)
    rows += is_fixed_step(hooke_method_name(m));
  assert_int_equal(rows, sizeof expected / sizeof expected[0]);
}
