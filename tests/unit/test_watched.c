/* Watched quantities: every form of the grammar and its refusals, tension compared with the change of energy
 * with length, and periods compared with known ones. */
#include "check.h"
#include "core/memory.h"
#include "measure/quantity/watched.h"
#include "model/particles.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
#define COUNT(list) (sizeof(list) / sizeof((list)[0]))

/* Three particles and two groups: "rods" of two springs and "tie" of one, without length; and a rope of five
 * particles. */
static hooke_system *scene(void) {
  static const double q[] = {0, 0, 0, 1, 0.2, 0, 2, 0.5, 0.3};
  static const int64_t rods[] = {0, 1, 1, 2}, tie[] = {0, 2};
  const double mass = 1.0;
  hooke_system *system = small_system(3, q, NULL, mass, 0);
  small_group(system, "springs", "rods", 2, rods, "stiffness=50 damping=0.7 rest_length=0.8,1.5");
  small_group(system, "springs", "tie", 1, tie, "stiffness=50 damping=0.7 law=length rest_length=0");
  small_part(system, "rope", "line", "from=5,0,0 to=6,0,0 segments=4 mass=1 stretch.stiffness=10");
  check_ok(hooke_system_commit(system));
  return system;
}

/* Reads one more quantity, whose value and unit are these. */
static void check_form(struct hk_watched_list *list, const char *text, const char *unit, double value,
                       const double *q, const double *v) {
  const int64_t count = list->count;
  check_ok(hk_watched_read(list, "watch", text));
  assert_int_equal(list->count, count + 1);
  assert_int_equal(hk_watched_find(list, text), count);
  assert_string_equal(hk_watched_unit(&list->item[count]), unit);
  const double found = hk_watched_value(&list->item[count], list->system, 0.0, q, v);
  if (!(fabs(found - value) <= 1e-12 * (1.0 + fabs(value))))
    check_failed("%s is %.17g, expected %.17g", text, found, value);
}

/* Length, strain and tension of every spring; returns the energy of all. */
static double check_springs(struct hk_watched_list *list, const double *q, const double *v) {
  static const struct {
    const char *group;
    int64_t count;
  } groups[] = {{"rods", 2}, {"tie", 1}, {"line.stretch", 4}};
  int64_t ends[14], at = 0;
  double stiffness[7], damping[7], rest[7], energy = 0.0;
  check_ok(hooke_system_members(list->system, "springs", ends, stiffness, damping, rest));
  for (size_t g = 0; g < COUNT(groups); g++) {
    for (int64_t k = 0; k < groups[g].count; k++, at++) {
      const double *a = q + 3 * ends[2 * at], *b = q + 3 * ends[2 * at + 1];
      const double *u = v + 3 * ends[2 * at], *w = v + 3 * ends[2 * at + 1];
      const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, length = hypot(hypot(d[0], d[1]), d[2]),
                   rate = (d[0] * (w[0] - u[0]) + d[1] * (w[1] - u[1]) + d[2] * (w[2] - u[2])) / length;
      const double tension = stiffness[at] * (length - rest[at]) + damping[at] * rate,
                   value[] = {length, tension, (length - rest[at]) / rest[at]};
      static const char *const word[] = {"length", "tension", "strain"}, *const unit[] = {"m", "N", ""};
      for (int what = 0; what < (rest[at] > 0.0 ? 3 : 2); what++) {
        char text[64];
        snprintf(text, sizeof text, "%s:%d.%s", groups[g].group, (int)k, word[what]);
        check_form(list, text, unit[what], value[what], q, v);
      }
      energy += 0.5 * stiffness[at] * pow(length - rest[at], 2.0);
    }
  }
  assert_int_equal(at, hooke_system_count(list->system, "springs"));
  return energy;
}

/* Every quantity is its formula of q and v. */
TEST(every_form_is_read) {
  owned_system *system = scene();
  struct hk_watched_list list = {.system = system};
  double q[24], v[24], kinetic = 0.0;
  for (int k = 0; k < 24; k++) {
    char text[64];
    q[k] = system->position[k] + 0.1 * sin(3.0 * k);
    v[k] = cos(5.0 * k);
    kinetic += 0.5 * system->mass[k / 3] * v[k] * v[k];
    snprintf(text, sizeof text, k < 9 ? "%d.%c" : "line:%d.%c", k / 3 - (k < 9 ? 0 : 3), 'x' + k % 3);
    check_form(&list, text, "m", q[k], q, v);
  }
  const double potential = check_springs(&list, q, v);
  check_form(&list, "kinetic", "J", kinetic, q, v);
  check_form(&list, "potential", "J", potential, q, v);
  check_form(&list, "energy", "J", kinetic + potential, q, v);
  check_form(&list, "period:2.y", "s", q[7], q, v);
  check_form(&list, "period:kinetic", "s", kinetic, q, v);
  const int64_t count = list.count; /* in a list, with blanks, and repeated */
  check_ok(hk_watched_read(&list, "watch", "7.y, energy ,7.y"));
  assert_int_equal(list.count, count + 1);
  hk_watched_release(&list);
}

TEST(what_is_nothing_is_refused) {
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
  owned_system *system = scene();
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
}

/* Indices into groups with dropped springs are refused. */
TEST(springs_that_are_left_out_are_said) {
  static const double q[] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, stiffness[] = {0.0, 10.0};
  static const int64_t ends[] = {0, 1, 1, 2};
  owned_system *system = small_system(3, q, NULL, 1.0, 0);
  hooke_options *options = new_options("springs");
  check_ok(hooke_options_set_numbers(options, "stiffness", 2, stiffness));
  check_ok(hooke_system_add_springs(system, "some", 2, ends, options));
  hooke_options_destroy(options);
  check_ok(hooke_system_commit(system));
  struct hk_watched_list list = {.system = system};
  check_status(hk_watched_read(&list, "watch", "some:0.length"), HOOKE_BAD_VALUE);
  check_message("neither stiffness nor damping");
  hk_watched_release(&list);
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
  struct hk_watched watched = {.kind = HOOKE_WATCHED_TENSION, .spring = 0};
  return hk_watched_value(&watched, system, 0.0, q, v);
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

TEST(tension_is_the_slope_of_energy_and_the_force) {
  static const struct springs laws[] = {{NULL, 30.0, 0.0, 1.2, 0},     {"length", 30.0, 0.0, 1.2, 0},
                                        {"length", 30.0, 0.0, 0.0, 0}, {NULL, 30.0, 0.0, 1.2, 1},
                                        {NULL, 30.0, 2.0, 1.2, 0},     {"length", 30.0, 2.0, 1.2, 1},
                                        {"length", 30.0, 2.0, 1.2, 0}};
  static const double lengths[] = {0.7, 1.19, 1.3, 2.5}, rates[] = {-40.0, -0.1, 0.0, 3.0};
  for (size_t k = 0; k < COUNT(laws); k++) {
    owned_system *system = one_spring(laws[k]);
    for (size_t i = 0; i < COUNT(lengths); i++) {
      const double r = lengths[i], h = 1e-5;
      check_close(tension(system, r, 0.0), (energy(system, r + h) - energy(system, r - h)) / (2.0 * h), 1e-7);
      for (size_t j = 0; j < COUNT(rates); j++)
        check_close(tension(system, r, rates[j]), pull(system, r, rates[j]), 1e-12);
      /* a cable does not push, at any damping */
      assert_true(!laws[k].pull_only || tension(system, r, -40.0) >= 0.0);
    }
  }
}

/* ---- periods ---- */

TEST(periods_are_known) {
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
