/* Classes of springs: a law that gives every spring of a class its material, equal to the bit, from its rest
 * length. */
#include "model/sum/net.h"

#include <math.h>
#include <string.h>

/* Numbers of their own are faster than divisions, and take 16 bytes a spring: with no more springs than
 * this. */
enum { FEW_SPRINGS = 1 << 17 };

static int same_bits(double a, double b) {
  return memcmp(&a, &b, sizeof a) == 0;
}

static int fits_spring(const struct hk_net_class *class, const struct hk_spring *spring) {
  const int strain = class->shape & HOOKE_NET_STRAIN;
  const double share = strain ? spring->rest_length : 1.0;
  return same_bits(spring->kappa, class->kappa / share) && same_bits(spring->gamma, class->gamma / share);
}

static int fits(const struct hk_net_class *class, const struct hk_run *run) {
  if (((class->shape & HOOKE_NET_PULL_ONLY) != 0) != ((run->shape & HOOKE_RUN_PULL_ONLY) != 0)) return 0;
  const int64_t count = run->shape & HOOKE_RUN_MIXED ? run->count : 1;
  for (int64_t k = 0; k < count; k++) {
    const struct hk_spring spring = hk_run_spring(run, k);
    if (!fits_spring(class, &spring)) return 0;
  }
  return 1;
}

/* The number that divided by `length` is `share`, as far as one spring tells: within a unit in the last
 * place. */
static double multiple(double share, double length, int off) {
  const double whole = share * length;
  return off == 0 ? whole : nextafter(whole, off > 0 ? (double)INFINITY : 0.0);
}

/* A class that the run fits, shared numbers first; 0 if there is none. */
static int make(const struct hk_run *run, struct hk_net_class *class) {
  const struct hk_spring spring = hk_run_spring(run, 0);
  const int32_t pull = spring.pull_only ? HOOKE_NET_PULL_ONLY : 0;
  *class = (struct hk_net_class){
      .shape = HOOKE_NET_LENGTHS | pull, .uniform = 1, .kappa = spring.kappa, .gamma = spring.gamma};
  if (fits(class, run)) return 1;
  class->shape = HOOKE_NET_STRAIN | pull;
  for (int stiff = -1; stiff <= 1; stiff++) {
    for (int damp = -1; damp <= 1; damp++) {
      class->kappa = multiple(spring.kappa, spring.rest_length, stiff);
      class->gamma = multiple(spring.gamma, spring.rest_length, damp);
      if (isfinite(class->kappa) && isfinite(class->gamma) && fits(class, run)) return 1;
    }
  }
  return 0;
}

/* Each run into the first class that it fits; 0 if that takes too many. */
static int by_law(const struct hk_springs *springs, struct hk_net *net, int32_t *class_of) {
  net->classes = 0;
  for (int64_t r = 0; r < springs->run_count; r++) {
    int32_t c = 0;
    while (c < net->classes && !fits(&net->class[c], &springs -> run[r]))
      c++;
    if (c == HOOKE_NET_CLASSES || (c == net->classes && !make(&springs->run[r], &net->class[c]))) return 0;
    if (c == net->classes) net->classes++;
    class_of[r] = c;
  }
  return 1;
}

static int divides(const struct hk_net *net) {
  int32_t strain = 0;
  for (int32_t c = 0; c < net->classes; c++)
    strain |= net->class[c].shape & HOOKE_NET_STRAIN;
  return strain != 0;
}

static void by_spring(const struct hk_springs *springs, struct hk_net *net, int32_t *class_of) {
  net->classes = 2;
  net->class[0] = (struct hk_net_class){.shape = HOOKE_NET_MIXED};
  net->class[1] = (struct hk_net_class){.shape = HOOKE_NET_MIXED | HOOKE_NET_PULL_ONLY};
  for (int64_t r = 0; r < springs->run_count; r++)
    class_of[r] = (springs->run[r].shape & HOOKE_RUN_PULL_ONLY) != 0;
}

static void look_at_lengths(const struct hk_springs *springs, struct hk_net *net, const int32_t *class_of) {
  uint8_t seen[HOOKE_NET_CLASSES] = {0};
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    struct hk_net_class *class = &net->class[class_of[r]];
    for (int64_t k = 0; k < (run->shape & HOOKE_RUN_MIXED ? run->count : 1); k++) {
      const double length = hk_run_material(run, k).rest_length;
      if (!seen[class_of[r]]) class->rest_length = length;
      seen[class_of[r]] = 1;
      if (!same_bits(length, class->rest_length)) class->uniform = 0;
    }
    if (run->shape & HOOKE_RUN_DAMPED) class->shape |= HOOKE_NET_DAMPED;
  }
}

/* Where every class has one rest length there are no arrays at all. */
static void share_lengths(struct hk_net *net) {
  int32_t uniform = 1;
  for (int32_t c = 0; c < net->classes; c++)
    uniform &= net->class[c].uniform;
  for (int32_t c = 0; c < net->classes && uniform; c++) {
    struct hk_net_class *class = &net->class[c];
    if (class->shape & HOOKE_NET_STRAIN) {
      class->kappa /= class->rest_length;
      class->gamma /= class->rest_length;
    }
    class->shape &= ~HOOKE_NET_MIXED;
  }
}

void hk_net_classify(const struct hk_springs *springs, struct hk_net *net, int32_t *class_of) {
  const int lawful = by_law(springs, net, class_of);
  if (!lawful || (divides(net) && springs->count <= FEW_SPRINGS)) by_spring(springs, net, class_of);
  look_at_lengths(springs, net, class_of);
  share_lengths(net);
}
