/* Spring groups: options, checks, and the conversion of both laws to one. */
#include "model/force/spring.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct hk_option_row spring_rows[] = {
    HOOKE_OPTION(
        "law", HOOKE_OPTION_ONE_OF("strain length"), "strain",
        "strain: force by relative stretch, the same at any resolution; length: by stretch in metres"),
    HOOKE_OPTION("stiffness", HOOKE_OPTION_EACH("N (strain law), N/m (length law)"), NULL,
                 "stiffness, one number or one for each spring; required without a curve"),
    HOOKE_OPTION("curve", .type = HOOKE_OPTION_FAMILY, NULL,
                 "in place of stiffness: the tension of all springs, by a table or by coefficients",
                 .family = &hk_curve_options),
    HOOKE_OPTION("damping", HOOKE_OPTION_EACH("N s (strain law), N s/m (length law)"), "0",
                 "damping along the spring, one number or one for each"),
    HOOKE_OPTION("damping_ratio", HOOKE_OPTION_EACH(NULL), NULL,
                 "in place of damping: 1 is the critical one of its two ends on the spring alone, one number "
                 "or one for each"),
    HOOKE_OPTION("rest_length", HOOKE_OPTION_EACH("m"), "initial",
                 "rest length, one number or one for each spring; > 0 with the strain law; initial: as added",
                 .words = "initial"),
    HOOKE_SCALE_OPTIONS,
    HOOKE_OPTION("compression", .type = HOOKE_OPTION_FLAG, "true",
                 "false: the spring only pulls, like a cable"),
};

const struct hk_option_table hk_spring_options = {"spring group", HOOKE_OPTION_ROWS(spring_rows)};

int64_t hk_springs_run(const struct hk_springs *springs, int64_t number) {
  return hk_runs_find(&springs->run->first, springs->run_count, sizeof *springs->run, number);
}

struct hk_spring hk_springs_find(const struct hk_springs *springs, int64_t number, double t) {
  const struct hk_run *run = &springs->run[hk_springs_run(springs, number)];
  return hk_run_spring_at(run, number - run->first, &(struct hk_scaler){.t = t});
}

double hk_springs_mean(const struct hk_springs *springs, int64_t first, int64_t count, double t) {
  double sum = 0.0, stiff = 0.0;
  for (int64_t s = first; s < first + count; s++) {
    const double kappa = hk_springs_find(springs, s, t).kappa;
    if (kappa > 0.0) sum += log(kappa), stiff += 1.0;
  }
  return exp(sum / fmax(1.0, stiff));
}

/* ---- damping ratios ---- */

/* By the product, or by the roots where that leaves the range of numbers. */
double hk_critical_damping(double kappa, double mass) {
  const double product = kappa * mass;
  const int fits = product >= DBL_MIN && product <= DBL_MAX;
  return 2.0 * (fits ? sqrt(product) : sqrt(kappa) * sqrt(mass));
}

/* Keeps the ratios until commit, when it is known what is held. */
static int32_t keep_ratios(const hooke_options *options, struct hk_group *group) {
  const int64_t given = hooke_options_number_count(options, "damping_ratio");
  if (given == 0) return HOOKE_OK;
  group->ratio = hk_new(group->count, sizeof(double));
  for (int64_t k = 0; k < group->count && group->ratio; k++)
    group->ratio[k] = hooke_options_numbers(options, "damping_ratio")[given > 1 ? k : 0];
  return group->ratio ? HOOKE_OK : HOOKE_NO_MEMORY;
}

int32_t hk_springs_find_damping(const hooke_system *system, struct hk_group *group, int64_t number) {
  for (int64_t k = 0; k < group->count && group->ratio; k++) {
    const double inverse = 0.5 * system->inverse_mass[group->particle[0][k]] +
                           0.5 * system->inverse_mass[group->particle[1][k]]; /* 0 where held */
    const double mass = inverse > 0.0 ? 0.5 / inverse : 0.0, kappa = group->number[HOOKE_KAPPA][k];
    const double gamma = group->number[HOOKE_GAMMA][k] = group->ratio[k] * hk_critical_damping(kappa, mass);
    if (gamma <= 1e300) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "%g of spring %lld is a damping of %g N s/m; up to 1e300 are allowed",
            group->ratio[k], (long long)k, gamma);
    return hk_fail_within(HOOKE_BAD_VALUE, "springs[%lld].damping_ratio", (long long)number);
  }
  return HOOKE_OK;
}

/* ---- numbers of a group ---- */

