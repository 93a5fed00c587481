/* Calls that build a system refuse invalid input, name the item at fault, and leave the system unchanged. */
#include "check.h"
#include "small.h"

#include <math.h>
#include <string.h>

static const double place[] = {0, 0, 0, 1, 0, 0, 2, 0, 0};

static hooke_system *three(void) {
  return small_system(3, place, NULL, 1.0, 0);
}

TEST(test_particles) {
  const double bad_place[] = {0, 0, 0, 1, NAN, 0}, bad_velocity[] = {0, 0, 0, 0, 0, INFINITY};
  const double mass = 1.0, none = 0.0, negative[] = {1.0, -2.5}, masses[] = {1, 2, 3};
  owned_system *system = three();
  check_status(hooke_system_add_particles(system, 2, bad_place, NULL, 1, &mass, NULL), HOOKE_BAD_VALUE);
  check_message("position[1][1]");
  check_message("nan");
  check_status(hooke_system_add_particles(system, 2, place, bad_velocity, 1, &mass, NULL), HOOKE_BAD_VALUE);
  check_message("velocity[1][2]");
  check_status(hooke_system_add_particles(system, 2, place, NULL, 1, &none, NULL), HOOKE_BAD_VALUE);
  check_message("mass");
  check_message("> 0");
  check_status(hooke_system_add_particles(system, 2, place, NULL, 2, negative, NULL), HOOKE_BAD_VALUE);
  check_message("mass[1]");
  check_message("-2.5");
  check_status(hooke_system_add_particles(system, 2, place, NULL, 3, masses, NULL), HOOKE_BAD_VALUE);
  check_message("3 masses");
  check_status(hooke_system_add_particles(system, -1, place, NULL, 1, &mass, NULL), HOOKE_BAD_VALUE);
  check_message("-1");
  assert_int_equal(hooke_system_particle_count(system), 3);
}

static hooke_options *spring_options(const char *name, double value) {
  hooke_options *options = options_with("springs", "stiffness=10");
  if (name != NULL) check_ok(hooke_options_set_number(options, name, value));
  return options;
}

static void refuse_springs(int64_t count, const int64_t *ends, const hooke_options *options,
                           const char *culprit, const char *value) {
  owned_system *system = three();
  check_status(hooke_system_add_springs(system, "edges", count, ends, options), HOOKE_BAD_VALUE);
  check_message(culprit);
  check_message(value);
  /* unchanged: it accepts a valid group and commits */
  const int64_t good[] = {0, 2};
  springs_with(system, 1, good, .stiffness = 1, .rest_length = -1);
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_count(system, "springs"), 1);
  assert_int_equal(hooke_system_group_count(system, "springs"), 1);
}

TEST(test_springs) {
  const int64_t outside[] = {0, 1, 1, 7}, below[] = {-1, 2}, same[] = {0, 1, 2, 2}, good[] = {0, 1, 1, 2};
  const double three_values[] = {1, 2, 3}, with_zero[] = {1, 0};
  hooke_options *options = spring_options(NULL, 0.0);
  refuse_springs(2, outside, options, "between[1][1]", "7");
  refuse_springs(1, below, options, "between[0][0]", "-1");
  refuse_springs(2, same, options, "between[1]", "particles 2 and 2; a spring has two different ones");
  check_ok(hooke_options_set_numbers(options, "stiffness", 3, three_values));
  refuse_springs(2, good, options, "stiffness", "3 values");
  hooke_options_destroy(options);

  options = spring_options("rest_length", 0.0);
  refuse_springs(2, good, options, "rest_length", "strain");
  check_ok(hooke_options_set_numbers(options, "rest_length", 2, with_zero));
  refuse_springs(2, good, options, "rest_length[1]", "0");
  hooke_options_destroy(options);

  check_ok(hooke_options_create("springs", &options)); /* no stiffness */
  refuse_springs(2, good, options, "stiffness", "");
  hooke_options_destroy(options);
}

/* Coincident ends have no initial length for the strain law. */
TEST(test_initial_length_of_nothing) {
  const double q[] = {0, 0, 0, 1, 1, 1, 1, 1, 1};
  const int64_t ends[] = {0, 1, 1, 2};
  owned_system *system = small_system(3, q, NULL, 1.0, 0);
  owned_options *options = spring_options(NULL, 0.0);
  check_status(hooke_system_add_springs(system, "edges", 2, ends, options), HOOKE_BAD_VALUE);
  check_message("[1]");
  check_ok(hooke_options_set_text(options, "law", "length"));
  check_ok(hooke_system_add_springs(system, "edges", 2, ends, options));
  check_ok(hooke_system_commit(system));
}

