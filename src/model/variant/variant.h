/* A variant: a system rebuilt from another with some ingredients left out, with other numbers, or parts at
 * another resolution. */
#pragma once

#include "model/force/force.h"
#include "model/part_record.h"

/* The changes; hk_variant_create() gives zeros with arrays. 1: left out. */
struct hk_variant {
  uint8_t without[HOOKE_FORCES]; /* by row of the table of forces: one without groups */
  int32_t damping;
  int32_t compression; /* 1: springs only pull */
  uint8_t *group;      /* by group of the table */
  uint8_t *spring;     /* by spring */
  uint8_t *particle;   /* by particle; particles of parts are left out only with their part */
  uint8_t *part;       /* by part */
  uint8_t *rigid;      /* by part: 1: it is one rigid body, and what is inside it drops out */
  int32_t loose;       /* 1: parts become plain particles and groups, of which any may be left out */
  /* factors, initially 1, which hk_variant_join() multiplies */
  double *scale;      /* by part: on the cells along each axis */
  double *factor[2];  /* by group: on stiffness (HOOKE_KAPPA) and damping (HOOKE_GAMMA) of its members */
  double *single[2];  /* the same by spring, which breaks up what options say of its group */
  double *mass;       /* by particle */
  double drag;        /* on the linear drag */
  double velocity[3]; /* added to the initial velocity of every free particle [m/s]; not joined */
};

/* Creates a variant of a committed system without changes. HOOKE_NO_MEMORY. */
int32_t hk_variant_create(const hooke_system *system, struct hk_variant *variant);
void hk_variant_release(struct hk_variant *variant);
/* Also leaves out everything that `other`, of the same system, leaves out, and changes what it changes. */
void hk_variant_join(const hooke_system *system, struct hk_variant *variant, const struct hk_variant *other);

/* 1 if joining `other`, without factors but on cells, would change nothing: everything that it leaves out is
 * left out already, or belongs to a part or a group that is. */
int32_t hk_variant_covers(const hooke_system *system, const struct hk_variant *variant,
                          const struct hk_variant *other);

/* First group from `group` on, of a kept part, of which some but not all springs are left out: options of a
 * part cannot express that. -1 if there is none. */
int64_t hk_variant_next_split(const hooke_system *system, const struct hk_variant *variant, int64_t group);

/* Map from the particles of a system to those of its variant. */
struct hk_variant_part {
  int64_t first;             /* number in the variant; -1: left out */
  int64_t count;             /* in the variant */
  int32_t axes;              /* 0: particle by particle */
  int64_t cells[3], made[3]; /* along each axis, in the system and in the variant */
};
struct hk_variant_map {
  const hooke_system *from;
  int64_t *to; /* by particle: its number, that of the nearest one in a part of another resolution, or -1 */
  struct hk_variant_part *part;
};
void hk_variant_map_release(struct hk_variant_map *map);

/* 1 if a particle of the system is also one of the variant; 0 if it was left out, or is in a part of another
 * resolution. */
int32_t hk_variant_is_same(const struct hk_variant_map *map, int64_t particle);

/* Position of a particle of the system, from positions q of the variant (rows): its own, or in a part of
 * another resolution that of the same material point by linear interpolation. NaN if it was left out. */
void hk_variant_place(const struct hk_variant_map *map, int64_t particle, const double *q,
                      double position[3]);

/* Creates and commits the variant of a committed system, and the map into it; the caller owns both. Objects
 * made from options (parts, groups of one material) are made from options again, so that an unchanged variant
 * has the same bits. The first variant of a system finds out whether one that leaves out nothing equals it:
 * HOOKE_INTERNAL, with what differs, if not. HOOKE_UNSUITED where a callback would see particles renumbered,
 * and a rigid body would lose some; HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_variant_make(const hooke_system *from, const struct hk_variant *variant, hooke_system **made,
                        struct hk_variant_map *map);

/* ---- steps of hk_variant_make(), for its files and those of forces alone ---- */

/* A variant under construction: source, changes, result. */
struct hk_variant_maker {
  const hooke_system *from;
  const struct hk_variant *variant;
  hooke_system *made;
  struct hk_variant_map *map;
};

/* Cells of a part at a scale (variant_map.c); returns the number of axes. */
int32_t hk_variant_cells(const struct hk_part_record *part, double scale, int64_t cells[3], int64_t made[3]);
/* Particle of the variant nearest to a part's particle (both counted within the part); the higher of two. */
int64_t hk_variant_nearest(const struct hk_variant_part *part, int64_t offset);
/* Corners of the cell of the variant that contains a part's particle, with their weights; those of weight 0
 * are left out. Returns their number, 8 at most. */
int32_t hk_variant_corners(const struct hk_variant_part *part, int64_t offset, int64_t corner[8],
                           double weight[8]);

/* Adds particles, in parts and alone, and fills the map (variant_particles.c). */
int32_t hk_variant_add_particles(struct hk_variant_maker *maker);
/* Multiplies stiffness and damping, as far as they are set, of a group of springs or of a family ("bend.") of
 * a part. */
int32_t hk_variant_scale_options(hooke_options *options, const char *family, const double factor[2]);
/* Pins and drives. A particle of a part at another resolution is constrained if all particles that it lies
 * between are, or one that it is nearest to (variant_constrained.c). */
int32_t hk_variant_constrain(struct hk_variant_maker *maker);
/* Whether bending or clamps of the part are left out, so that it adds no clamps itself. */
int hk_variant_frees_clamps(const struct hk_variant_maker *maker, int64_t part);
/* 1 if the part of a group does not add it because single springs of it are left out; the remaining ones are
 * added as a group of their own. `first` is the group's first member. Not for a part at another resolution,
 * whose springs differ. */
int32_t hk_variant_breaks_up(const struct hk_variant_maker *maker, const struct hk_group *group,
                             int64_t first);
/* HOOKE_UNSUITED if particles are renumbered, for a force (`what`) that knows them by their numbers. */
int32_t hk_variant_require_numbers(const struct hk_variant_maker *maker, const char *what);
