/* Variants of a system: omitted contents are absent, and parts at another resolution represent the same
 * material. What is left as it was is in test_variant_same.c. */
#include "check.h"
#include "random_scene.h"
#include "run.h"
#include "small.h"

#include "model/group.h"
#include "model/variant/variant.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static hooke_system *make(const hooke_system *from, const struct hk_variant *variant,
                          struct hk_variant_map *map) {
  hooke_system *made;
  check_ok(hk_variant_make(from, variant, &made, map));
  return made;
}

static struct hk_variant nothing_of(const hooke_system *system) {
  struct hk_variant variant;
  check_ok(hk_variant_create(system, &variant));
  return variant;
}

static void leave_out(struct hk_variant *variant, const struct hk_force_row *force) {
  variant->without[hk_force_number(force)] = 1;
}

static void release(struct hk_variant *variant, struct hk_variant_map *map, hooke_system *made) {
  hk_variant_release(variant);
  hk_variant_map_release(map);
  hooke_system_destroy(made);
}

/* ---- a scene of two parts and a group that joins them ---- */

/* Particles 0 and 1 alone, a rope of 9 (2 to 10), a cloth of 7 x 5 (11 to 45). */
static hooke_system *two_parts(void) {
  const double alone[6] = {-1, 0, 0, 5, 5, 5};
  const int64_t ends[4] = {0, 2, 10, 11}, pinned = 1;
  hooke_system *system = small_system(2, alone, NULL, 0.5, 0);
  small_part(system, "rope", "rope",
             "from=0,0,0 to=2,0,0 segments=8 mass=1 pinned=0,1 stretch.stiffness=100 stretch.damping=0.1 "
             "bend.stiffness=10 bend.damping=0");
  small_part(system, "cloth", "cloth",
             "origin=0,0,1 edges=3,0,0,0,0,2 size=7,5 mass=2 pinned=top structural.stiffness=50 "
             "structural.damping=0.2 shear.stiffness=20 shear.damping=0");
  small_group(system, "springs", "ties", 2, ends, "stiffness=30 damping=0.3");
  check_ok(hooke_system_pin(system, 1, &pinned));
  check_ok(hooke_system_set_drag(system, 0.1));
  return small_falling(system);
}

enum { TIES = 0, STRETCH = 1, BEND = 2, STRUCTURAL = 3, SHEAR = 4, ROPE = 0, CLOTH = 1 };

static int64_t size_of(const hooke_system *system, const char *name) {
  for (int64_t g = 0; g < hooke_system_group_count(system, "springs"); g++) {
    if (strcmp(hooke_system_group_name(system, "springs", g), name) == 0)
      return hooke_system_group_size(system, "springs", g);
  }
  return 0;
}

static void check_sizes(const hooke_system *made, const int64_t size[5]) {
  static const char *const names[] = {"ties", "rope.stretch", "rope.bend", "cloth.structural", "cloth.shear"};
  for (int k = 0; k < 5; k++)
    assert_int_equal(size_of(made, names[k]), size[k]);
}

TEST(what_is_left_out_is_out) {
  hooke_system *system = two_parts(), *made;
  struct hk_variant variant = nothing_of(system);
  struct hk_variant_map map;
  check_sizes(system, (const int64_t[]){2, 8, 7, 58, 48});
  assert_int_equal(hooke_system_count(system, "forces"), 3);

  variant.group[BEND] = variant.group[TIES] = 1;
  leave_out(&variant, &hk_force_gravity);
  leave_out(&variant, &hk_force_drag);
  variant.damping = 1;
  made = make(system, &variant, &map);
  check_sizes(made, (const int64_t[]){0, 8, 0, 58, 48});
  assert_int_equal(hooke_system_count(made, "forces"), 1);
  double gamma[128];
  check_ok(hooke_system_members(made, "springs", NULL, NULL, gamma, NULL));
  for (int64_t k = 0; k < hooke_system_count(made, "springs"); k++)
    assert_true(gamma[k] == 0.0);
  release(&variant, &map, made);

  /* a part takes its springs with it, and those that tie it; later particles are renumbered */
  variant = nothing_of(system);
  variant.part[ROPE] = variant.particle[1] = 1;
  made = make(system, &variant, &map);
  check_sizes(made, (const int64_t[]){0, 0, 0, 58, 48});
  assert_int_equal(hooke_system_particle_count(made), 36);
  assert_int_equal(map.to[0], 0);
  assert_int_equal(map.to[1], -1);
  assert_int_equal(map.to[5], -1);
  assert_int_equal(map.to[11], 1);
  double place[3], *q = new_doubles(3 * 36);
  hk_variant_place(&map, 5, q, place);
  assert_true(isnan(place[0]));
  free(q);
  release(&variant, &map, made);
  hooke_system_destroy(system);
}

/* Two of the seven springs two apart in the rope; the rest is a group of its own, numbered among the explicit
 * ones. */
