/* Kinds of springs: a law that gives every spring of a kind its material, equal to the bit, from its rest
 * length. */
#include "model/sum/tiled.h"

#include <math.h>
#include <string.h>

/* Individually stored numbers are faster than divisions, and take 16 bytes a spring: used up to this number
 * of springs. */
enum { FEW_SPRINGS = 1 << 17 };

static int same_bits(double a, double b) {
  return memcmp(&a, &b, sizeof a) == 0;
}

static int fits_spring(const struct hk_tiled_kind *kind, const struct hk_spring *spring) {
  const int strain = kind->shape & HOOKE_TILED_STRAIN;
  const double divisor = strain ? spring->rest_length : 1.0;
  return same_bits(spring->kappa, kind->kappa / divisor) && same_bits(spring->gamma, kind->gamma / divisor);
}

static int is_alike(const struct hk_tiled_kind *kind, const struct hk_run *run) {
  return ((kind->shape & HOOKE_TILED_PULL_ONLY) != 0) == ((run->shape & HOOKE_RUN_PULL_ONLY) != 0) &&
         kind->scaling == run->scaling;
}

static int fits(const struct hk_tiled_kind *kind, const struct hk_run *run) {
  if (!is_alike(kind, run)) return 0;
  const int64_t count = run->shape & HOOKE_RUN_MIXED ? run->count : 1;
  for (int64_t k = 0; k < count; k++) {
    const struct hk_spring spring = hk_run_spring(run, k);
    if (!fits_spring(kind, &spring)) return 0;
  }
  return 1;
}

/* The number that divided by `length` is `divisor`, as far as one spring shows: within a unit in the last
 * place. */
static double multiple(double divisor, double length, int off) {
  const double whole = divisor * length;
  return off == 0 ? whole : nextafter(whole, off > 0 ? (double)INFINITY : 0.0);
}

/* A kind that fits the run, shared numbers first; 0 if there is none. */
static int make(const struct hk_run *run, struct hk_tiled_kind *kind) {
  const struct hk_spring spring = hk_run_spring(run, 0);
  const int32_t pull = spring.pull_only ? HOOKE_TILED_PULL_ONLY : 0;
  *kind = (struct hk_tiled_kind){.shape = HOOKE_TILED_LENGTHS | pull,
                                 .uniform = 1,
                                 .kappa = spring.kappa,
                                 .gamma = spring.gamma,
                                 .scaling = run->scaling};
  if (fits(kind, run)) return 1;
  kind->shape = HOOKE_TILED_STRAIN | pull;
  for (int stiff = -1; stiff <= 1; stiff++) {
    for (int damp = -1; damp <= 1; damp++) {
      kind->kappa = multiple(spring.kappa, spring.rest_length, stiff);
      kind->gamma = multiple(spring.gamma, spring.rest_length, damp);
      if (isfinite(kind->kappa) && isfinite(kind->gamma) && fits(kind, run)) return 1;
    }
  }
  return 0;
}

/* Assigns each run to the first kind that fits; 0 if that takes too many. */
static int by_law(const struct hk_springs *springs, struct hk_tiled *tiled, int32_t *kind_of) {
  tiled->kinds = 0;
  for (int64_t r = 0; r < springs->run_count; r++) {
    int32_t c = 0;
    while (c < tiled->kinds && !fits(&tiled->kind[c], &springs->run[r]))
      c++;
    if (c == HOOKE_TILED_KINDS || (c == tiled->kinds && !make(&springs->run[r], &tiled->kind[c]))) return 0;
    if (c == tiled->kinds) tiled->kinds++;
    kind_of[r] = c;
  }
  return 1;
}

static int divides(const struct hk_tiled *tiled) {
  int32_t strain = 0;
  for (int32_t c = 0; c < tiled->kinds; c++)
    strain |= tiled->kind[c].shape & HOOKE_TILED_STRAIN;
  return strain != 0;
}

static int by_spring(const struct hk_springs *springs, struct hk_tiled *tiled, int32_t *kind_of) {
  tiled->kinds = 2;
  tiled->kind[0] = (struct hk_tiled_kind){.shape = HOOKE_TILED_MIXED};
  tiled->kind[1] = (struct hk_tiled_kind){.shape = HOOKE_TILED_MIXED | HOOKE_TILED_PULL_ONLY};
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    int32_t c = 0;
    while (c < tiled->kinds && !is_alike(&tiled->kind[c], run))
      c++;
    if (c == HOOKE_TILED_KINDS) return 0;
    if (c == tiled->kinds)
      tiled->kind[tiled->kinds++] = (struct hk_tiled_kind){
          .shape = tiled->kind[(run->shape & HOOKE_RUN_PULL_ONLY) != 0].shape, .scaling = run->scaling};
    kind_of[r] = c;
  }
  return 1;
}

static void look_at_lengths(const struct hk_springs *springs, struct hk_tiled *tiled,
                            const int32_t *kind_of) {
  uint8_t seen[HOOKE_TILED_KINDS] = {0};
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    struct hk_tiled_kind *kind = &tiled->kind[kind_of[r]];
    for (int64_t k = 0; k < (run->shape & HOOKE_RUN_MIXED ? run->count : 1); k++) {
      const double length = hk_run_material(run, k).rest_length;
      if (!seen[kind_of[r]]) kind->rest_length = length;
      seen[kind_of[r]] = 1;
      if (!same_bits(length, kind->rest_length)) kind->uniform = 0;
    }
    if (run->shape & HOOKE_RUN_DAMPED) kind->shape |= HOOKE_TILED_DAMPED;
  }
}

/* If every kind has one rest length there are no arrays at all. */
static void share_lengths(struct hk_tiled *tiled) {
  int32_t uniform = 1;
  for (int32_t c = 0; c < tiled->kinds; c++)
    uniform &= tiled->kind[c].uniform;
  for (int32_t c = 0; c < tiled->kinds && uniform; c++) {
    struct hk_tiled_kind *kind = &tiled->kind[c];
    if (kind->shape & HOOKE_TILED_STRAIN) {
      kind->kappa /= kind->rest_length;
      kind->gamma /= kind->rest_length;
    }
    kind->shape &= ~HOOKE_TILED_MIXED;
  }
}

int32_t hk_tiled_sort_kinds(const struct hk_springs *springs, struct hk_tiled *tiled, int32_t *kind_of) {
  const int lawful = by_law(springs, tiled, kind_of);
  if (!lawful || (divides(tiled) && springs->count <= FEW_SPRINGS)) {
    if (!by_spring(springs, tiled, kind_of)) return 0;
  }
  look_at_lengths(springs, tiled, kind_of);
  share_lengths(tiled);
  return 1;
}
