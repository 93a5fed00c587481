/* Watched quantities: every form of the grammar and its refusals, tension compared with the change of energy
 * with length, reactions with Newton's law, extremes and periods with known ones. */
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
  hooke_system *system = small_system(3, q, NULL, mass, 1);
  small_group(system, "springs", "rods", 2, rods, "stiffness=50 damping=0.7 rest_length=0.8,1.5");
  small_group(system, "springs", "tie", 1, tie, "stiffness=50 damping=0.7 law=length rest_length=0");
  small_part(system, "rope", "line", "from=5,0,0 to=6,0,0 segments=4 mass=1 stretch.stiffness=10");
  check_ok(hooke_system_commit(system));
  return system;
}

static double value_of(const struct hk_watched_list *list, int64_t k, double t, const double *q,
                       const double *v) {
  struct hk_watched_list one = *list;
  double value;
  one.item += k;
  one.count = 1;
  hk_watched_values(&one, t, q, v, &value);
  return value;
}

/* Reads one more quantity, whose value and unit are these. */
static void check_form(struct hk_watched_list *list, const char *text, const char *unit, double value,
                       const double *q, const double *v) {
  const int64_t count = list->count;
  check_ok(hk_watched_read(list, "watch", text));
  assert_int_equal(list->count, count + 1);
  assert_int_equal(hk_watched_find(list, text), count);
  assert_string_equal(hk_watched_unit(&list->item[count]), unit);
  const double found = value_of(list, count, 0.0, q, v);
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

/* The largest and the smallest are those of a loop over the indices. */
static void check_over_groups(struct hk_watched_list *list, const double *q, const double *v) {
  static const char *const words[] = {"length", "strain", "tension"}, *const units[] = {"m", "", "N"};
  for (int k = 0; k < 3; k++) {
    double most = -INFINITY, least = INFINITY;
    char text[64];
    for (int i = 0; i < 4; i++) {
      snprintf(text, sizeof text, "line.stretch:%d.%s", i, words[k]);
      const double value = value_of(list, hk_watched_find(list, text), 0.0, q, v);
      most = fmax(most, value);
      least = fmin(least, value);
    }
    assert_true(most > least);
    snprintf(text, sizeof text, "line.stretch:max.%s", words[k]);
    check_form(list, text, units[k], most, q, v);
    snprintf(text, sizeof text, "line.stretch:min.%s", words[k]);
    check_form(list, text, units[k], least, q, v);
  }
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
    kinetic += k < 3 ? 0.0 : 0.5 * system->mass[k / 3] * v[k] * v[k];
    snprintf(text, sizeof text, k < 9 ? "%d.%c" : "line:%d.%c", k / 3 - (k < 9 ? 0 : 3), 'x' + k % 3);
    check_form(&list, text, "m", q[k], q, v);
  }
  const double potential = check_springs(&list, q, v);
  check_form(&list, "kinetic", "J", kinetic, q, v);
  check_form(&list, "potential", "J", potential, q, v);
  check_form(&list, "energy", "J", kinetic + potential, q, v);
  check_form(&list, "period:2.y", "s", q[7], q, v);
  check_form(&list, "period:kinetic", "s", kinetic, q, v);
  check_over_groups(&list, q, v);
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
             {"0.energy", "nothing to watch"},
             {"x", "0.x, .y, .z (a particle, or its name, or part:0), 0.reaction, .reaction_x"},
             {"rods:top.length", "over the group: group:max or group:min), energy, kinetic"},
             {"rods:max.x", "nothing to watch"},
             {"rope:max.length", "allowed: rods, tie, line.stretch"},
             {"tie:max.strain", "allowed: length, tension"},
             {"1.reaction", "allowed: a pinned or driven one, such as 0"},
             {"8.reaction_y", "the scene has the particles 0 to 7"},
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
  static const struct hk_watched_word word = {"tension", "N", HOOKE_WATCHED_SPRING, HOOKE_WATCHED_TENSION,
                                              -1};
  struct hk_watched watched = {.what = &word, .spring = 0};
  const struct hk_watched_list list = {.system = system, .count = 1, .item = &watched};
  return value_of(&list, 0, 0.0, q, v);
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

/* A curve with damping that only pulls, whose factor follows time. */
TEST(tension_of_a_curve_is_the_force_at_any_time) {
  static const double q[] = {0, 0, 0, 1.5, 0, 0}, lengths[] = {0.7, 1.19, 1.3, 2.5},
                      rates[] = {-40.0, 0.0, 3.0};
  static const int64_t ends[] = {0, 1};
  owned_system *system = small_system(2, q, NULL, 1.0, 0);
  small_group(system, "springs", "curved", 1, ends,
              "law=length rest_length=1.2 curve.coefficients=30,5,80 damping=2 compression=false "
              "stiffness_scale.motion=harmonic stiffness_scale.amplitude=0.5 stiffness_scale.frequency=1");
  check_ok(hooke_system_commit(system));
  struct hk_watched_list list = {.system = system};
  check_ok(hk_watched_read(&list, "watch", "curved:0.tension"));
  for (size_t k = 0; k < COUNT(lengths) * COUNT(rates) * 2; k++) {
    const double r = lengths[k % 4], rate = rates[k / 4 % 3], t = k < 12 ? 0.0 : 0.2;
    const double at[] = {0, 0, 0, r, 0, 0}, v[] = {0, 0, 0, rate, 0, 0};
    double force[6];
    check_ok(hooke_system_force(system, t, at, v, force));
    check_close(value_of(&list, 0, t, at, v), -force[3], 1e-12);
    assert_true(r > 1.2 ? rate < 0.0 || -force[3] > 1.0 : force[3] == 0.0);
  }
  hk_watched_release(&list);
}

/* ---- reactions ---- */

static double reaction(const hooke_system *system, int64_t particle, const char *word, double t,
                       const double *q, const double *v) {
  struct hk_watched_list list = {.system = system};
  char text[64];
  snprintf(text, sizeof text, "%d.%s", (int)particle, word);
  check_ok(hk_watched_read(&list, "watch", text));
  const double value = value_of(&list, 0, t, q, v);
  hk_watched_release(&list);
  return value;
}

/* m a - f of a pinned particle, and of ones that a sine and a table drive: the parabola t^2/2 along x. */
TEST(reactions_are_those_of_newton) {
  static const double q[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2, 0.5}, v[12] = {0};
  static const double amplitude[] = {0.1, 0.2, 0.0}, times[] = {0, 1, 2},
                      parabola[] = {0, 0, 0, 0.5, 0, 0, 2, 0, 0};
  static const int64_t ends[] = {0, 3, 1, 3, 2, 3}, held[] = {0, 1, 2};
  static const char *const words[] = {"reaction_x", "reaction_y", "reaction_z"};
  const double t = 0.3, bend = -pow(2.0 * PI * 1.5, 2.0) * sin(2.0 * PI * 1.5 * t), m = 2.0, k = 50.0,
               rest = 0.5;
  const double a[3][3] = {{0, 0, 0}, {0.1 * bend, 0.2 * bend, 0}, {1, 0, 0}};
  owned_system *system = small_system(4, q, NULL, m, 1);
  small_group(system, "springs", "rods", 3, ends, "law=length stiffness=50 rest_length=0.5");
  check_ok(hooke_system_drive_harmonic(system, 1, held + 1, amplitude, 1.5, 0.0));
  check_ok(hooke_system_drive_table(system, 1, held + 2, 3, times, parabola));
  small_falling(system);
  for (int p = 0; p < 3; p++) {
    double expected[3], d[3], length = 0.0;
    for (int c = 0; c < 3; c++)
      d[c] = q[9 + c] - q[3 * p + c], length = hypot(length, d[c]);
    for (int c = 0; c < 3; c++) {
      expected[c] = m * (a[p][c] + (c == 1 ? 9.81 : 0.0)) - k * (length - rest) * d[c] / length;
      check_close(reaction(system, p, words[c], t, q, v), expected[c], 1e-12);
    }
    check_close(reaction(system, p, "reaction", t, q, v), hypot(hypot(expected[0], expected[1]), expected[2]),
                1e-12);
  }
}

/* At any state the supports carry what the free particles do not take as acceleration. */
TEST(reactions_and_accelerations_balance_the_weight) {
  owned_system *system = small_cloth(20, 50.0, 0.1);
  const int64_t n = system->particle_count;
  double *q = new_doubles(3 * n), *v = new_doubles(3 * n), *a = new_doubles(3 * n), sum = 0.0, mass = 0.0;
  for (int64_t k = 0; k < 3 * n; k++) {
    q[k] = system->position[k] + (system->constrained[k / 3] ? 0.0 : 0.01 * sin(7.0 * (double)k));
    v[k] = system->constrained[k / 3] ? 0.0 : cos(5.0 * (double)k);
  }
  check_ok(hooke_system_acceleration(system, 0.0, q, v, a));
  for (int64_t p = 0; p < n; p++) {
    mass += system->mass[p];
    sum += system->constrained[p] ? reaction(system, p, "reaction_y", 0.0, q, v)
                                  : -system->mass[p] * a[3 * p + 1];
  }
  check_close(sum, -mass * system->gravity[1], 1e-10);
  free(q);
  free(v);
  free(a);
}

/* What holds a particle in a body, and what a callback does, is not known. */
static int32_t stay(int64_t count, double t, double *q, double *v, void *ctx) {
  (void)count, (void)t, (void)q, (void)v, (void)ctx;
  return 0;
}

TEST(reactions_that_are_not_known_are_refused) {
  static const double q[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 3, 0, 0};
  static const int64_t body[] = {0, 1, 2}, driven[] = {3};
  owned_system *system = small_system(4, q, NULL, 1.0, 1);
  check_ok(hooke_system_add_body(system, "plate", 3, body, 0));
  check_ok(hooke_system_drive_callback(system, 1, driven, stay, NULL));
  check_ok(hooke_system_commit(system));
  struct hk_watched_list list = {.system = system};
  check_status(hk_watched_read(&list, "watch", "0.reaction"), HOOKE_BAD_VALUE);
  check_message("allowed: particles of no body");
  check_status(hk_watched_read(&list, "watch", "3.reaction_z"), HOOKE_BAD_VALUE);
  check_message("allowed: particles that are pinned, or driven by a sine or a table");
  hk_watched_release(&list);
}

/* ---- extremes ---- */

static void see(struct hk_extremes *e, int64_t count, double step, double (*of)(double)) {
  *e = (struct hk_extremes){0};
  for (int64_t k = 0; k < count; k++)
    hk_extremes_see(e, step * (double)k, of(step * (double)k));
}

static double wave(double t) {
  return 3.0 + exp(-0.1 * t) * sin(t + 0.3);
}
static double slack(double t) {
  return fmax(0.0, 2.0 - t) + fmax(0.0, t - 7.3);
}
static double kink(double t) {
  return -fabs(t - 1.234);
}

/* The smallest and largest of a wave by a few samples a period, to the fifth order; no kink is overshot. */
TEST(extremes_are_those_between_samples) {
  struct hk_extremes coarse, fine;
  const double top = atan(10.0) - 0.3, low = top + PI;
  see(&coarse, 30, 0.3, wave);
  see(&fine, 60, 0.15, wave);
  const double error = fabs(coarse.most[0] - wave(top));
  assert_true(error < 1e-5 && error > 1e-9);
  check_between(fabs(fine.most[0] - wave(top)) / error, 0.0, 1.0 / 16.0);
  check_between(fabs(-fine.most[1] - wave(low)), 0.0, 1e-6);
  check_between(fabs(fine.at[0] - top), 0.0, 1e-4);
  check_between(fabs(fine.at[1] - low), 0.0, 1e-4);
  see(&coarse, 100, 0.1, slack);
  assert_true(coarse.most[1] == 0.0);
  see(&coarse, 50, 0.05, kink);
  assert_true(coarse.most[0] < 0.0);
  hk_extremes_see(&coarse, 3.0, NAN);
  assert_true(coarse.lost && !fine.lost);
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
