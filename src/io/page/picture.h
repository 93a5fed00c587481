/* A system on a page: springs as lines between particles, as many as a page can hold. */
#pragma once

#include "hooke/system.h"
#include "io/file/text.h"

/* Springs of a picture, and of a film, at most; particles where no group of springs fits. */
enum { HOOKE_PICTURE_SPRINGS = 9000, HOOKE_FILM_SPRINGS = 6000, HOOKE_PICTURE_DOTS = 1500 };

struct hk_picture {
  const hooke_system *system;
  int64_t spring_count, drawn_count;
  int64_t *ends;       /* 2 spring_count */
  char *drawn;         /* of each spring */
  char *shut;          /* by spring, 1: excluded; the caller's to mark */
  int64_t shown_count; /* listed particles */
  int64_t *list;       /* of each, its number */
  int64_t *slot;       /* by particle: its index in this list, from 1; 0: none */
};

/* An empty picture. Must be released also on failure. HOOKE_NO_MEMORY. */
int32_t hk_picture_create(const hooke_system *system, struct hk_picture *picture);
void hk_picture_release(struct hk_picture *picture);

/* Draws a spring. */
void hk_picture_take(struct hk_picture *picture, int64_t spring);
/* Draws the groups of springs, without those that are excluded, of which each fits whole: every k-th spring
 * of a net is no net. Returns whether any is drawn. */
int32_t hk_picture_take_families(struct hk_picture *picture, int64_t most);
/* Lists every so many-th particle. */
void hk_picture_show_evenly(struct hk_picture *picture);
/* Lists a particle, whether any of its springs are drawn or not. */
void hk_picture_show(struct hk_picture *picture, int64_t particle);

/* Adds "springs" and "particles": the counts that there are, without springs that are excluded; "spring" and
 * "ends": numbers of the springs drawn, and indices of their ends, which are listed; "particle" and "held":
 * the number of each in the list, and whether it is pinned or driven. */
void hk_picture_add(struct hk_text *data, struct hk_picture *picture);
/* Vectors as rows of x y z under `key`, those at the indices of a list (NULL: as they are), rounded to six
 * digits of their extent; none if NULL. */
void hk_picture_add_vectors(struct hk_text *data, const char *key, const double *vectors, const int64_t *list,
                            int64_t count);
/* The largest along an axis. */
double hk_picture_extent(const double *vectors, const int64_t *list, int64_t count);
