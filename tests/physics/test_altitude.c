/* Altitude springs: which altitude acts, its effects, and what it must not change. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Particles of unequal masses, to be committed; with altitude springs on all `tetrahedra` whose rest lengths
 * are scaled by `scale`. */
static hooke_system *new_scene(int64_t n, const double *q, int64_t count, const int64_t *tetrahedra,
                               double stiffness, double damping, double scale) {
  owned_doubles *mass = new_doubles(n);
  for (int64_t p = 0; p < n; p++)
    mass[p] = 0.5 + 0.1 * (double)(p % 4);
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, n, q, NULL, n, mass, NULL));
  owned_options *options =
      options_with("altitude", "stiffness=%.17g damping=%.17g rest_scale=%.17g", stiffness, damping, scale);
  check_ok(hooke_system_add_altitude(system, "altitude", count, tetrahedra, options));
  return system;
}

static void add_springs(hooke_system *system, int64_t count, const int64_t *ends, double stiffness) {
  owned_options *options = options_with("springs", "stiffness=%.17g", stiffness);
  check_ok(hooke_system_add_springs(system, "edges", count, ends, options));
}

static hooke_system *commit(hooke_system *system) {
  return committed(system);
}

static const int64_t corners[4] = {0, 1, 2, 3}, edges[12] = {0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3};

static void random_corners(struct random_source *source, double q[12]) {
  do {
    for (int k = 0; k < 12; k++)
      q[k] = random_between(source, -1.0, 1.0);
  } while (fabs(volume_of(q, corners)) < 0.3);
}

/* ---- one tetrahedron ---- */

/* Width of the tetrahedron between two planes normal to n. */
static double width_along(const double *q, const double n[3]) {
  double low = INFINITY, high = -INFINITY;
  for (int p = 0; p < 4; p++) {
    const double at = dot(q + 3 * p, n);
    low = fmin(low, at);
    high = fmax(high, at);
  }
  return (high - low) / sqrt(dot(n, n));
}

/* The shortest altitude is the minimum width of the tetrahedron: no direction has a smaller one, and that of
 * the force has it. */
TEST(the_shortest_is_the_least_width) {
  struct random_source source = {3};
  const double still[12] = {0};
  for (int trial = 0; trial < 200; trial++) {
    double q[12], length, force[12], rest[7];
    random_corners(&source, q);
    owned_system *system = commit(new_scene(4, q, 1, corners, 5.0, 0.0, 1.25));
    check_ok(hooke_system_altitude_lengths(system, q, &length));
    check_ok(hooke_system_members(system, "altitude", NULL, NULL, NULL, rest));
    double least = INFINITY;
    for (int k = 0; k < 7; k++) {
      assert_true((rest[k] < 0.0) == (volume_of(q, corners) < 0.0));
      least = fmin(least, fabs(rest[k]) / 1.25);
    }
    check_close(length, least, 1e-14);
    for (int k = 0; k < 300; k++) {
      double n[3];
      for (int a = 0; a < 3; a++)
        n[a] = random_between(&source, -1.0, 1.0);
      if (dot(n, n) > 0.01) assert_true(width_along(q, n) >= length * (1.0 - 1e-12));
    }
    check_ok(hooke_system_force(system, 0.0, q, still, force));
    /* a repulsion of 5 (1/1.25 - 1), which adds up to 1 on either side, within the tetrahedron */
    double out[3] = {0}, push = 0.0, most = 0.0;
    for (int p = 0; p < 4; p++) {
      if (dot(force + 3 * p, force + 3 * p) > most) {
        most = dot(force + 3 * p, force + 3 * p);
        memcpy(out, force + 3 * p, sizeof out);
      }
    }
    check_close(width_along(q, out), length, 1e-12);
    for (int p = 0; p < 4; p++)
      push += fmax(0.0, dot(force + 3 * p, out) / sqrt(most));
    check_close(push, 5.0 * (1.0 - 1.0 / 1.25), 1e-12);
  }
}

/* Rest lengths are three volumes over the area of a face, or the volume over the parallelogram of two
 * edges. */
