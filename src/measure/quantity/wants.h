/* What is wanted: bounds of errors, the option "want". A length is one of all free particles; a list,
 * "tip=2mm,line:max.tension=1%,energy=0.1J,1cm", has watched quantities, particles (the distance from where
 * they should be) and lengths. The error of a run is the largest of error over bound, times `most`. */
#pragma once

#include "measure/claims.h"
#include "measure/quantity/watched.h"

enum { HOOKE_WANTS = 16, HOOKE_WANT_NAME = 96 };

/* For a row of options. */
#define HOOKE_OPTION_WANT HOOKE_OPTION_POSITIVE("m"), .wants = 1
#define HOOKE_WANT_FORMS                                                                                     \
  "; or a list, such as tip=2mm,line:max.tension=1%,energy=0.1J, of particles, of what --watch takes, and "  \
  "of lengths, with % of its largest absolute value over the run"

struct hk_want {
  char name[HOOKE_WANT_NAME]; /* "particles": all free ones */
  int32_t width;              /* numbers that it is the distance of: 3, 1, or 0: all free particles */
  int64_t at[3];              /* in the list of watched quantities */
  int32_t relative;           /* 1: to the largest absolute value, of a particle way from its start */
  double bound;
};

struct hk_wants {
  struct hk_watched_list *list; /* NULL: a length alone */
  int32_t count;                /* 0: nothing is wanted */
  int32_t whole;                /* 1: it has a period, which only a whole run has */
  struct hk_want want[HOOKE_WANTS];
  double most;   /* the length [m], or 1 of a list; NaN: nothing is wanted */
  double length; /* of one unit of `most` [m], for tolerances and displacements: 1, or that of a list */
};

/* Reads the option "want", and adds what it names to a list, which has to outlive it. HOOKE_BAD_VALUE. */
int32_t hk_wants_read(struct hk_wants *wants, struct hk_watched_list *list, const hooke_options *options);

/* Makes a length that of each quantity of a list, which are all in m. HOOKE_BAD_VALUE, for "watch". */
int32_t hk_wants_of_each(struct hk_wants *wants, struct hk_watched_list *list, const char *text);

/* 1 if it is a list, so that errors are fractions of what is wanted. */
static inline int32_t hk_wants_is_list(const struct hk_wants *wants) {
  return wants && wants->list;
}
/* After a number: " m", "" of a problem, or what an error is in. */
const char *hk_wants_unit(const struct hk_wants *wants, const hooke_system *system);
/* 1 if it is of particles, none of which is farther off than the farthest. */
int32_t hk_want_is_place(const struct hk_wants *wants, int32_t number);
/* "m", "N", ... */
const char *hk_want_unit(const struct hk_wants *wants, int32_t number);

/* Bounds, the relative ones by the largest values over the first `frames` frames of a run. */
void hk_wants_bounds(const struct hk_wants *wants, const struct hk_watched_series *series, int64_t frames,
                     double bound[HOOKE_WANTS]);
/* Refuses a part of a largest value over `frames` frames of which the first `known` have less than a tenth.
 */
int32_t hk_wants_require_values(const struct hk_wants *wants, const struct hk_watched_series *series,
                                int64_t frames, int64_t known);
/* Raises `most` to the distances of frame i of a run from frame j of another one: `far` of all free
 * particles, then those of the wants; of periods that of the runs, where these are their last frames. NaN
 * where unknown. */
void hk_wants_spread(const struct hk_wants *wants, const struct hk_watched_series *a, int64_t i,
                     const struct hk_watched_series *b, int64_t j, double far, double most[1 + HOOKE_WANTS]);
/* What was found of one of the wants, a row of a table. */
struct hk_want_found {
  const char *name, *unit;
  double wanted, error, met; /* the error NaN where it is not known, and `met` */
};
/* Finds the errors of a run over the first `frames` frames of its series `a`, against `b`, by whose
 * `recorded` frames relative bounds are; `far` is the largest distance of a particle over these. `own` is
 * added to them: in a list as a fraction of what is wanted. */
void hk_wants_find(const struct hk_wants *wants, const struct hk_watched_series *a,
                   const struct hk_watched_series *b, int64_t recorded, int64_t frames, double far,
                   double own, struct hk_want_found found[HOOKE_WANTS]);
/* The claims "error" of a list, with `where` after the errors. */
void hk_wants_claim(const struct hk_wants *wants, const struct hk_want_found found[HOOKE_WANTS],
                    enum hk_claim_of of, const char *by, const char *where, struct hk_claims *claims);

enum { HOOKE_WANT_COLUMNS = 5 };
extern const struct hk_column hk_want_columns[HOOKE_WANT_COLUMNS];
#define HOOKE_WANTS_TABLE                                                                                    \
  .name = "wants", .doc = "what is wanted, one by one, and its error", .columns = hk_want_columns,           \
  .column_count = HOOKE_WANT_COLUMNS

/* Makes those of periods NaN: where the last frames are not among those that were compared. */
void hk_wants_forget_periods(const struct hk_wants *wants, double most[1 + HOOKE_WANTS]);
/* By how much the value itself is not known: of a period, for interpolation between the frames. */
double hk_want_doubt(const struct hk_wants *wants, int32_t number, const struct hk_watched_series *series);
/* The largest difference over the wants, at a frame of both. NaN if one is unknown. */
double hk_wants_error(const struct hk_wants *wants, const double bound[HOOKE_WANTS],
                      const struct hk_watched_series *a, const struct hk_watched_series *b, int64_t frame,
                      double far);
