/* A system written as a scene and read again is the same system, to the bit. */
#include "model/check_value.h"
#include "model/force/drive.h"
#include "model/variant/variant.h"
#include "check.h"
#include "small.h"
#include "random_scene.h"

#include "model/system.h"

#include <string.h>
#include <unistd.h>

static void check_springs(const hooke_system *found, const hooke_system *expected) {
  const int64_t count = hooke_system_count(expected, "springs");
  assert_int_equal(hooke_system_count(found, "springs"), count);
  owned_doubles *a = new_doubles(3 * count), *b = new_doubles(3 * count);
  owned_wholes *ends = new_block(2 * count, sizeof *ends), *other = new_block(2 * count, sizeof *other);
  check_ok(hooke_system_members(found, "springs", ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(expected, "springs", other, NULL, NULL, NULL));
  assert_memory_equal(ends, other, (size_t)(2 * count) * sizeof *ends);
  check_ok(hooke_system_members(found, "springs", NULL, a, a + count, a + 2 * count));
  check_ok(hooke_system_members(expected, "springs", NULL, b, b + count, b + 2 * count));
  check_same_bits(3 * count, a, b);
}

static void check_same_system(const hooke_system *found, const hooke_system *expected) {
  const int64_t n = expected->particle_count;
  assert_int_equal(found->particle_count, n);
  check_same_bits(3 * n, found->position, expected->position);
  assert_int_equal(found->velocity != NULL, expected->velocity != NULL);
  if (found->velocity) check_same_bits(3 * n, found->velocity, expected->velocity);
  check_same_bits(n, found->mass, expected->mass);
  assert_memory_equal(found->constrained, expected->constrained, (size_t)n);
  assert_int_equal(found->group_count, expected->group_count);
  for (int64_t g = 0; g < expected->group_count; g++)
    assert_string_equal(found->group[g].name, expected->group[g].name);
  check_springs(found, expected);
  check_same_bits(3, found->gravity, expected->gravity);
  check_same_bits(1, &found->drag, &expected->drag);
  assert_int_equal(found->drive_count, expected->drive_count);
  assert_true(hk_system_check_value(found) == hk_system_check_value(expected));
}

/* A scene that is made in memory has the text that is written. */
static void check_in_memory(const hooke_system *system, const hooke_options *run,
                            const hooke_scene *written) {
  owned_scene *made = NULL;
  check_ok(hooke_scene_of_system(system, hooke_scene_text(written, "title"), run, "memory", NULL, &made));
  assert_string_equal(hooke_scene_text(made, "text"), hooke_scene_text(written, "text"));
  check_ok(hooke_scene_commit(made));
  check_same_system(hooke_scene_system(made), system);
}

static void write_and_read(const hooke_system *system, hooke_scene **scene) {
  char path[] = "/tmp/hooke-scene-XXXXXX";
  const int descriptor = mkstemp(path);
  assert_true(descriptor >= 0);
  close(descriptor);
  owned_options *run = options_with("run", "step=0.1 method=rk4");
  check_ok(hooke_scene_write(path, system, "a \"title\" \\ <b> \xc3\xa4", run));
  check_ok(hooke_scene_load(path, NULL, scene));
  check_ok(hooke_scene_commit(*scene));
  assert_string_equal(hooke_scene_text(*scene, "title"), "a \"title\" \\ <b> \xc3\xa4");
  assert_true(hooke_options_number(hooke_scene_run_options(*scene), "step") == 0.1);
  assert_string_equal(hooke_options_text(hooke_scene_run_options(*scene), "method"), "rk4");
  assert_false(hooke_options_is_set(hooke_scene_run_options(*scene), "duration"));
  check_in_memory(system, run, *scene);
  unlink(path);
}

TEST(random_systems_come_back) {
  for (uint64_t seed = 1; seed <= 64; seed++) {
    const int32_t features = (int32_t)(seed * 29) & SCENE_EVERYTHING & ~(SCENE_CALLBACK | SCENE_DRIVEN);
    owned_random_scene scene;
    owned_scene *read = NULL;
    random_scene_with(&scene, .seed = seed, .particles = 20, .springs = 40, .features = features,
                      .triples = (int64_t)(seed % 3 * 4), .medium = (int32_t)(seed % 16), .cloth = {5, 4},
                      .lattice = {3, 4, 2}, .rope = 7);
    write_and_read(scene.system, &read);
    check_same_system(hooke_scene_system(read), scene.system);
  }
}

/* A lattice and a mesh from a file, with pins beyond those of their options: the mesh is written with its
 * numbers, so that the scene needs no file. */
TEST(lattice_and_mesh_come_back) {
  const double amplitude[3] = {0, 0.1, 0};
  const int64_t pinned[2] = {5, 65}, driven = 61;
  owned_scene *read = NULL;
  hooke_system *system =
      small_part(NULL, "lattice", "block",
                 "origin=0.1,0.2,0.3 edges=1.1,0.1,0,0,0.7,0,0.2,0,0.3 size=4,3,5 density=3 pinned=top,3 "
                 "shear.stiffness=7 shear.damping_ratio=0.1");
  owned_options *mesh = options_with("mesh",
                                     "mass=0.7 transform.scale=0.1 transform.translate=%.17g,5,-2 weld=1e-5 "
                                     "structural.stiffness=3 bend.stiffness=2 bend.damping_ratio=0.2",
                                     1.0 / 3.0);
  check_ok(hooke_mesh_read(HOOKE_SOURCE_DIR "/examples/scenes/ball.obj", mesh));
  check_ok(hooke_system_add_part(system, "mesh", "ball", mesh, NULL, NULL));
  check_ok(hooke_system_pin(system, 2, pinned));
  check_ok(hooke_system_drive_harmonic(system, 1, &driven, amplitude, 2.0, 0.5));
  check_ok(hooke_system_commit(system));
  assert_int_equal(system->particle_count, 60 + 42);
  write_and_read(system, &read);
  check_same_system(hooke_scene_system(read), system);
  hooke_system_destroy(system);
}

/* A part comes before the particles, which a scene numbers first; and the wind is a table. */
TEST(drag_of_each_particle_comes_back) {
  const double drag[5] = {1, 2, 3, 4, 5}, place[6] = {5, 0, 0, 6, 0, 0}, one = 1.0, time[2] = {0, 2},
               velocity[6] = {1, 2, 3, 4, 5, 6}, numbered[5] = {4, 5, 1, 2, 3};
  owned_scene *read = NULL;
  owned_system *system =
      small_part(NULL, "rope", "rope",
                 "from=0,0,0 to=1,0,0 segments=2 mass=1 stretch.stiffness=1 fluid_drag.density=2 "
                 "fluid_drag.diameter=0.3 fluid_drag.normal=1 fluid_drag.tangential=0.1");
  check_ok(hooke_system_add_particles(system, 2, place, NULL, 1, &one, NULL));
  owned_options *options = options_with("scene", "quadratic_drag=0.5");
  check_ok(hooke_options_set_numbers(options, "drag", 5, drag));
  check_ok(hooke_options_set_numbers(options, "wind.time", 2, time));
  check_ok(hooke_options_set_numbers(options, "wind.velocity", 6, velocity));
  check_ok(hooke_scene_options_apply(options, system));
  check_ok(hooke_system_commit(system));
  check_ok(hooke_scene_of_system(system, NULL, NULL, "memory", NULL, &read));
  check_ok(hooke_scene_commit(read));
  const struct hk_medium *found = hooke_scene_system(read)->medium;
  check_same_bits(5, found->drag.value, numbered);
  assert_true(found->quadratic_drag.most == 0.5 && found->quadratic_drag.value == NULL);
  check_same_bits(2, found->wind.time, time);
  check_same_bits(6, found->wind.value, velocity);
  assert_int_equal(hooke_system_count(hooke_scene_system(read), "fluid_drag"), 2);
}

static void add_strand(hooke_system *system, int curl) {
  small_part(
      system, "strand", curl ? "curl" : NULL,
      "from=0.1,0.2,0.3 to=1.7,0.1,-0.6 segments=13 %s density=0.7 pinned=start,3 bend.stiffness=3 "
      "altitude.stiffness=7 altitude.damping_ratio=0.3 altitude.rest_scale=0.9 altitude.compression=%s",
      curl ? "curl=0.3 turns=-2.3" : "offset=0.3", curl ? "true" : "false");
}

/* Tetrahedra of parts are equal to the bit; a scene cannot express explicit ones. */
TEST(strands_come_back) {
  hooke_system *system;
  owned_scene *read = NULL;
  check_ok(hooke_system_create(&system));
  add_strand(system, 0);
  add_strand(system, 1);
  check_ok(hooke_system_commit(system));
  write_and_read(system, &read);
  const hooke_system *found = hooke_scene_system(read);
  check_same_system(found, system);
  assert_int_equal(system->altitudes->count, 24 + 11);
  assert_int_equal(found->altitudes->count, system->altitudes->count);
  assert_memory_equal(found->altitudes->tetrahedron, system->altitudes->tetrahedron,
                      (size_t)system->altitudes->count * sizeof *system->altitudes->tetrahedron);
  hooke_system_destroy(system);

  const int64_t corners[4] = {0, 1, 2, 3};
  check_ok(hooke_system_create(&system));
  add_strand(system, 1);
  small_group(system, "altitude", "mine", 1, corners, "stiffness=1");
  check_ok(hooke_system_commit(system));
  check_status(hooke_scene_write("/tmp/hooke-never-written.json", system, NULL, NULL), HOOKE_UNSUITED);
  check_message("tetrahedra of its own");
  hooke_system_destroy(system);
}

/* Of one material and of many, by both laws, in parts, and dropped members among them. */
TEST(springs_that_follow_time_come_back) {
  const char *const words[] = {
      "law=strain stiffness=3 damping=0.2 rest_length=0.7,1.1,0.3 rest_scale.motion=harmonic rest_scale.mean=1.1 "
      "rest_scale.amplitude=-0.3 rest_scale.frequency=2 rest_scale.phase=0.1",
      "law=length stiffness=3,0,5 damping=0.1 stiffness_scale.motion=table stiffness_scale.time=-1,0.1,2 "
      "stiffness_scale.value=0.2,1,0",
      "stiffness=3 rest_scale.motion=table rest_scale.time=0,1 rest_scale.value=1,0.5 stiffness_scale=2"};
  const int64_t ends[6] = {0, 1, 2, 1, 3, 0};
  owned_scene *read = NULL;
  owned_system *system = new_system();
  small_part(
      system, "rope", "line",
      "from=0.1,0.2,0.3 to=1.7,0.1,-0.6 segments=13 mass=0.7 stretch.stiffness=3 stretch.damping_ratio=0.3 "
      "stretch.rest_scale.motion=harmonic stretch.rest_scale.amplitude=0.3 stretch.rest_scale.frequency=2");
  for (int k = 0; k < 3; k++)
    small_group(system, "springs", "some", 3, ends, words[k]);
  check_ok(hooke_system_commit(system));
  assert_true(system->springs->scaled);
  write_and_read(system, &read);
  check_same_system(hooke_scene_system(read), system);
}

/* Triples are equal to the bit, beside those of parts; an empty group keeps its place. */
TEST(bending_comes_back) {
  const double coefficient[2] = {0.1 + 0.2, 1.0 / 3.0}, zero = 0.0;
  const int64_t triples[6] = {3, 1, 0, 2, 4, 5};
  owned_scene *read = NULL;
  owned_system *system = new_system();
  add_strand(system, 1);
  check_ok(hooke_system_add_bending(system, "two", 2, triples, 2, coefficient));
  check_ok(hooke_system_add_bending(system, "none", 2, triples, 1, &zero));
  check_ok(hooke_system_add_bending(system, NULL, 1, triples, 1, coefficient));
  check_ok(hooke_system_commit(system));
  write_and_read(system, &read);
  check_same_system(hooke_scene_system(read), system);
  assert_int_equal(hooke_system_count(hooke_scene_system(read), "bending"), 3);
  assert_int_equal(hk_system_groups_of(hooke_scene_system(read), &hk_force_bending), 3);
}

/* Anchors are equal to the bit, in a variant that leaves a group out, too; an empty group keeps its place. */
TEST(anchors_come_back) {
  const double stiffness[2] = {0.1 + 0.2, 7.0}, point[6] = {1.0 / 3.0, 2, 3, 4, 5, 6};
  const int64_t tied[2] = {5, 3};
  int64_t particle[3];
  double points[9], number[3][3];
  owned_system *system = NULL, *made = NULL;
  owned_scene *read = NULL;
  owned(hk_variant_release) struct hk_variant variant;
  owned(hk_variant_map_release) struct hk_variant_map map;
  check_ok(hooke_system_create(&system));
  add_strand(system, 1);
  owned_options *options = options_with("anchors", "stiffness=0");
  check_ok(hooke_system_add_anchors(system, "nothing", 1, tied, options));
  check_ok(hooke_options_set_number(options, "stiffness", 3.0));
  check_ok(hooke_system_add_anchors(system, "one", 1, tied, options));
  check_ok(hooke_options_set_numbers(options, "stiffness", 2, stiffness));
  check_ok(hooke_options_set_numbers(options, "points", 6, point));
  check_ok(hooke_options_set_number(options, "damping", 0.7));
  check_ok(hooke_system_add_anchors(system, "two", 2, tied, options));
  check_ok(hooke_system_commit(system));
  write_and_read(system, &read);
  assert_true(hk_system_check_value(hooke_scene_system(read)) == hk_system_check_value(system));
  assert_int_equal(hk_system_groups_of(hooke_scene_system(read), &hk_force_anchor), 3);

  check_ok(hk_variant_create(system, &variant));
  variant.group[hk_system_first_group(system, &hk_force_anchor) + 1] = 1;
  check_ok(hk_variant_make(system, &variant, &made, &map));
  assert_int_equal(hooke_system_count(made, "anchors"), 2);
  check_ok(hooke_system_members(made, "anchors", particle, number[0], number[1], number[2]));
  check_ok(hooke_system_anchor_points(made, points));
  assert_true(particle[0] == 5 && particle[1] == 3 && number[1][1] == 0.7);
  assert_memory_equal(points, point, sizeof point);
  assert_memory_equal(number[0], stiffness, sizeof stiffness);
}

/* Loads are equal to the bit, and as they were given; a variant leaves a group out. */
TEST(loads_come_back) {
  static const char *const words[] = {"force=0.1,2,-3",
                                      "motion=harmonic force=0.1,0,0 frequency=1.5 phase=0.3",
                                      "motion=table force=0,0,0;0.1,0.2,0.3 time=0.1,0.7"};
  owned_scene *read = NULL;
  owned_system *system = new_system(), *made = NULL;
  owned(hk_variant_release) struct hk_variant variant;
  owned(hk_variant_map_release) struct hk_variant_map map;
  add_strand(system, 1);
  for (int k = 0; k < 3; k++) {
    owned_options *options = options_with("loads", "%s", words[k]);
    check_ok(hooke_system_add_loads(system, 2, (int64_t[]){5, 4 + k}, options));
  }
  check_ok(hooke_system_commit(system));
  write_and_read(system, &read);
  check_same_system(hooke_scene_system(read), system);
  assert_true(hk_system_check_value(hooke_scene_system(read)) == hk_system_check_value(system));
  const char *flat = strstr(hooke_scene_text(read, "text"), "\"force\": [0.1, 2");
  assert_non_null(flat);

  check_ok(hk_variant_create(system, &variant));
  variant.group[hk_system_first_group(system, &hk_force_loads) + 1] = 1;
  check_ok(hk_variant_make(system, &variant, &made, &map));
  assert_int_equal(hooke_system_count(made, "loads"), 4);
  int64_t particle[4];
  check_ok(hooke_system_members(made, "loads", particle, NULL, NULL, NULL));
  assert_true(particle[0] == 5 && particle[1] == 4 && particle[2] == 5 && particle[3] == 6);
}

/* By the numbers that the particles have in the scene; in a variant those that are there. */
TEST(names_come_back) {
  const double position[] = {0, 1, 0, 1, 1, 0};
  owned_system *system = small_part(NULL, "rope", "line",
                                    "from=0,0,0 to=1,0,0 segments=2 mass=1 stretch.stiffness=9"),
               *made = NULL;
  owned_scene *read = NULL;
  owned(hk_variant_release) struct hk_variant variant;
  owned(hk_variant_map_release) struct hk_variant_map map;
  check_ok(hooke_system_add_particles(system, 2, position, NULL, 1, (double[]){2.0}, NULL));
  check_ok(hooke_system_name_particle(system, "tip", 2));
  check_ok(hooke_system_name_particle(system, "bob", 4));
  check_ok(hooke_system_commit(system));
  check_status(hooke_system_name_particle(system, "late", 0), HOOKE_BAD_CALL);
  check_ok(hooke_scene_of_system(system, NULL, NULL, "memory", NULL, &read));
  check_ok(hooke_scene_commit(read));
  const hooke_system *again = hooke_scene_system(read);
  assert_int_equal(hooke_system_named_particle(again, "tip"), 4);
  assert_int_equal(hooke_system_named_particle(again, "bob"), 1);
  assert_int_equal(hooke_system_named_particle(again, "top"), -1);
  check_same_bits(3, again->position + 3, system->position + 12);

  check_ok(hk_variant_create(system, &variant));
  variant.part[0] = 1;
  check_ok(hk_variant_make(system, &variant, &made, &map));
  assert_int_equal(hooke_system_named_particle(made, "tip"), -1);
  assert_int_equal(hooke_system_named_particle(made, "bob"), 1);
}

/* Of particles and parts, as options of a part and as set after it; in a variant at half the resolution it is
 * that of the same points. */
TEST(gravity_factors_come_back) {
  const double place[6] = {0, 5, 0, 1, 5, 0}, factor[2] = {-0.3, 2.0};
  owned_scene *read = NULL;
  owned_system *system = small_system(2, place, NULL, 1.0, 0), *made = NULL;
  owned(hk_variant_release) struct hk_variant variant;
  owned(hk_variant_map_release) struct hk_variant_map map;
  check_ok(hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  small_part(system, "rope", "one",
             "from=0,0,0 to=1,0,0 segments=4 mass=1 stretch.stiffness=5 "
             "gravity_factor=0.1,0.2,0.3,0.4,0.5");
  small_part(system, "rope", "two",
             "from=0,1,0 to=1,1,0 segments=3 mass=1 stretch.stiffness=5 gravity_factor=0.7");
  small_part(system, "rope", "three", "from=0,2,0 to=1,2,0 segments=2 mass=1 stretch.stiffness=5");
  check_ok(hooke_system_set_gravity_factor(system, 0, 2, 2, factor));
  check_ok(hooke_system_set_gravity_factor(system, 8, 1, 1, factor));
  check_ok(hooke_system_commit(system));
  write_and_read(system, &read);
  check_same_system(hooke_scene_system(read), system);
  check_same_bits(14, hooke_scene_system(read)->gravity_factor, system->gravity_factor);
  assert_true(hk_system_check_value(hooke_scene_system(read)) == hk_system_check_value(system));
  assert_non_null(strstr(hooke_scene_text(read, "text"), "\"gravity_factor\": [0.1, 0.2, 0.3, 0.4, 0.5]"));

  check_ok(hk_variant_create(system, &variant));
  variant.scale[0] = 0.5;
  check_ok(hk_variant_make(system, &variant, &made, &map));
  const double right[12] = {-0.3, 2.0, 0.1, 0.3, 0.5, 0.7, -0.3, 0.7, 0.7, 1.0, 1.0, 1.0};
  assert_int_equal(made->particle_count, 12);
  for (int p = 0; p < 12; p++)
    check_close(made->gravity_factor[p], right[p], 1e-15);
}

/* One for all stays a ratio, which finds the same damping where other particles are held; several become
 * dampings. A variant without damping has none. */
TEST(damping_ratios_come_back) {
  const double position[] = {0, 0, 0, 1, 0, 0, 3, 0, 0};
  const int64_t ends[] = {0, 1, 1, 2};
  double gamma[4];
  owned_system *system = small_system(3, position, NULL, 0.3, 1), *made = NULL;
  owned_scene *read = NULL;
  owned(hk_variant_release) struct hk_variant variant;
  owned(hk_variant_map_release) struct hk_variant_map map;
  small_group(system, "springs", "one", 2, ends, "stiffness=7 damping_ratio=0.3 rest_scale=0.9");
  small_group(system, "springs", "two", 2, ends, "stiffness=7,9 damping_ratio=0.1,0.7");
  check_ok(hooke_system_commit(system));
  write_and_read(system, &read);
  assert_non_null(strstr(hooke_scene_text(read, "text"), "\"damping_ratio\": 0.3"));

  check_ok(hk_variant_create(system, &variant));
  variant.damping = 1;
  check_ok(hk_variant_make(system, &variant, &made, &map));
  check_ok(hooke_system_members(made, "springs", NULL, NULL, gamma, NULL));
  assert_true(gamma[0] == 0.0 && gamma[1] == 0.0 && gamma[2] == 0.0 && gamma[3] == 0.0);
}

/* Driven as before: at some times, to the same positions to the bit. */
TEST(drives_come_back) {
  const double at[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, mass[3] = {1, 2, 3}, amplitude[3] = {0.1, 0, 0.2};
  const double time[3] = {0, 0.5, 2}, displacement[9] = {0, 0, 0, 0.1, 0.2, 0.3, 0, 1, 0};
  const int64_t first = 0, last = 2;
  owned_scene *read = NULL;
  owned_system *system = new_system();
  check_ok(hooke_system_add_particles(system, 3, at, NULL, 3, mass, NULL));
  check_ok(hooke_system_drive_harmonic(system, 1, &first, amplitude, 1.5, 0.25));
  check_ok(hooke_system_drive_table(system, 1, &last, 3, time, displacement));
  check_ok(hooke_system_commit(system));
  write_and_read(system, &read);
  check_same_system(hooke_scene_system(read), system);
  for (int64_t d = 0; d < 2; d++) {
    for (double t = -0.5; t < 3.0; t += 0.11) {
      double a[6], b[6];
      check_ok(hk_drive_evaluate(&system->drive[d], t, a, a + 3));
      check_ok(hk_drive_evaluate(&hooke_scene_system(read)->drive[d], t, b, b + 3));
      check_same_bits(6, b, a);
    }
  }
}

TEST(zeros_keep_their_sign) {
  const double at[6] = {-0.0, 0, 0, 1, -0.0, 0}, still[6] = {0, 0, -0.0, 0, 0, 0}, mass = 1;
  owned_scene *read = NULL;
  owned_system *system = committed(small_system(2, at, still, mass, 0));
  write_and_read(system, &read);
  check_same_system(hooke_scene_system(read), system);
}

/* "-0" is an integer, too, and a scene cannot express the sign of one. */
TEST(whole_numbers_have_one_zero) {
  const double wanted[2] = {0.0, 1.0};
  owned_options *options = options_with("rope", "pinned=-0,1");
  check_same_bits(2, hooke_options_numbers(options, "pinned"), wanted);
}

TEST(keys_of_a_scene_are_applied) {
  hooke_options *options, *other;
  const double origin[3] = {0, 0, 0}, gravity[3] = {0, -9.81, 0}, mass = 1;
  owned_system *system = small_system(1, origin, NULL, mass, 0);
  options = options_with("scene", "gravity=0,-9.81,0 drag=0.25");
  check_ok(hooke_scene_options_apply(options, system));
  check_same_bits(3, system->gravity, gravity);
  assert_true(system->drag == 0.25);
  check_ok(hooke_options_create("particles", &other));
  check_status(hooke_scene_options_apply(other, system), HOOKE_BAD_VALUE);
  check_message("options: are those of a particles; make them with hooke_options_create(\"scene\", ...)");
  hooke_options_destroy(other);
  check_status(hooke_options_create("wheel", &other), HOOKE_BAD_VALUE);
  check_message("scene, particles, driven");
  assert_null(other);
  hooke_scene *scene;
  check_status(hooke_scene_of_system(system, NULL, NULL, NULL, NULL, &scene), HOOKE_BAD_CALL);
  assert_null(scene);
  check_ok(hooke_system_commit(system));
  check_status(hooke_scene_options_apply(options, system), HOOKE_BAD_CALL);
  hooke_options_destroy(options);
}

static void check_not_written(const hooke_system *system, const char *force) {
  check_status(hooke_scene_write("/tmp/hooke-never-written.json", system, NULL, NULL), HOOKE_UNSUITED);
  check_message(force);
  assert_int_not_equal(access("/tmp/hooke-never-written.json", F_OK), 0);
}

/* Forces that have no key: a callback, and one that only the inside knows. */
TEST(forces_without_a_key_are_not_lost) {
  static const struct hk_element element = {.count = 1, .weight = {1.0}, .k_along = 2.0, .over = 1.0};
  static const double place[3] = {0.0, 0.0, 0.0}, one = 1.0;
  owned_random_scene scene;
  random_scene_with(&scene, .seed = 5, .particles = 10, .springs = 9, .features = SCENE_CALLBACK);
  check_not_written(scene.system, "callbacks");
  owned_system *system = small_system(1, place, NULL, one, 0);
  hk_system_set_linear(system, 1, &element, place);
  check_ok(hooke_system_commit(system));
  check_not_written(system, "\"linear\"");
}
