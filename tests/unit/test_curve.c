/* Curves of springs: the cubic, its integral, what springs that only pull leave of it, the largest stiffness,
 * and what copies, variants and written scenes keep. */
#include "check.h"
#include "small.h"

#include "model/check_value.h"
#include "model/force/spring.h"
#include "model/system.h"
#include "model/variant/variant.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A spring of 2 m along x, of 1 m at the start. */
static hooke_system *pair(const char *words) {
  const double place[6] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[2] = {0, 1};
  hooke_system *system = small_system(2, place, NULL, 1.0, 1);
  owned_options *options = new_options("springs");
  check_ok(try_words(options, words));
  check_ok(hooke_options_set_number(options, "rest_length", 2.0));
  check_ok(hooke_system_add_springs(system, "curved", 1, ends, options));
  return committed(system);
}

static struct hk_law law_at(const hooke_system *system, double length) {
  const struct hk_spring spring = hk_springs_find(system->springs, 0, 0.0);
  return hk_spring_law(&spring, length);
}

/* Values and integrals from 0 by PchipInterpolator of SciPy 1.17.1 and its antiderivative(); beyond the ends
 * lines of the slopes 142.5 and 92.38095238095241 that its derivative() has there. */
TEST(a_table_is_the_cubic_of_fritsch_and_butland) {
  static const double known[][3] = {
      {-0.3, -16.430555555555557, 1.9093017762660605}, {-0.05, -1.3304988662131523, 0.033203420256991301},
      {0.1, 3.0338168325181316, 0.15043114353179288},  {0.3, 5.400125968307786, 1.0943261539446612},
      {0.45, 5.7586334645993746, 1.9287449568116175},  {0.7, 13.683836996336993, 3.9928386999003882}};
  owned_system *system = pair("curve.strain=-0.5,-0.1,0,0.2,0.5,0.9 curve.force=-40,-3,0,5,6,30");
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
    const struct hk_law law = law_at(system, 2.0 * (1.0 + known[k][0]));
    check_close(law.tension, known[k][1], 1e-14 * 40.0);
    check_close(law.energy, 2.0 * known[k][2], 1e-14 * 20.0);
  }
  const double below = -0.2, above = 0.4, low = 142.5, high = 92.38095238095241;
  const struct hk_law first = law_at(system, 2.0 * (1.0 - 0.5 + below)),
                      last = law_at(system, 2.0 * (1.9 + above));
  check_close(first.tension, -40.0 + low * below, 1e-12);
  check_close(first.slope, low / 2.0, 1e-12);
  check_close(first.energy, 2.0 * (7.386848072562357 - 40.0 * below + low * below * below / 2.0), 1e-12);
  check_close(last.tension, 30.0 + high * above, 1e-12);
  check_close(last.energy, 2.0 * (8.271253687690377 + 30.0 * above + high * above * above / 2.0), 1e-12);
  check_between(law_at(system, 2.0).energy, 0.0, 0.0);
}

TEST(coefficients_are_those_of_powers) {
  owned_system *system = pair("law=length curve.coefficients=3,-0.5,0.25");
  for (double e = -1.5; e < 3.0; e += 0.37) {
    const struct hk_law law = law_at(system, 2.0 + e);
    check_close(law.tension, 3.0 * e - 0.5 * e * e + 0.25 * e * e * e, 1e-13);
    check_close(law.slope, 3.0 - e + 0.75 * e * e, 1e-13);
    check_close(law.energy, 1.5 * e * e - 0.5 / 3.0 * e * e * e + 0.0625 * e * e * e * e, 1e-13);
  }
}

/* max(0, F) above the rest length, whose integral is the energy: by the spring that pushes too. */
static void check_clipped(const char *words) {
  enum { STEPS = 4000 };
  char both[256];
  snprintf(both, sizeof both, "%s compression=false", words);
  owned_system *raw = pair(words), *pulls = pair(both);
  const double h = 4.0 / STEPS;
  double sum = 0.0;
  int changes = 0;
  for (int k = 0; k < STEPS; k++) {
    const double r = 2.0 + (k + 0.5) * h, force = law_at(raw, r).tension;
    changes += (force > 0.0) != (law_at(raw, r + h).tension > 0.0);
    check_close(law_at(pulls, r).tension, fmax(0.0, force), 1e-13);
    sum += fmax(0.0, force) * h;
    check_close(law_at(pulls, r + 0.5 * h).energy, sum, 2e-5);
  }
  assert_true(changes >= 1 && sum > 0.2);
  for (double r = 0.1; r < 2.0; r += 0.1)
    check_between(law_at(pulls, r).tension + law_at(pulls, r).energy, 0.0, 0.0);
}

TEST(springs_that_only_pull_have_the_positive_part) {
  check_clipped("law=length curve.coefficients=0.2,-0.3,0.1");
  check_clipped("curve.elongation=0.2,0.5,1,2,3 curve.force=-1,2,-1,1,-0.2 curve.falling=true");
  check_clipped("curve.elongation=-1,3 curve.force=1,-1 curve.falling=true");
  owned_system *rising = pair("compression=false curve.elongation=0,1 curve.force=-1,1");
  check_close(law_at(rising, 4.0).tension, 3.0, 1e-14);
  check_close(law_at(rising, 4.0).energy, 1.5 * 3.0 / 2.0, 1e-14);
}

