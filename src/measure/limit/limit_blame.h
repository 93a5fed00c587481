/* What determines a limit: the springs and particles that carry the limiting mode, and what it would buy to
 * change them. */
#ifndef HOOKE_MEASURE_LIMIT_LIMIT_BLAME_H
#define HOOKE_MEASURE_LIMIT_LIMIT_BLAME_H

#include "measure/trial/patience.h"
#include "model/system.h"

enum { HOOKE_BLAME_MOST = 100 };

struct hk_blamed_spring {
  int64_t spring, first, second, group;
  double share;           /* of x.(h^2 K + 2 h C)x, all forces included in the whole */
  double stiffness_share; /* the part of `share` that is of h^2 K */
};

struct hk_blamed_particle {
  int64_t particle;
  double share; /* of the kinetic energy */
  double mass;  /* [kg] */
};

/* Shares by the number of a force in its table, and the damping of all that comes in groups. */
enum { HOOKE_BLAME_DAMPING = HOOKE_FORCES, HOOKE_BLAME_SHARES };

struct hk_blame {
  /* the largest shares first */
  int64_t spring_count, particle_count;
  struct hk_blamed_spring spring[HOOKE_BLAME_MOST];
  struct hk_blamed_particle particle[HOOKE_BLAME_MOST];
  double stiffness_share; /* of h^2 K in the whole */
  double force_share[HOOKE_BLAME_SHARES];
  int64_t group_count;
  double *group_share; /* one a group of the system */
  /* of whoever asks for a remedy: as in linearised.h */
  struct hk_patience *patience;
  double room;
};

/* Shares of the springs, groups, forces and particles of a committed system at q (3n) in a mode (3n
 * displacements, NULL: none is known), `h2` being the weight of K and `h` that of 2 C. HOOKE_NO_MEMORY. */
int32_t hk_blame_find(const hooke_system *system, const double *q, const double *mode, double h2, double h,
                      struct hk_blame *blame);
void hk_blame_release(struct hk_blame *blame);

/* The force that has half of the whole or more, or HOOKE_BLAME_DAMPING; -1 if springs by their stiffness
 * have, or none has. Its name. */
int32_t hk_blame_force(const struct hk_blame *blame);
const char *hk_blame_force_name(int32_t force);
int32_t hk_blame_is_drag(int32_t force);

/* The name of a group by its place in `group_share`; "" without one. */
const char *hk_blame_group_name(const hooke_system *system, int64_t group);

struct hk_remedy {
  const char *kind;      /* "soften" springs or make particles "heavier"; NULL: no small set is to blame */
  int64_t count;         /* springs or particles to change, the first of the blame */
  double cost;           /* factor of the step that the limit without them has */
  double factor;         /* by which to change them */
  double gain;           /* factor of the step that this buys: re-computed, */
  double gain_predicted; /* and by first-order perturbation */
  int32_t force;         /* 1: the sentence is about drag or damping, which limit the step */
  char sentence[640];
};

/* The smallest set of springs or particles with 90 % of the mode, if it is small against the scene and the
 * step without it would be larger; `factor` is what the set costs. `limit` is that of `method` at q as it is.
 * Where there is no such set `sentence` says what there is instead, the counts are 0 and the numbers NaN. The
 * failures of hk_limit_predict(). */
int32_t hk_remedy_find(const hooke_system *system, const double *q, const char *method, double limit,
                       const struct hk_blame *blame, struct hk_remedy *remedy);

#endif
