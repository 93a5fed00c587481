/* Loads: forces F(t) on particles, constant or a course of time. A constant one has the potential -F.q, as
 * gravity; the others do work. */

#include "core/memory.h"
#include "core/status.h"
#include "core/sum.h"
#include "model/check_value.h"
#include "model/course.h"
#include "model/system.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("motion", HOOKE_OPTION_ONE_OF("constant harmonic table"), "constant", "course of the force"),
    HOOKE_OPTION("force", HOOKE_OPTION_VECTORS("N", 1, 0), NULL,
                 "force on each particle; its amplitude, or a row for each time", .required = 1, .flat = 1),
    HOOKE_COURSE_OPTIONS(NULL, NULL, NULL),
};

static const struct hk_option_table options_table = {"loads", HOOKE_OPTION_ROWS(rows)};

/* A group of loads: particles `first` to before `first` + `count` of the list below. */
struct load {
  struct hk_course course;
  int64_t first, count;
};

struct loads {
  int64_t groups, particles;
  struct load *load;
  int32_t *particle;
};

/* ---- adding a group ---- */

static int32_t find_course(const hooke_options *options, struct hk_course *course) {
  const char *motion = hooke_options_text(options, "motion");
  const int64_t given = hooke_options_number_count(options, "force") / 3;
  *course = (struct hk_course){.width = 3};
  if (strcmp(motion, "table") != 0 && given != 1)
    return hk_fail(HOOKE_BAD_VALUE, "force", "%lld rows given; allowed: one, as the motion is \"%s\"",
                   (long long)given, motion);
  if (strcmp(motion, "constant") != 0)
    return hk_course_from_options(course, options, "", "force", "force", hk_parabolic_slopes);
  memcpy(course->mean, hooke_options_numbers(options, "force"), sizeof course->mean);
  return HOOKE_OK;
}

int32_t hooke_system_add_loads(hooke_system *system, int64_t count, const int64_t *particles,
                               const hooke_options *options) {
  const struct hk_addition added = {&hk_force_loads, NULL, count, particles, options, 0};
  struct hk_group group;
  struct hk_course course = {0};
  int32_t status = hk_group_begin(system, &added, &group);
  if (status == HOOKE_OK) status = find_course(options, &course);
  if (status == HOOKE_OK) status = hooke_options_copy(options, &group.options);
  hk_course_release(&course);
  return hk_group_end(system, status, &group);
}

/* ---- from groups ---- */

static const struct loads *loads_of(const hooke_system *system) {
  return system->rest->own[hk_force_number(&hk_force_loads)];
}

static void release(hooke_system *system) {
  void **own = &system->rest->own[hk_force_number(&hk_force_loads)];
  struct loads *loads = *own;
  for (int64_t g = 0; loads && g < loads->groups; g++)
    hk_course_release(&loads->load[g].course);
  if (loads) hk_free(loads->load);
  if (loads) hk_free(loads->particle);
  hk_free(loads);
  *own = NULL;
}

static int32_t take_group(const struct hk_group *group, struct loads *loads) {
  struct load *load = &loads->load[loads->groups++];
  load->first = loads->particles;
  load->count = group->count;
  loads->particles += group->count;
  memcpy(loads->particle + load->first, group->particle[0], (size_t)group->count * sizeof(int32_t));
  return find_course(group->options, &load->course);
}

static int32_t commit(hooke_system *system, const struct hk_group *group, int64_t count) {
  if (count == 0) return HOOKE_OK;
  struct loads *loads = hk_new(1, sizeof *loads);
  if (loads == NULL) return HOOKE_NO_MEMORY;
  system->rest->own[hk_force_number(&hk_force_loads)] = loads;
  loads->load = hk_new(count, sizeof *loads->load);
  loads->particle = hk_new(hk_force_count(system, &hk_force_loads), sizeof *loads->particle);
  int32_t status = loads->load && loads->particle ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t g = 0; g < count && status == HOOKE_OK; g++)
    status = take_group(&group[g], loads);
  return status;
}

