/* Particles with prescribed motion. */
#ifndef HOOKE_MODEL_FORCE_DRIVE_H
#define HOOKE_MODEL_FORCE_DRIVE_H

#include "hooke/system.h"

enum hk_drive_kind { HOOKE_DRIVE_HARMONIC, HOOKE_DRIVE_TABLE, HOOKE_DRIVE_CALLBACK };

struct hk_drive_group {
  enum hk_drive_kind kind;
  int64_t count;
  int32_t *particle;
  double *origin; /* initial positions, 3 count */
  double amplitude[3], frequency, phase;
  int64_t samples;
  double *time, *displacement, *slope; /* samples, 3 samples, 3 samples */
  hooke_drive *callback;
  void *ctx;
};

/* Computes position and velocity of the group's particles at time t, 3 count each; returns the value of a
 * callback. */
int32_t hk_drive_evaluate(const struct hk_drive_group *drive, double t, double *q, double *v);

void hk_drive_release(struct hk_drive_group *drive);

#endif
