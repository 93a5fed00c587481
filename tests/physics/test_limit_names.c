/* Bending and altitude springs that limit the step: closed forms of one element, and what names it in limits,
 * warnings, diagnoses and costs. Limits of random scenes with them are in test_random_limits.c. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct kind {
  const char *force, *part, *words, *group, *element;
  double above; /* the limit that a run blows up by */
} kinds[] = {
    {"bending", "rope",
     "from=0,0,0 to=2.5,0,0 segments=25 mass=0.26 bending=0.5 pinned=0,1 stretch.stiffness=1 "
     "stretch.rest_scale=0.9",
     "line.bending", "the bending of particles ", 1.01},
    {"altitude", "strand",
     "from=0,0,0 to=1,0,0 segments=12 mass=0.1 pinned=0,1,2 stretch.stiffness=1 altitude.stiffness=40",
     "line.altitude", "the altitude springs of particles ", 1.05}};
enum { KINDS = 2 };

static hooke_system *new_line(const struct kind *kind) {
  hooke_system *system = new_system();
  small_part(system, kind->part, "line", "%s", kind->words);
  check_ok(hooke_system_commit(system));
  return system;
}

static void check_has(const char *sentence, const char *words) {
  if (sentence == NULL || strstr(sentence, words) == NULL) check_failed("%s: %s", words, sentence);
}

TEST(limits_blame_and_change_the_group) {
  for (int k = 0; k < KINDS; k++) {
    char has[64];
    snprintf(has, sizeof has, "group `%s` has ", kinds[k].group);
    owned_system *system = new_line(&kinds[k]);
    owned_measurement *limit = limits_of(system, "verlet", 1);
    check_has(hooke_measurement_text(limit, "changes", 0, "sentence"), has);
    assert_string_equal(hooke_measurement_text(limit, "blame", 0, "force"), kinds[k].force);
    check_between(hooke_measurement_number(limit, "blame", 0, "share"), 0.98, 1.0);
    assert_true(isnan(hooke_measurement_number(limit, "blame", 0, "number")));
    for (int64_t row = 1; row < hooke_measurement_row_count(limit, "blame"); row++)
      check_between(hooke_measurement_number(limit, "blame", row, "share"), 0.0, 0.02);
  }
}

struct heard {
  const struct kind *kind;
  int warnings;
};

static int32_t hear(const char *what, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  struct heard *heard = ctx;
  (void)t, (void)limit, (void)particle;
  if (strstr(what, "limit") == NULL) return 0; /* such as that nothing moves */
  check_has(sentence, heard->kind->element);
  assert_int_equal(spring, -1);
  heard->warnings++;
  return 0;
}

/* A step above the limit diverges, one of 0.99 of it does not. */
TEST(runs_above_the_limit_are_explained) {
  for (int k = 0; k < 2 * KINDS; k++) {
    const struct kind *kind = &kinds[k / 2];
    const int above = k % 2;
    owned_system *system = new_line(kind);
    owned_measurement *limit = limits_of(system, "verlet", 1);
    const double most = hooke_measurement_number(limit, "rows", 0, "predicted"),
                 step = (above ? kind->above : 0.99) * most;
    owned_integrator *integrator = start_run(
        system, (struct run){.method = "verlet", .step = step, .duration = 5000 * step, .every = 100 * step});
    owned_state *state = start_state(system);
    struct heard heard = {kind, 0};
    hooke_state_position(state)[3 * 13 + 1] += 1e-5;
    check_ok(hooke_integrator_on_warning(integrator, hear, &heard));
    check_status(hooke_integrator_run(integrator, state), above ? HOOKE_DIVERGED : HOOKE_OK);
    assert_true(heard.warnings >= above);
    if (!above) continue;
    owned_measurement *why = NULL;
    check_ok(explain_run(integrator, &why));
    assert_string_equal(hooke_measurement_text(why, "why", 0, "cause"), "step-above-limit");
    check_has(hooke_measurement_text(why, "why", 0, "sentence"), kind->element);
    check_has(hooke_measurement_text(why, "why", 0, "sentence"), kind->group);
    check_close(hooke_measurement_number(why, "why", 0, "limit"), most, 0.02 * most);
  }
}

/* The row sum of a particle far from the ends of a beam is 16 c, which a long one comes arbitrarily close to;
 * a particle over a fixed face is on one spring of ks/h, whose whole weight is on it. */
TEST(bounds_are_those_of_one_element) {
  const double c = 0.5 / (0.1 * 0.1 * 0.1), slowest = 2.0 / sqrt(16.0 * c / 0.01);
  const double q[12] = {0, 0, 0, 1, 0, 0, 0.4, 1, 0, 0.5, 0.4, 0.3}, mass = 0.2;
  const int64_t corners[4] = {0, 1, 2, 3}, held[3] = {0, 1, 2};
  owned_system *beam = new_system(), *top = small_system(4, q, NULL, mass, 0);
  small_part(beam, "rope", "beam", "from=0,0,0 to=10,0,0 segments=100 mass=1.01 bending=0.5 pinned=0,1");
  check_ok(hooke_system_commit(beam));
  check_close(bound_at_start(beam, "verlet"), slowest, 1e-12 * slowest);
  check_between(bound_at_start(beam, "forward-euler"), 0.0, 0.0);
  owned_options *options = options_with("altitude", "stiffness=6 damping=0.01");
  check_ok(hooke_system_add_altitude(top, "heights", 1, corners, options));
  check_ok(hooke_system_pin(top, 3, held));
  check_ok(hooke_system_commit(top));
  const double omega = sqrt(6.0 / 0.3 / 0.2), rate = 0.01 / 0.3 / 0.2, z = rate / (2.0 * omega);
  check_close(bound_at_start(top, "verlet"), 2.0 / omega, 1e-12);
  check_close(bound_at_start(top, "symplectic-euler"), 2.0 * (sqrt(1.0 + z * z) - z) / omega, 1e-9);
  check_close(bound_at_start(top, "forward-euler"), 0.01 / 6.0, 1e-12);
}

TEST(they_are_ingredients) {
  for (int k = 0; k < KINDS; k++) {
    owned_system *system = new_line(&kinds[k]);
    owned_options *options = options_with("cost", "predict=1"), *run = options_with("run", "step=1e-4");
    owned_measurement *cost = NULL;
    check_ok(hooke_measurement_create("cost", system, run, options, &cost));
    check_ok(hooke_measurement_run(cost, NULL));
    const int64_t row = hooke_measurement_find(cost, "rows", "kind", kinds[k].force);
    assert_string_equal(hooke_measurement_text(cost, "rows", row, "ingredient"), kinds[k].group);
    assert_true(hooke_measurement_number(cost, "rows", row, "memory_bytes") > 500.0);
    assert_true(isnan(hooke_measurement_number(cost, "rows", row, "springs")));
  }
}