static int32_t refuse_rest_length(int64_t k, int64_t given, double length) {
  char where[64];
  if (given > 1) {
    snprintf(where, sizeof where, "rest_length[%lld]", (long long)k);
  } else {
    snprintf(where, sizeof where, given == 1 ? "rest_length" : "between[%lld]", (long long)k);
  }
  return hk_fail(HOOKE_BAD_VALUE, where,
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

/* A table of elongations is of the length law, unless the law is given. */
static int32_t is_strain(const hooke_options *options) {
  if (!hooke_options_is_set(options, "law") && hooke_options_is_set(options, "curve.elongation")) return 0;
  return strcmp(hooke_options_text(options, "law"), "strain") == 0;
}

static int32_t check_strength(const hooke_options *options) {
  char allowed[HOOKE_OPTION_ALLOWED];
  const int32_t stiff = hooke_options_is_set(options, "stiffness");
  if (hk_options_has_family(options, "curve"))
    return stiff ? hk_fail(HOOKE_BAD_VALUE, "curve", "is given beside stiffness; a group has one of them")
                 : HOOKE_OK;
  if (stiff) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "stiffness", "is required but missing; allowed: %s, or a curve instead",
                 hk_option_allowed(hk_options_find(&hk_spring_options, "stiffness"), allowed));
}

/* A number with a unit must be of the law: 2kN is not a stiffness of the length law. */
static int32_t check_unit(const hooke_options *options, const char *name, const char *unit) {
  const char *given = hk_options_unit_given(options, name), *law = is_strain(options) ? "strain" : "length";
  if (given == NULL || strcmp(given, unit) == 0) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, name,
                 "is given in units of %s; the %s law needs one of %s, or say \"law\": \"%s\"", given, law,
                 unit, strcmp(law, "strain") == 0 ? "length" : "strain");
}

static int32_t check_units(const hooke_options *options) {
  const int strain = is_strain(options);
  const int32_t status = check_unit(options, "stiffness", strain ? "N" : "N/m");
  return status ? status : check_unit(options, "damping", strain ? "N s" : "N s/m");
}

int32_t hk_springs_find_material(const hooke_system *system, const hooke_options *options,
                                 struct hk_group *group) {
  const int strain = is_strain(options);
  const double scale = hk_scale_number(options, "rest_scale"),
               more = hk_scale_number(options, "stiffness_scale");
  const int64_t given = hooke_options_number_count(options, "rest_length");
  double *const *number = group->number;
  hk_group_fill(group, options);
  for (int64_t k = 0; k < group->count; k++) {
    const double length =
        scale * (given > 0 ? number[HOOKE_REST_LENGTH][k] : initial_length(group, system->position, k));
    const double stiffness = group->curve ? group->curve->slope : more * number[HOOKE_KAPPA][k];
    const double damping = number[HOOKE_GAMMA][k];
    if (strain && !(length > 0.0)) return refuse_rest_length(k, given, length);
    number[HOOKE_REST_LENGTH][k] = length;
    number[HOOKE_KAPPA][k] = strain ? stiffness / length : stiffness;
    number[HOOKE_GAMMA][k] = strain ? damping / length : damping;
    if (fabs(number[HOOKE_KAPPA][k]) <= 1e300 && number[HOOKE_GAMMA][k] <= 1e300 && length <= 1e300) continue;
    return hk_fail(
        HOOKE_BAD_VALUE, "stiffness",
        "spring %lld has stiffness %g, damping %g and rest length %g; allowed: stiffness / rest length, "
        "damping / rest length and rest length up to 1e300",
        (long long)k, stiffness, damping, length);
  }
  return keep_ratios(options, group);
}

/* ---- adding a group ---- */

static int32_t check_damping(const hooke_system *system, const hooke_options *options) {
  if (!hooke_options_is_set(options, "damping_ratio")) return HOOKE_OK;
  if (hooke_options_is_set(options, "damping"))
    return hk_fail(HOOKE_BAD_VALUE, "damping_ratio",
                   "damping and damping_ratio are both given; a group has one of them");
  return !system->overdamped
             ? HOOKE_OK
             : hk_fail(HOOKE_BAD_VALUE, "damping_ratio",
                       "is not allowed; in an overdamped scene drag is the only friction, and damping is 0");
}

static int32_t keep_options(const hooke_options *options, struct hk_group *group) {
  for (int k = HOOKE_KAPPA; k <= HOOKE_REST_LENGTH; k++)
    if (hooke_options_number_count(options, hk_group_names[k]) > 1) return HOOKE_OK;
  if (hooke_options_number_count(options, "damping_ratio") > 1) return HOOKE_OK;
  return hooke_options_copy(options, &group->options);
}

int32_t hk_system_add_springs(hooke_system *system, const struct hk_addition *added) {
  struct hk_group group;
  int32_t status = hk_group_begin(system, added, &group);
  if (status == HOOKE_OK) status = check_strength(added->options);
  if (status == HOOKE_OK) status = check_units(added->options);
  if (status == HOOKE_OK) status = check_damping(system, added->options);
  if (status == HOOKE_OK) group.pull_only = hooke_options_number(added->options, "compression") == 0.0;
  if (status == HOOKE_OK)
    status = hk_curve_from_options(added->options, is_strain(added->options), group.pull_only, &group.curve);
  if (status == HOOKE_OK && group.curve)
    status = hk_curve_scale(&group.curve, hk_scale_number(added->options, "stiffness_scale"));
  if (status == HOOKE_OK)
    status = hk_scaling_create(added->options, is_strain(added->options), &group.scaling);
  if (status == HOOKE_OK) status = hk_springs_find_material(system, added->options, &group);
  if (status == HOOKE_OK && !added->from_part) status = keep_options(added->options, &group);
  return hk_group_end(system, status, &group);
}

int32_t hooke_system_add_springs(hooke_system *system, const char *name, int64_t count, const int64_t *ends,
                                 const hooke_options *options) {
  return hk_system_add_springs(system,
                               &(struct hk_addition){&hk_force_springs, name, count, ends, options, 0});
}
