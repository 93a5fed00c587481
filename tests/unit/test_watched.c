/* Watched quantities: every form of the grammar and its refusals, tension compared with the change of energy
 * with length, and periods compared with known ones. */
#include "check.h"
#include "core/memory.h"
#include "measure/quantity/watched.h"
#include "model/particles.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
#define COUNT(list) (sizeof(list) / sizeof((list)[0]))

/* Three particles and two groups: "rods" of two springs and "tie" of one, without length; and a rope of five
 * particles. */
static hooke_system *scene(void) {
  static const double q[] = {0, 0, 0, 1, 0.2, 0, 2, 0.5, 0.3};
  static const int64_t rods[] = {0, 1, 1, 2}, tie[] = {0, 2};
  const double mass = 1.0;
  hooke_system *system;
  hooke_options *options, *rope;
  check_ok(hooke_system_create(&system));
  check_ok(hooke_system_add_particles(system, 3, q, NULL, 1, &mass, NULL));
  check_ok(hooke_options_create("springs", &options));
  check_ok(hooke_options_set_number(options, "stiffness", 50.0));
  check_ok(hooke_system_add_springs(system, "rods", 2, rods, options));
  check_ok(hooke_options_set_text(options, "law", "length"));
  check_ok(hooke_options_set_number(options, "rest_length", 0.0));
  check_ok(hooke_system_add_springs(system, "tie", 1, tie, options));
  check_ok(hooke_options_create("rope", &rope));
  check_ok(hooke_options_set_text(rope, "from", "5,0,0"));
  check_ok(hooke_options_set_text(rope, "to", "6,0,0"));
  check_ok(hooke_options_set_number(rope, "segments", 4));
  check_ok(hooke_options_set_number(rope, "mass", 1));
  check_ok(hooke_options_set_number(rope, "stretch.stiffness", 10));
  check_ok(hooke_system_add_part(system, "rope", "line", rope, NULL, NULL));
  check_ok(hooke_system_commit(system));
  hooke_options_destroy(options);
  hooke_options_destroy(rope);
  return system;
}

static void every_form_is_read(void **unused) {
  (void)unused;
  static const struct {
    const char *text, *unit;
    double value; /* at the start, with velocities of 1 m/s along y of particle 2 alone */
  } forms[] = {{"1.x", "m", 1.0},
               {"2.z", "m", 0.3},
               {"line:0.x", "m", 5.0},
               {"line:4.x", "m", 6.0},
               {"tie:0.length", "m", 2.08326666560},
               {"rods:1.strain", "", 0.0},
               {"line.stretch:3.length", "m", 0.25},
               {"rods:0.tension", "N", 0.0},
               {"tie:0.tension", "N", 104.1633332800},
               {"kinetic", "J", 0.5},
               {"potential", "J", 108.5},
               {"energy", "J", 109.0},
               {"period:2.y", "s", 0.5},
               {"period:kinetic", "s", 0.5}};
  hooke_system *system = scene();
  struct hk_watched_list list = {.system = system};
  double *v = new_doubles(3 * system->particle_count);
  v[7] = 1.0;
  for (size_t k = 0; k < COUNT(forms); k++) {
    check_ok(hk_watched_read(&list, "watch", forms[k].text));
    assert_int_equal(list.count, (int64_t)k + 1);
    const struct hk_watched *item = &list.item[k];
    assert_string_equal(hk_watched_unit(item), forms[k].unit);
    check_close(hk_watched_value(item, system, system->position, v), forms[k].value, 1e-9);
    assert_int_equal(hk_watched_find(&list, forms[k].text), (int64_t)k);
  }
  /* in a list, with blanks, and repeated */
  check_ok(hk_watched_read(&list, "watch", "1.y, energy ,1.y"));
  assert_int_equal(list.count, (int64_t)COUNT(forms) + 1);
  hk_watched_release(&list);
  free(v);
  hooke_system_destroy(system);
}

