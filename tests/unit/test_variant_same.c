/* Systems rebuilt with something left out: with nothing left out they are the same to the loop and the bit.
 */
#include "check.h"
#include "random_scene.h"
#include "run.h"
#include "small.h"

#include "model/check_value.h"
#include "model/system.h"
#include "model/variant/variant.h"

#include <string.h>

/* One of these is left out, or the group `group` (-1: none). */
struct what {
  const struct hk_force_row *force;
  int32_t damping;
  int64_t group;
};

static hooke_system *without(const hooke_system *system, struct what what) {
  owned(hk_variant_release) struct hk_variant variant;
  owned(hk_variant_map_release) struct hk_variant_map map;
  hooke_system *made;
  check_ok(hk_variant_create(system, &variant));
  if (what.force) variant.without[hk_force_number(what.force)] = 1;
  variant.damping = what.damping;
  if (what.group >= 0) variant.group[what.group] = 1;
  check_ok(hk_variant_make(system, &variant, &made, &map));
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
  assert_int_equal(found->springs->run_count, expected->springs->run_count);
  assert_int_equal(found->strided->count, expected->strided->count);
  assert_int_equal(found->force_row_count, expected->force_row_count);
  assert_memory_equal(found->force_row, expected->force_row,
                      (size_t)expected->force_row_count * sizeof *found->force_row);
  for (int64_t r = 0; r < expected->springs->run_count; r++) {
    const struct hk_run *a = &found->springs->run[r], *b = &expected->springs->run[r];
    assert_true(a->loop == b->loop && a->first == b->first && a->count == b->count && a->shape == b->shape);
  }
  check_groups(found, expected, -1);
}

static void check_same_run(const hooke_system *found, const hooke_system *expected, const char *method) {
  const struct run run = {.method = method, .step = 1e-4, .duration = 2e-3};
  const int64_t size = 3 * hooke_system_particle_count(expected);
  owned_doubles *a = new_doubles(2 * size), *b = new_doubles(2 * size);
  run_to_end(found, run, a, a + size);
  run_to_end(expected, run, b, b + size);
  check_same_bits(2 * size, a, b);
}

/* Many combinations of features, with parts and drives of every kind. */
TEST(nothing_left_out_is_the_same) {
  for (int32_t features = 0; features <= SCENE_EVERYTHING; features += 7) {
    owned_random_scene scene;
    random_scene_with(&scene, .seed = (uint64_t)(500 + features), .particles = 40 + features % 50,
                      .springs = 3 * (features % 70), .features = features, .medium = features % 16,
                      .cloth = {features % 3 ? 12 : 0, 9}, .rope = features % 5 ? 25 : 0);
    owned_system *made = without(scene.system, (struct what){.group = -1});
    check_same_loops(made, scene.system);
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      const char *method = hooke_method_name(m);
      const int32_t linear = features % 16 < MEDIUM_QUADRATIC;
      if (is_fixed_step(method) && (linear || strcmp(method, "shardlow") != 0))
        check_same_run(made, scene.system, method);
    }
  }
}

static int has_force(const hooke_system *system, const char *name) {
  for (int64_t k = 0; k < hooke_system_count(system, "forces"); k++) {
    if (strcmp(hooke_system_force_name(system, k), name) == 0) return 1;
  }
  return 0;
}

/* One ingredient is gone and all others are unchanged. */
TEST(one_is_left_out) {
  owned_random_scene scene;
  random_scene_with(&scene, .seed = 8, .particles = 50, .springs = 70, .features = SCENE_EVERYTHING,
                    .cloth = {12, 9});
  static const char *const forces[] = {"springs", "drag", "callback", "gravity"};
  for (int k = 0; k < 4; k++) {
    const struct hk_force_row *force = k > 0 ? hk_force_find(forces[k]) : NULL;
    owned_system *made = without(scene.system, (struct what){.force = force, .group = -1});
    for (int f = 0; f < 4; f++)
      assert_int_equal(has_force(made, forces[f]), f != k || k == 0);
    assert_int_equal(made->springs->count, scene.system->springs->count);
  }
  owned_system *undamped = without(scene.system, (struct what){.damping = 1, .group = -1});
  assert_true(hk_force_is_damped(scene.system, &hk_force_springs));
  assert_false(hk_force_is_damped(undamped, &hk_force_springs));
  assert_in_range(scene.system->group_count, 2, 16);
  for (int64_t g = 0; g < scene.system->group_count; g++) {
    owned_system *made = without(scene.system, (struct what){.group = g});
    check_groups(made, scene.system, g);
  }
}

/* ---- every force of the table ---- */

static hooke_options *options_of(const char *table) {
  hooke_options *options = new_options(table);
  check_ok(hooke_options_set_number(options, "stiffness", 3.0));
  return options;
}

/* Six particles, and where a wind blows a rope, with every force that a system with inertia, or an overdamped
 * one, can have. */