TEST(rest_lengths_are_altitudes) {
  const double q[12] = {0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0, 2}; /* at a corner of three right angles: 6 V = 24 */
  double rest[7];
  owned_system *system = commit(new_scene(4, q, 1, corners, 1.0, 0.0, 1.0));
  check_ok(hooke_system_members(system, "altitude", NULL, NULL, NULL, rest));
  const double face = 24.0 / sqrt(12.0 * 12.0 + 8.0 * 8.0 + 6.0 * 6.0);
  const double expected[7] = {
      face, 3.0, 4.0, 2.0, 24.0 / (3.0 * sqrt(20.0)), 24.0 / (4.0 * sqrt(13.0)), 24.0 / (2.0 * 5.0)};
  for (int k = 0; k < 7; k++)
    check_close(rest[k], expected[k], 1e-14);
}

/* Pushed through the opposite face, the particle comes back; held by edges alone it stays on the wrong side.
 */
TEST(what_is_inside_out_turns_back) {
  const double q0[12] = {0, 0, 0, 1, 0, 0, 0.4, 1, 0, 0.5, 0.4, 0.5};
  for (int with = 0; with <= 1; with++) {
    double q[12], v[12] = {0};
    owned_system *system = new_scene(4, q0, 1, corners, with ? 40.0 : 0.0, 0.0, 1.0);
    add_springs(system, 6, edges, 10.0);
    check_ok(hooke_system_set_drag(system, 2.0));
    commit(system);
    memcpy(q, q0, sizeof q);
    q[11] = -q[11];
    owned_state *state = start_state(system);
    memcpy(hooke_state_position(state), q, sizeof q);
    memcpy(hooke_state_velocity(state), v, sizeof v);
    owned_integrator *integrator =
        start_with(system, .method = "symplectic-euler", .step = 1e-3, .duration = 40.0, .every = 40.0);
    check_ok(hooke_integrator_run(integrator, state));
    const double volume = volume_of(hooke_state_position(state), corners), whole = volume_of(q0, corners);
    check_close(volume, with ? whole : -whole, 1e-3 * whole);
  }
}

/* ---- motion ---- */

static void run_from(const hooke_system *system, struct run run, int64_t n, double *q, double *v) {
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  const size_t bytes = (size_t)(3 * n) * sizeof(double);
  memcpy(hooke_state_position(state), q, bytes);
  memcpy(hooke_state_velocity(state), v, bytes);
  check_ok(hooke_integrator_run(integrator, state));
  memcpy(q, hooke_state_position(state), bytes);
  memcpy(v, hooke_state_velocity(state), bytes);
}

/* A flat pyramid, whose shortest altitude by far is that of its top. */
static const double pyramid[12] = {0, 0, 0, 1, 0, 0, 0.4, 1, 0, 0.5, 0.4, 0.3};

/* Relative error of the energy at a time; the top swings by a tenth of its height. */
static double energy_error(double step) {
  double q[12], v[12] = {0};
  memcpy(q, pyramid, sizeof q);
  owned_system *system = new_scene(4, q, 1, corners, 40.0, 0.0, 1.0);
  add_springs(system, 6, edges, 10.0);
  commit(system);
  v[11] = 0.2, v[3] = 0.05;
  const double before = hooke_system_energy(system, "total", q, v);
  run_from(system, (struct run){.method = "verlet", .step = step, .duration = 0.3, .every = 0.3}, 4, q, v);
  const double after = hooke_system_energy(system, "total", q, v);
  assert_true(hooke_system_energy(system, "altitude", q, NULL) > 1e-3 * before);
  return fabs(after - before) / before;
}

TEST(verlet_keeps_the_energy_to_its_order) {
  const double coarse = energy_error(5e-3), fine = energy_error(5e-4);
  check_between(coarse, 1e-6, 1e-2);
  check_between(fine / coarse, 0.005, 0.02);
}

/* At a change of the altitude the energy jumps by the difference due to the rest lengths, and momentum is
 * conserved. */
TEST(the_energy_jumps_where_another_altitude_acts) {
  double q[12], jump = 0.0, last = NAN, at = NAN;
  memcpy(q, pyramid, sizeof q);
  owned_system *system = commit(new_scene(4, q, 1, corners, 40.0, 0.0, 1.0));
  for (int k = 0; k <= 4000; k++) {
    q[11] = 0.3 + 1e-3 * k;
    const double energy = hooke_system_energy(system, "altitude", q, NULL);
    if (fabs(energy - last) > jump) {
      jump = fabs(energy - last);
      at = q[11];
    }
    last = energy;
  }
  /* the slope of the first altitude's energy is 40 (h - 0.3)/0.3 a metre */
  assert_true(jump > 10.0 * 1e-3 * 40.0 * (at - 0.3) / 0.3);
}

