/* A variant: a system made anew from another with some of it left out, or parts of it at another
 * resolution. */
#ifndef HOOKE_MODEL_VARIANT_VARIANT_H
#define HOOKE_MODEL_VARIANT_VARIANT_H

#include "model/force/force.h"

/* What is changed; starts as zeros with arrays from hk_variant_create(). 1: left out. */
struct hk_variant {
  int32_t gravity, drag, force, damping;
  int32_t compression; /* 1: springs only pull */
  uint8_t *group;      /* one a group of the table */
  uint8_t *spring;     /* one a spring */
  uint8_t *particle;   /* one a particle; those of parts go with their part only */
  uint8_t *part;       /* one a part */
  double *scale;       /* one a part: factor on the cells along each axis */
  double stiffness;    /* factor on all stiffness; 1 at first, and nothing to join */
  double velocity[3];  /* added to the start of every free particle [m/s]; nothing to join either */
};

/* A variant of a committed system that changes nothing. HOOKE_NO_MEMORY. */
int32_t hk_variant_create(const hooke_system *system, struct hk_variant *variant);
void hk_variant_release(struct hk_variant *variant);
/* Leaves out what `other` leaves out, too; both of one system. */
void hk_variant_join(const hooke_system *system, struct hk_variant *variant, const struct hk_variant *other);

/* 1 if joining `other` would change nothing: what it leaves out is out, or of a part or a group that is. */
int32_t hk_variant_covers(const hooke_system *system, const struct hk_variant *variant,
                          const struct hk_variant *other);

/* The first group from `group` on, of a part that stays, of which some springs are left out and some stay:
 * options of a part have no words for it. -1 if there is none. */
int64_t hk_variant_next_split(const hooke_system *system, const struct hk_variant *variant, int64_t group);

/* Where particles of a system are in a variant of it. */
struct hk_variant_part {
  int64_t first;             /* in the variant; -1: left out */
  int64_t count;             /* there */
  int32_t axes;              /* 0: particle by particle */
  int64_t cells[3], made[3]; /* along each axis, in the system and in the variant */
};
struct hk_variant_map {
  const hooke_system *from;
  int64_t
      *to; /* one a particle: it, or in a part of another resolution the one nearest to it; -1: left out */
  struct hk_variant_part *part;
};
void hk_variant_map_release(struct hk_variant_map *map);

/* 1 if a particle of the system is one of the variant, too; 0 if it was left out, or is in a part of another
 * resolution. */
int32_t hk_variant_is_same(const struct hk_variant_map *map, int64_t particle);

/* Position of a particle of the system, from positions q of the variant (rows): its own, or in a part of
 * another resolution that of the same material point by linear interpolation. NaN where it was left out. */
void hk_variant_place(const struct hk_variant_map *map, int64_t particle, const double *q,
                      double position[3]);

/* Makes the variant of a committed system, committed too, and the map into it. Both are the caller's. What is
 * built from options (parts, groups with one material) is built from options again, so that nothing changed
 * gives the same bits. HOOKE_UNSUITED where a callback would see particles renumbered; HOOKE_BAD_VALUE,
 * HOOKE_NO_MEMORY. */
int32_t hk_variant_make(const hooke_system *from, const struct hk_variant *variant, hooke_system **made,
                        struct hk_variant_map *map);

/* ---- pieces of making one; nobody else needs them ---- */

/* One being made: what of, how, and so far. */
struct hk_variant_maker {
  const hooke_system *from;
  const struct hk_variant *variant;
  hooke_system *made;
  struct hk_variant_map *map;
};

/* Cells of a part at a scale (variant_map.c); the number of axes. */
int32_t hk_variant_cells(const struct hk_part_record *part, double scale, int64_t cells[3], int64_t made[3]);
/* The one in the variant that is nearest to a part's particle (both counted within the part), the higher one
 * of two. */
int64_t hk_variant_nearest(const struct hk_variant_part *part, int64_t offset);
/* Corners of the cell of the variant that a part's particle lies in, with their weights; those of weight 0
 * are left out. Returns how many, 8 at most. */
int32_t hk_variant_corners(const struct hk_variant_part *part, int64_t offset, int64_t corner[8],
                           double weight[8]);

/* Adds particles, in parts and alone, and fills the map (variant_particles.c). */
int32_t hk_variant_add_particles(struct hk_variant_maker *maker);
/* Pins and drives. A particle of a part at another resolution is constrained if all are that it lies between,
 * or one that it is nearest to (variant_constrained.c). */
int32_t hk_variant_constrain(struct hk_variant_maker *maker);
/* 1 if the part of a group does not bring it because single springs of it are left out; those that stay are
 * added as a group of their own. `first` is the group's first member. Not in a part at another resolution,
 * where springs are others. */
int32_t hk_variant_breaks_up(const struct hk_variant_maker *maker, const struct hk_group *group,
                             int64_t first);
/* Each adds a group that no part brings; `first` is the number of its first member (`keep` of the table of
 * forces). Tetrahedra keep their rest lengths. */
int32_t hk_variant_keep_springs(struct hk_variant_maker *maker, const struct hk_group *group, int64_t first);
int32_t hk_variant_keep_bending(struct hk_variant_maker *maker, const struct hk_group *group, int64_t first);
int32_t hk_variant_keep_altitude(struct hk_variant_maker *maker, const struct hk_group *group, int64_t first);

#endif
