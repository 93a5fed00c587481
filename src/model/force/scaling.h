/* Factors of springs that follow time, which their groups share: l0(t) = rest_scale l0 in every place of the
 * law, and a stiffness times stiffness_scale. */
#pragma once

#include "core/table/option.h"
#include "kernel/spring/spring_loops.h"
#include "model/course.h"

#include <math.h>

struct hk_scaling {
  struct hk_course rest, stiffness; /* of one number each */
  int32_t strain;                   /* 1: the rest length divides the stiffness and the damping */
};

/* Of a factor in time; and the rows of both factors. */
extern const struct hk_option_table hk_scale_options;
#define HOOKE_SCALE_OPTIONS                                                                                  \
  HOOKE_OPTION("rest_scale", HOOKE_OPTION_POSITIVE(NULL), "1", "factor on the rest length",                  \
               .family = &hk_scale_options),                                                                 \
      HOOKE_OPTION("stiffness_scale", HOOKE_OPTION_NOT_NEGATIVE(NULL), "1", "factor on the stiffness",       \
                   .family = &hk_scale_options)

/* The factor of an option that is a number, 1 where it follows time. */
double hk_scale_number(const hooke_options *options, const char *name);

/* NULL where neither option follows time. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_scaling_create(const hooke_options *options, int32_t strain, struct hk_scaling **scaling);
/* NULL has a copy, too. */
int32_t hk_scaling_copy(const struct hk_scaling *from, struct hk_scaling **copy);
void hk_scaling_release(struct hk_scaling *scaling);
/* Bytes; 0 of NULL. */
int64_t hk_scaling_memory(const struct hk_scaling *scaling);
void hk_scaling_check(const struct hk_scaling *scaling, uint32_t *value);

/* In place of a time: numbers as they were given; the stiffest and most damped of all times, and the
 * shortest.
 */
#define HOOKE_AS_GIVEN NAN
#define HOOKE_STIFFEST INFINITY

/* Factors of the material of springs at time t, and their rates: those of the group that was last asked for,
 * so that springs in the order of their groups need them once a group. Begins as {.t = t}. */
struct hk_scaler {
  double t;
  const struct hk_scaling *of;
  struct hk_material by, rate;
  double force, force_rate; /* of what is multiplied alone, the tension of a curve */
};
void hk_scaler_find(struct hk_scaler *scaler, const struct hk_scaling *scaling);

static inline struct hk_material hk_scaled(struct hk_material m, const struct hk_scaling *scaling,
                                           struct hk_scaler *scaler) {
  if (scaling == NULL) return m;
  if (scaler->of != scaling) hk_scaler_find(scaler, scaling);
  return (struct hk_material){m.kappa * scaler->by.kappa, m.gamma * scaler->by.gamma,
                              m.rest_length * scaler->by.rest_length};
}

/* The runs of springs as they are at a time:
 *   for (hk_begin_runs(springs, t, &walk); (run = hk_next_run(&walk)) != NULL;)
 * Runs of many materials that follow time come in pieces. */
struct hk_springs;
struct hk_run_walk {
  const struct hk_springs *springs;
  int64_t next, done;
  struct hk_scaler scaler;
  struct hk_run run;
  double kappa[HOOKE_RUN_PIECE], gamma[HOOKE_RUN_PIECE], rest_length[HOOKE_RUN_PIECE];
};
void hk_begin_runs(const struct hk_springs *springs, double t, struct hk_run_walk *walk);
const struct hk_run *hk_next_run(struct hk_run_walk *walk);
