/* Springs, and the runs that commit sorts their groups into. */
#pragma once

#include "hooke/system.h"
#include "kernel/spring/spring_body.h"
#include "kernel/spring/spring_loops.h"
#include "model/force/curve.h"
#include "model/force/element.h"
#include "model/force/scaling.h"
#include "model/sum/runs.h"
#include "model/vector3.h"

extern const struct hk_option_table hk_spring_options;

/* All springs of a committed system, in their order. */
struct hk_springs {
  int64_t count;
  int32_t scaled; /* 1: numbers of some follow time */
  int64_t run_count;
  struct hk_run *run;
  struct hk_stored stored;
  int64_t curved; /* springs with a curve */
};

/* A spring, whatever run it is in. */
struct hk_spring {
  int64_t head, tail;
  double kappa, gamma, rest_length;
  int32_t pull_only;
  const struct hk_curve *curve; /* NULL: linear; otherwise kappa is its slope at the rest length */
  double scale;                 /* factor on the tension of the curve */
};

/* As it is at the time of the scaler. */
static inline struct hk_spring hk_run_spring_at(const struct hk_run *run, int64_t k,
                                                struct hk_scaler *scaler) {
  const struct hk_material m = hk_scaled(hk_run_material(run, k), run->scaling, scaler);
  return (struct hk_spring){hk_run_head(run, k),
                            hk_run_tail(run, k),
                            m.kappa,
                            m.gamma,
                            m.rest_length,
                            (run->shape & HOOKE_RUN_PULL_ONLY) != 0,
                            run->curve,
                            run->scaling ? run->scale * scaler->force : run->scale};
}

/* The one place of a tension: every spring here, and linear ones in the loops of springs, to the bit. */
HOOKE_INLINE struct hk_law hk_spring_law(const struct hk_spring *spring, double r) {
  const double stretch = r - spring->rest_length, tension = spring->kappa * stretch;
  if (!spring->curve) return (struct hk_law){0.5 * tension * stretch, tension, spring->kappa};
  const struct hk_law law = hk_curve_law(spring->curve, stretch, spring->rest_length);
  return (struct hk_law){spring->scale * law.energy, spring->scale * law.tension, spring->scale * law.slope};
}

/* As it was given. */
static inline struct hk_spring hk_run_spring(const struct hk_run *run, int64_t k) {
  return hk_run_spring_at(run, k, &(struct hk_scaler){.t = HOOKE_AS_GIVEN});
}

/* A spring at given ends: length, direction (zeros if it has none), tension and rate of stretch; v may be
 * NULL. */
struct hk_stretch {
  double length, direction[3], tension, elastic, slope, rate;
  int32_t slack; /* pulls only, and is slack */
};
HOOKE_INLINE void hk_spring_stretch(const struct hk_spring *spring, const double *q, const double *v,
                                    struct hk_stretch *stretch) {
  const double *qi = q + 3 * spring->head, *qj = q + 3 * spring->tail;
  const double d[3] = {qi[0] - qj[0], qi[1] - qj[1], qi[2] - qj[2]};
  const double r = hk_spring_length(d[0], d[1], d[2]), ir = hk_spring_inverse_length(r);
  double rate = 0.0;
  if (v) {
    const double *vi = v + 3 * spring->head, *vj = v + 3 * spring->tail;
    rate = (((vi[0] - vj[0]) * d[0] + (vi[1] - vj[1]) * d[1]) + (vi[2] - vj[2]) * d[2]) * ir;
  }
  const struct hk_law law = hk_spring_law(spring, r);
  const double free_tension = law.tension + spring->gamma * rate;
  stretch->length = r;
  for (int a = 0; a < 3; a++)
    stretch->direction[a] = d[a] * ir;
  stretch->rate = rate;
  stretch->slack = spring->pull_only && (r <= spring->rest_length || free_tension < 0.0);
  stretch->tension = stretch->slack ? 0.0 : free_tension;
  stretch->elastic = spring->pull_only && r <= spring->rest_length ? 0.0 : law.tension;
  stretch->slope = law.slope;
}

