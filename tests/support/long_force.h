/* The accelerations of canonical.h once more, in long double and with motions prescribed, as a rate for
 * extrapolation.h. */
#ifndef TESTS_SUPPORT_LONG_FORCE_H
#define TESTS_SUPPORT_LONG_FORCE_H

#include "canonical.h"
#include "extrapolation.h"

/* A particle that is moved about where it was added. */
struct long_drive {
  int64_t particle;
  double amplitude[3], frequency, phase; /* harmonic */
  int64_t samples;                       /* 0: harmonic */
  double *time, *displacement;           /* samples, 3 samples */
};

/* How far it is from there at t, and its velocity. */
void long_drive_move(const struct long_drive *drive, long double t, long double d[3], long double u[3]);

struct long_force {
  const struct canonical *canonical; /* its gravity and drag count, too; it has no callback */
  int64_t drive_count;
  const struct long_drive *drive;
  const double *origin; /* 3n: where particles were added */
  double extent;        /* [m] that an error of a position is measured by */
};

/* y is the positions, then the velocities, 6n together; both are of struct long_force. */
void long_force_rate(long double t, long double *y, long double *f, void *ctx);
void long_force_scale(const long double *y, const long double *f, long double *scale, void *ctx);

/* Half the largest distance between two of the positions, coordinate by coordinate; 1 where all are one. */
double long_force_extent(int64_t particles, const double *q);

#endif
