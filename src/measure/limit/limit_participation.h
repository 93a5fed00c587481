/* The elements that determine a limit: the springs and particles that carry the limiting mode, and the gain
 * of changing them. */
#pragma once

#include "measure/needs/price.h"
#include "measure/trial/budget.h"
#include "model/force/force.h"

enum { HOOKE_MOST_LIMITING = 100 };

/* What limits a step: a spring, or a force. */
struct hk_limiting {
  int64_t spring, first, second; /* -1: of a force */
  double share;                  /* of x.(h^2 K + 2 h C)x, all forces included in the whole; NaN: unknown */
  double stiffness_share;        /* part of `share` due to h^2 K */
  const char *group;             /* of the system; "" for none */
  const char *force;             /* NULL: a spring */
};

/* The element of a group, of any force, with the largest share; 0: none. */
struct hk_limiting_element {
  int32_t force; /* its number */
  int64_t number;
  double share;
};

struct hk_limiting_particle {
  int64_t particle;
  double share; /* of the kinetic energy */
  double mass;  /* [kg] */
};

/* Shares by the number of a force in its table, the damping of all forces with groups, and the geometric
 * stiffness of bodies (rigid.h). */
enum {
  HOOKE_PARTICIPATION_DAMPING = HOOKE_FORCES,
  HOOKE_PARTICIPATION_GEOMETRIC,
  HOOKE_PARTICIPATION_SHARES
};

struct hk_participation {
  /* the largest shares first */
  int64_t spring_count, particle_count;
  struct hk_limiting spring[HOOKE_MOST_LIMITING];
  struct hk_limiting_particle particle[HOOKE_MOST_LIMITING];
  struct hk_limiting_element heaviest;
  double stiffness_share; /* of h^2 K in the whole */
  double force_share[HOOKE_PARTICIPATION_SHARES];
  int64_t group_count;
  double *group_share; /* by group of the system */
  /* for a suggestion: the largest stable step if nothing were damped, by verlet [s]; as in linearised.h */
  double undamped;
  struct hk_budget *budget;
  double memory;
};

/* Shares of the springs, groups, forces and particles of a committed system at q and v (3n) in a mode (3n
 * displacements, NULL: unknown), with `h2` the weight of K and `h` that of 2 C. HOOKE_NO_MEMORY. */
int32_t hk_participation_find(const hooke_system *system, const double *q, const double *v,
                              const double *mode, double h2, double h,
                              struct hk_participation *participation);
void hk_participation_release(struct hk_participation *participation);

/* The force with half of the total or more, or HOOKE_PARTICIPATION_DAMPING or _GEOMETRIC; -1 if it is the
 * stiffness of springs, or none. */
int32_t hk_participation_force(const struct hk_participation *participation);
int32_t hk_participation_is_drag(int32_t force);

/* The group with the largest share; -1 if there is none. */
int64_t hk_participation_group(const struct hk_participation *participation);
/* Name of a group by its index in `group_share`; "" if it has none. */
const char *hk_participation_group_name(const hooke_system *system, int64_t group);

struct hk_limiting_list {
  int64_t count;
  struct hk_limiting row[HOOKE_MOST_LIMITING + 1];
};

/* Fills the list: hk_participation_force(), if there is one, then the springs. */
void hk_limiting_take(const struct hk_participation *participation, struct hk_limiting_list *list);
/* Adds a spring; -1, or one more than there is room for, is left out. */
void hk_limiting_add(const hooke_system *system, int64_t spring, double share, struct hk_limiting_list *list);

struct hk_suggestion {
  const char *kind;      /* "soften" springs or make particles "heavier"; NULL: no small set is limiting */
  int64_t count;         /* springs or particles to change, the first of the participation */
  double cost;           /* ratio of the step limit without them */
  double factor;         /* factor of the change */
  double gain;           /* ratio of the step limits after the change: recomputed, */
  double gain_predicted; /* and by first-order perturbation */
  int32_t force;         /* 1: the sentence is about drag or damping, which limits the step */
  int32_t without;       /* what it says a step of without: participation's number of a force; -1: nothing */
  struct hk_price price; /* of the change, or of leaving that out, once found */
  char sentence[640];
};

extern const struct hk_suggestion hk_no_suggestion; /* without a sentence */

/* The smallest set of springs or particles with 90 % of the mode, if it is small against the scene and the
 * step without it would be larger; `factor` is the cost of the set. `limit` is that of `method` at q as it
 * is. Without such a set `sentence` describes the limiting groups, the counts are 0 and the numbers NaN. The
 * failures of hk_limit_predict(). */
int32_t hk_suggestion_find(const hooke_system *system, const double *q, const char *method, double limit,
                           const struct hk_participation *participation, struct hk_suggestion *suggestion);

/* Finds and tells the prices of what it says (needs/price.h). */
int32_t hk_suggestion_price(const hooke_system *system, const hooke_options *run, const char *method,
                            double limit, const struct hk_participation *participation,
                            struct hk_budget *budget, struct hk_suggestion *suggestion);
