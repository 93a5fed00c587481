/* Parts: the contents of rope and cloth, their order, and that rest lengths are equal to the bit. */
#include "hooke.h"
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

/* All queries of a committed system about its springs. */
struct members {
  int64_t count;
  int64_t *ends;
  double *kappa, *gamma, *rest_length;
};

static struct members springs_of(const hooke_system *system) {
  struct members s = {.count = hooke_system_count(system, "springs")};
  s.ends = new_block(2 * s.count, sizeof(int64_t));
  s.kappa = new_doubles(s.count);
  s.gamma = new_doubles(s.count);
  s.rest_length = new_doubles(s.count);
  check_ok(hooke_system_members(system, "springs", s.ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, s.kappa, s.gamma, s.rest_length));
  return s;
}

static void release(struct members *s) {
  free(s->ends);
  free(s->kappa);
  free(s->gamma);
  free(s->rest_length);
}

static hooke_options *rope_options(double segments) {
  return options_with("rope", "from=0.1,0.2,0.3 to=1.3,0.2,-0.6 segments=%.17g mass=0.7", segments);
}

static hooke_options *cloth_options(double nu, double nv) {
  return options_with("cloth", "origin=0.1,0.7,0.3 edges=1.1,0,0.2,0.1,0,0.9 size=%.17g,%.17g mass=0.3", nu,
                      nv);
}

static void check_position(const hooke_system *system, int64_t particle, double x, double y, double z) {
  owned_state *state = start_state(system);
  const double *q = hooke_state_position(state) + 3 * particle;
  check_close(q[0], x, 1e-15);
  check_close(q[1], y, 1e-15);
  check_close(q[2], z, 1e-15);
}

static void check_spring(const struct members *s, int64_t k, int64_t first, int64_t second) {
  assert_in_range(k, 0, s->count - 1);
  if (s->ends[2 * k] == first && s->ends[2 * k + 1] == second) return;
  check_failed("spring %lld joins %lld and %lld, not %lld and %lld", (long long)k, (long long)s->ends[2 * k],
               (long long)s->ends[2 * k + 1], (long long)first, (long long)second);
}

/* Springs begin..end-1 have exactly this rest length. */
static void check_equal_bits(const struct members *s, int64_t begin, int64_t end, double rest_length) {
  for (int64_t k = begin; k < end; k++)
    check_same_bits(1, &s->rest_length[k], &rest_length);
}

TEST(a_rope_is_a_line) {
  owned_system *system = new_system();
  owned_options *options = rope_options(7);
  set_options(options, "stretch.stiffness=100 stretch.damping=0.5 bend.stiffness=3 bend.rest_scale=0.5");
  int64_t first = -1, count = -1;
  check_ok(hooke_system_add_part(system, "rope", "line", options, &first, &count));
  check_ok(hooke_system_commit(system));
  assert_int_equal(first, 0);
  assert_int_equal(count, 8);
  assert_int_equal(hooke_system_particle_count(system), 8);
  assert_int_equal(hooke_system_group_count(system, "springs"), 2);
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "line.stretch");
  assert_string_equal(hooke_system_group_name(system, "springs", 1), "line.bend");
  assert_int_equal(hooke_system_group_size(system, "springs", 0), 7);
  assert_int_equal(hooke_system_group_size(system, "springs", 1), 6);
  for (int k = 0; k < 8; k++) {
    check_close(hooke_system_mass(system)[k], 0.7 / 8, 0.0);
    check_position(system, k, 0.1 + 1.2 * k / 7, 0.2, 0.3 - 0.9 * k / 7);
  }
  owned(release) struct members s = springs_of(system);
  for (int k = 0; k < 7; k++)
    check_spring(&s, k, k, k + 1);
  for (int k = 0; k < 6; k++)
    check_spring(&s, 7 + k, k, k + 2);
  const double piece = s.rest_length[0];
  check_close(piece, 1.5 / 7, 1e-15);
  check_equal_bits(&s, 0, 7, piece);
  check_equal_bits(&s, 7, 13, 0.5 * (2.0 * piece));
  check_close(s.kappa[0], 100 / piece, 1e-12);
  check_close(s.gamma[6], 0.5 / piece, 1e-14);
  check_close(s.kappa[7], 3 / piece, 1e-13);
  check_close(s.gamma[7], 0.0, 0.0);
}