/* Derivative of the force on the first end: -(stiffness dx + damping dv) with df/dx = -(u c^T + b (I - u
 * u^T)) and df/dv = -gamma u u^T. Returns 0 if it is zero. */
struct hk_spring_slope {
  double u[3], c[3], b, gamma;
  int32_t isotropic; /* coincident ends, rest length 0: df/dx = -b I */
};
HOOKE_INLINE int32_t hk_spring_slope_find(const struct hk_spring *spring, const double *q, const double *v,
                                          struct hk_spring_slope *slope) {
  struct hk_stretch s;
  hk_spring_stretch(spring, q, v, &s);
  slope->isotropic = 0;
  slope->gamma = spring->gamma;
  if (s.length == 0.0) {
    slope->isotropic = spring->rest_length == 0.0 && !spring->pull_only;
    slope->b = spring->kappa;
    return slope->isotropic;
  }
  if (s.slack) return 0;
  const double *vi = v + 3 * spring->head, *vj = v + 3 * spring->tail;
  slope->b = s.tension / s.length;
  for (int a = 0; a < 3; a++) {
    slope->u[a] = s.direction[a];
    slope->c[a] =
        s.slope * s.direction[a] + spring->gamma * ((vi[a] - vj[a]) - s.rate * s.direction[a]) / s.length;
  }
  return 1;
}

HOOKE_INLINE void hk_spring_slope_change(const struct hk_spring_slope *s, const double dx[3],
                                         const double dv[3], double change[3]) {
  const double along = s->isotropic ? 0.0 : hk_dot3(s->u, dx);
  const double pull = s->isotropic ? 0.0 : hk_dot3(s->c, dx) + s->gamma * hk_dot3(s->u, dv);
  for (int a = 0; a < 3; a++)
    change[a] = s->isotropic ? s->b * dx[a] : pull * s->u[a] + s->b * (dx[a] - along * s->u[a]);
}

/* The blocks of a run with a curve, as hk_tangent_fill() makes those of others
 * (kernel/spring/tangent_loops.h).
 */
struct hk_tangent;
void hk_spring_fill_tangent(const struct hk_run *run, const struct hk_fields *fields, double alpha,
                            double beta, const struct hk_tangent *tangent);

/* Of the springs with curves: how many have no largest stiffness, how many have one that falls and how many
 * are where it does, and the sum of their tensions at rest lengths, in absolute value [N]. */
struct hk_curved {
  int64_t unbounded, fall, falling;
  double tension;
};
struct hk_curved hk_springs_curved(const struct hk_springs *springs, double t, const double *q);

/* The largest tension of all at positions q and time t, in absolute value [N], and the largest slope times
 * length [N]. */
void hk_springs_largest(const struct hk_springs *springs, double t, const double *q, double *tension,
                        double *strength);

/* A spring as an element. */
void hk_spring_element(const struct hk_spring *spring, const double *q, const double *v,
                       struct hk_element *out);

/* For builders. A part's springs follow those of all explicit groups, whenever they are added; otherwise the
 * same as hooke_system_add_springs(). */
int32_t hk_system_add_springs(hooke_system *system, const struct hk_addition *added);

/* The same of anchors. */
int32_t hk_system_add_anchors(hooke_system *system, const struct hk_addition *added);

/* Kappa, gamma and rest length of every spring of a group, whose ends are known; damping ratios are kept
 * until commit. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_springs_find_material(const hooke_system *system, const hooke_options *options,
                                 struct hk_group *group);

/* 2 sqrt(kappa m). */
double hk_critical_damping(double kappa, double mass);
/* At commit: gamma of every spring of a group that has damping ratios, from the inverse masses.
 * HOOKE_BAD_VALUE, of group `number`. */
int32_t hk_springs_find_damping(const hooke_system *system, struct hk_group *group, int64_t number);

/* Finds the run of a spring, and the spring at a time. */
int64_t hk_springs_run(const struct hk_springs *springs, int64_t number);
struct hk_spring hk_springs_find(const struct hk_springs *springs, int64_t number, double t);
/* The geometric mean of kappa, where it is above 0, of springs from `first` on; 1 without any. */
double hk_springs_mean(const struct hk_springs *springs, int64_t first, int64_t count, double t);
