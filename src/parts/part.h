/* Parts: the table of kinds, and helpers of their builders. A new kind is one file and one row in part.c. */
#pragma once

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
  /* The k-th particle (0, 1, ...) that a word of `pinned` denotes; -1 past the last. NULL: there are none. */
  int64_t (*named)(const struct hk_part *part, const char *word, int64_t k);
  const struct hk_part_grid *grid; /* NULL: its particles form no grid */
  const char *summary;             /* one line */
};

/* A grid of the option `size`, in particles, or a line of the option `segments`. */
extern const struct hk_part_grid hk_part_sized;
int32_t hk_part_set_cells(hooke_options *options, const int64_t cells[3]);

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
#define HOOKE_PART_GRAVITY                                                                                   \
  HOOKE_OPTION("gravity_factor", HOOKE_OPTION_COUNTED(1, 0), NULL,                                           \
               "factor on gravity, weight less buoyancy over weight: one number, or one a particle")
#define HOOKE_PART_CLAMPED(names)                                                                            \
  HOOKE_OPTION("clamped", HOOKE_OPTION_WHOLES(0, INT32_MAX, 0, -1), NULL,                                    \
               "ends held still in place and in direction; needs bending", .words = (names),                 \
               .word_lists = 1)
#define HOOKE_PART_RIGID                                                                                     \
  HOOKE_OPTION("rigid", .type = HOOKE_OPTION_FLAG, "false",                                                  \
               "true: it moves as one rigid body, and springs inside it are dropped")
#define HOOKE_PART_FAMILY(key, text)                                                                         \
  HOOKE_OPTION(key, .type = HOOKE_OPTION_FAMILY, NULL, text, .family = &hk_part_family)

/* Options of a family of springs, nested in the table of every kind. */
extern const struct hk_option_table hk_part_family;

/* Point (x, y, z), which is number `k` of those of `count` along each axis, in a grid of `size`. */
static inline int64_t hk_part_point(const int64_t count[3], int64_t k, const int64_t size[3], int64_t at[3]) {
  at[0] = k % count[0];
  at[1] = k / count[0] % count[1];
  at[2] = k / count[0] / count[1];
  return (at[2] * size[1] + at[1]) * size[0] + at[0];
}

/* Checks that the part fits before anything is allocated, and returns an array of 3 coordinates for each
 * particle, which the caller frees. `what` is the part in messages: "a cloth of 3 x 4 particles". */
int32_t hk_part_new_positions(struct hk_part *part, struct hk_more more, const char *what, double **position);

/* `count` if the part has springs of the family, else 0. */
double hk_part_if_family(const struct hk_part *part, const char *family, double count);

/* Adds the particles of a grid of `size`; the option `mass` is their total, or `density` refers to the
 * `piece` that an inner one represents: its length, area or volume, by the number of axes, halved for each
 * axis at one of whose ends a particle is. */
int32_t hk_part_add_particles(struct hk_part *part, int32_t axes, const int64_t size[3], double piece,
                              const double *position);

/* Adds the springs of a family from pairs of particles and a rest length for each, as one group; nothing if
 * the family is not named. */
int32_t hk_part_add_pairs(struct hk_part *part, const char *family, int64_t count, const int64_t *ends,
                          const double *rest_length);

/* "<part>.<family>", which the caller frees; NULL without memory. */
char *hk_part_group_name(const struct hk_part *part, const char *family);

/* A `named` of parts with two ends: their words are "start" and "end". */
int64_t hk_part_named_end(const struct hk_part *part, const char *word, int64_t k);