TEST(a_rope_ends_where_it_is_told) {
  for (int segments = 1; segments < 60; segments++) {
    owned_system *system = new_system();
    owned_options *options = rope_options(segments);
    check_ok(hooke_system_add_part(system, "rope", NULL, options, NULL, NULL));
    check_ok(hooke_system_commit(system));
    owned_state *state = start_state(system);
    check_same_bits(3, hooke_state_position(state) + 3 * segments, hooke_options_numbers(options, "to"));
    check_same_bits(3, hooke_state_position(state), hooke_options_numbers(options, "from"));
  }
}

enum { NU = 5, NV = 4 };

static int64_t at(int64_t r, int64_t c) {
  return r * NU + c;
}

static hooke_options *full_cloth(void) {
  hooke_options *options = cloth_options(NU, NV);
  set_options(options, "structural.stiffness=50 shear.stiffness=20 bend.stiffness=5");
  return options;
}

TEST(a_cloth_has_its_springs_in_order) {
  owned_system *system = new_system();
  owned_options *options = full_cloth();
  check_ok(hooke_system_add_part(system, "cloth", "flag", options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_particle_count(system), NU * NV);
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "flag.structural");
  assert_string_equal(hooke_system_group_name(system, "springs", 1), "flag.shear");
  assert_string_equal(hooke_system_group_name(system, "springs", 2), "flag.bend");

  owned(release) struct members s = springs_of(system);
  int64_t k = 0;
  for (int r = 0; r < NV; r++)
    for (int c = 0; c + 1 < NU; c++)
      check_spring(&s, k++, at(r, c), at(r, c + 1));
  const int64_t v_edges = k;
  for (int r = 0; r + 1 < NV; r++)
    for (int c = 0; c < NU; c++)
      check_spring(&s, k++, at(r, c), at(r + 1, c));
  const int64_t shear = k;
  assert_int_equal(shear, hooke_system_group_size(system, "springs", 0));
  for (int r = 0; r + 1 < NV; r++)
    for (int c = 0; c + 1 < NU; c++)
      check_spring(&s, k++, at(r, c), at(r + 1, c + 1));
  const int64_t second = k;
  for (int r = 0; r + 1 < NV; r++)
    for (int c = 0; c + 1 < NU; c++)
      check_spring(&s, k++, at(r, c + 1), at(r + 1, c));
  const int64_t bend = k;
  for (int r = 0; r < NV; r++)
    for (int c = 0; c + 2 < NU; c++)
      check_spring(&s, k++, at(r, c), at(r, c + 2));
  const int64_t bend_v = k;
  for (int r = 0; r + 2 < NV; r++)
    for (int c = 0; c < NU; c++)
      check_spring(&s, k++, at(r, c), at(r + 2, c));
  assert_int_equal(k, s.count);

  /* every spring at rest initially, and one number for each family and direction */
  owned_state *state = start_state(system);
  const double *q = hooke_state_position(state);
  for (k = 0; k < s.count; k++) {
    const double *a = q + 3 * s.ends[2 * k], *b = q + 3 * s.ends[2 * k + 1];
    const double length =
        sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
    check_close(s.rest_length[k], length, 1e-14);
  }
  const int64_t begin[] = {0, v_edges, shear, second, bend, bend_v, s.count};
  for (int f = 0; f < 6; f++)
    check_equal_bits(&s, begin[f], begin[f + 1], s.rest_length[begin[f]]);
  check_equal_bits(&s, bend, bend + 1, 2.0 * s.rest_length[0]);
  check_equal_bits(&s, bend_v, bend_v + 1, 2.0 * s.rest_length[v_edges]);
  check_position(system, NU - 1, 1.2, 0.7, 0.5);
  check_position(system, NU * NV - 1, 1.3, 0.7, 1.4);
}

TEST(a_family_that_is_absent_has_no_springs) {
  owned_system *system = new_system();
  owned_options *options = cloth_options(3, 3);
  check_ok(hooke_options_set_number(options, "shear.stiffness", 20));
  check_ok(hooke_system_add_part(system, "cloth", NULL, options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_group_count(system, "springs"), 1);
  assert_int_equal(hooke_system_count(system, "springs"), 8);
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "cloth0.shear");
}