TEST(single_springs_of_a_family_are_left_out) {
  owned_system *system = two_parts();
  struct hk_variant variant = nothing_of(system);
  struct hk_variant_map map;
  variant.spring[2 + 8] = variant.spring[2 + 8 + 3] = variant.spring[1] = 1;
  hooke_system *made = make(system, &variant, &map);
  check_sizes(made, (const int64_t[]){1, 8, 5, 58, 48});
  int64_t ends[2 * 128];
  double kappa[128], gamma[128], full[128];
  check_ok(hooke_system_members(made, "springs", ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(made, "springs", NULL, kappa, gamma, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, full, NULL, NULL));
  const int64_t left[] = {3, 4, 6, 7, 8}; /* lower ends: 2 + 1, 2 + 2, 2 + 4, ... */
  for (int k = 0; k < 5; k++) {
    assert_int_equal(ends[2 * (1 + k)], left[k]);
    assert_int_equal(ends[2 * (1 + k) + 1], left[k] + 2);
    assert_true(kappa[1 + k] == full[2 + 8]);
  }
  release(&variant, &map, made);
}

/* ---- resolution ---- */

/* Positions of the variant that are an affine function of the material are recovered at every particle. */
static void check_affine(const hooke_system *system, const hooke_system *made,
                         const struct hk_variant_map *map) {
  owned_state *from = NULL, *to = NULL;
  check_ok(hooke_state_create(system, &from));
  check_ok(hooke_state_create(made, &to));
  double *q = hooke_state_position(to);
  for (int64_t p = 0; p < hooke_system_particle_count(made); p++) {
    const double x = q[3 * p], y = q[3 * p + 1], z = q[3 * p + 2];
    q[3 * p] = 1.0 + 2.0 * x - z;
    q[3 * p + 1] = y + 0.5 * x;
    q[3 * p + 2] = 3.0 * z - x;
  }
  for (int64_t p = 0; p < hooke_system_particle_count(system); p++) {
    const double *at = hooke_state_position(from) + 3 * p;
    double place[3];
    hk_variant_place(map, p, q, place);
    check_close(place[0], 1.0 + 2.0 * at[0] - at[2], 1e-14);
    check_close(place[1], at[1] + 0.5 * at[0], 1e-14);
    check_close(place[2], 3.0 * at[2] - at[0], 1e-14);
  }
}

static int64_t pinned_count(const hooke_system *system) {
  return hooke_system_particle_count(system) - hooke_system_count(system, "free");
}

TEST(parts_at_another_resolution_stand_for_the_same_material) {
  static const struct {
    double rope, cloth;
    int64_t particles, pinned;
  } cases[] = {
      {0.5, 1.0, 2 + 5 + 35, 1 + 2 + 7},  /* the clamp of two stays one */
      {2.0, 1.0, 2 + 17 + 35, 1 + 3 + 7}, /* and keeps its length */
      {4.0, 1.0, 2 + 33 + 35, 1 + 5 + 7},
      {1.0, 0.5, 2 + 9 + 4 * 3, 1 + 2 + 4}, /* 6 x 4 cells: 3 x 2 */
      {1.0, 2.0, 2 + 9 + 13 * 9, 1 + 2 + 13},
      {0.3, 0.01, 2 + 3 + 4, 1 + 1 + 2}, /* 8 cells: 2; one cell is the minimum */
  };
  owned_system *system = two_parts();
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    struct hk_variant variant = nothing_of(system);
    struct hk_variant_map map;
    variant.scale[ROPE] = cases[k].rope;
    variant.scale[CLOTH] = cases[k].cloth;
    hooke_system *made = make(system, &variant, &map);
    assert_int_equal(hooke_system_particle_count(made), cases[k].particles);
    assert_int_equal(pinned_count(made), cases[k].pinned);
    assert_int_equal(size_of(made, "ties"), 2);
    check_affine(system, made, &map);
    release(&variant, &map, made);
  }
}

TEST(a_callback_keeps_its_particles) {
  owned_random_scene scene;
  random_scene_with(&scene, .seed = 3, .particles = 12, .springs = 20, .cloth = {4, 4});
  owned(hk_variant_release) struct hk_variant variant = nothing_of(scene.system);
  struct hk_variant_map map;
  hooke_system *made = make(scene.system, &variant, &map);
  hooke_system_destroy(made);
  hk_variant_map_release(&map);

  const double at[6] = {0, 0, 0, 1, 0, 0}, mass = 1.0;
  owned_system *open = small_system(2, at, NULL, mass, 0);
  check_ok(hooke_system_set_force(open, idle_force, NULL, NULL));
  check_ok(hooke_system_commit(open));
  struct hk_variant fewer = nothing_of(open);
  fewer.particle[0] = 1;
  check_status(hk_variant_make(open, &fewer, &made, &map), HOOKE_UNSUITED);
  assert_null(made);
  leave_out(&fewer, &hk_force_callback); /* allowed without the callback */
  made = make(open, &fewer, &map);
  assert_int_equal(hooke_system_particle_count(made), 1);
  release(&fewer, &map, made);
}

/* ---- one within another ---- */

enum { MOST_SINGLE = 64 };

/* One thing left out. */
struct single {
  struct hk_variant variant;
  int64_t part;            /* the part that is left out or changed; -1 */
  int64_t of_part;         /* the part of the ingredient that is left out; -1 */
  int64_t group, of_group; /* the group of springs that is left out; that of the spring that is; -1 */
};

