#include "parts/material.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/force/bending.h"

#include <float.h>
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

static int32_t derive(const struct hk_part *part, const char *family, const char *name, const char *unit,
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

static int is_edge(int64_t k, int64_t count) {
  return k == 0 || k == count - 1;
}

/* The kinds of particles, by the number of edges that they are on. */
static int32_t derive_masses(const struct hk_part *part, int64_t rows, int64_t columns) {
  const int64_t within = columns - 2, down = rows - 2;
  const int rope = rows == 1;
  int32_t status = HOOKE_OK;
  if (within > 0 && (rope || down > 0))
    status = derive(part, NULL, "mass of an inner particle", "kg", part->inner_mass);
  if (status == HOOKE_OK && rope) status = derive(part, NULL, "mass of an end", "kg", 0.5 * part->inner_mass);
  if (status == HOOKE_OK && !rope && (within > 0 || down > 0))
    status = derive(part, NULL, "mass of an edge particle", "kg", 0.5 * part->inner_mass);
  if (status == HOOKE_OK && !rope)
    status = derive(part, NULL, "mass of a corner", "kg", 0.25 * part->inner_mass);
  return status;
}

double hk_part_total_mass(const struct hk_part *part) {
  return hooke_options_is_set(part->options, "mass") ? hooke_options_number(part->options, "mass") : 0.0;
}

int32_t hk_part_masses(struct hk_part *part, int64_t rows, int64_t columns, double piece, int64_t *mass_count,
                       double **mass) {
  const int32_t status = hk_part_check_masses(part);
  if (status != HOOKE_OK) return status;
  const int by_density = hooke_options_is_set(part->options, "density");
  *mass_count = by_density ? rows * columns : 1;
  *mass = hk_new(*mass_count, sizeof(double));
  if (*mass == NULL) return HOOKE_NO_MEMORY;
  if (!by_density) {
    part->inner_mass = **mass = hk_part_total_mass(part) / (double)part->count;
    return HOOKE_OK;
  }
  const double inner = part->inner_mass = hooke_options_number(part->options, "density") * piece;
  if (!isfinite(inner) || !isfinite(1.0 / (0.25 * inner))) {
    return hk_fail(HOOKE_BAD_VALUE, "density",
                   "an inner particle stands for %g m%s and would have a mass of %g kg; allowed: finite and "
                   "> 0, so let the ends and edges of the part lie apart",
                   piece, rows == 1 ? "" : "^2", inner);
  }
  for (int64_t r = 0; r < rows; r++) {
    for (int64_t c = 0; c < columns; c++) {
      const double down = rows > 1 && is_edge(r, rows) ? 0.5 : 1.0;
      (*mass)[r * columns + c] = (is_edge(c, columns) ? 0.5 : 1.0) * down * inner;
    }
  }
  return derive_masses(part, rows, columns);
}

/* ---- damping ---- */

static double reduced_mass(const struct hk_part *part, const int64_t *ends) {
  if (part->inner_mass > 0.0) return 0.5 * part->inner_mass;
  const double a = part->system->mass[ends[0]], b = part->system->mass[ends[1]];
  return a * (b / (a + b));
}

/* By the product, or by the roots where that leaves the range of numbers. */
double hk_critical_damping(double kappa, double mass) {
  const double product = kappa * mass;
  const int fits = product >= DBL_MIN && product <= DBL_MAX;
  return 2.0 * (fits ? sqrt(product) : sqrt(kappa) * sqrt(mass));
}

void hk_part_damping(const struct hk_part *part, const char *family, int64_t count, const int64_t *ends,
                     const double *rest_length, double *damping) {
  const double zeta = hk_part_material(part, family, "damping_ratio");
  const double stiffness = hk_part_material(part, family, "stiffness");
  const double scale = hk_part_material(part, family, "rest_scale");
  for (int64_t k = 0; k < count; k++) {
    const double length = rest_length[k] * scale, kappa = stiffness / length;
    damping[k] = zeta * hk_critical_damping(kappa, reduced_mass(part, ends + 2 * k)) * length;
  }
}

#define DIRECTIONS(of)                                                                                       \
  of, of " along u", of " along v", of " along u + v", of " along u - v", /* a lattice: */                   \
      of " along x", of " along y", of " along z", of " along x + y", of " along x - y", of " along x + z",  \
      of " along x - z", of " along y + z", of " along y - z", of " along x + y + z", of " along x - y - z", \
      of " along x - y + z", of " along x + y - z"

int32_t hk_part_derive_springs(const struct hk_part *part, const char *family, int32_t strip_count,
                               const struct hk_part_strip *strip) {
  static const char *const kappa[] = {DIRECTIONS("kappa")}, *const gamma[] = {DIRECTIONS("gamma")};
  const struct hk_group *group = hk_system_last_group(part->system, &hk_force_springs);
  int32_t status = HOOKE_OK;
  for (int64_t s = 0, first = 0; s < strip_count && status == HOOKE_OK; s++) {
    const int64_t springs = strip[s].rows * strip[s].columns;
    const int told = s > 0 && strip[s].direction == strip[s - 1].direction; /* layers of a lattice */
    if (springs == 0) continue;
    if (!told)
      status = derive(part, family, kappa[strip[s].direction], "N/m", group->number[HOOKE_KAPPA][first]);
    if (!told && status == HOOKE_OK)
      status = derive(part, family, gamma[strip[s].direction], "N s/m", group->number[HOOKE_GAMMA][first]);
    first += springs;
  }
  return status;
}

/* ---- bending ---- */

static int64_t triples_of(const struct hk_part_beams *beams) {
  return beams->rows > 0 && beams->columns > 0 ? beams->rows * beams->columns : 0;
}

static void join(const struct hk_part *part, int64_t stride, const struct hk_part_beams *beams,
                 int64_t *triple, double *coefficient) {
  for (int64_t r = 0; r < beams->rows; r++) {
    for (int64_t c = 0; c < beams->columns; c++) {
      const int64_t at = part->first + r * stride + c;
      for (int e = 0; e < 3; e++)
        *triple++ = at + e * beams->step;
      const int edge = beams->side_by_side == HOOKE_BEAMS_ROWS      ? is_edge(r, beams->rows)
                       : beams->side_by_side == HOOKE_BEAMS_COLUMNS ? is_edge(c, beams->columns)
                                                                    : 0;
      *coefficient++ = edge ? 0.5 * beams->coefficient : beams->coefficient;
    }
  }
}

static int32_t derive_beams(const struct hk_part *part, const struct hk_part_beams *beams) {
  static const char *const inner[] = {"c", "c along u", "c along v"};
  static const char *const edge[] = {NULL, "c along u at an edge", "c along v at an edge"};
  const int64_t lines = beams->side_by_side == HOOKE_BEAMS_ROWS ? beams->rows : beams->columns;
  int32_t status = HOOKE_OK;
  if (beams->side_by_side == HOOKE_BEAMS_ALONE || lines > 2)
    status = derive(part, "bending", inner[beams->direction], "N/m", beams->coefficient);
  if (status == HOOKE_OK && beams->side_by_side != HOOKE_BEAMS_ALONE)
    status = derive(part, "bending", edge[beams->direction], "N/m", 0.5 * beams->coefficient);
  return status;
}

static int32_t check_beams(const struct hk_part_beams *beams) {
  if (beams->coefficient > 0.0 && beams->coefficient <= 1e300) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "bending",
                 "its triples would have a coefficient of %g N/m; allowed: > 0 up to 1e300, so let the "
                 "ends and edges of the part lie apart",
                 beams->coefficient);
}

