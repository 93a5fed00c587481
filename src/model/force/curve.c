#include "model/force/curve.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/check_value.h"
#include "model/course.h"

#include <math.h>
#include <string.h>

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("strain", HOOKE_OPTION_COUNTED(2, 0), NULL, "ascending strains of a table: the strain law"),
    HOOKE_OPTION("elongation", HOOKE_OPTION_COUNTED(2, 0), NULL,
                 "ascending elongations of a table: the length law", .unit = "m"),
    HOOKE_OPTION("force", HOOKE_OPTION_COUNTED(2, 0), NULL,
                 "tension at each of them, positive where the spring pulls", .unit = "N"),
    HOOKE_OPTION("falling", .type = HOOKE_OPTION_FLAG, "false", "true: the table may fall"),
    HOOKE_OPTION(
        "coefficients", HOOKE_OPTION_COUNTED(3, 3), NULL,
        "k1, k2, k3 of k1 e + k2 e^2 + k3 e^3, e the strain or, with the length law, the elongation"),
};

const struct hk_option_table hk_curve_options = {"curve", HOOKE_OPTION_ROWS(rows)};

/* ---- values ---- */

static double end_of(const struct hk_curve *curve, int64_t k) {
  return k + 1 < curve->count ? curve->piece[k + 1].start : (double)INFINITY;
}

/* Between samples F/r is largest at one of them, or where it equals the slope; towards length 0, or the rest
 * length of springs that only pull, it may have no bound. */
double hk_curve_stiffest(const struct hk_curve *curve, double rest_length) {
  const double unit = curve->strain ? rest_length : 1.0, nearest = curve->pull_only ? rest_length : 0.0;
  const double tension = hk_curve_law(curve, nearest - rest_length, rest_length).tension;
  double most = curve->steepest / unit;
  if (tension > 0.0) most = fmax(most, tension / nearest);
  for (int64_t k = 0; k < curve->samples; k++) {
    const double r = rest_length + unit * curve->at[k];
    if (r > nearest) most = fmax(most, curve->force[k] / r);
  }
  return most;
}

void hk_curve_check(const struct hk_curve *curve, uint32_t *value) {
  hk_check_whole(value, curve->strain);
  hk_check_whole(value, curve->samples);
  hk_check_add(value, curve->at, curve->samples, sizeof(double));
  hk_check_add(value, curve->force, curve->samples > 0 ? curve->samples : 3, sizeof(double));
}

/* ---- pieces ---- */

static struct hk_curve_piece *add_piece(struct hk_curve *curve, double start, double origin,
                                        const double c[4]) {
  struct hk_curve_piece *piece = &curve->piece[curve->count++];
  *piece = (struct hk_curve_piece){.start = start, .origin = origin};
  memcpy(piece->c, c, sizeof piece->c);
  return piece;
}

static void add_pieces(struct hk_curve *curve, const double *slope) {
  const int64_t last = curve->samples - 1;
  const double *e = curve->at, *f = curve->force;
  if (curve->samples == 0) {
    add_piece(curve, -INFINITY, 0.0, (const double[4]){0.0, f[0], f[1], f[2]});
    return;
  }
  add_piece(curve, -INFINITY, e[0], (const double[4]){f[0], slope[0]});
  for (int64_t k = 0; k < last; k++) {
    const double h = e[k + 1] - e[k], s = (f[k + 1] - f[k]) / h, m0 = slope[k], m1 = slope[k + 1];
    add_piece(curve, e[k], e[k],
              (const double[4]){f[k], m0, (3.0 * s - 2.0 * m0 - m1) / h, (m0 + m1 - 2.0 * s) / h / h});
  }
  add_piece(curve, e[last], e[last], (const double[4]){f[last], slope[last]});
}

/* Slopes are those of the next piece at an end. */
static void find_slopes(struct hk_curve *curve) {
  curve->slope = hk_piece_slope(hk_curve_at(curve, 0.0), 0.0);
  curve->steepest = -INFINITY;
  for (int64_t k = 0; k < curve->count; k++) {
    const struct hk_curve_piece *p = &curve->piece[k];
    const double end = end_of(curve, k), top = p->origin - p->c[2] / (3.0 * p->c[3]);
    const int unbounded = isinf(end) && (p->c[2] != 0.0 || p->c[3] != 0.0);
    const double here = hk_piece_slope(p, isfinite(p->start) ? p->start : p->origin);
    curve->steepest = fmax(curve->steepest, unbounded ? (double)INFINITY : here);
    if (top > p->start && top < end) curve->steepest = fmax(curve->steepest, hk_piece_slope(p, top));
  }
  for (int64_t k = 1; k < curve->samples; k++)
    curve->falls |= curve->force[k] < curve->force[k - 1];
}

