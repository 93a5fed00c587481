/* Spring groups while a system is built, and the runs that commit sorts them into. */
#ifndef HOOKE_MODEL_FORCE_SPRING_H
#define HOOKE_MODEL_FORCE_SPRING_H

#include "core/option.h"
#include "kernel/spring_loops.h"

int32_t hk_spring_options_create(hooke_options **options);

struct hk_group {
  char *name;
  int64_t count;
  int64_t dropped;        /* from commit on: springs without stiffness and damping, which count no more */
  int32_t from_part;      /* springs of parts are numbered after those of groups */
  int64_t part;           /* of those: which part */
  hooke_options *options; /* as given, where they hold for all springs alike; else NULL */
  int32_t pull_only;
  /* count each; taken over by the runs at commit */
  int32_t *head, *tail;
  double *kappa, *gamma, *rest_length;
};

/* All springs of a committed system, in spring order. */
struct hk_springs {
  int64_t count;
  int64_t run_count;
  struct hk_run *run;
  int64_t indexed_count, mixed_count; /* springs whose ends, or material, are stored one by one */
  int32_t *head, *tail;
  double *kappa, *gamma, *rest_length;
};

/* One spring, whatever run it is in. */
struct hk_spring {
  int64_t head, tail;
  double kappa, gamma, rest_length;
  int32_t pull_only;
};

static inline struct hk_spring hk_run_spring(const struct hk_run *run, int64_t k) {
  const int32_t indexed = run->shape & HOOKE_RUN_INDEXED;
  const struct hk_material material = hk_run_material(run, k);
  struct hk_spring spring;
  spring.head = indexed ? run->head[k] : run->start + k;
  spring.tail = indexed ? run->tail[k] : run->start + k + run->offset;
  spring.kappa = material.kappa;
  spring.gamma = material.gamma;
  spring.rest_length = material.rest_length;
  spring.pull_only = (run->shape & HOOKE_RUN_PULL_ONLY) != 0;
  return spring;
}

/* Particles of the lower ends of a run of constant offset: from the first to the one after the last. */
static inline int64_t hk_run_low(const struct hk_run *run) {
  return run->offset > 0 ? run->start : run->start + run->offset;
}

static inline int64_t hk_run_high(const struct hk_run *run) {
  return hk_run_low(run) + run->count;
}

/* A spring at given ends: length, direction (zeros where it has none), tension and rate of stretch; v may be
 * NULL. */
struct hk_stretch {
  double length, direction[3], tension, elastic, rate;
  int32_t slack; /* pulls only, and has nothing to pull */
};
void hk_spring_stretch(const struct hk_spring *spring, const double *q, const double *v,
                       struct hk_stretch *stretch);
/* The same at rest and under tension: a spring that only pulls may become taut at any time. */
void hk_spring_stretch_taut(const struct hk_spring *spring, const double *q, struct hk_stretch *stretch);

/* Sorts the groups of a system into runs. HOOKE_NO_MEMORY leaves `springs` empty. */
int32_t hk_springs_create(const struct hk_group *group, int64_t group_count, struct hk_springs *springs);
void hk_springs_release(struct hk_springs *springs);
/* 1 if some spring is damped. */
int32_t hk_springs_are_damped(const struct hk_springs *springs);
/* For whoever has made the runs look their material up elsewhere. */
void hk_springs_drop_material(struct hk_springs *springs);
int64_t hk_springs_memory(const struct hk_springs *springs);

/* Swaps springs that have neither stiffness nor damping behind the others, which keep their order, and takes
 * them out of the count; and back into it. */
void hk_group_drop(struct hk_group *group);
void hk_group_take_back(struct hk_group *group);

void hk_group_release(struct hk_group *group);
/* Releases what is one number a spring; the runs have it. */
void hk_group_release_arrays(struct hk_group *group);

#endif
