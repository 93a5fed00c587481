/* Parts: the table of kinds, and what their builders share. A new kind is one file and one row in part.c. */
#ifndef HOOKE_BUILD_PART_H
#define HOOKE_BUILD_PART_H

#include "core/option.h"
#include "hooke/build.h"
#include "model/part_record.h"

/* A part under construction. */
struct hooke_part {
  hooke_system *system;
  const char *name;
  const hooke_options *options;
  int64_t first, count;
};

struct hooke_part_kind {
  const struct hooke_option_table *table;
  int32_t (*build)(struct hooke_part *part);
  /* The k-th particle (0, 1, ...) that a word of `pinned` stands for; -1 past the last. */
  int64_t (*named)(const struct hooke_part *part, const char *word, int64_t k);
  const struct hooke_part_grid *grid; /* NULL: its particles are no grid */
};

extern const struct hooke_part_kind hooke_part_rope;
extern const struct hooke_part_kind hooke_part_cloth;

/* Rows that kinds have in common: a point [m], the total mass, held particles, a family of springs. */
#define HOOKE_PART_POINT(key, text)                                                                          \
  {                                                                                                          \
    .name = (key), .type = HOOKE_OPTION_NUMBERS, .unit = "m", .min_count = 3, .max_count = 3, .required = 1, \
    .doc = (text)                                                                                            \
  }
#define HOOKE_PART_MASS                                                                                      \
  {                                                                                                          \
    .name = "mass", .type = HOOKE_OPTION_NUMBER, .unit = "kg", .low = 0, .above_low = 1, .high = 1e300,      \
    .required = 1, .doc = "total mass, shared equally"                                                       \
  }
#define HOOKE_PART_PINNED(names, text)                                                                       \
  {                                                                                                          \
    .name = "pinned", .type = HOOKE_OPTION_NUMBERS, .low = 0, .high = INT32_MAX, .whole = 1,                 \
    .words = (names), .word_lists = 1, .doc = (text)                                                         \
  }
#define HOOKE_PART_FAMILY(key, text)                                                                         \
  { .name = (key), .type = HOOKE_OPTION_FAMILY, .family = &hooke_part_family, .doc = (text) }

/* Options of a family of springs, nested in the table of every kind. */
extern const struct hooke_option_table hooke_part_family;

/* Springs of one family and direction between the points of a grid: row by row, spring (r, c) joins r*stride
 * + c + low and r*stride + c + high, low < high. One rest length serves them all, so that it is equal to the
 * bit. */
struct hooke_part_strip {
  int64_t rows, columns, low, high;
  double rest_length;
};

/* Checks `count` before anything is allocated and gives an array of 3 count coordinates, to be freed. The
 * format says what is too large: "a cloth of 3 x 4 particles". */
int32_t hooke_part_new_positions(struct hooke_part *part, int64_t count, double **position,
                                 const char *format, ...) __attribute__((format(printf, 4, 5)));

/* Adds the particles; the option `mass` is their total. */
int32_t hooke_part_add_particles(struct hooke_part *part, const double *position);

/* Adds the springs of a family, strip after strip, as one group; nothing if the family is not named. */
int32_t hooke_part_add_family(struct hooke_part *part, const char *family, int64_t stride,
                              int32_t strip_count, const struct hooke_part_strip *strip);

double hooke_part_length(const double *vector);

#endif