/* Far from rest the jumps are a source of energy at any step; a run that they end reports it. */
TEST(a_run_that_jumps_drive_is_explained) {
  const double v[12] = {0.1, -0.1, 0.3, 0.1, -0.3, 0.2, 0.7, 0.5, -0.4, -0.6, -0.3, 0.0}, mass = 0.5;
  owned_system *system = small_system(4, pyramid, v, mass, 0);
  owned_options *options = options_with("altitude", "stiffness=40");
  check_ok(hooke_system_add_altitude(system, "a", 1, corners, options));
  add_springs(system, 6, edges, 1.0);
  commit(system);
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 2e-3, .duration = 20.0,
            .every = 0.1);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  hooke_measurement *why = NULL;
  const int32_t status = explain_run(integrator, &why);
  if (status != HOOKE_NOT_BUILT) {
    check_status(status, HOOKE_OK);
    assert_string_equal(hooke_measurement_text(why, "why", 0, "cause"), "model-gains-energy");
    if (strstr(hooke_measurement_text(why, "why", 0, "sentence"), "the model gains energy by itself") == NULL)
      check_failed("%s", hooke_measurement_text(why, "why", 0, "sentence"));
    assert_true(hooke_measurement_row_count(why, "advice") > 0);
    hooke_measurement_destroy(why);
  }
}

enum { SEGMENTS = 24, CURL = SEGMENTS + 1 };

/* A curl as a part: 24 segments, two turns, 1 cm about 8 cm. */
static hooke_system *new_curl(double turns, double twist, double altitude, double damping,
                              const char *pinned) {
  const char *const family[] = {"stretch", "bend", "twist", "altitude"};
  const double stiffness[] = {40.0, 4.0, twist, altitude};
  hooke_system *system = new_system();
  owned_options *options = options_with(
      "strand", "from=0,0,0 to=0,-0.08,0 segments=%d curl=0.01 turns=%.17g mass=1e-3", SEGMENTS, turns);
  if (pinned) check_ok(hooke_options_set_text(options, "pinned", pinned));
  for (int k = 0; k < 4; k++) {
    char name[64];
    if (stiffness[k] == 0.0) continue;
    snprintf(name, sizeof name, "%s.stiffness", family[k]);
    check_ok(hooke_options_set_number(options, name, stiffness[k]));
    snprintf(name, sizeof name, "%s.damping", family[k]);
    check_ok(hooke_options_set_number(options, name, damping * stiffness[k]));
  }
  check_ok(hooke_system_add_part(system, "strand", "hair", options, NULL, NULL));
  return system;
}

TEST(momenta_stay) {
  struct random_source source = {8};
  owned_system *system = commit(new_curl(2.0, 2.0, 1.0, 1e-5, NULL));
  double q[3 * CURL], v[3 * CURL], before[6], after[6];
  owned_state *state = start_state(system);
  memcpy(q, hooke_state_position(state), sizeof q);
  for (int k = 0; k < 3 * CURL; k++)
    v[k] = random_between(&source, -0.5, 0.5);
  hooke_system_momentum(system, v, before);
  hooke_system_angular_momentum(system, q, v, before + 3);
  run_from(system, (struct run){.method = "symplectic-euler", .step = 1e-5, .duration = 0.1, .every = 0.1},
           CURL, q, v);
  hooke_system_momentum(system, v, after);
  hooke_system_angular_momentum(system, q, v, after + 3);
  assert_true(largest(3, before) > 1e-6 && largest(3, before + 3) > 1e-8);
  check_between(largest_difference(6, before, after), 0.0, 1e-16);
}

/* Every method agrees with Runge-Kutta with a fine step. */
TEST(methods_agree) {
  owned_system *system = new_curl(2.0, 2.0, 1.0, 1e-4, "0,1,2");
  const double gravity[3] = {0.0, -9.81, 0.0};
  check_ok(hooke_system_set_gravity(system, gravity));
  commit(system);
  double expected[3 * CURL];
  end_of_run(expected, NULL, system, .method = "rk4", .step = 5e-6, .duration = 0.005, .every = 0.005);
  for (const char *method = NULL; (method = next_method(method, hooke_method_is_built));) {
    struct run run = {.method = method, .duration = 0.005, .every = 0.005};
    const int first_order = strstr(method, "euler") != NULL;
    if (hooke_method_is_adaptive(method))
      run.rtol = 1e-9, run.atol = 1e-12;
    else
      run.step = first_order ? 4e-6 : 1e-5;
    double q[3 * CURL];
    run_to_end(system, run, q, NULL);
    const double error = largest_difference(3 * CURL, q, expected);
    if (error > (first_order ? 3e-6 : 1e-8)) check_failed("%s is off by %g", method, error);
  }
}

