/* Springs, and the runs that commit sorts their groups into. */
#ifndef HOOKE_MODEL_FORCE_SPRING_H
#define HOOKE_MODEL_FORCE_SPRING_H

#include "kernel/spring_loops.h"
#include "model/force/element.h"
#include "model/group.h"

extern const struct hk_option_table hk_spring_options;

/* All springs of a committed system, in their order. */
struct hk_springs {
  int64_t count;
  int64_t run_count;
  struct hk_run *run;
  int64_t indexed_count, mixed_count; /* springs with individually stored ends or material */
  int32_t *head, *tail;
  double *kappa, *gamma, *rest_length;
};

/* A spring, whatever run it is in. */
struct hk_spring {
  int64_t head, tail;
  double kappa, gamma, rest_length;
  int32_t pull_only;
};

static inline struct hk_spring hk_run_spring(const struct hk_run *run, int64_t k) {
  const struct hk_material material = hk_run_material(run, k);
  struct hk_spring spring;
  spring.head = hk_run_head(run, k);
  spring.tail = hk_run_tail(run, k);
  spring.kappa = material.kappa;
  spring.gamma = material.gamma;
  spring.rest_length = material.rest_length;
  spring.pull_only = (run->shape & HOOKE_RUN_PULL_ONLY) != 0;
  return spring;
}

/* A spring at given ends: length, direction (zeros if it has none), tension and rate of stretch; v may be
 * NULL. */
struct hk_stretch {
  double length, direction[3], tension, elastic, rate;
  int32_t slack; /* pulls only, and is slack */
};
void hk_spring_stretch(const struct hk_spring *spring, const double *q, const double *v,
                       struct hk_stretch *stretch);
/* The same at rest and with tension: a spring that only pulls may become taut at any time. */
void hk_spring_stretch_taut(const struct hk_spring *spring, const double *q, struct hk_stretch *stretch);

/* Derivative of the force on the first end: -(stiffness dx + damping dv) with df/dx = -(u c^T + b (I - u
 * u^T)) and df/dv = -gamma u u^T. Returns 0 if it is zero. */
struct hk_spring_slope {
  double u[3], c[3], b, gamma;
  int32_t isotropic; /* coincident ends, rest length 0: df/dx = -b I */
};
int32_t hk_spring_slope_find(const struct hk_spring *spring, const double *q, const double *v,
                             struct hk_spring_slope *slope);
void hk_spring_slope_change(const struct hk_spring_slope *slope, const double dx[3], const double dv[3],
                            double change[3]);
void hk_spring_slope_blocks(const struct hk_spring_slope *slope, double stiff[9], double damp[9]);

/* A spring as an element. */
void hk_spring_element(const struct hk_spring *spring, const double *q, const double *v,
                       struct hk_element *out);

/* Finds the run of a spring, and the spring. */
int64_t hk_springs_run(const struct hk_springs *springs, int64_t number);
struct hk_spring hk_springs_find(const struct hk_springs *springs, int64_t number);

/* Sorts the groups of a system into runs. HOOKE_NO_MEMORY leaves `springs` empty. */
int32_t hk_springs_create(const struct hk_group *group, int64_t group_count, struct hk_springs *springs);
void hk_springs_release(struct hk_springs *springs);
/* 1 if some spring is damped. */
int32_t hk_springs_are_damped(const struct hk_springs *springs);
/* Replaces the material of runs by a lookup elsewhere. */
void hk_springs_drop_material(struct hk_springs *springs);
int64_t hk_springs_memory(const struct hk_springs *springs);

#endif
