/* Curves: tensions of springs that are no straight line, by tables or by three coefficients. */
#pragma once

#include "core/table/option.h"

/* From `start` on the tension is c0 + c1 x + c2 x^2 + c3 x^3, x = e - origin, and its integral from 0 to e is
 * `stored` more than that from the origin. */
struct hk_curve_piece {
  double start, origin, c[4], stored;
};

/* The tension F(e), e the strain or the elongation [m] of a spring: a monotone cubic through a table, beyond
 * its ends lines of the slopes there; or k1 e + k2 e^2 + k3 e^3. Of springs that only pull it is max(0, F),
 * and 0 below e = 0. */
struct hk_curve {
  int32_t strain, pull_only;
  int64_t samples;    /* 0: three coefficients in `force` */
  double *at, *force; /* as given */
  double slope;       /* of F at 0 */
  double steepest;    /* the largest slope; infinity where there is none */
  int32_t falls;      /* 1: a table that falls somewhere */
  int64_t count;
  struct hk_curve_piece *piece; /* ascending; the first one begins nowhere, the last one has no end */
};

/* The members of the option `curve`. */
extern const struct hk_option_table hk_curve_options;

/* The curve of a group, NULL without the option. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_curve_from_options(const hooke_options *options, int32_t strain, int32_t pull_only,
                              struct hk_curve **curve);
/* The same law; NULL is copied as NULL. HOOKE_NO_MEMORY. */
int32_t hk_curve_copy(const struct hk_curve *from, int32_t pull_only, struct hk_curve **curve);
void hk_curve_destroy(struct hk_curve *curve);

/* Multiplies the forces, to the same bits as a law of their products. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_curve_scale(struct hk_curve **curve, double factor);

static inline const struct hk_curve_piece *hk_curve_at(const struct hk_curve *curve, double e) {
  int64_t low = 0, high = curve->count;
  while (high - low > 1) {
    const int64_t middle = low + (high - low) / 2;
    if (curve->piece[middle].start <= e)
      low = middle;
    else
      high = middle;
  }
  return &curve->piece[low];
}

/* Tension, its slope, and its integral from the origin. */
static inline double hk_piece_value(const struct hk_curve_piece *p, double e) {
  const double x = e - p->origin, *c = p->c;
  return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

static inline double hk_piece_slope(const struct hk_curve_piece *p, double e) {
  const double x = e - p->origin, *c = p->c;
  return c[1] + x * (2.0 * c[2] + x * (3.0 * c[3]));
}

static inline double hk_piece_integral(const struct hk_curve_piece *p, double e) {
  const double x = e - p->origin, *c = p->c;
  return x * (c[0] + x * (c[1] / 2.0 + x * (c[2] / 3.0 + x * (c[3] / 4.0))));
}

/* What a spring stores [J], the tension that it has by that [N], and how this grows with its length [N/m].
 * Whoever asks for one pays for no other. */
struct hk_law {
  double energy, tension, slope;
};
static inline struct hk_law hk_curve_law(const struct hk_curve *curve, double stretch, double rest_length) {
  const double unit = curve->strain ? rest_length : 1.0, e = curve->strain ? stretch / rest_length : stretch;
  const struct hk_curve_piece *piece = hk_curve_at(curve, e);
  return (struct hk_law){unit * (piece->stored + hk_piece_integral(piece, e)), hk_piece_value(piece, e),
                         hk_piece_slope(piece, e) / unit};
}

/* The larger of the largest slope [N/m] and the largest tension over length at any length; infinity where
 * there is none. */
double hk_curve_stiffest(const struct hk_curve *curve, double rest_length);

/* Adds everything to a check value. */
void hk_curve_check(const struct hk_curve *curve, uint32_t *value);