static hooke_system *with_every_force(int32_t overdamped, int32_t wind) {
  static const double at[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0.5, 2, 0, 1}, one = 1.0;
  static const int64_t ends[4] = {0, 1, 4, 5}, triple[3] = {1, 0, 2}, corners[4] = {0, 1, 2, 3}, tied = 5;
  static const struct hk_element element = {
      .count = 1, .particle = {4}, .weight = {1.0}, .k_along = 2.0, .k_across = 2.0, .over = 1.0};
  owned_options *spring = options_of("springs"), *altitude = options_of("altitude"),
                *anchor = options_of("anchors");
  hooke_system *system = new_system();
  check_ok(hooke_system_set_dynamics(system, overdamped ? "overdamped" : "inertial"));
  check_ok(hooke_system_add_particles(system, 6, at, NULL, 1, &one, NULL));
  check_ok(hooke_system_add_springs(system, "pair", 2, ends, spring));
  check_ok(hooke_system_add_bending(system, "fold", 1, triple, 1, &one));
  check_ok(hooke_system_add_altitude(system, "solid", 1, corners, altitude));
  check_ok(hooke_system_add_anchors(system, "tie", 1, &tied, anchor));
  owned_options *load = options_with("loads", "force=0.1,0.2,0.3");
  check_ok(hooke_system_add_loads(system, 1, &tied, load));
  owned_options *ball = options_with("obstacles", "shape=sphere center=0,0.2,0 radius=0.4 stiffness=30");
  check_ok(hooke_system_add_obstacle(system, 2, (const int64_t[]){0, 1}, ball));
  hk_system_set_linear(system, 1, &element, at);
  check_ok(hooke_system_set_gravity(system, (const double[]){1.0, -9.81, 0.5}));
  if (wind && !overdamped)
    small_part(system, "rope", "rope",
               "from=0,0,0 to=1,1,0 segments=2 mass=1 fluid_drag.density=2 fluid_drag.diameter=0.3 "
               "fluid_drag.normal=1 fluid_drag.tangential=0.1");
  owned_options *medium =
      options_with("scene", "dynamics=%s drag=0.3%s%s", overdamped ? "overdamped" : "inertial",
                   wind ? " wind=1,2,3" : "", wind && !overdamped ? " quadratic_drag=1,2,3,4,5,6,7,8,9" : "");
  check_ok(hooke_scene_options_apply(medium, system));
  check_ok(hooke_system_set_force(system, random_scene_force, NULL, NULL));
  return committed(system);
}

/* Without this force; weight is left out and copied with gravity. */
static hooke_system *without_force(const hooke_system *system, const struct hk_force_row *row) {
  if (row->members) return without(system, (struct what){.group = hk_system_first_group(system, row)});
  return without(system, (struct what){row == &hk_force_weight ? &hk_force_gravity : row, .group = -1});
}

TEST(every_force_survives_a_copy_and_is_missed) {
  uint8_t seen[HOOKE_FORCES] = {0};
  for (int32_t kind = 0; kind < 4; kind++) {
    const int32_t overdamped = kind % 2;
    hooke_system *system = with_every_force(overdamped, kind / 2),
                 *made = without(system, (struct what){.group = -1});
    assert_null(hk_system_difference(made, system));
    assert_true(hk_system_check_value(made) == hk_system_check_value(system));
    check_same_loops(made, system);
    check_same_run(made, system, "rk4");
    hooke_system_destroy(made);
    for (int32_t k = 0; hk_force_table(k); k++) {
      const struct hk_force_row *row = hk_force_table(k);
      const int32_t of_both = overdamped && row != &hk_force_weight && row != &hk_force_wind;
      if (!hk_force_is_present(system, row) || of_both) continue;
      seen[k] = 1;
      made = without_force(system, row);
      assert_string_equal(hk_system_difference(made, system), row->name);
      assert_true(hk_system_check_value(made) != hk_system_check_value(system));
      hooke_system_destroy(made);
    }
    hooke_system_destroy(system);
  }
  for (int32_t k = 0; hk_force_table(k); k++) {
    const struct hk_force_row *row = hk_force_table(k);
    if (!seen[k] || !row->check ||
        !(row->members
              ? row->recall && row->place && row->member &&
                    (row->elements == NULL || row->width[row->is_drag ? HOOKE_GAMMA : HOOKE_KAPPA] == 1)
              : row->copy || row == &hk_force_weight))
      check_failed("%s is not in the scenes of this test, or has no check value or no copy", row->name);
  }
}

/* ---- a copy that is none ---- */

static void check_refused(const hooke_system *system, const char *what) {
  owned(hk_variant_release) struct hk_variant variant;
  struct hk_variant_map map;
  hooke_system *made;
  check_ok(hk_variant_create(system, &variant));
  variant.without[hk_force_number(&hk_force_drag)] = 1; /* also of a variant that leaves out something else */
  check_status(hk_variant_make(system, &variant, &made, &map), HOOKE_INTERNAL);
  assert_null(made);
  check_message(what);
}

/* A copy makes springs from the options of their group, and particles of a part from those of the part. */
TEST(what_a_copy_changes_is_named) {
  hooke_system *system = with_every_force(0, 0);
  hooke_options *options = system->group[0].options;
  check_ok(hooke_options_set_number(options, "stiffness", 4.0));
  check_refused(system, "changes its springs");
  check_ok(hooke_options_set_number(options, "stiffness", 3.0));
  hooke_system_destroy(without(system, (struct what){.force = &hk_force_drag, .group = -1}));
  hooke_system_destroy(system);
  system = small_cloth(3, 10.0, 0.1);
  system->position[4] += 1e-9;
  check_refused(system, "changes its particles");
  hooke_system_destroy(system);
}
