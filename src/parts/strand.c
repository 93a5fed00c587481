/* Strand: a hair after Selle, Lentine and Fedkiw 2008, "A mass spring model for hair simulation" (ACM
 * Transactions on Graphics 27(3)). Springs between neighbours (stretch), particles two apart (bend) and three
 * apart (twist), and the altitude springs of the tetrahedra of every four consecutive particles.
 *
 * Tetrahedra of a straight line would be flat. So a straight strand has an extra particle for every segment,
 * at its middle, `offset` segment lengths off the axis: the extra particles wind about it, a sixth of a turn
 * to the right each. All tetrahedra are then congruent, and their shortest altitude is much shorter than the
 * others (with a quarter turn two would be equal, and rounding would decide which one acts). A curl
 * (particles on a helix about the axis) needs no extra particles. */
#include "parts/material.h"
#include "parts/part.h"

#include "core/memory.h"
#include "core/sine.h"
#include "core/status.h"
#include "model/force/altitude.h"
#include "model/vector3.h"

#include <math.h>
#include <stdio.h>

static const struct hk_option_row rows[] = {
    HOOKE_PART_POINT("from", "0,0,0", "where its axis begins"),
    HOOKE_PART_POINT("to", "0,-1,0", "where its axis ends"),
    HOOKE_OPTION(
        "segments", HOOKE_OPTION_WHOLE(1, INT32_MAX / 2 - 1), NULL,
        "pieces of the axis; it has one particle more, and if it is straight one in each piece besides",
        .required = 1, .example = "24"),
    HOOKE_OPTION(
        "offset", HOOKE_OPTION_UP_TO(NULL, 100), "0.5",
        "of a straight strand: distance of the extra particles from the axis, over the length of a segment"),
    HOOKE_OPTION("curl", HOOKE_OPTION_POSITIVE("m"), NULL,
                 "radius of the helix that the particles lie on, instead of extra ones; with turns"),
    HOOKE_OPTION("turns", HOOKE_OPTION_BETWEEN(-1e9, 1e9), NULL,
                 "of the helix about its axis: > 0 as a right-handed screw, < 0 as a left-handed one"),
    HOOKE_PART_MASS("equally"),
    HOOKE_PART_DENSITY("kg/m", "mass over length, instead of mass: every particle has that of its piece"),
    HOOKE_PART_PINNED("start end", "particles held still: numbers within the strand, or words"),
    HOOKE_PART_GRAVITY,
    HOOKE_PART_RIGID,
    HOOKE_PART_FAMILY("stretch", "springs between neighbours"),
    HOOKE_PART_FAMILY("bend", "springs two apart"),
    HOOKE_PART_FAMILY("twist", "springs three apart"),
    HOOKE_PART_FAMILY("altitude", "altitude springs of every four consecutive particles"),
};

static const struct hk_option_table table = {"strand", HOOKE_OPTION_ROWS(rows)};

/* A straight strand, or a curl if its radius is above 0. */
struct strand {
  double axis[3][3]; /* two transverse unit vectors and one along the axis, right-handed */
  double piece;      /* of the axis, per segment */
  double offset, radius, turns;
  int64_t segments;
};

/* The first transverse vector is as close as possible to the coordinate axis most nearly normal to the
 * strand. */
static void find_axes(const double span[3], double length, double axis[3][3]) {
  int least = 0;
  for (int a = 0; a < 3; a++) {
    axis[2][a] = span[a] / length;
    if (fabs(axis[2][a]) < fabs(axis[2][least])) least = a;
  }
  const double *d = axis[2], along = d[least];
  double square = 0.0;
  for (int a = 0; a < 3; a++) {
    axis[0][a] = (a == least ? 1.0 : 0.0) - along * d[a];
    square += axis[0][a] * axis[0][a];
  }
  for (int a = 0; a < 3; a++)
    axis[0][a] /= sqrt(square);
  hk_cross3(d, axis[0], axis[1]);
}