TEST(test_spring_options) {
  owned_options *options = spring_options(NULL, 0.0);
  const double bad[] = {1.0, -3.0};
  check_status(hooke_options_set_number(options, "stiffness", -5.0), HOOKE_BAD_VALUE);
  check_message("stiffness");
  check_message("-5");
  check_status(hooke_options_set_numbers(options, "damping", 2, bad), HOOKE_BAD_VALUE);
  check_message("-3");
  check_status(hooke_options_set_number(options, "rest_scale", 0.0), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_number(options, "stiffness", NAN), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_text(options, "law", "hooke"), HOOKE_BAD_VALUE);
  check_message("strain");
  check_message("length");
  check_status(hooke_options_set_number(options, "stifness", 1.0), HOOKE_BAD_VALUE);
  check_message("stifness");
  check_close(hooke_options_number(options, "stiffness"), 10.0, 0.0); /* kept */
}

TEST(test_pins_and_drives) {
  const int64_t outside[] = {0, 3}, one = 1, two = 2, twice[] = {0, 0};
  const double amplitude[] = {1, 0, 0}, lost[] = {1, NAN, 0}, time[] = {0, 1, 1}, moved[9] = {0};
  owned_system *system = three();
  check_status(hooke_system_pin(system, 2, outside), HOOKE_BAD_VALUE);
  check_message("pinned[1]");
  check_message("3");
  check_ok(hooke_system_pin(system, 1, &one));
  check_ok(hooke_system_pin(system, 1, &one)); /* twice is allowed */
  check_status(hooke_system_drive_harmonic(system, 1, &one, amplitude, 1.0, 0.0), HOOKE_BAD_VALUE);
  check_message("particle 1");
  check_message("pinned");
  check_status(hooke_system_drive_harmonic(system, 2, twice, amplitude, 1.0, 0.0), HOOKE_BAD_VALUE);
  check_message("particle 0");
  check_status(hooke_system_drive_harmonic(system, 1, &two, lost, 1.0, 0.0), HOOKE_BAD_VALUE);
  check_message("amplitude[1]");
  check_status(hooke_system_drive_harmonic(system, 1, &two, amplitude, INFINITY, 0.0), HOOKE_BAD_VALUE);
  check_message("frequency");
  check_status(hooke_system_drive_table(system, 1, &two, 3, time, moved), HOOKE_BAD_VALUE);
  check_message("time[2]");
  check_status(hooke_system_drive_table(system, 1, &two, 1, time, moved), HOOKE_BAD_VALUE);
  check_message("2 or more");
  check_ok(hooke_system_drive_table(system, 1, &two, 2, time, moved));
  check_status(hooke_system_drive_harmonic(system, 1, &two, amplitude, 1.0, 0.0), HOOKE_BAD_VALUE);
  check_message("driven");
  check_status(hooke_system_pin(system, 1, &two), HOOKE_BAD_VALUE);
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_count(system, "free"), 1);
  assert_true(hooke_system_inverse_mass(system)[0] == 1.0);
  assert_true(hooke_system_inverse_mass(system)[1] == 0.0 && hooke_system_inverse_mass(system)[2] == 0.0);
}

TEST(test_gravity_and_drag) {
  const double gravity[] = {0, 0, -INFINITY};
  owned_system *system = three();
  check_status(hooke_system_set_gravity(system, gravity), HOOKE_BAD_VALUE);
  check_message("gravity[2]");
  check_status(hooke_system_set_drag(system, -0.5), HOOKE_BAD_VALUE);
  check_message("-0.5");
  check_status(hooke_system_set_drag(system, NAN), HOOKE_BAD_VALUE);
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_count(system, "forces"), 0);
}

/* A pinned particle with a velocity is refused at commit; the system stays open. */
TEST(test_moving_pin) {
  const double v[] = {0, 0, 0, 0, 0.25, 0, 0, 0, 0};
  const int64_t one = 1;
  owned_system *system = small_system(3, place, v, 1.0, 0);
  check_ok(hooke_system_pin(system, 1, &one));
  check_status(hooke_system_commit(system), HOOKE_BAD_VALUE);
  check_message("particle 1");
  check_message("0.25");
  assert_int_equal(hooke_system_is_committed(system), 0);
  check_ok(hooke_system_set_drag(system, 1.0)); /* still open */
}