static int64_t memory(const hooke_system *system) {
  const struct loads *loads = loads_of(system);
  int64_t numbers = 0;
  for (int64_t g = 0; loads && g < loads->groups; g++)
    numbers += 7 * loads->load[g].course.samples;
  if (loads == NULL) return 0;
  return loads->groups * (int64_t)sizeof *loads->load + loads->particles * (int64_t)sizeof(int32_t) +
         numbers * (int64_t)sizeof(double);
}

static void recall(const hooke_system *system, int64_t first, struct hk_group *to) {
  memcpy(to->particle[0], loads_of(system)->particle + first, (size_t)to->count * sizeof(int32_t));
}

static void check(const hooke_system *system, uint32_t *value) {
  const struct loads *loads = loads_of(system);
  hk_check_add(value, loads->particle, loads->particles, sizeof *loads->particle);
  for (int64_t g = 0; g < loads->groups; g++) {
    hk_check_whole(value, loads->load[g].count);
    hk_course_check(&loads->load[g].course, value);
  }
}

/* ---- the force ---- */

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  const struct loads *loads = loads_of(system);
  for (const struct load *l = loads->load; l < loads->load + loads->groups; l++) {
    double force[3];
    hk_course_at(&l->course, t, force, NULL);
    for (int64_t k = l->first; k < l->first + l->count; k++)
      for (int a = 0; a < 3; a++)
        motion->f[a][loads->particle[k]] += force[a];
  }
  return HOOKE_OK;
}

static int is_constant(const struct load *load) {
  const double *a = load->course.amplitude;
  return load->course.samples == 0 && a[0] == 0.0 && a[1] == 0.0 && a[2] == 0.0;
}

/* The sum of F.x, of the constant loads or of the others. */
static double product_with(const hooke_system *system, int constant, double t, const double *x) {
  const struct loads *loads = loads_of(system);
  struct hk_sum sum = {0.0, 0.0};
  for (const struct load *l = loads->load; l < loads->load + loads->groups; l++) {
    double force[3];
    if (is_constant(l) != constant) continue;
    hk_course_at(&l->course, t, force, NULL);
    for (int64_t k = l->first; k < l->first + l->count; k++)
      hk_sum_add(&sum, hk_dot3(force, x + 3 * (int64_t)loads->particle[k]));
  }
  return hk_sum_value(&sum);
}

static double energy(const hooke_system *system, double t, const double *q) {
  return -product_with(system, 1, t, q);
}

static double power(const hooke_system *system, double t, const double *q, const double *v) {
  (void)q;
  return product_with(system, 0, t, v);
}

static int32_t does_work(const hooke_system *system) {
  const struct loads *loads = loads_of(system);
  int32_t some = 0;
  for (int64_t g = 0; g < loads->groups; g++)
    some |= !is_constant(&loads->load[g]);
  return some;
}

static void add_pull(const hooke_system *system, double *force, double *kick) {
  const struct loads *loads = loads_of(system);
  for (int64_t g = 0; g < loads->groups; g++) {
    const struct load *l = &loads->load[g];
    const double *f = l->course.mean;
    for (int64_t k = l->first; k < l->first + l->count; k++) {
      *force += (fabs(f[0]) + fabs(f[1])) + fabs(f[2]);
      *kick += system->inverse_mass[loads->particle[k]] * hk_dot3(f, f);
    }
  }
}

const struct hk_force_row hk_force_loads = {.name = "loads",
                                            .in_scenes = 1,
                                            .members = "loads",
                                            .bytes = 100.0,
                                            .options = &options_table,
                                            .member = "load",
                                            .place = "particles",
                                            .member_particles = 1,
                                            .on_free = 1,
                                            HOOKE_FORCE_OF_GROUPS,
                                            .add = add,
                                            .energy = energy,
                                            .does_work = does_work,
                                            .power = power,
                                            .add_pull = add_pull};