static int32_t read(const hooke_options *options, struct strand *strand) {
  const double *from = hooke_options_numbers(options, "from"), *to = hooke_options_numbers(options, "to");
  const double span[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const double length = hk_length3(span);
  const int curl = hooke_options_is_set(options, "curl"), turns = hooke_options_is_set(options, "turns");
  if (curl != turns) {
    return hk_fail(HOOKE_BAD_VALUE, curl ? "curl" : "turns",
                   "a curl has both curl (its radius) and turns, and %s is missing", curl ? "turns" : "curl");
  }
  if (curl && hooke_options_is_set(options, "offset")) {
    return hk_fail(HOOKE_BAD_VALUE, "offset",
                   "a curl has no extra particles; an offset is for a strand without curl and turns");
  }
  if (!(length > 0.0) || !isfinite(length)) {
    return hk_fail(HOOKE_BAD_VALUE, "to",
                   "the axis from `from` to `to` is %g m long; allowed: finite and > 0", length);
  }
  strand->segments = (int64_t)hooke_options_number(options, "segments");
  strand->piece = length / (double)strand->segments;
  strand->offset = curl ? 0.0 : hooke_options_number(options, "offset") * strand->piece;
  strand->radius = curl ? hooke_options_number(options, "curl") : 0.0;
  strand->turns = curl ? hooke_options_number(options, "turns") / (double)strand->segments : 0.0;
  find_axes(span, length, strand->axis);
  return HOOKE_OK;
}

static int is_curl(const struct strand *strand) {
  return strand->radius > 0.0;
}

/* Transverse position of particle k, and its number of segments along the axis. */
static double place(const struct strand *strand, int64_t k, double across[2]) {
  static const double s = 0.86602540378443864676; /* sin 60 degrees */
  static const double sixth[6][2] = {{1, 0}, {0.5, s}, {-0.5, s}, {-1, 0}, {-0.5, -s}, {0.5, -s}};
  if (is_curl(strand)) {
    double sine, cosine;
    hk_sine_of_turns((double)k * strand->turns, &sine, &cosine);
    across[0] = strand->radius * cosine;
    across[1] = strand->radius * sine;
    return (double)k;
  }
  for (int a = 0; a < 2; a++)
    across[a] = k % 2 ? strand->offset * sixth[k / 2 % 6][a] : 0.0;
  return 0.5 * (double)k;
}

/* Distance between particles k and k + apart. */
static double distance(const struct strand *strand, int64_t k, int64_t apart) {
  const double half = 0.5 * (double)apart * strand->piece;
  if (is_curl(strand)) {
    double sine, cosine;
    hk_sine_of_turns(0.5 * (double)apart * strand->turns, &sine, &cosine);
    const double chord = 2.0 * strand->radius * sine, along = 2.0 * half;
    return sqrt(chord * chord + along * along);
  }
  /* neighbouring extra particles are `offset` apart across the axis, the same as their distance from it */
  if (apart == 2 && k % 2 == 0) return half;
  return sqrt(half * half + strand->offset * strand->offset);
}

static int32_t add_particles(struct hk_part *part, const struct strand *strand, int64_t count) {
  const double *from = hooke_options_numbers(part->options, "from");
  const double *to = hooke_options_numbers(part->options, "to");
  const double n = (double)count;
  const struct hk_more more = {
      .particles = n,
      .of = {{&hk_force_springs, hk_part_if_family(part, "stretch", n) + hk_part_if_family(part, "bend", n) +
                                     hk_part_if_family(part, "twist", n)},
             {&hk_force_altitude, hk_part_if_family(part, "altitude", n)}}};
  double *position;
  char what[64];
  snprintf(what, sizeof what, "a strand of %lld segments", (long long)strand->segments);
  int32_t status = hk_part_new_positions(part, more, what, &position);
  if (status != HOOKE_OK) return hk_fail_within(status, "segments");
  for (int64_t k = 0; k < count; k++) {
    double across[2];
    const double fraction = place(strand, k, across) / (double)strand->segments;
    for (int a = 0; a < 3; a++) {
      const double at = k == count - 1 ? to[a] : from[a] + fraction * (to[a] - from[a]);
      position[3 * k + a] = at + (across[0] * strand->axis[0][a] + across[1] * strand->axis[1][a]);
    }
  }
  const double piece = is_curl(strand) ? distance(strand, 0, 1) : 0.5 * strand->piece;
  status = hk_part_add_particles(part, 1, (const int64_t[]){count, 1, 1}, piece, position);
  hk_free(position);
  return status;
}

/* Two springs apart of a straight strand differ by whether they are on its axis; all other springs of a
 * family are alike. */
static int32_t derive_springs(const struct hk_part *part, const struct strand *strand, const char *family,
                              int64_t apart, int64_t count) {
  if (apart != 2 || is_curl(strand)) return hk_part_derive_spring(part, family, 0, "kappa", "gamma");
  const int32_t status = hk_part_derive_spring(part, family, 0, "kappa on the axis", "gamma on the axis");
  if (status != HOOKE_OK || count < 2) return status;
  return hk_part_derive_spring(part, family, 1, "kappa of extra particles", "gamma of extra particles");
}

static int32_t add_family(struct hk_part *part, const struct strand *strand, const char *family,
                          int64_t apart) {
  const int64_t count = part->count > apart ? part->count - apart : 0;
  if (!hk_options_has_family(part->options, family)) return HOOKE_OK;
  int64_t *ends = hk_new(2 * count, sizeof *ends);
  double *rest_length = hk_new(count, sizeof *rest_length);
  int32_t status = ends && rest_length ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++) {
    ends[2 * k] = part->first + k;
    ends[2 * k + 1] = part->first + k + apart;
    rest_length[k] = distance(strand, k, apart);
  }
  if (status == HOOKE_OK) status = hk_part_add_pairs(part, family, count, ends, rest_length);
  hk_free(ends);
  hk_free(rest_length);
  if (status != HOOKE_OK || count == 0 || !hk_part_is_given(part, family, "damping_ratio")) return status;
  return derive_springs(part, strand, family, apart, count);
}