static int32_t add_triples(const struct hk_part *part, int64_t stride, int32_t count,
                           const struct hk_part_beams *beams, int64_t *triple, double *coefficient) {
  int64_t done = 0;
  int32_t status = HOOKE_OK;
  for (int32_t k = 0; k < count && status == HOOKE_OK; k++) {
    if (triples_of(&beams[k]) == 0) continue;
    status = check_beams(&beams[k]);
    if (status == HOOKE_OK) status = derive_beams(part, &beams[k]);
    join(part, stride, &beams[k], triple + 3 * done, coefficient + done);
    done += triples_of(&beams[k]);
  }
  char *name = hk_part_group_name(part, "bending");
  if (name == NULL) return HOOKE_NO_MEMORY;
  if (status == HOOKE_OK)
    status = hk_system_add_bending(part->system,
                                   &(struct hk_addition){&hk_force_bending, name, done, triple, NULL, 1},
                                   done, coefficient);
  hk_free(name);
  return status;
}

int32_t hk_part_add_bending(struct hk_part *part, int64_t stride, int32_t count,
                            const struct hk_part_beams *beams) {
  int64_t triples = 0;
  for (int32_t k = 0; k < count; k++)
    triples += triples_of(&beams[k]);
  if (hooke_options_number(part->options, "bending") == 0.0 || triples == 0) return HOOKE_OK;
  int64_t *triple = hk_new(3 * triples, sizeof(int64_t));
  double *coefficient = hk_new(triples, sizeof(double));
  int32_t status = HOOKE_NO_MEMORY;
  if (triple && coefficient) status = add_triples(part, stride, count, beams, triple, coefficient);
  hk_free(triple);
  hk_free(coefficient);
  return status;
}

char *hk_part_group_name(const struct hk_part *part, const char *family) {
  char *name = hk_new((int64_t)(strlen(part->name) + strlen(family) + 2), 1);
  if (name) sprintf(name, "%s.%s", part->name, family);
  return name;
}
