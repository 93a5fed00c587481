#include "parts/material.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double hk_part_material(const struct hk_part *part, const char *family, const char *key) {
  char dotted[64];
  snprintf(dotted, sizeof dotted, "%s.%s", family, key);
  return hooke_options_number(part->options, dotted);
}

int32_t hk_part_is_given(const struct hk_part *part, const char *family, const char *key) {
  char dotted[64];
  snprintf(dotted, sizeof dotted, "%s.%s", family, key);
  return hooke_options_is_set(part->options, dotted);
}

int32_t hk_part_derive(const struct hk_part *part, const char *family, const char *name, const char *unit,
                       double value) {
  return hk_system_add_derived(part->system, part->name, family, name, unit, value);
}

/* ---- masses ---- */

/* Of an overdamped system, where masses serve gravity and damping ratios alone. */
static int32_t check_massless(const struct hk_part *part) {
  const char *const ending = ".damping_ratio";
  for (int64_t k = 0; k < hooke_options_row_count(part->options); k++) {
    const char *name = hooke_options_row(part->options, k, "name");
    const size_t length = strlen(name), end = strlen(ending);
    if (length > end && strcmp(name + length - end, ending) == 0 && hooke_options_is_set(part->options, name))
      return hk_fail(HOOKE_BAD_VALUE, name, "is given to a part that has neither mass nor density");
  }
  return HOOKE_OK;
}

int32_t hk_part_check_masses(const struct hk_part *part) {
  const int both = hooke_options_is_set(part->options, "density");
  if (both != hooke_options_is_set(part->options, "mass")) return HOOKE_OK;
  if (!both && part->system->overdamped) return check_massless(part);
  return hk_fail(HOOKE_BAD_VALUE, both ? "density" : NULL,
                 "%s; a part needs one of mass (total, kg) and density (of its material)",
                 both ? "mass and density are both given" : "neither mass nor density is given");
}

/* The kinds of particles, by the number of axes at one of whose ends they are. */
static int32_t derive_masses(const struct hk_part *part, int32_t axes, const int64_t size[3]) {
  static const char inner[] = "mass of an inner particle", corner[] = "mass of a corner";
  static const char *const name[][4] = {
      {inner, "mass of an end"},
      {inner, "mass of an edge particle", corner},
      {inner, "mass of a particle on a face", "mass of a particle on an edge", corner}};
  int32_t outside = axes, status = HOOKE_OK;
  for (int32_t a = 0; a < axes; a++)
    outside -= size[a] > 2;
  for (; outside <= axes && status == HOOKE_OK; outside++)
    status = hk_part_derive(part, NULL, name[axes - 1][outside], "kg", ldexp(part->inner_mass, -outside));
  return status;
}

double hk_part_total_mass(const struct hk_part *part) {
  return hooke_options_is_set(part->options, "mass") ? hooke_options_number(part->options, "mass") : 0.0;
}

static void share_mass(double inner, int32_t axes, const int64_t size[3], int64_t count, double *mass) {
  for (int64_t k = 0, at[3]; k < count; k++) {
    int outside = 0;
    hk_part_point(size, k, size, at);
    for (int32_t a = 0; a < axes; a++)
      outside += at[a] % (size[a] - 1) == 0;
    mass[k] = ldexp(inner, -outside);
  }
}

static int32_t find_masses(struct hk_part *part, int32_t axes, const int64_t size[3], double piece,
                           int64_t count, double *mass) {
  static const char *const unit[] = {"", "m", "m^2", "m^3"};
  if (!hooke_options_is_set(part->options, "density")) {
    part->inner_mass = *mass = hk_part_total_mass(part) / (double)part->count;
    return HOOKE_OK;
  }
  part->inner_mass = hooke_options_number(part->options, "density") * piece;
  if (!isfinite(part->inner_mass) || !isfinite(1.0 / ldexp(part->inner_mass, axes == 3 ? -3 : -2)))
    return hk_fail(HOOKE_BAD_VALUE, "density",
                   "an inner particle stands for %g %s and would have a mass of %g kg; allowed: finite and "
                   "> 0, so let the %s",
                   piece, unit[axes], part->inner_mass,
                   axes == 3 ? "edges of the part span a volume" : "ends and edges of the part lie apart");
  share_mass(part->inner_mass, axes, size, count, mass);
  return derive_masses(part, axes, size);
}

int32_t hk_part_add_particles(struct hk_part *part, int32_t axes, const int64_t size[3], double piece,
                              const double *position) {
  const int64_t count = hooke_options_is_set(part->options, "density") ? part->count : 1;
  double *mass = hk_new(count, sizeof(double));
  int32_t status = mass ? hk_part_check_masses(part) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = find_masses(part, axes, size, piece, count, mass);
  if (status == HOOKE_OK)
    status = hooke_system_add_particles(part->system, part->count, position, NULL, count, mass, &part->first);
  hk_free(mass);
  return status;
}

/* ---- damping ---- */

static double reduced_mass(const struct hk_part *part, const int64_t *ends) {
  if (part->inner_mass > 0.0) return 0.5 * part->inner_mass;
  const double a = part->system->mass[ends[0]], b = part->system->mass[ends[1]];
  return a * (b / (a + b));
}

int32_t hk_part_set_damping(const struct hk_part *part, const char *family, int64_t count,
                            const int64_t *ends, const double *rest_length, hooke_options *springs) {
  const double zeta = hk_part_material(part, family, "damping_ratio");
  const double stiffness = hk_part_material(part, family, "stiffness");
  const double scale = hk_part_material(part, family, "rest_scale");
  double *damping = hk_new(count, sizeof(double));
  if (damping == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count; k++) {
    const double length = rest_length[k] * scale, kappa = stiffness / length;
    damping[k] = zeta * hk_critical_damping(kappa, reduced_mass(part, ends + 2 * k)) * length;
  }
  const int32_t status = hooke_options_set_numbers(springs, "damping", count, damping);
  hk_free(damping);
  return status;
}

int32_t hk_part_check_damping(const struct hk_part *part, const char *family) {
  if (!hk_part_is_given(part, family, "damping_ratio") || !hk_part_is_given(part, family, "damping"))
    return HOOKE_OK;
  hk_fail(HOOKE_BAD_VALUE, "damping_ratio",
          "damping and damping_ratio are both given; a family has one of them");
  return hk_fail_within(HOOKE_BAD_VALUE, "%s", family);
}

int32_t hk_part_derive_spring(const struct hk_part *part, const char *family, int64_t k, const char *kappa,
                              const char *gamma) {
  const struct hk_group *group = hk_system_last_group(part->system, &hk_force_springs);
  const int32_t status = hk_part_derive(part, family, kappa, "N/m", group->number[HOOKE_KAPPA][k]);
  if (status != HOOKE_OK) return status;
  return hk_part_derive(part, family, gamma, "N s/m", group->number[HOOKE_GAMMA][k]);
}

char *hk_part_group_name(const struct hk_part *part, const char *family) {
  char *name = hk_new((int64_t)(strlen(part->name) + strlen(family) + 2), 1);
  if (name) sprintf(name, "%s.%s", part->name, family);
  return name;
}