TEST(test_calls_out_of_order) {
  const double gravity[] = {0, 0, 1}, mass = 1.0;
  const int64_t ends[] = {0, 1}, one = 1;
  double out[9];
  hooke_state *state = NULL;
  hooke_integrator *integrator = NULL;
  owned_options *options = spring_options(NULL, 0.0), *run = NULL;
  owned_system *system = three();
  run = options_with("run", "step=0.1");
  check_status(hooke_system_force(system, 0.0, place, place, out), HOOKE_BAD_CALL);
  check_status(hooke_system_acceleration(system, 0.0, place, place, out), HOOKE_BAD_CALL);
  check_status(hooke_state_create(system, &state), HOOKE_BAD_CALL);
  check_status(hooke_integrator_create(system, run, &integrator), HOOKE_BAD_CALL);
  assert_true(isnan(hooke_system_energy(system, "total", place, place)));
  assert_null(hooke_system_mass(system));
  check_ok(hooke_system_commit(system));
  check_status(hooke_system_commit(system), HOOKE_BAD_CALL);
  check_status(hooke_system_add_particles(system, 1, place, NULL, 1, &mass, NULL), HOOKE_BAD_CALL);
  check_status(hooke_system_add_springs(system, NULL, 1, ends, options), HOOKE_BAD_CALL);
  check_status(hooke_system_pin(system, 1, &one), HOOKE_BAD_CALL);
  check_status(hooke_system_set_gravity(system, gravity), HOOKE_BAD_CALL);
  check_status(hooke_system_set_drag(system, 1.0), HOOKE_BAD_CALL);
  check_status(hooke_system_drive_harmonic(system, 1, &one, gravity, 1.0, 0.0), HOOKE_BAD_CALL);
}

/* Groups keep their order, names and sizes; springs are numbered through them. */
TEST(test_spring_numbers) {
  const int64_t first[] = {2, 0}, second[] = {0, 1, 1, 2}, expected[] = {2, 0, 0, 1, 1, 2};
  int64_t ends[6];
  double kappa[3], gamma[3], rest[3];
  owned_system *system = three();
  owned_options *options = spring_options("damping", 0.5);
  check_ok(hooke_system_add_springs(system, "long", 1, first, options));
  check_ok(hooke_options_set_number(options, "rest_scale", 0.5));
  check_ok(hooke_system_add_springs(system, NULL, 2, second, options));
  check_status(hooke_system_members(system, "springs", ends, NULL, NULL, NULL), HOOKE_BAD_CALL);
  check_ok(hooke_system_commit(system));
  check_ok(hooke_system_members(system, "springs", ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, kappa, gamma, rest));
  assert_memory_equal(ends, expected, sizeof ends);
  const double expected_kappa[] = {5, 20, 20}, expected_gamma[] = {0.25, 1, 1},
               expected_rest[] = {2, 0.5, 0.5};
  check_same_bits(3, kappa, expected_kappa);
  check_same_bits(3, gamma, expected_gamma);
  check_same_bits(3, rest, expected_rest);
  assert_int_equal(hooke_system_group_count(system, "springs"), 2);
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "long");
  assert_string_equal(hooke_system_group_name(system, "springs", 1), "");
  assert_null(hooke_system_group_name(system, "springs", 2));
  assert_int_equal(hooke_system_group_size(system, "springs", 0), 1);
  assert_int_equal(hooke_system_group_size(system, "springs", 1), 2);
}

/* ---- numbers one by one ---- */

enum { CORNERS = 8, MEMBERS = 3, MOST = 3 * MEMBERS };
static const int64_t of_members[] = {0, 1, 2, 3, 4, 5, 6, 7, 1, 4, 0, 2};

typedef int32_t add_members(hooke_system *system, int64_t count, const int64_t *particles,
                            const hooke_options *options);

static int32_t add_springs(hooke_system *system, int64_t count, const int64_t *p, const hooke_options *o) {
  return hooke_system_add_springs(system, NULL, count, p, o);
}

static int32_t add_altitude(hooke_system *system, int64_t count, const int64_t *p, const hooke_options *o) {
  return hooke_system_add_altitude(system, NULL, count, p, o);
}