/* ---- altitude springs ---- */

/* Four consecutive particles, the first at k. Rest lengths are computed from positions about an axis through
 * the origin, so that they are the same to the bit wherever the strand is. */
static int32_t find_rest(const struct hk_part *part, const struct strand *strand, int64_t k, double scale,
                         struct hk_tetrahedron *tetrahedron) {
  double x[4][3];
  for (int j = 0; j < 4; j++) {
    x[j][2] = strand->piece * place(strand, k + j, x[j]);
    tetrahedron->particle[j] = (int32_t)(part->first + k + j);
  }
  return hk_tetrahedron_rest((const double(*)[3])x, scale, tetrahedron);
}

/* Damping ratio of the shortest altitude, with half of the inner mass moving on either side. */
static int32_t find_damping(const struct hk_part *part, struct hk_tetrahedron *t) {
  t->damping = hooke_options_number(part->options, "altitude.damping");
  if (!hk_part_is_given(part, "altitude", "damping_ratio")) return HOOKE_OK;
  double l = t->rest[0];
  for (int k = 1; k < HOOKE_ALTITUDES; k++)
    l = fmin(l, t->rest[k]);
  const double zeta = hooke_options_number(part->options, "altitude.damping_ratio");
  t->damping = zeta * hk_critical_damping(t->stiffness / l, 0.5 * part->inner_mass) * l;
  return hk_part_derive(part, "altitude", "kd", "N s", t->damping);
}

static int32_t refuse_in_time(const struct hk_part *part) {
  const char *const names[] = {"altitude.rest_scale", "altitude.stiffness_scale"};
  for (int k = 0; k < 2; k++)
    if (hk_options_has_family(part->options, names[k]))
      return hk_fail(
          HOOKE_UNSUITED, names[k],
          "altitude springs do not follow time; allowed: a number, or other families of the strand");
  return HOOKE_OK;
}

static int32_t add_altitude(struct hk_part *part, const struct strand *strand) {
  const int64_t count = part->count - 3;
  if (!hk_options_has_family(part->options, "altitude") || count <= 0) return HOOKE_OK;
  if (hk_part_check_damping(part, "altitude") != HOOKE_OK) return HOOKE_BAD_VALUE;
  if (refuse_in_time(part) != HOOKE_OK) return HOOKE_UNSUITED;
  const double scale = hooke_options_number(part->options, "altitude.rest_scale");
  struct hk_tetrahedron kind[2] = {
      {.stiffness = hooke_options_number(part->options, "altitude.stiffness") *
                    hooke_options_number(part->options, "altitude.stiffness_scale"),
       .pull_only = hooke_options_number(part->options, "altitude.compression") == 0.0}};
  char *name = hk_part_group_name(part, "altitude");
  int32_t status = name ? find_rest(part, strand, 0, scale, &kind[0]) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = find_damping(part, &kind[0]);
  kind[1] = kind[0];
  if (status == HOOKE_OK && !is_curl(strand)) status = find_rest(part, strand, 1, scale, &kind[1]);
  if (status == HOOKE_OK) status = hk_system_add_tetrahedra(part->system, name, count, part->first, kind);
  hk_free(name);
  return status == HOOKE_OK ? status : hk_fail_within(status, "altitude");
}

static int32_t build(struct hk_part *part) {
  struct strand strand;
  int32_t status = read(part->options, &strand);
  if (status != HOOKE_OK) return status;
  const int64_t count = is_curl(&strand) ? strand.segments + 1 : 2 * strand.segments + 1;
  status = add_particles(part, &strand, count);
  if (status == HOOKE_OK) status = add_family(part, &strand, "stretch", 1);
  if (status == HOOKE_OK) status = add_family(part, &strand, "bend", 2);
  if (status == HOOKE_OK) status = add_family(part, &strand, "twist", 3);
  return status == HOOKE_OK ? add_altitude(part, &strand) : status;
}

/* Changes the resolution of a curl, a line of points of its helix. A straight strand has none: the offset of
 * its extra particles depends on its resolution, so no other resolution gives the same strand. */
static int32_t cells(const hooke_options *options, int64_t cells[3]) {
  cells[0] = (int64_t)hooke_options_number(options, "segments");
  return hooke_options_is_set(options, "curl") ? 1 : 0;
}

static const struct hk_part_grid grid = {cells, hk_part_set_cells};

const struct hooke_part_kind hk_part_strand = {.table = &table,
                                               .build = build,
                                               .named = hk_part_named_end,
                                               .grid = &grid,
                                               .summary = "a hair, straight or curled, that keeps "
                                                          "its curl: springs between neighbours, "
                                                          "two and three apart, and across tetrahedra"};
