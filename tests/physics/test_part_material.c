/* Density, damping ratio and bending stiffness of parts: the resulting particles, springs and triples. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static hooke_options *new_rope(double length, double segments, const char *of_mass, double mass) {
  return options_with("rope", "from=0,0,0 to=%.17g,0,%.17g segments=%.17g %s=%.17g", 0.6 * length,
                      0.8 * length, segments, of_mass, mass);
}

/* Edges of 2 m and 1 m, 60 degrees apart. */
static hooke_options *new_cloth(double nu, double nv, const char *of_mass, double mass) {
  return options_with("cloth", "origin=1,2,3 edges=2,0,0,0.5,0,%.17g size=%.17g,%.17g %s=%.17g", sqrt(0.75),
                      nu, nv, of_mass, mass);
}

/* The options are destroyed. */
static hooke_system *build(const char *kind, hooke_options *options) {
  hooke_system *system = new_system();
  check_ok(hooke_system_add_part(system, kind, "part", options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  hooke_options_destroy(options);
  return system;
}

static double derived(const hooke_system *system, const char *family, const char *name) {
  double value = NAN;
  for (int64_t k = 0; k < hooke_system_count(system, "derived"); k++) {
    const char *of = hooke_system_derived_text(system, k, "family");
    assert_string_equal(hooke_system_derived_text(system, k, "part"), "part");
    const int is_of_it = family && of ? strcmp(of, family) == 0 : family == of;
    if (is_of_it && strcmp(hooke_system_derived_text(system, k, "name"), name) == 0)
      value = hooke_system_derived_value(system, k);
  }
  return value;
}

/* ---- density ---- */

static double total(const hooke_system *system) {
  double sum = 0.0;
  for (int64_t p = 0; p < hooke_system_particle_count(system); p++)
    sum += hooke_system_mass(system)[p];
  return sum;
}

TEST(a_rope_weighs_the_same_at_every_resolution) {
  for (int n = 1; n <= 64; n *= 2) {
    owned_system *rope = build("rope", new_rope(3.0, n, "density", 0.2));
    const double *mass = hooke_system_mass(rope);
    check_close(total(rope), 0.6, 1e-15);
    check_close(mass[0], 0.3 / n, 1e-16);
    check_close(mass[n], 0.3 / n, 1e-16);
    for (int p = 1; p < n; p++)
      check_close(mass[p], 0.6 / n, 1e-16);
    check_close(derived(rope, NULL, "mass of an end"), mass[0], 0.0);
    if (n > 1) check_close(derived(rope, NULL, "mass of an inner particle"), mass[1], 0.0);
    assert_int_equal(hooke_system_count(rope, "derived"), n > 1 ? 2 : 1);
  }
}

TEST(a_cloth_weighs_its_area) {
  const int size[][2] = {{2, 2}, {2, 5}, {6, 2}, {7, 4}, {33, 17}};
  for (size_t k = 0; k < sizeof size / sizeof size[0]; k++) {
    const int nu = size[k][0], nv = size[k][1];
    owned_system *cloth = build("cloth", new_cloth(nu, nv, "density", 0.3));
    const double cell = 2.0 * sqrt(0.75) / ((nu - 1) * (nv - 1)), *mass = hooke_system_mass(cloth);
    check_close(total(cloth), 0.3 * 2.0 * sqrt(0.75), 1e-14);
    for (int p = 0; p < nu * nv; p++) {
      const int r = p / nu, c = p % nu;
      const double side = r == 0 || r == nv - 1 ? 0.5 : 1.0, end = c == 0 || c == nu - 1 ? 0.5 : 1.0;
      check_close(mass[p], 0.3 * cell * side * end, 1e-15);
    }
    check_close(derived(cloth, NULL, "mass of a corner"), mass[0], 0.0);
    assert_int_equal(hooke_system_count(cloth, "derived"), 1 + (nu > 2 || nv > 2) + (nu > 2 && nv > 2));
  }
}

TEST(a_mass_is_shared_equally) {
  owned_system *rope = build("rope", new_rope(3.0, 4, "mass", 0.5));
  for (int p = 0; p < 5; p++)
    check_close(hooke_system_mass(rope)[p], 0.1, 0.0);
  assert_int_equal(hooke_system_count(rope, "derived"), 0);
  assert_null(hooke_system_derived_text(rope, 0, "name"));
  assert_true(isnan(hooke_system_derived_value(rope, 0)));
}

/* ---- damping ratio ---- */

/* Two particles of one spring: each swing is smaller than the previous one by exp(-2 pi zeta/sqrt(1 -
 * zeta^2)). */
TEST(a_pair_swings_as_its_ratio_says) {
  const double zeta = 0.2, m = 0.25, kappa = 50.0 / 0.8;
  hooke_options *options = new_rope(1.0, 1, "mass", 2.0 * m);
  set_options(options, "stretch.stiffness=50 stretch.damping_ratio=%.17g stretch.rest_scale=0.8", zeta);
  owned_system *pair = build("rope", options);
  const double omega = sqrt(2.0 * kappa / m), period = 2.0 * acos(-1.0) / (omega * sqrt(1.0 - zeta * zeta));
  double q[6];
  end_of_run(q, NULL, pair, .method = "rk4", .step = period / 1000, .duration = period, .every = period);
  const double length = hypot(q[0] - q[3], q[2] - q[5]);
  check_close((length - 0.8) / 0.2, exp(-2.0 * acos(-1.0) * zeta / sqrt(1.0 - zeta * zeta)), 1e-8);
}

/* A mass of 1 kg on 1800 N/m, let go 1 m from rest: the spring of a user interface, by the closed form. */
TEST(a_group_overshoots_as_its_ratio_says) {
  const double q0[] = {0, 0, 0, 11, 0, 0};
  const int64_t ends[] = {0, 1};
  double q[6];
  owned_system *system = small_system(2, q0, NULL, 1.0, 1);
  small_group(system, "springs", NULL, 1, ends, "law=length stiffness=1800 rest_length=10 damping_ratio=0.6");
  check_ok(hooke_system_commit(system));
  const double turn = acos(-1.0) / (sqrt(1800.0) * 0.8); /* from one end of the swing to the other */
  const struct run run = {.method = "rk4", .step = turn / 1000, .duration = turn, .every = turn};
  run_to_end(system, run, q, NULL);
  check_close(10.0 - q[3], 0.0947802, 1e-6);
  end_of_run(q, NULL, system, .method = "rk4", .step = 1e-4, .duration = 0.4, .every = 0.4);
  check_close(q[3], 10.000044149, 1e-9);
}

/* c = 2 zeta sqrt(kappa mu), where a held end is infinitely heavy; of two held ones there is none. */
TEST(a_group_is_damped_as_its_ends_are_held) {
  const double q[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0}, mass[] = {1, 2, 3, 5}, amplitude[] = {0, 0, 1};
  const int64_t ends[] = {1, 2, 0, 1, 2, 3, 3, 0}, pinned = 0, driven = 3;
  const double zeta[] = {0.1, 0.2, 0.3, 0.4}, kappa = 36.0 / 1.5, free = 2.0 * 3.0 / (2.0 + 3.0);
  for (int each = 0; each < 2; each++) {
    double gamma[4];
    owned_system *system = new_system();
    check_ok(hooke_system_add_particles(system, 4, q, NULL, 4, mass, NULL));
    small_group(system, "springs", NULL, 4, ends, "stiffness=36 rest_scale=0.75 damping_ratio=%s",
                each ? "0.1,0.2,0.3,0.4" : "0.1");
    check_ok(hooke_system_pin(system, 1, &pinned));
    check_ok(hooke_system_drive_harmonic(system, 1, &driven, amplitude, 1.0, 0.0));
    check_ok(hooke_system_commit(system));
    const int64_t kept = hooke_system_count(system, "springs");
    assert_int_equal(kept, 4);
    check_ok(hooke_system_members(system, "springs", NULL, NULL, gamma, NULL));
    const double mu[] = {free, 2.0, 3.0, 0.0};
    for (int k = 0; k < 4; k++)
      check_close(gamma[k], 2.0 * zeta[each ? k : 0] * sqrt(kappa * mu[k]), 1e-14);
  }
}

TEST(every_direction_has_its_own) {
  hooke_options *options = new_cloth(21, 31, "density", 0.3);
  set_options(options, "structural.stiffness=40 structural.damping_ratio=0.1 shear.stiffness=7 "
                       "shear.damping_ratio=0.3 shear.rest_scale=1.1 bend.stiffness=3 bend.damping=0.02");
  owned_system *cloth = build("cloth", options);
  const double u = 0.1, v = 1.0 / 30, m = 0.3 * u * v * sqrt(0.75);
  const double along = sqrt(u * u + v * v + u * v), across = sqrt(u * u + v * v - u * v);
  const struct {
    const char *family, *kappa, *gamma;
    int64_t count;
    double stiffness, length, zeta;
  } strip[] = {{"structural", "kappa along u", "gamma along u", 20 * 31, 40.0, u, 0.1},
               {"structural", "kappa along v", "gamma along v", 21 * 30, 40.0, v, 0.1},
               {"shear", "kappa along u + v", "gamma along u + v", 20 * 30, 7.0, 1.1 * along, 0.3},
               {"shear", "kappa along u - v", "gamma along u - v", 20 * 30, 7.0, 1.1 * across, 0.3}};
  const int64_t springs = hooke_system_count(cloth, "springs");
  owned_doubles *kappa = new_doubles(springs), *gamma = new_doubles(springs);
  check_ok(hooke_system_members(cloth, "springs", NULL, kappa, gamma, NULL));
  int64_t k = 0;
  for (size_t s = 0; s < sizeof strip / sizeof strip[0]; s++) {
    const double first_kappa = kappa[k], first_gamma = gamma[k],
                 expected = strip[s].stiffness / strip[s].length;
    check_close(first_kappa, expected, 1e-12 * expected);
    check_close(first_gamma, 2.0 * strip[s].zeta * sqrt(expected * m / 2.0), 1e-12 * first_gamma);
    check_close(derived(cloth, strip[s].family, strip[s].kappa), first_kappa, 0.0);
    check_close(derived(cloth, strip[s].family, strip[s].gamma), first_gamma, 0.0);
    for (const int64_t end = k + strip[s].count; k < end; k++) {
      check_same_bits(1, &kappa[k], &first_kappa);
      check_same_bits(1, &gamma[k], &first_gamma);
    }
  }
  for (; k < springs; k++)
    assert_true(gamma[k] > 0.0);
  assert_true(isnan(derived(cloth, "bend", "gamma along u"))); /* is kept as given */
}

/* Values equal to the bit take no memory of their own: a cloth with a ratio is as small as one with a
 * damping. */
TEST(ratios_keep_the_runs) {
  hooke_options *ratio = new_cloth(40, 50, "mass", 0.3), *plain = new_cloth(40, 50, "mass", 0.3);
  set_options(ratio, "structural.stiffness=40 structural.damping_ratio=0.1");
  set_options(plain, "structural.stiffness=40 structural.damping=0.1");
  owned_system *a = build("cloth", ratio), *b = build("cloth", plain);
  check_between((double)(hooke_system_count(a, "memory") - hooke_system_count(b, "memory")), 0.0, 2000.0);
}

/* ---- bending ---- */

/* Lines along u row by row, then lines along v, first particle row by row; half at the edges. */
TEST(a_cloth_bends_along_its_lines) {
  const int nu = 5, nv = 4;
  hooke_options *options = new_cloth(nu, nv, "mass", 0.3);
  check_ok(hooke_options_set_number(options, "bending", 0.7));
  owned_system *cloth = build("cloth", options);
  const double u = 0.5, v = 1.0 / 3, area = u * v * sqrt(0.75);
  const double along_u = 0.7 * (area / u) / (u * u * u), along_v = 0.7 * (area / v) / (v * v * v);
  assert_int_equal(hooke_system_count(cloth, "bending"), nv * (nu - 2) + (nv - 2) * nu);
  int64_t triples[3 * 22], k = 0;
  double c[22];
  check_ok(hooke_system_members(cloth, "bending", triples, NULL, NULL, NULL));
  check_ok(hooke_system_members(cloth, "bending", NULL, c, NULL, NULL));
  for (int r = 0; r < nv; r++) {
    for (int at = r * nu; at < r * nu + nu - 2; at++, k++) {
      for (int e = 0; e < 3; e++)
        assert_int_equal(triples[3 * k + e], at + e);
      check_close(c[k], r == 0 || r == nv - 1 ? 0.5 * along_u : along_u, 1e-14);
    }
  }
  for (int at = 0; at < (nv - 2) * nu; at++, k++) {
    for (int e = 0; e < 3; e++)
      assert_int_equal(triples[3 * k + e], at + e * nu);
    check_close(c[k], at % nu == 0 || at % nu == nu - 1 ? 0.5 * along_v : along_v, 1e-13);
  }
  assert_int_equal(k, 22);
  check_close(derived(cloth, "bending", "c along u"), along_u, 1e-14);
  check_close(derived(cloth, "bending", "c along u at an edge"), 0.5 * along_u, 1e-14);
  check_close(derived(cloth, "bending", "c along v"), along_v, 1e-13);
  check_close(derived(cloth, "bending", "c along v at an edge"), 0.5 * along_v, 1e-13);
  assert_string_equal(hooke_system_group_name(cloth, "bending", 0), "part.bending");
}

/* A cloth of one cell across has edges only; one of two particles along a direction does not bend along it.
 */
TEST(narrow_cloths) {
  hooke_options *strip = new_cloth(2, 6, "mass", 0.3), *cell = new_cloth(2, 2, "mass", 0.3);
  check_ok(hooke_options_set_number(strip, "bending", 0.7));
  check_ok(hooke_options_set_number(cell, "bending", 0.7));
  owned_system *a = build("cloth", strip), *b = build("cloth", cell);
  assert_int_equal(hooke_system_count(a, "bending"), 8);
  assert_true(isnan(derived(a, "bending", "c along v")));
  assert_true(derived(a, "bending", "c along v at an edge") > 0.0);
  assert_int_equal(hooke_system_group_count(b, "bending"), 0);
  assert_int_equal(hooke_system_count(b, "derived"), 0);
}

/* A part that fails midway leaves nothing behind. */
TEST(failures_are_rolled_back) {
  owned_options *fine = new_rope(1.0, 4, "density", 0.2), *bad = new_rope(1.0, 4, "density", 0.2);
  check_ok(hooke_options_set_number(fine, "bending", 1.0));
  set_options(bad, "bending=1 pinned=9");
  owned_system *system = new_system();
  check_ok(hooke_system_add_part(system, "rope", NULL, fine, NULL, NULL));
  check_status(hooke_system_add_part(system, "rope", NULL, bad, NULL, NULL), HOOKE_BAD_VALUE);
  check_message("pinned[0]");
  assert_int_equal(hooke_system_group_count(system, "bending"), 1);
  assert_int_equal(hooke_system_count(system, "derived"), 3);
  check_ok(hooke_options_unset(bad, "pinned"));
  check_ok(hooke_options_set_number(bad, "mass", 1.0));
  check_status(hooke_system_add_part(system, "rope", NULL, bad, NULL, NULL), HOOKE_BAD_VALUE);
  check_message("mass and density are both given");
  check_ok(hooke_options_unset(bad, "mass"));
  check_ok(hooke_options_unset(bad, "density"));
  check_status(hooke_system_add_part(system, "rope", NULL, bad, NULL, NULL), HOOKE_BAD_VALUE);
  check_message("neither mass nor density");
}
