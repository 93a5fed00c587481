/* Spring groups: options, checks, and the conversion of both laws to one. */
#include "model/force/spring.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"

#include <stdio.h>
#include <string.h>

static const struct hk_option_row spring_rows[] = {
    {.name = "law",
     .type = HOOKE_OPTION_CHOICE,
     .words = "strain length",
     .fallback = "strain",
     .doc = "strain: force by relative stretch, the same at any resolution; length: by stretch in metres"},
    {.name = "stiffness",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "N (strain law), N/m (length law)",
     .low = 0.0,
     .high = 1e300,
     .min_count = 1,
     .required = 1,
     .doc = "stiffness, one number or one for each spring"},
    {.name = "damping",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "N s (strain law), N s/m (length law)",
     .low = 0.0,
     .high = 1e300,
     .min_count = 1,
     .fallback = "0",
     .doc = "damping along the spring, one number or one for each"},
    {.name = "rest_length",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "m",
     .low = 0.0,
     .high = 1e300,
     .min_count = 1,
     .words = "initial",
     .fallback = "initial",
     .doc = "rest length, one number or one for each spring; > 0 with the strain law; initial: as added"},
    {.name = "rest_scale",
     .type = HOOKE_OPTION_NUMBER,
     .low = 0.0,
     .above_low = 1,
     .high = 1e300,
     .fallback = "1",
     .doc = "factor on the rest length"},
    {.name = "compression",
     .type = HOOKE_OPTION_FLAG,
     .fallback = "true",
     .doc = "false: the spring only pulls, like a cable"},
};

const struct hk_option_table hk_spring_options = {"spring group", HOOKE_OPTION_ROWS(spring_rows)};

int64_t hk_springs_run(const struct hk_springs *springs, int64_t number) {
  int64_t low = 0, high = springs->run_count - 1;
  while (low < high) {
    const int64_t middle = low + (high - low + 1) / 2;
    if (springs->run[middle].first <= number)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

struct hk_spring hk_springs_find(const struct hk_springs *springs, int64_t number) {
  const struct hk_run *run = &springs->run[hk_springs_run(springs, number)];
  return hk_run_spring(run, number - run->first);
}

void hk_spring_stretch_taut(const struct hk_spring *spring, const double *q, struct hk_stretch *stretch) {
  struct hk_spring taut = *spring;
  taut.pull_only = 0;
  hk_spring_stretch(&taut, q, NULL, stretch);
}

/* ---- adding a group ---- */

static int32_t check_ends(const hooke_system *system, int64_t count, const int64_t *ends) {
  if (count < 0) {
    return hk_fail(HOOKE_BAD_VALUE, "between", "%lld springs; 0 or more are allowed", (long long)count);
  }
  const int32_t status = hk_system_check_more(system, &hk_force_springs, count);
  if (status != HOOKE_OK) return hk_fail_within(status, "between");
  for (int64_t k = 0; k < count; k++) {
    for (int end = 0; end < 2; end++) {
      const int64_t p = ends[2 * k + end];
      if (p >= 0 && p < system->particle_count) continue;
      char place[64];
      snprintf(place, sizeof place, "between[%lld][%d]", (long long)k, end);
      return hk_fail_index(place, "there is no particle", (double)p, system->particle_count);
    }
    if (ends[2 * k] == ends[2 * k + 1]) {
      char place[64];
      snprintf(place, sizeof place, "between[%lld]", (long long)k);
      return hk_fail(HOOKE_BAD_VALUE, place,
                     "both ends are particle %lld; a spring joins two different particles",
                     (long long)ends[2 * k]);
    }
  }
  return HOOKE_OK;
}

static int32_t check_count(const hooke_options *options, const char *name, int64_t count) {
  const int64_t given = hooke_options_number_count(options, name);
  if (given <= 1 || given == count) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, name, "%lld values for %lld springs; allowed: one, or one for each",
                 (long long)given, (long long)count);
}

/* Values of one number, or one number for each spring. */
struct values {
  const double *value;
  int64_t stride;
};

static struct values values_of(const hooke_options *options, const char *name) {
  return (struct values){hooke_options_numbers(options, name), hooke_options_number_count(options, name) > 1};
}

static int32_t refuse_rest_length(int64_t k, int64_t given, double length) {
  char place[64];
  if (given > 1) {
    snprintf(place, sizeof place, "rest_length[%lld]", (long long)k);
  } else {
    snprintf(place, sizeof place, given == 1 ? "rest_length" : "between[%lld]", (long long)k);
  }
  return hk_fail(HOOKE_BAD_VALUE, place,
                 "rest length %g of spring %lld; the strain law needs one > 0 (the length law takes 0)",
                 length, (long long)k);
}

/* Springs are in any order, so the positions of their ends are prefetched. */
static void ask_for_ends(const struct hk_group *group, const double *position, int64_t k) {
  if (k >= group->count) return;
  __builtin_prefetch(position + 3 * (int64_t)group->particle[0][k]);
  __builtin_prefetch(position + 3 * (int64_t)group->particle[1][k]);
}

static double initial_length(const struct hk_group *group, const double *position, int64_t k) {
  const double *qi = position + 3 * (int64_t)group->particle[0][k],
               *qj = position + 3 * (int64_t)group->particle[1][k];
  ask_for_ends(group, position, k + 16);
  return hk_spring_length(qi[0] - qj[0], qi[1] - qj[1], qi[2] - qj[2]);
}

/* A number with a unit must be of the law: 2kN is not a stiffness of the length law. */
static int32_t check_unit(const hooke_options *options, const char *name, const char *unit) {
  const char *given = hk_options_unit_given(options, name), *law = hooke_options_text(options, "law");
  if (given == NULL || strcmp(given, unit) == 0) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, name,
                 "is given in units of %s; the %s law needs one of %s, or say \"law\": \"%s\"", given, law,
                 unit, strcmp(law, "strain") == 0 ? "length" : "strain");
}