static void what_is_nothing_is_refused(void **unused) {
  (void)unused;
  static const struct {
    const char *text, *message;
  } bad[] = {{"", "nothing to watch"},
             {"1.y,", "nothing to watch"},
             {",1.y", "nothing to watch"},
             {"1.w", "nothing to watch"},
             {"1.yy", "nothing to watch"},
             {"1", "nothing to watch"},
             {".y", "nothing to watch"},
             {"-1.y", "nothing to watch"},
             {"1 .y", "nothing to watch"},
             {"line.y", "nothing to watch"},
             {"line:.y", "nothing to watch"},
             {"line:-1.y", "nothing to watch"},
             {"line:1e3.y", "nothing to watch"},
             {"period:", "nothing to watch"},
             {"period:period:1.y", "nothing to watch"},
             {"rods.length", "nothing to watch"},
             {"Energy", "nothing to watch"},
             {"99999999999999999999.y", "nothing to watch"},
             {"8.y", "the scene has the particles 0 to 7"},
             {"line:5.y", "line has the particles 0 to 4"},
             {"lime:0.y", "allowed: line"},
             {"rods:0.y", "allowed: line"},
             {"rods:2.length", "rods has the springs 0 to 1"},
             {"line.stretch:4.strain", "line.stretch has the springs 0 to 3"},
             {"line:0.length", "allowed: rods, tie, line.stretch"},
             {":0.length", "allowed: rods, tie, line.stretch"},
             {"tie:0.strain", "allowed: length, tension"}};
  hooke_system *system = scene();
  struct hk_watched_list list = {.system = system};
  check_ok(hk_watched_read(&list, "watch", "0.x"));
  for (size_t k = 0; k < COUNT(bad); k++) {
    check_status(hk_watched_read(&list, "watch", bad[k].text), HOOKE_BAD_VALUE);
    check_message(bad[k].message);
    check_message("watch");
  }
  char *endless = new_block(4000, 1);
  memset(endless, '1', 3998);
  check_status(hk_watched_read(&list, "watch", endless), HOOKE_BAD_VALUE);
  check_status(hk_watched_read(&list, "probe", "1.x,energy,nobody"), HOOKE_BAD_VALUE);
  check_message("probe");
  assert_int_equal(list.count, 1);
  free(endless);
  hk_watched_release(&list);
  hooke_system_destroy(system);
}

/* Indices into groups with dropped springs are refused. */
static void springs_that_are_left_out_are_said(void **unused) {
  (void)unused;
  static const double q[] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, stiffness[] = {0.0, 10.0};
  static const int64_t ends[] = {0, 1, 1, 2};
  const double mass = 1.0;
  hooke_system *system;
  hooke_options *options;
  check_ok(hooke_system_create(&system));
  check_ok(hooke_system_add_particles(system, 3, q, NULL, 1, &mass, NULL));
  check_ok(hooke_options_create("springs", &options));
  check_ok(hooke_options_set_numbers(options, "stiffness", 2, stiffness));
  check_ok(hooke_system_add_springs(system, "some", 2, ends, options));
  hooke_options_destroy(options);
  check_ok(hooke_system_commit(system));
  struct hk_watched_list list = {.system = system};
  check_status(hk_watched_read(&list, "watch", "some:0.length"), HOOKE_BAD_VALUE);
  check_message("neither stiffness nor damping");
  hk_watched_release(&list);
  hooke_system_destroy(system);
}

/* ---- tension ---- */

/* A spring between particles at (0,0,0) and (r,0,0). */
static hooke_system *one_spring(struct springs law) {
  static const double q[] = {0, 0, 0, 1.5, 0, 0};
  static const int64_t ends[] = {0, 1};
  hooke_system *system = small_system(2, q, NULL, 1.0, 0);
  small_springs(system, 1, ends, law);
  check_ok(hooke_system_commit(system));
  return system;
}

static double tension(const hooke_system *system, double r, double rate) {
  const double q[] = {0, 0, 0, r, 0, 0}, v[] = {0, 0, 0, rate, 0, 0};
  struct hk_watched watched = {.kind = HOOKE_WATCHED_TENSION,
                               .spring = hk_run_spring(&system->springs->run[0], 0)};
  return hk_watched_value(&watched, system, q, v);
}