/* ---- the largest stiffness ---- */

static double stiffest(const char *words) {
  owned_system *system = pair(words);
  const struct hk_spring spring = hk_springs_find(system->springs, 0, 0.0);
  return hk_curve_stiffest(spring.curve, spring.rest_length);
}

TEST(the_largest_stiffness_is_that_of_slopes_or_of_tension_over_length) {
  /* lines: the slope; tension where the length is 0, which has no bound, and 7 N at 2 m of one that only
   * pulls */
  check_close(stiffest("curve.elongation=-1,0,1 curve.force=-6,0,6"), 6.0, 1e-14);
  check_close(stiffest("curve.strain=-0.5,0,0.5 curve.force=-6,0,6"), 6.0, 1e-14);
  assert_true(isinf(stiffest("curve.elongation=0,1 curve.force=7,8")));
  check_close(stiffest("curve.elongation=0,1 curve.force=7,8 compression=false"), 3.5, 1e-14);
  assert_true(isinf(stiffest("law=length curve.coefficients=1,0,1e-3")));
  check_close(stiffest("law=length curve.coefficients=5,0,0"), 5.0, 1e-14);
  /* no slope or quotient on a fine grid is above it, and some are at it */
  static const char words[] = "curve.elongation=-1.8,-1.7,-1,0,0.5,3 curve.force=-1,1,1.5,2,4,4.5";
  owned_system *system = pair(words);
  const double most = stiffest(words);
  double found = 0.0;
  for (double r = 1e-3; r < 20.0; r += 1e-4) {
    const struct hk_law law = law_at(system, r);
    found = fmax(found, fmax(law.slope, law.tension / r));
  }
  check_between(found, 0.999 * most, most * (1.0 + 1e-12));
}

/* ---- what keeps them ---- */

/* Damping is one for each, so that no options are kept, and quotients by rest lengths have to come back. */
static hooke_system *group_of_three(const char *words, int32_t pull_only) {
  const double place[12] = {0, 0, 0, 1, 0.3, 0, 1.9, 0.1, 0.7, 3, 0, 0}, damping[3] = {0.1, 0.7, 1.3};
  const int64_t ends[6] = {0, 1, 1, 2, 2, 3};
  hooke_system *system = small_system(4, place, NULL, 1.0, 1);
  owned_options *options = new_options("springs");
  check_ok(try_words(options, words));
  check_ok(hooke_options_set_number(options, "rest_scale", 0.83));
  check_ok(hooke_options_set_number(options, "compression", !pull_only));
  check_ok(hooke_options_set_numbers(options, "damping", 3, damping));
  check_ok(hooke_system_add_springs(system, "curved", 3, ends, options));
  return committed(system);
}

static const char *const kinds[] = {"curve.strain=-0.5,0,0.5,1 curve.force=-40,0,30,29 curve.falling=true",
                                    "curve.elongation=-0.5,0,0.5 curve.force=-40,0,30",
                                    "law=length curve.coefficients=3,1,7", "curve.coefficients=3,1,7"};

TEST(a_written_scene_has_the_same_curve) {
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
    owned_system *system = group_of_three(kinds[k], 1);
    owned_scene *scene = NULL;
    check_ok(hooke_scene_of_system(system, NULL, NULL, "memory", NULL, &scene));
    check_ok(hooke_scene_commit(scene));
    assert_true(hk_system_check_value(hooke_scene_system(scene)) == hk_system_check_value(system));
    owned_system *other = group_of_three(kinds[(k + 1) % 4], 1);
    assert_true(hk_system_check_value(other) != hk_system_check_value(system));
  }
}

TEST(variants_keep_a_curve_and_scale_it) {
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
    owned_system *system = group_of_three(kinds[k], 0), *made = NULL;
    owned(hk_variant_release) struct hk_variant variant;
    owned(hk_variant_map_release) struct hk_variant_map map;
    check_ok(hk_variant_create(system, &variant));
    variant.factor[HOOKE_KAPPA][0] = 1.1;
    variant.compression = 1;
    check_ok(hk_variant_make(system, &variant, &made, &map));
    for (double r = 0.2; r < 3.0; r += 0.13) {
      const struct hk_spring spring = hk_springs_find(system->springs, 1, 0.0);
      const int taut = r > spring.rest_length;
      const struct hk_spring other = hk_springs_find(made->springs, 1, 0.0);
      const struct hk_law law = hk_spring_law(&spring, r), same = hk_spring_law(&other, r);
      check_close(same.tension, taut ? 1.1 * law.tension : 0.0, 1e-12);
      check_close(same.energy, taut ? 1.1 * law.energy : 0.0, 1e-12);
      check_close(same.slope, taut ? 1.1 * law.slope : 0.0, 1e-11);
    }
  }
}