static struct single *next_single(const hooke_system *system, struct single *all, int *count) {
  struct single *single = &all[(*count)++];
  assert_true(*count <= MOST_SINGLE);
  *single = (struct single){nothing_of(system), -1, -1, -1, -1};
  return single;
}

/* Two parts, with springs, triples and tetrahedra of their own, and the same by hand. */
static hooke_system *everything(void) {
  const double place[] = {9, 0, 0, 9.3, 0, 0, 9.1, 0.28, 0, 9.12, 0.1, 0.26}, coefficient = 2;
  const int64_t ends[] = {0, 1, 1, 2, 2, 3}, triple[] = {0, 1, 2}, corners[] = {0, 1, 2, 3};
  hooke_system *system = small_system(4, place, NULL, 0.1, 0);
  small_part(system, "strand", "strand",
             "from=0,1,0 to=1,1,0 segments=4 mass=0.1 stretch.stiffness=20 stretch.damping=0 "
             "bend.stiffness=2 bend.damping=0 altitude.stiffness=1");
  small_part(system, "cloth", "cloth",
             "edges=1,0,0,0,0,1 size=3,3 mass=0.2 bending=0.001 structural.stiffness=20 "
             "structural.damping=0.1");
  small_group(system, "springs", "ties", 3, ends, "stiffness=30");
  check_ok(hooke_system_add_bending(system, "hinge", 1, triple, 1, &coefficient));
  small_group(system, "altitude", "body", 1, corners, "stiffness=3");
  return committed(system);
}

static int list_singles(const hooke_system *system, struct single *all) {
  int count = 0;
  int64_t first = 0;
  leave_out(&next_single(system, all, &count)->variant, &hk_force_gravity);
  leave_out(&next_single(system, all, &count)->variant, &hk_force_drag);
  leave_out(&next_single(system, all, &count)->variant, &hk_force_callback);
  next_single(system, all, &count)->variant.damping = 1;
  next_single(system, all, &count)->variant.compression = 1;
  next_single(system, all, &count)->variant.particle[2] = 1;
  for (int64_t g = 0; g < system->group_count; first += system->group[g++].count) {
    const struct hk_group *group = &system->group[g];
    struct single *whole = next_single(system, all, &count);
    whole->variant.group[g] = 1;
    whole->group = g;
    whole->of_part = group->from_part ? group->part : -1;
    if (group->force != &hk_force_springs) continue;
    struct single *one = next_single(system, all, &count);
    one->variant.spring[first + group->count - 1] = 1;
    one->of_group = g;
    one->of_part = whole->of_part;
  }
  for (int64_t k = 0; k < system->part_count; k++) {
    struct single *out = next_single(system, all, &count);
    out->variant.part[k] = 1;
    out->part = out->of_part = k;
    struct single *finer = next_single(system, all, &count);
    finer->variant.scale[k] = 2.0;
    finer->of_part = k;
  }
  return count;
}

static int is_within(const struct single *all, int outer, int inner) {
  const struct single *a = &all[outer], *b = &all[inner];
  if (a->part >= 0) return b->of_part == a->part;
  return a->group >= 0 && b->of_group == a->group;
}

/* An omission is contained in itself, and in that of its group or part; and in the union of two if it is in
 * either. */
TEST(variants_within_variants) {
  owned_system *system = everything();
  static struct single all[MOST_SINGLE];
  const int count = list_singles(system, all);
  owned(hk_variant_release) struct hk_variant nothing = nothing_of(system);
  assert_true(hk_system_groups_of(system, &hk_force_bending) >= 2);
  assert_true(hk_system_groups_of(system, &hk_force_altitude) >= 2 && system->part_count == 2);
  for (int i = 0; i < count; i++) {
    const int refined = all[i].of_part >= 0 && all[i].variant.scale[all[i].of_part] != 1.0;
    assert_int_equal(hk_variant_covers(system, &all[i].variant, &nothing), 1);
    assert_int_equal(hk_variant_covers(system, &nothing, &all[i].variant), 0);
    for (int j = 0; j < count; j++) {
      /* a part twice as fine does not even contain itself: joined, it would be four times as fine */
      const int expected = (i == j && !refined) || is_within(all, i, j);
      if (hk_variant_covers(system, &all[i].variant, &all[j].variant) != expected)
        check_failed("variants %d and %d of %d: not %d", i, j, count, expected);
      owned(hk_variant_release) struct hk_variant both = nothing_of(system);
      hk_variant_join(system, &both, &all[i].variant);
      hk_variant_join(system, &both, &all[j].variant);
      for (int k = 0; k < count; k++) {
        const int either = hk_variant_covers(system, &all[i].variant, &all[k].variant) ||
                           hk_variant_covers(system, &all[j].variant, &all[k].variant);
        assert_int_equal(hk_variant_covers(system, &both, &all[k].variant), either);
      }
    }
  }
  for (int i = 0; i < count; i++)
    hk_variant_release(&all[i].variant);
}