static double energy(const hooke_system *system, double r) {
  const double q[] = {0, 0, 0, r, 0, 0};
  return hooke_system_energy(system, "springs", q, NULL);
}

/* The force on the second end along the spring, by the library's own loops. */
static double pull(const hooke_system *system, double r, double rate) {
  const double q[] = {0, 0, 0, r, 0, 0}, v[] = {0, 0, 0, rate, 0, 0};
  double force[6];
  check_ok(hooke_system_force(system, 0.0, q, v, force));
  return -force[3];
}

static void tension_is_the_slope_of_energy_and_the_force(void **unused) {
  (void)unused;
  static const struct springs laws[] = {{NULL, 30.0, 0.0, 1.2, 0},     {"length", 30.0, 0.0, 1.2, 0},
                                        {"length", 30.0, 0.0, 0.0, 0}, {NULL, 30.0, 0.0, 1.2, 1},
                                        {NULL, 30.0, 2.0, 1.2, 0},     {"length", 30.0, 2.0, 1.2, 1},
                                        {"length", 30.0, 2.0, 1.2, 0}};
  static const double lengths[] = {0.7, 1.19, 1.3, 2.5}, rates[] = {-40.0, -0.1, 0.0, 3.0};
  for (size_t k = 0; k < COUNT(laws); k++) {
    hooke_system *system = one_spring(laws[k]);
    for (size_t i = 0; i < COUNT(lengths); i++) {
      const double r = lengths[i], h = 1e-5;
      check_close(tension(system, r, 0.0), (energy(system, r + h) - energy(system, r - h)) / (2.0 * h), 1e-7);
      for (size_t j = 0; j < COUNT(rates); j++)
        check_close(tension(system, r, rates[j]), pull(system, r, rates[j]), 1e-12);
      /* a cable does not push, at any damping */
      assert_true(!laws[k].pull_only || tension(system, r, -40.0) >= 0.0);
    }
    hooke_system_destroy(system);
  }
}

/* ---- periods ---- */

static void periods_are_known(void **unused) {
  (void)unused;
  enum { FRAMES = 200 };
  double time[FRAMES], value[FRAMES], flat[FRAMES], rising[FRAMES], noisy[FRAMES], coarse[FRAMES];
  const double period = 1.37;
  for (int f = 0; f < FRAMES; f++) {
    time[f] = 3.0 + 0.05 * f;
    value[f] = 2.0 + 0.3 * sin(2.0 * PI * (time[f] + 0.2) / period);
    noisy[f] = value[f] + 0.02 * sin(2.0 * PI * time[f] / (0.17 * period));
    flat[f] = 7.0 + (f % 2 ? 1e-15 : 0.0);
    rising[f] = time[f];
    coarse[f] = sin(2.0 * PI * time[f] / 0.13);
  }
  check_close(hk_watched_period(FRAMES, time, value), period, 2e-6);
  /* small ripples are no periods */
  check_close(hk_watched_period(FRAMES, time, noisy), period, 0.02);
  assert_true(isnan(hk_watched_period(FRAMES, time, flat)));
  assert_true(isnan(hk_watched_period(FRAMES, time, rising)));
  /* sampled 2.6 times a period only */
  assert_true(isnan(hk_watched_period(FRAMES, time, coarse)));
  /* too short for two passages */
  assert_true(isnan(hk_watched_period(30, time, value)));
  assert_true(isnan(hk_watched_period(1, time, value)));
  value[50] = NAN;
  assert_true(isnan(hk_watched_period(FRAMES, time, value)));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_form_is_read), cmocka_unit_test(what_is_nothing_is_refused),
      cmocka_unit_test(springs_that_are_left_out_are_said),
      cmocka_unit_test(tension_is_the_slope_of_energy_and_the_force), cmocka_unit_test(periods_are_known)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