/* ---- a hanging curl ---- */

/* Fraction of tetrahedra of four consecutive particles that never invert, frame by frame, in half a second.
 */
static double share_kept(double turns, double twist, double altitude) {
  enum { FRAMES = 50 };
  owned_system *system = new_curl(turns, twist, altitude, 1e-5, "0,1,2");
  const double gravity[3] = {0.0, -9.81, 0.0};
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, 1e-5));
  commit(system);
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 2e-5, .duration = 0.01,
            .every = 0.01);
  int turned[CURL - 3] = {0}, kept = 0;
  for (int frame = 0; frame <= FRAMES; frame++) {
    for (int64_t k = 0; k < CURL - 3; k++) {
      const double volume = volume_of(hooke_state_position(state), (const int64_t[]){k, k + 1, k + 2, k + 3});
      turned[k] |= !(volume * turns > 0.0);
    }
    if (frame < FRAMES) check_ok(hooke_integrator_run(integrator, state));
  }
  for (int k = 0; k < CURL - 3; k++)
    kept += !turned[k];
  return (double)kept / (CURL - 3);
}

/* Released, a curl keeps its handedness by altitude and twist springs, for either hand; not without both of
 * them, nor by twist springs alone. */
TEST(a_hanging_curl_stays_a_curl) {
  check_between(share_kept(2.0, 2.0, 1.0), 1.0, 1.0);
  check_between(share_kept(-2.0, 2.0, 1.0), 1.0, 1.0);
  check_between(share_kept(2.0, 0.0, 0.0), 0.0, 0.8);
  check_between(share_kept(2.0, 2.0, 0.0), 0.0, 0.9);
}

/* ---- numbers ---- */