/* The root of k1 + k2 e + k3 e^2 next above `from`; infinity: there is none. */
static double next_root_of_coefficients(const double k[3], double from) {
  const double q = -0.5 * (k[1] + copysign(sqrt(k[1] * k[1] - 4.0 * k[2] * k[0]), k[1]));
  const double root[2] = {q / k[2], k[0] / q};
  double next = INFINITY;
  for (int j = 0; j < 2; j++)
    if (root[j] > from && root[j] < next) next = root[j];
  return next;
}

/* Of a piece of a table, which is monotone, between `from` and `to`. */
static double next_root_of_piece(const struct hk_curve_piece *p, double from, double to) {
  if (isinf(to)) to = fmax(from, p->origin - 2.0 * p->c[0] / p->c[1]);
  if (!(hk_piece_value(p, from) * hk_piece_value(p, to) < 0.0)) return INFINITY;
  const int rises = hk_piece_value(p, to) > 0.0;
  for (double middle; (middle = from + 0.5 * (to - from)) > from && middle < to;) {
    if ((hk_piece_value(p, middle) > 0.0) == rises)
      to = middle;
    else
      from = middle;
  }
  return to;
}

/* Leaves 0 of what is below e = 0 or negative. HOOKE_NO_MEMORY. */
static int32_t clip(struct hk_curve *curve) {
  static const double zero[4];
  const struct hk_curve raw = *curve;
  curve->count = 0;
  curve->piece = hk_new(3 * raw.count + 1, sizeof *curve->piece);
  if (curve->piece) add_piece(curve, -INFINITY, 0.0, zero);
  for (int64_t k = 0; k < raw.count && curve->piece; k++) {
    const struct hk_curve_piece *p = &raw.piece[k];
    double from = fmax(p->start, 0.0), end = end_of(&raw, k);
    while (from < end) {
      const double root =
          raw.samples == 0 ? next_root_of_coefficients(raw.force, from) : next_root_of_piece(p, from, end);
      const double to = fmin(root, end), inside = isinf(to) ? 2.0 * from + 1.0 : from + 0.5 * (to - from);
      add_piece(curve, from, p->origin, hk_piece_value(p, inside) > 0.0 ? p->c : zero);
      from = to;
    }
  }
  hk_free(raw.piece);
  return curve->piece ? HOOKE_OK : HOOKE_NO_MEMORY;
}

/* From one piece to the next, from 0 on either way, so that nothing cancels. */
static void integrate(struct hk_curve *curve) {
  struct hk_curve_piece *const first = curve->piece, *const last = first + curve->count - 1;
  struct hk_curve_piece *const middle = first + (hk_curve_at(curve, 0.0) - first);
  middle->stored = -hk_piece_integral(middle, 0.0);
  for (struct hk_curve_piece *p = middle + 1; p <= last; p++)
    p->stored = p[-1].stored + hk_piece_integral(p - 1, p->start) - hk_piece_integral(p, p->start);
  for (struct hk_curve_piece *p = middle - 1; p >= first; p--)
    p->stored = p[1].stored + hk_piece_integral(p + 1, p[1].start) - hk_piece_integral(p, p[1].start);
}

static int32_t check_pieces(const struct hk_curve *curve) {
  for (int64_t k = 0; k < curve->count; k++) {
    const struct hk_curve_piece *p = &curve->piece[k];
    if (isfinite(p->c[1] + p->c[2] + p->c[3] + p->stored)) continue;
    return hk_fail(HOOKE_BAD_VALUE, curve->samples > 0 ? "curve.force" : "curve.coefficients",
                   "has slopes that are not finite");
  }
  return HOOKE_OK;
}

static int32_t fill(struct hk_curve *curve, const double *at, const double *force) {
  const int64_t samples = curve->samples, forces = samples > 0 ? samples : 3;
  curve->at = hk_new(samples, sizeof(double));
  curve->force = hk_new(forces, sizeof(double));
  curve->piece = hk_new(samples + 1, sizeof *curve->piece);
  double *slope = hk_new(samples, sizeof(double));
  int32_t status = curve->at && curve->force && curve->piece && slope ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    if (samples > 0) memcpy(curve->at, at, (size_t)samples * sizeof(double));
    memcpy(curve->force, force, (size_t)forces * sizeof(double));
    hk_monotone_slopes(samples, 1, at, force, slope);
    add_pieces(curve, slope);
    find_slopes(curve);
    if (curve->pull_only) status = clip(curve);
  }
  hk_free(slope);
  if (status == HOOKE_OK) integrate(curve);
  return status == HOOKE_OK ? check_pieces(curve) : status;
}