/* Constrained particles of a system as text: "x..x". */
static void held(const hooke_system *system, char *text) {
  const int64_t n = hooke_system_particle_count(system);
  for (int64_t k = 0; k < n; k++)
    text[k] = hooke_system_inverse_mass(system)[k] == 0.0 ? 'x' : '.';
  text[n] = '\0';
}

static void check_pinned(const char *kind, const char *pinned, const char *expected) {
  char found[64];
  owned_system *system = new_system();
  owned_options *options = strcmp(kind, "rope") == 0 ? rope_options(4) : cloth_options(4, 3);
  check_ok(hooke_options_set_text(options, "pinned", pinned));
  check_ok(hooke_system_add_part(system, kind, NULL, options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  held(system, found);
  assert_string_equal(found, expected);
}

TEST(pinned_particles_have_names) {
  check_pinned("rope", "start", "x....");
  check_pinned("rope", "end", "....x");
  check_pinned("rope", "start, end", "x...x");
  check_pinned("rope", "end 1 2", ".xx.x");
  check_pinned("cloth", "corners", "x..x....x..x");
  check_pinned("cloth", "top", "xxxx........");
  check_pinned("cloth", "top-corners", "x..x........");
  check_pinned("cloth", "top-corners, 5", "x..x.x......");
  check_pinned("cloth", "6", "......x.....");
}

TEST(parts_come_after_groups_and_are_counted) {
  owned_system *system = new_system();
  owned_options *options = rope_options(2);
  set_options(options, "stretch.stiffness=1 pinned=start");
  const double position[] = {5, 0, 0, 6, 0, 0}, mass = 2;
  int64_t first = -1;
  check_ok(hooke_system_add_particles(system, 2, position, NULL, 1, &mass, NULL));
  check_ok(hooke_system_add_part(system, "rope", "", options, &first, NULL));
  assert_int_equal(first, 2);
  check_ok(hooke_system_add_part(system, "rope", "named", options, &first, NULL));
  assert_int_equal(first, 5);
  check_ok(hooke_system_add_part(system, "rope", NULL, options, &first, NULL));
  assert_int_equal(first, 8);
  small_group(system, "springs", "tie", 1, (int64_t[]){1, 4}, "stiffness=9");
  check_ok(hooke_system_commit(system));

  const char *const names[] = {"tie", "rope0.stretch", "named.stretch", "rope2.stretch"};
  assert_int_equal(hooke_system_group_count(system, "springs"), 4);
  for (int k = 0; k < 4; k++)
    assert_string_equal(hooke_system_group_name(system, "springs", k), names[k]);
  owned(release) struct members s = springs_of(system);
  check_spring(&s, 0, 1, 4);
  check_spring(&s, 1, 2, 3);
  check_spring(&s, 3, 5, 6);
  check_spring(&s, 6, 9, 10);
  char found[32];
  held(system, found);
  assert_string_equal(found, "..x..x..x..");
}

/* A refused part leaves no trace: the system is then built as if it had never been tried. */
static void check_refused(const char *kind, hooke_options *options, int32_t status, const char *message) {
  owned_system *system = new_system();
  const double position[] = {0, 0, 0}, mass = 1;
  check_ok(hooke_system_add_particles(system, 1, position, NULL, 1, &mass, NULL));
  int64_t first = -7, count = -7;
  check_status(hooke_system_add_part(system, kind, "bad", options, &first, &count), status);
  check_message(message);
  assert_int_equal(first, -7);
  assert_int_equal(count, -7);
  assert_int_equal(hooke_system_particle_count(system), 1);
  owned_options *good = rope_options(3);
  check_ok(hooke_options_set_number(good, "stretch.stiffness", 1));
  check_ok(hooke_system_add_part(system, "rope", NULL, good, &first, &count));
  assert_int_equal(first, 1);
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_group_count(system, "springs"), 1);
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "rope0.stretch");
  char found[32];
  held(system, found);
  assert_string_equal(found, ".....");
  hooke_options_destroy(options);
}

