/* Particles with prescribed motion. */
#pragma once

#include "hooke/system.h"
#include "model/course.h"

struct hk_drive_group {
  int64_t count;
  int32_t *particle;
  double *origin;          /* initial positions, 3 count */
  struct hk_course course; /* displacement */
  hooke_drive *callback;   /* in place of it; NULL: none */
  void *ctx;
};

/* Computes position and velocity of the group's particles at time t, 3 count each; returns the value of a
 * callback. */
int32_t hk_drive_evaluate(const struct hk_drive_group *drive, double t, double *q, double *v);

/* Reaction of the support of a particle with the acceleration a, on which the forces f of
 * hooke_system_force() act, which are without its own weight. `reaction` may be f. */
void hk_support_reaction(const hooke_system *system, int64_t particle, const double a[3], const double f[3],
                         double reaction[3]);

void hk_drive_release(struct hk_drive_group *drive);
