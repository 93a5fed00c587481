/* Parts: the table of kinds, and helpers of their builders. A new kind is one file and one row in part.c. */
#ifndef HOOKE_PARTS_PART_H
#define HOOKE_PARTS_PART_H

#include "core/table/option.h"
#include "hooke/parts.h"
#include "model/derived.h"
#include "model/part_record.h"
#include "model/force/force.h"
#include "model/size_limit.h"

/* A part under construction. */
struct hk_part {
  hooke_system *system;
  const char *name;
  const hooke_options *options;
  int64_t first, count;
  double inner_mass; /* of a particle on no edge [kg], once particles are added; 0: they differ */
};

struct hooke_part_kind {
  const struct hk_option_table *table;
  int32_t (*build)(struct hk_part *part);
  /* The k-th particle (0, 1, ...) that a word of `pinned` denotes; -1 past the last. */
  int64_t (*named)(const struct hk_part *part, const char *word, int64_t k);
  const struct hk_part_grid *grid; /* NULL: its particles form no grid */
  const char *summary;             /* one line */
};

/* A grid of the option `size`, in particles. */
extern const struct hk_part_grid hk_part_sized;

extern const struct hooke_part_kind hk_part_rope;
extern const struct hooke_part_kind hk_part_cloth;
extern const struct hooke_part_kind hk_part_lattice;
extern const struct hooke_part_kind hk_part_mesh;
extern const struct hooke_part_kind hk_part_strand;

/* Options of kind number `k`, NULL past the last. */
const struct hk_option_table *hk_part_table(int64_t k);
/* Options of a kind by its name; NULL, with HOOKE_BAD_VALUE recorded, if there is none of this name or no
 * name. */
const struct hk_option_table *hk_part_find(const char *name);

/* Rows shared by kinds: a point [m], the corner where a grid begins [m], the total mass or the density,
 * bending stiffness, constrained particles, whether it is one rigid body, a family of springs. */
#define HOOKE_PART_POINT(key, such_as, text)                                                                 \
  HOOKE_OPTION(key, HOOKE_OPTION_VECTOR("m"), NULL, text, .required = 1, .example = (such_as))
#define HOOKE_PART_ORIGIN HOOKE_OPTION("origin", HOOKE_OPTION_VECTOR("m"), "0,0,0", "corner where it begins")
#define HOOKE_PART_MASS(shared)                                                                              \
  HOOKE_OPTION("mass", HOOKE_OPTION_POSITIVE("kg"), NULL, "total mass, shared " shared "; or density",       \
               .example = "1")
#define HOOKE_PART_DENSITY(of, text) HOOKE_OPTION("density", HOOKE_OPTION_POSITIVE(of), NULL, text)
#define HOOKE_PART_BENDING(of, text) HOOKE_OPTION("bending", HOOKE_OPTION_NOT_NEGATIVE(of), "0", text)
#define HOOKE_PART_PINNED(names, text)                                                                       \
  HOOKE_OPTION("pinned", HOOKE_OPTION_WHOLES(0, INT32_MAX, 0, 0), NULL, text, .words = (names),              \
               .word_lists = 1)
#define HOOKE_PART_RIGID                                                                                     \
  HOOKE_OPTION("rigid", .type = HOOKE_OPTION_FLAG, "false",                                                  \
               "true: it moves as one rigid body, and springs inside it are dropped")
#define HOOKE_PART_FAMILY(key, text)                                                                         \
  HOOKE_OPTION(key, .type = HOOKE_OPTION_FAMILY, NULL, text, .family = &hk_part_family)

/* Options of a family of springs, nested in the table of every kind. */
extern const struct hk_option_table hk_part_family;

/* Springs of one family and direction between the points of a grid: row by row, spring (r, c) joins r*stride
 * + c + low and r*stride + c + high, low < high. All have one rest length, equal to the bit. */
enum hk_part_direction {
  HOOKE_PART_ALONG,
  HOOKE_PART_U,
  HOOKE_PART_V,
  HOOKE_PART_DIAGONAL,
  HOOKE_PART_OTHER_DIAGONAL,
  HOOKE_PART_LATTICE /* and the following ones: the directions of a lattice, in order */
};
struct hk_part_strip {
  int64_t rows, columns, low, high;
  double rest_length;
  enum hk_part_direction direction;
};

/* Lines of a grid as parallel beams: triple (r, c) joins particles at = r*stride + c, at + step and at + 2
 * step. Those in the first and the last row (or column) represent half the width of the others. */
enum hk_part_beam_order { HOOKE_BEAMS_ALONE, HOOKE_BEAMS_ROWS, HOOKE_BEAMS_COLUMNS };
struct hk_part_beams {
  int64_t rows, columns, step;
  double coefficient; /* [N/m] */
  enum hk_part_direction direction;
  enum hk_part_beam_order side_by_side;
};

/* Checks that the part fits before anything is allocated, and returns an array of 3 coordinates for each
 * particle, which the caller frees. The format describes the part in messages: "a cloth of 3 x 4 particles".
 */
int32_t hk_part_new_positions(struct hk_part *part, struct hk_more more, double **position,
                              const char *format, ...) __attribute__((format(printf, 4, 5)));

/* `count` if the part has springs of the family, else 0. */
double hk_part_if_family(const struct hk_part *part, const char *family, double count);

/* Adds rows x columns particles; the option `mass` is their total, or `density` refers to the `piece` that an
 * inner one represents: its length (one row) or area. */
int32_t hk_part_add_particles(struct hk_part *part, int64_t rows, int64_t columns, double piece,
                              const double *position);

/* Adds the springs of a family, strip after strip, as one group; nothing if the family is not named. */
int32_t hk_part_add_family(struct hk_part *part, const char *family, int64_t stride, int32_t strip_count,
                           const struct hk_part_strip *strip);

/* The same from pairs of particles and a rest length for each. */
int32_t hk_part_add_pairs(struct hk_part *part, const char *family, int64_t count, const int64_t *ends,
                          const double *rest_length);

/* Adds bending along the beams, one after the other, as one group; nothing if the option `bending` is 0. */
int32_t hk_part_add_bending(struct hk_part *part, int64_t stride, int32_t count,
                            const struct hk_part_beams *beams);

/* "<part>.<family>", which the caller frees; NULL without memory. */
char *hk_part_group_name(const struct hk_part *part, const char *family);

double hk_part_length(const double *vector);
/* HOOKE_BAD_VALUE for two edges in one line, or three in one plane. */
int32_t hk_part_check_edges(const double *edges, int32_t count);

#endif
