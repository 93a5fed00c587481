/* Scenes far from the origin of coordinates: forces come from differences, so only the spacing of the numbers
 * there limits the accuracy. */
#include "check.h"
#include "extreme.h"
#include "random.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A stretch of 0.1 m on a spring of 1 m: its remaining digits are those of 0.1 m over the spacing. */
TEST(test_oscillator) {
  const double distance[] = {0.0, 1e3, 1e6, 1e9};
  for (int k = 0; k < 4; k++) {
    char name[64];
    const double spacing = nextafter(distance[k] + 1.0, INFINITY) - (distance[k] + 1.0);
    snprintf(name, sizeof name, "%g m away", distance[k]);
    extreme_oscillate(&(struct extreme_oscillator){.family = "origin",
                                                   .name = name,
                                                   .law = "strain",
                                                   .stiffness = 1.0,
                                                   .mass = 1.0,
                                                   .distance = distance[k],
                                                   .step = 0.05,
                                                   .steps = 200,
                                                   .tolerance = fmax(1e-15, 1e-8 / (1.0 + distance[k])),
                                                   .absolute = distance[k] > 0.0 ? 1e-8 : 0.0,
                                                   .rounding = 1e-12 + 100.0 * spacing / 0.1});
  }
}

/* The loss away from the origin (at 1e9 m numbers are 1.2e-7 m apart), compared with the run at the origin.
 */
static double lost_at(double distance, const char *method, double h) {
  const double amplitude = 0.1;
  double end[2] = {0.0, 0.0};
  for (int far = 0; far < 2; far++) {
    const double x = far ? distance : 0.0, q[] = {x, 0, 0, x + 1.1, 0, 0}, mass = 1.0;
    const int64_t first = 0, ends[] = {0, 1};
    owned_system *system = small_system(2, q, NULL, mass, 0);
    check_ok(hooke_system_pin(system, 1, &first));
    owned_options *options = options_with("springs", "stiffness=1 rest_length=1");
    check_ok(hooke_system_add_springs(system, NULL, 1, ends, options));
    check_ok(hooke_system_commit(system));
    owned_outcome outcome;
    extreme_run(system, (struct extreme_run){.method = method, .step = h, .steps = 1000, .frame_steps = 100},
                &outcome);
    extreme_demand("origin", "digits", method, extreme_not_right(&outcome, 0.0, 0.0, 0.0), &outcome);
    end[far] = outcome.q[3] - outcome.q[0];
  }
  return fabs(end[1] - end[0]) / amplitude;
}

static void check_digits(double distance, const char *name) {
  const double spacing = nextafter(distance, INFINITY) - distance;
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) != 1 || hooke_method_is_adaptive(method)) continue;
    const double lost = lost_at(distance, method, 0.01);
    /* of 0.1 m, by a walk of 1000 roundings, or of three a step */
    const double most = strcmp(method, "tr-bdf2") == 0 ? 3000.0 : 1000.0;
    check_between(lost, 0.1 * spacing, most * spacing);
    char words[64];
    snprintf(words, sizeof words, "%.0e", lost);
    extreme_note("origin", name, method, words);
  }
}

TEST(test_digits) {
  check_digits(1e6, "1e+06 m away: lost in 1000 steps");
  check_digits(1e9, "1e+09 m away: lost in 1000 steps");
  check_digits(1e12, "1e+12 m away: lost in 1000 steps");
}

/* Where shifted positions are exact, forces are those at the origin, to the bit. */
TEST(test_same_forces) {
  enum { SIDE = 9, COUNT = SIDE * SIDE, SIZE = 3 * COUNT };
  owned_system *system = new_system();
  small_part(system, "cloth", NULL,
             "edges=1,0,0,0,0,1 size=%d,%d mass=1 structural.stiffness=50 structural.damping=0.1 "
             "shear.stiffness=50 shear.damping=0.1 bend.stiffness=50 bend.damping=0.1",
             (int)SIDE, (int)SIDE);
  check_ok(hooke_system_commit(system));
  struct random_source source = {7};
  double near[SIZE], far[SIZE], v[SIZE], at_origin[SIZE], away[SIZE];
  for (int k = 0; k < SIZE; k++) {
    near[k] = (double)random_whole(&source, -(1 << 20), 1 << 20) * 0x1p-20;
    far[k] = near[k] + 0x1p30;
    v[k] = random_between(&source, -1.0, 1.0);
    assert_true(far[k] - 0x1p30 == near[k]);
  }
  check_ok(hooke_system_force(system, 0.0, near, v, at_origin));
  check_ok(hooke_system_force(system, 0.0, far, v, away));
  check_same_bits(SIZE, away, at_origin);
  far[0] += 0x1p-20; /* a shift by one spacing is noticed */
  check_ok(hooke_system_force(system, 0.0, far, v, away));
  assert_true(away[0] != at_origin[0]);
}

int main(int argc, char **argv) {
  return extreme_finish(argc, argv, check_run_tests());
}