static int32_t check_units(const hooke_options *options) {
  const int strain = strcmp(hooke_options_text(options, "law"), "strain") == 0;
  const int32_t status = check_unit(options, "stiffness", strain ? "N" : "N/m");
  return status ? status : check_unit(options, "damping", strain ? "N s" : "N s/m");
}

/* kappa, gamma and rest length of every spring of the group. */
static int32_t find_material(const hooke_system *system, const hooke_options *options,
                             struct hk_group *group) {
  const int strain = strcmp(hooke_options_text(options, "law"), "strain") == 0;
  const double scale = hooke_options_number(options, "rest_scale");
  const int64_t given = hooke_options_number_count(options, "rest_length");
  const struct values stiffnesses = values_of(options, "stiffness"), dampings = values_of(options, "damping"),
                      lengths = values_of(options, "rest_length");
  for (int64_t k = 0; k < group->count; k++) {
    const double length =
        scale * (given > 0 ? lengths.value[k * lengths.stride] : initial_length(group, system->position, k));
    const double stiffness = stiffnesses.value[k * stiffnesses.stride],
                 damping = dampings.value[k * dampings.stride];
    if (strain && !(length > 0.0)) return refuse_rest_length(k, given, length);
    group->number[HOOKE_REST_LENGTH][k] = length;
    group->number[HOOKE_KAPPA][k] = strain ? stiffness / length : stiffness;
    group->number[HOOKE_GAMMA][k] = strain ? damping / length : damping;
    if (group->number[HOOKE_KAPPA][k] <= 1e300 && group->number[HOOKE_GAMMA][k] <= 1e300 && length <= 1e300)
      continue;
    return hk_fail(
        HOOKE_BAD_VALUE, "stiffness",
        "spring %lld has stiffness %g, damping %g and rest length %g; allowed: stiffness / rest length, "
        "damping / rest length and rest length up to 1e300",
        (long long)k, stiffness, damping, length);
  }
  return HOOKE_OK;
}

static int32_t fill_group(const hooke_system *system, const char *name, const int64_t *ends,
                          const hooke_options *options, struct hk_group *group) {
  group->pull_only = hooke_options_number(options, "compression") == 0.0;
  int32_t status = check_units(options);
  if (status == HOOKE_OK) status = hk_group_allocate(group, name, 2, 3, 0);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < group->count; k++) {
    group->particle[0][k] = (int32_t)ends[2 * k];
    group->particle[1][k] = (int32_t)ends[2 * k + 1];
  }
  return find_material(system, options, group);
}

static int32_t keep_options(const hooke_options *options, struct hk_group *group) {
  static const char *const lists[] = {"stiffness", "damping", "rest_length"};
  for (size_t k = 0; k < sizeof lists / sizeof lists[0]; k++) {
    if (hooke_options_number_count(options, lists[k]) > 1) return HOOKE_OK;
  }
  return hooke_options_copy(options, &group->options);
}

static int32_t add_group(hooke_system *system, const char *name, int64_t count, const int64_t *ends,
                         const hooke_options *options, int32_t from_part) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK)
    status =
        hk_options_require(options, &hk_spring_options, "options", "hooke_options_create(\"springs\", ...)");
  if (status == HOOKE_OK) status = hk_options_check_required(options);
  if (status == HOOKE_OK) status = check_ends(system, count, ends);
  if (status == HOOKE_OK) status = check_count(options, "stiffness", count);
  if (status == HOOKE_OK) status = check_count(options, "damping", count);
  if (status == HOOKE_OK) status = check_count(options, "rest_length", count);
  if (status != HOOKE_OK) return status;
  struct hk_group group = {
      .force = &hk_force_springs, .count = count, .from_part = from_part, .part = system->part_count - 1};
  status = fill_group(system, name, ends, options, &group);
  if (status == HOOKE_OK && !from_part) status = keep_options(options, &group);
  if (status == HOOKE_OK) return hk_system_add_group(system, &group);
  hk_group_release(&group);
  return status;
}

int32_t hooke_system_add_springs(hooke_system *system, const char *name, int64_t count, const int64_t *ends,
                                 const hooke_options *options) {
  return add_group(system, name, count, ends, options, 0);
}

int32_t hk_system_add_part_springs(hooke_system *system, const char *name, int64_t count, const int64_t *ends,
                                   const hooke_options *options) {
  return add_group(system, name, count, ends, options, 1);
}
