/* Strands: their particles, what joins them, and that they are at rest. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double from[3] = {1.0, 2.0, -0.5}, to[3] = {2.0, 0.0, 1.5}; /* 3 m apart */

static hooke_options *strand_options(int64_t segments, double curl, double turns) {
  hooke_options *options = options_with("strand",
                                        "segments=%d density=0.5 stretch.stiffness=10 bend.stiffness=20 "
                                        "twist.stiffness=30 altitude.stiffness=40",
                                        (int)segments);
  check_ok(hooke_options_set_numbers(options, "from", 3, from));
  check_ok(hooke_options_set_numbers(options, "to", 3, to));
  if (curl > 0.0) set_options(options, "curl=%.17g turns=%.17g", curl, turns);
  return options;
}

static hooke_system *new_strand(const hooke_options *options) {
  hooke_system *system = new_system();
  check_ok(hooke_system_add_part(system, "strand", "hair", options, NULL, NULL));
  return committed(system);
}

/* Along the axis from `from` [m], and the distance from it. */
static void about_axis(const double *q, double *along, double *distance) {
  double d[3], square = 0.0;
  *along = 0.0;
  for (int a = 0; a < 3; a++) {
    d[a] = q[a] - from[a];
    *along += d[a] * (to[a] - from[a]) / 3.0;
    square += d[a] * d[a];
  }
  *distance = sqrt(fmax(0.0, square - *along * *along));
}

static void check_at_rest(const hooke_system *system, const double *q) {
  const int64_t n = hooke_system_particle_count(system);
  owned_doubles *force = new_doubles(3 * n), *still = new_doubles(3 * n);
  check_ok(hooke_system_force(system, 0.0, q, still, force));
  check_between(largest(3 * n, force), 0.0, 1e-12);
}

static void check_counts(const hooke_system *system, int64_t n) {
  assert_int_equal(hooke_system_particle_count(system), n);
  assert_int_equal(hooke_system_group_count(system, "springs"), 3);
  static const char *const name[] = {"hair.stretch", "hair.bend", "hair.twist"};
  owned_wholes *ends = new_block(2 * (3 * n - 6), (int64_t)sizeof *ends);
  check_ok(hooke_system_members(system, "springs", ends, NULL, NULL, NULL));
  for (int64_t g = 0, s = 0; g < 3; g++) {
    assert_string_equal(hooke_system_group_name(system, "springs", g), name[g]);
    assert_int_equal(hooke_system_group_size(system, "springs", g), n - 1 - g);
    for (int64_t k = 0; k < n - 1 - g; k++, s++)
      assert_true(ends[2 * s] == k && ends[2 * s + 1] == k + 1 + g);
  }
  assert_int_equal(hooke_system_count(system, "altitude"), n - 3);
}

TEST(a_straight_strand_winds_about_its_axis) {
  enum { SEGMENTS = 9, N = 2 * SEGMENTS + 1 };
  owned_options *options = strand_options(SEGMENTS, 0.0, 0.0);
  owned_system *system = new_strand(options);
  owned_state *state = start_state(system);
  const double *q = hooke_state_position(state), piece = 3.0 / SEGMENTS;
  check_counts(system, N);
  double mass = 0.0;
  for (int k = 0; k < N; k++) {
    double along, distance;
    about_axis(q + 3 * k, &along, &distance);
    check_close(along, 0.5 * piece * k, 1e-14);
    check_close(distance, k % 2 ? 0.5 * piece : 0.0, 1e-7);
    mass += hooke_system_mass(system)[k];
  }
  check_close(mass, 1.5, 1e-14);
  check_at_rest(system, q);
  /* all tetrahedra are congruent, of one handedness, with a unique shortest altitude */
  double rest[7 * (N - 3)];
  check_ok(hooke_system_members(system, "altitude", NULL, NULL, NULL, rest));
  for (int k = 0; k < N - 3; k++) {
    double first = INFINITY, second = INFINITY;
    for (int j = 0; j < 7; j++) {
      assert_true(rest[7 * k + j] < 0.0);
      second = fmin(second, fmax(first, -rest[7 * k + j]));
      first = fmin(first, -rest[7 * k + j]);
    }
    check_between(second / first, 1.3, 1.4);
    check_close(rest[7 * k + 4] + rest[7 * k + 5] + rest[7 * k + 6], rest[4] + rest[5] + rest[6], 1e-14);
  }
}

TEST(a_curl_is_a_helix) {
  enum { SEGMENTS = 20, N = SEGMENTS + 1 };
  for (int left = 0; left <= 1; left++) {
    owned_options *options = strand_options(SEGMENTS, 0.2, left ? -2.5 : 2.5);
    owned_system *system = new_strand(options);
    owned_state *state = start_state(system);
    const double *q = hooke_state_position(state);
    check_counts(system, N);
    double length = 0.0, mass = 0.0, rest[7 * (N - 3)];
    for (int k = 0; k < N; k++) {
      double along, distance, square = 0.0;
      about_axis(q + 3 * k, &along, &distance);
      check_close(along, 3.0 / SEGMENTS * k, 1e-14);
      check_close(distance, 0.2, 1e-14);
      for (int a = 0; a < 3 && k > 0; a++)
        square += (q[3 * k + a] - q[3 * k + a - 3]) * (q[3 * k + a] - q[3 * k + a - 3]);
      length += sqrt(square);
      mass += hooke_system_mass(system)[k];
    }
    check_close(mass, 0.5 * length, 1e-13); /* the density is that of the hair, not of its axis */
    check_at_rest(system, q);
    check_ok(hooke_system_members(system, "altitude", NULL, NULL, NULL, rest));
    for (int k = 0; k < 7 * (N - 3); k++)
      assert_true((rest[k] < 0.0) == left && fabs(rest[k]) == fabs(rest[k % 7]));
  }
}

/* The shortest strands: no springs that would need more particles. */
TEST(short_strands) {
  hooke_options *options = strand_options(1, 0.0, 0.0);
  hooke_system *system = new_strand(options);
  assert_int_equal(hooke_system_particle_count(system), 3);
  assert_int_equal(hooke_system_count(system, "springs"), 3);
  assert_int_equal(hooke_system_count(system, "altitude"), 0);
  hooke_system_destroy(system);
  hooke_options_destroy(options);
  options = strand_options(1, 0.2, 0.3);
  system = new_strand(options);
  assert_int_equal(hooke_system_particle_count(system), 2);
  assert_int_equal(hooke_system_count(system, "springs"), 1);
  hooke_system_destroy(system);
  hooke_options_destroy(options);
}

TEST(ends_are_pinned_by_name) {
  owned_options *options = strand_options(4, 0.0, 0.0);
  check_ok(hooke_options_set_text(options, "pinned", "end,start,1"));
  owned_system *system = new_strand(options);
  for (int k = 0; k < 9; k++)
    assert_true((hooke_system_inverse_mass(system)[k] == 0.0) == (k == 0 || k == 1 || k == 8));
}
