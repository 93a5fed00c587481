/* Systems rebuilt with something left out: with nothing left out they are the same to the loop and the bit.
 */
#include "check.h"
#include "random_scene.h"
#include "run.h"

#include "model/variant/variant.h"

#include <stdlib.h>
#include <string.h>

/* One of these is left out, or the group `group` (-1: none). */
struct what {
  int32_t gravity, drag, force, damping;
  int64_t group;
};

static hooke_system *without(const hooke_system *system, struct what what) {
  struct hk_variant variant;
  struct hk_variant_map map;
  hooke_system *made;
  check_ok(hk_variant_create(system, &variant));
  variant.gravity = what.gravity;
  variant.drag = what.drag;
  variant.force = what.force;
  variant.damping = what.damping;
  if (what.group >= 0) variant.group[what.group] = 1;
  check_ok(hk_variant_make(system, &variant, &made, &map));
  hk_variant_map_release(&map);
  hk_variant_release(&variant);
  return made;
}

/* Those of `expected` but for one, in their order; groups without springs do not count. */
static void check_groups(const hooke_system *found, const hooke_system *expected, int64_t left_out) {
  int64_t at = 0;
  for (int64_t g = 0; g < expected->group_count; g++) {
    if (g == left_out || hooke_system_group_size(expected, "springs", g) == 0) continue;
    while (at < found->group_count && hooke_system_group_size(found, "springs", at) == 0)
      at++;
    assert_int_equal(hooke_system_group_size(found, "springs", at),
                     hooke_system_group_size(expected, "springs", g));
    assert_string_equal(hooke_system_group_name(found, "springs", at),
                        hooke_system_group_name(expected, "springs", g));
    at++;
  }
  for (; at < found->group_count; at++)
    assert_int_equal(hooke_system_group_size(found, "springs", at), 0);
}

static void check_same_loops(const hooke_system *found, const hooke_system *expected) {
  assert_int_equal(found->springs.run_count, expected->springs.run_count);
  assert_int_equal(found->strided.count, expected->strided.count);
  assert_int_equal(found->force_row_count, expected->force_row_count);
  assert_memory_equal(found->force_row, expected->force_row,
                      (size_t)expected->force_row_count * sizeof *found->force_row);
  for (int64_t r = 0; r < expected->springs.run_count; r++) {
    const struct hk_run *a = &found->springs.run[r], *b = &expected->springs.run[r];
    assert_true(a->loop == b->loop && a->first == b->first && a->count == b->count && a->shape == b->shape);
  }
  check_groups(found, expected, -1);
}

static void check_same_run(const hooke_system *found, const hooke_system *expected, const char *method) {
  const struct run run = {.method = method, .step = 1e-4, .duration = 2e-3};
  const int64_t size = 3 * hooke_system_particle_count(expected);
  double *a = new_doubles(2 * size), *b = new_doubles(2 * size);
  run_to_end(found, run, a, a + size);
  run_to_end(expected, run, b, b + size);
  check_same_bits(2 * size, a, b);
  free(a);
  free(b);
}

/* All combinations of features, with parts and drives of every kind. */
static void nothing_left_out_is_the_same(void **unused) {
  (void)unused;
  for (int32_t features = 0; features <= SCENE_EVERYTHING; features++) {
    struct random_scene scene;
    random_scene_create((struct random_scene_request){.seed = (uint64_t)(500 + features),
                                                      .particles = 40 + features % 50,
                                                      .springs = 3 * (features % 70),
                                                      .features = features,
                                                      .cloth = {features % 3 ? 12 : 0, 9},
                                                      .rope = features % 5 ? 25 : 0},
                        &scene);
    hooke_system *made = without(scene.system, (struct what){.group = -1});
    check_same_loops(made, scene.system);
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      if (is_fixed_step(hooke_method_name(m))) check_same_run(made, scene.system, hooke_method_name(m));
    }
    hooke_system_destroy(made);
    random_scene_destroy(&scene);
  }
}

static int has_force(const hooke_system *system, const char *name) {
  for (int64_t k = 0; k < hooke_system_count(system, "forces"); k++) {
    if (strcmp(hooke_system_force_name(system, k), name) == 0) return 1;
  }
  return 0;
}

/* One ingredient is gone and all others are unchanged. */
static void one_is_left_out(void **unused) {
  (void)unused;
  struct random_scene scene;
  random_scene_create(
      (struct random_scene_request){
          .seed = 8, .particles = 50, .springs = 70, .features = SCENE_EVERYTHING, .cloth = {12, 9}},
      &scene);
  static const char *const forces[] = {"springs", "drag", "callback", "gravity"};
  const struct what what[] = {
      {.group = -1}, {.drag = 1, .group = -1}, {.force = 1, .group = -1}, {.gravity = 1, .group = -1}};
  for (int k = 0; k < 4; k++) {
    hooke_system *made = without(scene.system, what[k]);
    for (int f = 0; f < 4; f++)
      assert_int_equal(has_force(made, forces[f]), f != k || k == 0);
    assert_int_equal(made->springs.count, scene.system->springs.count);
    hooke_system_destroy(made);
  }
  hooke_system *undamped = without(scene.system, (struct what){.damping = 1, .group = -1});
  assert_true(hk_springs_are_damped(&scene.system->springs));
  assert_false(hk_springs_are_damped(&undamped->springs));
  hooke_system_destroy(undamped);
  assert_in_range(scene.system->group_count, 2, 16);
  for (int64_t g = 0; g < scene.system->group_count; g++) {
    hooke_system *made = without(scene.system, (struct what){.group = g});
    check_groups(made, scene.system, g);
    hooke_system_destroy(made);
  }
  random_scene_destroy(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_left_out_is_the_same),
                                     cmocka_unit_test(one_is_left_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