TEST(groups_and_numbers) {
  double q[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  const int64_t two[8] = {3, 2, 1, 0, 4, 1, 2, 3};
  owned_system *system = new_curl(2.0, 2.0, 1.0, 0.0, NULL);
  int64_t first = 0;
  const double mass = 1.0;
  check_ok(hooke_system_add_particles(system, 5, q, NULL, 1, &mass, &first));
  assert_int_equal(first, CURL);
  int64_t shifted[8];
  for (int k = 0; k < 8; k++)
    shifted[k] = two[k] + first;
  owned_options *options = new_options("altitude");
  check_ok(hooke_options_set_numbers(options, "stiffness", 2, (const double[]){0.0, 3.0}));
  check_ok(hooke_system_add_altitude(system, "mine", 2, shifted, options));
  assert_int_equal(hooke_system_count(system, "altitude"), 2 + CURL - 3);
  check_status(hooke_system_members(system, "altitude", shifted, NULL, NULL, NULL), HOOKE_BAD_CALL);
  commit(system);
  check_status(hooke_system_add_altitude(system, "mine", 2, shifted, options), HOOKE_BAD_CALL);
  assert_int_equal(hooke_system_count(system, "altitude"), 1 + CURL - 3);
  assert_int_equal(hooke_system_group_count(system, "altitude"), 2);
  assert_string_equal(hooke_system_group_name(system, "altitude", 0), "mine");
  assert_string_equal(hooke_system_group_name(system, "altitude", 1), "hair.altitude");
  assert_null(hooke_system_group_name(system, "altitude", 2));
  assert_int_equal(hooke_system_group_size(system, "altitude", 0), 1);
  assert_int_equal(hooke_system_group_size(system, "altitude", 1), CURL - 3);
  assert_string_equal(hooke_system_force_name(system, 1), "altitude");
  int64_t ends[4 * (CURL - 2)];
  double strength[CURL - 2], brake[CURL - 2], rest[7 * (CURL - 2)];
  check_ok(hooke_system_members(system, "altitude", ends, NULL, NULL, NULL));
  assert_memory_equal(ends, shifted + 4, 4 * sizeof *ends);
  for (int64_t k = 0; k < CURL - 3; k++) {
    for (int64_t e = 0; e < 4; e++)
      assert_int_equal(ends[4 * (k + 1) + e], k + e);
  }
  check_ok(hooke_system_members(system, "altitude", NULL, strength, brake, rest));
  check_close(strength[0], 3.0, 0.0);
  check_close(strength[1], 1.0, 0.0);
  check_same_bits(7, rest + 7, rest + 7 * (CURL - 3)); /* those of a strand share one set of numbers */
}

/* Altitude springs without stiffness and damping add no force and no memory, and change no bit. */
TEST(no_strength_is_no_altitude_spring) {
  double q[12], v[12] = {0.1, 0.2, 0.3}, other_q[12], other_v[12];
  memcpy(q, pyramid, sizeof q);
  owned_system *with = new_scene(4, q, 1, corners, 0.0, 0.0, 1.0),
               *without = new_scene(4, q, 0, corners, 1.0, 0.0, 1.0);
  add_springs(with, 6, edges, 10.0);
  add_springs(without, 6, edges, 10.0);
  commit(with);
  commit(without);
  assert_int_equal(hooke_system_count(with, "forces"), 1);
  assert_int_equal(hooke_system_count(with, "altitude"), 0);
  assert_int_equal(hooke_system_count(with, "memory"), hooke_system_count(without, "memory"));
  memcpy(other_q, q, sizeof q);
  memcpy(other_v, v, sizeof v);
  const struct run run = {.method = "symplectic-euler", .step = 1e-3, .duration = 0.1, .every = 0.1};
  run_from(with, run, 4, q, v);
  run_from(without, run, 4, other_q, other_v);
  check_same_bits(12, q, other_q);
}

/* All particles in one line, or at one point: no altitude, no force, no NaN. */
TEST(a_line_has_no_altitude) {
  double line[12], force[12], length = 1.0;
  const double still[12] = {0};
  owned_system *system = commit(new_scene(4, pyramid, 1, corners, 40.0, 1.0, 1.0));
  for (int spread = 0; spread <= 1; spread++) {
    for (int k = 0; k < 12; k++)
      line[k] = (k % 3 + 1) * (1.0 + spread * (k / 3));
    check_ok(hooke_system_force(system, 0.0, line, still, force));
    check_between(largest(12, force), 0.0, 0.0);
    check_between(hooke_system_energy(system, "altitude", line, NULL), 0.0, 0.0);
    check_ok(hooke_system_altitude_lengths(system, line, &length));
    check_between(length, 0.0, 0.0);
  }
}

TEST(bad_tetrahedra_are_refused) {
  const double q[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1e-10, 0, 0, 1};
  const int64_t flat[8] = {0, 1, 2, 4, 0, 1, 2, 3}, far[4] = {0, 1, 5, 2}, twice[4] = {0, 4, 2, 4};
  owned_options *options = NULL, *springs = NULL;
  owned_system *system = new_scene(5, q, 0, flat, 1.0, 0.0, 1.0);
  options = new_options("altitude");
  springs = new_options("springs");
  check_status(hooke_system_add_altitude(system, "a", 1, flat, options), HOOKE_BAD_VALUE);
  check_message("stiffness: is required");
  check_ok(hooke_options_set_number(options, "stiffness", 1.0));
  check_status(hooke_system_add_altitude(system, "a", 2, flat, options), HOOKE_BAD_VALUE);
  check_message("tetrahedra[1]: particles 0, 1, 2 and 3 lie in a plane at rest: their shortest altitude is");
  check_status(hooke_system_add_altitude(system, "a", 1, far, options), HOOKE_BAD_VALUE);
  check_message("tetrahedra[0][2]: there is no particle 5; allowed: 0 to 4, as numbers begin at 0");
  check_status(hooke_system_add_altitude(system, "a", 1, twice, options), HOOKE_BAD_VALUE);
  check_message("tetrahedra[0]: particles 0, 4, 2 and 4; a tetrahedron has four different ones");
  check_status(hooke_system_add_altitude(system, "a", -1, flat, options), HOOKE_BAD_VALUE);
  check_message("-1 tetrahedra");
  check_status(hooke_system_add_altitude(system, "a", 1, flat, springs), HOOKE_BAD_VALUE);
  check_message("hooke_options_create(\"altitude\", ...)");
  check_ok(hooke_options_set_numbers(options, "stiffness", 3, (const double[]){1, 2, 3}));
  check_status(hooke_system_add_altitude(system, "a", 2, flat, options), HOOKE_BAD_VALUE);
  check_message("3 values for 2 tetrahedra");
  check_status(hooke_options_set_number(options, "stiffness", -1.0), HOOKE_BAD_VALUE);
  assert_int_equal(hooke_system_group_count(system, "altitude"), 1);
}