static int32_t add_anchors(hooke_system *system, int64_t count, const int64_t *p, const hooke_options *o) {
  return hooke_system_add_anchors(system, NULL, count, p, o);
}

static int32_t add_bending(hooke_system *system, int64_t count, const int64_t *p, const hooke_options *o) {
  return hooke_system_add_bending(system, NULL, count, p, hooke_options_number_count(o, "coefficient"),
                                  hooke_options_numbers(o, "coefficient"));
}

static const struct kind {
  const char *force;
  add_members *add;
  const char *without; /* a number, in whose place there is another */
} kinds[] = {{"springs", add_springs, "damping_ratio"},
             {"springs", add_springs, "damping"},
             {"altitude", add_altitude, ""},
             {"anchors", add_anchors, ""},
             {"bending", add_bending, ""}};

/* Every number that each member may have, of members `first` to `first` + `count`. */
static hooke_options *numbers_of(const struct kind *kind, int64_t first, int64_t count) {
  int64_t set = 0;
  hooke_options *options = new_options(kind->force);
  for (int64_t row = 0; row < hooke_options_row_count(options); row++) {
    double value[MOST];
    const char *name = hooke_options_row(options, row, "name");
    const double columns = hooke_options_row_number(options, row, "columns");
    const int64_t each = columns > 0.0 ? (int64_t)columns : 1;
    if (strcmp(hooke_options_row(options, row, "type"), "numbers") != 0) continue;
    if (hooke_options_row_number(options, row, "whole") == 1.0) continue; /* particles */
    if (strcmp(name, kind->without) == 0) continue;
    if (hooke_options_row(options, row, "family")[0]) continue; /* of all members alike */
    for (int64_t k = 0; k < each * MEMBERS; k++)
      value[k] = 0.3 + 0.2 * (double)row + 0.7 * (double)(k * k + k);
    check_ok(hooke_options_set_numbers(options, name, each * count, value + each * first));
    set++;
  }
  assert_in_range(set, 1, 4);
  return options;
}

/* Masses and members all at once, or one after the other. */
static hooke_system *built_of(const struct kind *kind, int one_by_one, const double *q, const double *mass) {
  const int64_t size = hooke_member_particles(kind->force), count = one_by_one ? 1 : MEMBERS,
                particles = one_by_one ? 1 : CORNERS;
  hooke_system *system = new_system();
  for (int64_t p = 0; p < CORNERS; p += particles)
    check_ok(hooke_system_add_particles(system, particles, q + 3 * p, NULL, particles, mass + p, NULL));
  for (int64_t k = 0; k < MEMBERS; k += count) {
    owned_options *options = numbers_of(kind, k, count);
    check_ok(kind->add(system, count, of_members + size * k, options));
  }
  return committed(system);
}

/* Unequal numbers in arrays act as when they are given one by one. */
TEST(test_each_has_its_numbers) {
  double q[3 * CORNERS], moved[3 * CORNERS], v[3 * CORNERS], mass[CORNERS], a[2][3 * CORNERS];
  for (int k = 0; k < 3 * CORNERS; k++) {
    q[k] = sin(1.0 + k * k);
    moved[k] = q[k] + 0.1 * cos(5.0 * k);
    v[k] = cos(7.0 * k);
    mass[k / 3] = 0.5 + 0.3 * (k / 3);
  }
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
    double stiffness[2][MEMBERS], damping[2][MEMBERS], rest[2][7 * MEMBERS] = {{0}};
    for (int one_by_one = 0; one_by_one < 2; one_by_one++) {
      owned_system *system = built_of(&kinds[k], one_by_one, q, mass);
      check_ok(hooke_system_acceleration(system, 0.0, moved, v, a[one_by_one]));
      check_ok(hooke_system_members(system, kinds[k].force, NULL, stiffness[one_by_one], damping[one_by_one],
                                    rest[one_by_one]));
    }
    assert_true(largest_difference(3 * CORNERS, a[0], q) > 0.0 && stiffness[0][0] != stiffness[0][1]);
    check_same_bits(3 * CORNERS, a[0], a[1]);
    check_same_bits(MEMBERS, stiffness[0], stiffness[1]);
    check_same_bits(MEMBERS, damping[0], damping[1]);
    check_same_bits(7 * MEMBERS, rest[0], rest[1]);
  }
}