static int32_t create(struct hk_curve law, const double *at, const double *force, struct hk_curve **curve) {
  struct hk_curve *made = *curve = hk_new(1, sizeof *made);
  if (made == NULL) return HOOKE_NO_MEMORY;
  *made = law;
  const int32_t status = fill(made, at, force);
  if (status == HOOKE_OK) return status;
  hk_curve_destroy(made);
  *curve = NULL;
  return status;
}

int32_t hk_curve_copy(const struct hk_curve *from, int32_t pull_only, struct hk_curve **curve) {
  *curve = NULL;
  if (from == NULL) return HOOKE_OK;
  const struct hk_curve law = {.strain = from->strain, .pull_only = pull_only, .samples = from->samples};
  return create(law, from->at, from->force, curve);
}

void hk_curve_destroy(struct hk_curve *curve) {
  if (curve == NULL) return;
  hk_free(curve->at);
  hk_free(curve->force);
  hk_free(curve->piece);
  hk_free(curve);
}

int32_t hk_curve_scale(struct hk_curve **curve, double factor) {
  struct hk_curve *const from = *curve;
  for (int64_t k = 0; k < (from->samples > 0 ? from->samples : 3); k++)
    from->force[k] *= factor;
  const int32_t status = hk_curve_copy(from, from->pull_only, curve);
  if (status == HOOKE_OK)
    hk_curve_destroy(from);
  else
    *curve = from;
  return status;
}

/* ---- from options ---- */

static int32_t check_table(const hooke_options *options, const char *key, int64_t samples, const double *at,
                           const double *force) {
  const int64_t forces = hooke_options_number_count(options, "curve.force");
  const int falling = hooke_options_number(options, "curve.falling") != 0.0;
  if (forces != samples)
    return hk_fail(HOOKE_BAD_VALUE, "curve.force",
                   "%lld forces given; allowed: %lld, one for each number in %s", (long long)forces,
                   (long long)samples, key);
  for (int64_t k = 1; k < forces; k++) {
    const int ascends = at[k] > at[k - 1];
    if (ascends && (falling || force[k] >= force[k - 1])) continue;
    hk_fail(
        HOOKE_BAD_VALUE, NULL,
        ascends
            ? "%g after %g is not allowed; a table that falls has negative stiffness, and says \"falling\": true"
            : "%g after %g is not allowed; a table ascends",
        ascends ? force[k] : at[k], ascends ? force[k - 1] : at[k - 1]);
    return hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld]", ascends ? "curve.force" : key, (long long)k);
  }
  return HOOKE_OK;
}

int32_t hk_curve_from_options(const hooke_options *options, int32_t strain, int32_t pull_only,
                              struct hk_curve **curve) {
  static const char *const name[] = {"curve.elongation", "curve.strain", "curve.coefficients"};
  const char *found = NULL;
  int given = 0;
  *curve = NULL;
  if (!hk_options_has_family(options, "curve")) return HOOKE_OK;
  for (int k = 0; k < 3; k++)
    if (hooke_options_is_set(options, name[k])) found = name[k], given++;
  if (given != 1)
    return hk_fail(HOOKE_BAD_VALUE, "curve",
                   "has %d of strain, elongation and coefficients; allowed: one of them", given);
  const int table = found != name[2];
  if (table && found != name[strain])
    return hk_fail(HOOKE_BAD_VALUE, found, "belongs to the law \"%s\"", strain ? "length" : "strain");
  for (int k = 0; k < 2; k++)
    if (!table && hooke_options_is_set(options, k ? "curve.falling" : "curve.force"))
      return hk_fail(HOOKE_BAD_VALUE, k ? "curve.falling" : "curve.force", "belongs to a table");
  const double *at = hooke_options_numbers(options, found),
               *force = table ? hooke_options_numbers(options, "curve.force") : at;
  struct hk_curve law = {.strain = strain, .pull_only = pull_only};
  if (table) law.samples = hooke_options_number_count(options, found);
  const int32_t status = table ? check_table(options, found, law.samples, at, force) : HOOKE_OK;
  return status == HOOKE_OK ? create(law, at, force, curve) : status;
}