TEST(bad_parts_are_refused) {
  hooke_options *options = rope_options(3);
  check_ok(hooke_options_set_text(options, "stretch", ""));
  check_refused("rope", options, HOOKE_BAD_VALUE, "stretch.stiffness");

  check_ok(hooke_options_create("rope", &options));
  check_refused("rope", options, HOOKE_BAD_VALUE, "from");

  options = full_cloth();
  check_ok(hooke_options_set_numbers(options, "pinned", 3, (double[]){0, 19, 20}));
  check_refused("cloth", options, HOOKE_BAD_VALUE,
                "pinned[2]: the part has no particle 20; allowed: 0 to 19, as numbers begin at 0");

  options = rope_options(3);
  check_ok(hooke_options_set_number(options, "bend.stiffness", 1));
  check_ok(hooke_options_set_numbers(options, "to", 3, (double[]){0.1, 0.2, 0.3}));
  check_refused("rope", options, HOOKE_BAD_VALUE, "bend: its springs would have a rest length of 0 m");

  options = full_cloth();
  check_ok(hooke_options_set_numbers(options, "edges", 6, (double[]){1e200, 1e200, 0, 0, 0, 1}));
  check_refused("cloth", options, HOOKE_BAD_VALUE,
                "structural: its springs would have a rest length of inf m");

  check_refused("rope", full_cloth(), HOOKE_BAD_VALUE,
                "options: are those of a cloth; make them with hooke_options_create(\"rope\", ...)");
  check_refused("sail", rope_options(1), HOOKE_BAD_VALUE,
                "no kind of part called \"sail\"; allowed: rope, cloth, lattice, mesh, strand");
}

TEST(impossible_sizes_are_refused_before_anything_is_allocated) {
  check_refused("cloth", cloth_options(1e6, 1e6), HOOKE_BAD_VALUE,
                "size: a cloth of 1000000 x 1000000 particles needs 280 TB of memory for 1e+12 particles");
  check_refused("cloth", cloth_options(2147483647, 2147483647), HOOKE_BAD_VALUE, "2147483647 x 2147483647");
  check_refused("rope", rope_options(2147483647), HOOKE_BAD_VALUE, "segments: a rope of 2147483647 segments");

  owned_options *options = cloth_options(2, 2);
  check_status(hooke_options_set_numbers(options, "size", 2, (double[]){1, 5}), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_numbers(options, "size", 2, (double[]){2.5, 5}), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_numbers(options, "size", 3, (double[]){2, 2, 2}), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_numbers(options, "edges", 3, (double[]){2, 2, 2}), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_number(options, "mass", 0), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_number(options, "structural.stiffness", -1), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_text(options, "pinned", "start"), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_number(options, "pinned", -1), HOOKE_BAD_VALUE);
}

TEST(a_committed_system_takes_no_part) {
  owned_system *system = new_system();
  owned_options *options = rope_options(1);
  check_ok(hooke_system_add_part(system, "rope", NULL, options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  check_status(hooke_system_add_part(system, "rope", NULL, options, NULL, NULL), HOOKE_BAD_CALL);
}

TEST(kinds_can_be_listed) {
  assert_string_equal(hooke_part_kind(0, "name"), "rope");
  assert_string_equal(hooke_part_kind(1, "name"), "cloth");
  assert_string_equal(hooke_part_kind(2, "name"), "lattice");
  assert_string_equal(hooke_part_kind(3, "name"), "mesh");
  assert_string_equal(hooke_part_kind(4, "name"), "strand");
  assert_null(hooke_part_kind(5, "name"));
  assert_null(hooke_part_kind(-1, "name"));
  hooke_options *options;
  check_status(hooke_options_create(NULL, &options), HOOKE_BAD_VALUE);
  assert_null(options);
}

TEST(particles_of_a_part_are_counted) {
  owned_system *system = NULL;
  owned_options *options = full_cloth();
  int64_t first[2], count[2];
  check_ok(hooke_system_create(&system));
  check_ok(hooke_system_add_part(system, "cloth", "a", options, &first[0], &count[0]));
  check_ok(hooke_system_add_part(system, "cloth", NULL, options, &first[1], &count[1]));
  for (int k = 0; k < 2; k++) {
    const char *part = k ? "cloth1" : "a";
    assert_int_equal(hooke_system_part_count(system, part, "particles"), count[k]);
    assert_int_equal(hooke_system_part_count(system, part, "before"), first[k]);
  }
  assert_true(first[1] == count[0] && count[1] > 1);
  assert_int_equal(hooke_system_part_count(system, "cloth0", "particles"), -1);
  assert_int_equal(hooke_system_part_count(system, "a", "springs"), -1);
}
