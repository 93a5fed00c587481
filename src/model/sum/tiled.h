/* Tiled batches: sums the forces of unordered springs in one pass over the particles.
 *
 * Particles get a working numbering in which neighbours are close, unless their own is good enough. Springs
 * are stored by the tile of their lower end in that numbering. The pass goes over tiles: forces of the
 * springs that begin in a tile go, on their lower ends, into a list of the tile and, on their upper ends,
 * into a ring, which reaches back to the first spring that ends in it; each particle then sums its springs
 * from both in ascending spring number, so that sums have the bits of the plain order. The particles of a
 * tile are not read after that, so they may move at once. Workers of a thread pool have ranges of tiles:
 * before anything moves they also compute the springs of earlier ranges that end in theirs, and save the data
 * that they need of later ones. */
#pragma once

#include "kernel/spring/tiled_loops.h"
#include "model/sum/strided.h"

enum { HOOKE_TILED_KINDS = 8 };

/* Springs that one loop can process. */
struct hk_tiled_kind {
  int32_t shape;   /* HOOKE_TILED_* */
  int32_t uniform; /* one rest length */
  double kappa, gamma, rest_length;
  const struct hk_scaling *scaling; /* as of their runs */
};

struct hk_tiled_tile {
  int64_t end;    /* of its springs; they begin where those of the previous tile end */
  int64_t before; /* first spring that ends in this tile or begins there */
  int32_t reach;  /* one past the last particle at which springs of this tile and earlier ones end */
};

/* `particles` 0: there is no tiled batch. */
struct hk_tiled {
  int64_t particles, springs, tiles;
  int32_t kinds, wide;
  int32_t stored; /* 1: all that iterates over springs goes by index; 0, in a small system: by number */
  struct hk_tiled_kind kind[HOOKE_TILED_KINDS];
  struct hk_tiled_tile *tile;
  int32_t *order;       /* particle of a working number; NULL: the same number */
  double *inverse_mass; /* by working number; NULL without `order` */
  int32_t *batch;       /* springs of each tile, by kind */

  /* by index: tile, kind, lower end */
  uint8_t *lower;                      /* from the first particle of the tile */
  void *upper;                         /* uint16_t, or uint32_t if wide: row of the window */
  double *kappa, *gamma, *rest_length; /* NULL: by kind */
  int32_t *slot;                       /* of each spring; NULL without arrays of material */

  /* by particle */
  uint16_t *degree;
  /* as wide as `upper`: indices into the list, and `list` + those into the ring, in ascending spring number
   */
  void *force;

  int64_t rows, list, ring; /* sizes of a window, a list of a tile and a ring */
};

/* The material of spring `at`, of that kind, as given: to the bit that of the loops of tiled batches. */
static inline struct hk_material hk_tiled_material(const struct hk_tiled *tiled,
                                                   const struct hk_tiled_kind *kind, int64_t at) {
  const int32_t form = kind->shape & HOOKE_TILED_MIXED;
  if (form == HOOKE_TILED_MIXED)
    return (struct hk_material){tiled->kappa[at], tiled->gamma[at], tiled->rest_length[at]};
  const double length = form ? tiled->rest_length[at] : kind->rest_length,
               divisor = form == HOOKE_TILED_STRAIN ? length : 1.0;
  return (struct hk_material){kind->kappa / divisor, kind->gamma / divisor, length};
}

/* HOOKE_NO_MEMORY. Moves material from the springs to the tiled batch. Makes none if runs or strided batches
 * are as good. */
int32_t hk_tiled_create(struct hk_springs *springs, int64_t particle_count, const double *inverse_mass,
                        struct hk_tiled *tiled);
void hk_tiled_release(struct hk_tiled *tiled);
int64_t hk_tiled_memory(const struct hk_tiled *tiled);
/* The part of it that grows with the number of springs. */
int64_t hk_tiled_spring_memory(const struct hk_tiled *tiled);

/* Numbers particles by breadth-first search along the springs, starting from an end of each piece: order[k]
 * is number k, place[p] the number of p. HOOKE_NO_MEMORY. */
int32_t hk_tiled_number(int64_t particles, int64_t springs, const int32_t *head, const int32_t *tail,
                        int32_t *order, int32_t *slot);

/* Finds the kinds of the springs of all runs, in tiled->kind; kind_of has one for each run. 0 if there are
 * too many. */
int32_t hk_tiled_sort_kinds(const struct hk_springs *springs, struct hk_tiled *tiled, int32_t *kind_of);

/* Numbers in window, list and ring. */
int64_t hk_tiled_numbers(const struct hk_tiled *tiled);

/* Windows and rings of one pass at a time, for so many workers of a thread pool. NULL without memory. */
struct hk_tiled_scratch;
struct hk_tiled_scratch *hk_tiled_scratch_create(const struct hk_tiled *tiled, int32_t workers);
void hk_tiled_scratch_destroy(struct hk_tiled_scratch *scratch);
int64_t hk_tiled_scratch_memory(const struct hk_tiled_scratch *scratch);

/* Receives sums over `count` particles from `from` on in f; may move these particles. */
typedef void hk_tile(int64_t from, int64_t count, double *const f[3], void *ctx);

struct hk_motion;

/* One pass over all particles of `motion` at time t, whose tiles are in working numbers; returns the number
 * of springs with a rest length but no direction. Workers of its pool process their own tiles at the same
 * time, each in ascending order. */
int64_t hk_tiled_pass(const struct hk_tiled *tiled, struct hk_motion *motion, double t, hk_tile *tile,
                      void *ctx);
