/* A system on a page: springs as lines between particles, as many as a page can hold. */
#ifndef HOOKE_IO_PAGE_PICTURE_H
#define HOOKE_IO_PAGE_PICTURE_H

#include "hooke/system.h"
#include "io/file/text.h"

struct hk_picture {
  const hooke_system *system;
  int64_t spring_count, drawn_count;
  int64_t *ends;       /* 2 spring_count */
  char *drawn;         /* of each spring */
  char *shut;          /* of each spring, 1: it is not among those to take evenly; the caller's to mark */
  int64_t shown_count; /* particles told of */
  int64_t *place;      /* of each particle among them, from 1; 0: none */
};

/* Nothing is drawn yet. On failure, too, release it. HOOKE_NO_MEMORY. */
int32_t hk_picture_create(const hooke_system *system, struct hk_picture *picture);
void hk_picture_release(struct hk_picture *picture);

/* Draws a spring. */
void hk_picture_take(struct hk_picture *picture, int64_t spring);
/* Draws of the springs from `first` up to `end` those that are left and not shut, evenly as many as there is
 * room for. */
void hk_picture_take_evenly(struct hk_picture *picture, int64_t first, int64_t end, int64_t room);
/* Tells of a particle, whether it has springs that are drawn or not. */
void hk_picture_show(struct hk_picture *picture, int64_t particle);

/* "spring" and "ends": the springs that are drawn by number, and the places of their ends. */
void hk_picture_add_springs(struct hk_text *data, struct hk_picture *picture);
/* The particles told of, in the order of their places; the caller frees it. NULL: no memory. */
int64_t *hk_picture_list(const struct hk_picture *picture);
/* "particle" and "held": the number of each in that list, and whether it is pinned or driven. */
void hk_picture_add_particles(struct hk_text *data, const struct hk_picture *picture, const int64_t *list);

/* Vectors as rows of x y z under `key`, those at the places of a list, rounded to whole multiples of 1/scale;
 * none of NULL. */
void hk_picture_add_vectors(struct hk_text *data, const char *key, const double *vectors, const int64_t *list,
                            int64_t count, double scale);
/* A scale that leaves six digits of the extent of positions; infinity: none is to be rounded. */
double hk_picture_scale(const double *position, const int64_t *list, int64_t count);

#endif
