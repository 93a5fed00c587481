/* Particles with prescribed motion. */
#ifndef HOOKE_MODEL_FORCE_DRIVE_H
#define HOOKE_MODEL_FORCE_DRIVE_H

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

void hk_drive_release(struct hk_drive_group *drive);

#endif
