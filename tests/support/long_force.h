/* The accelerations of canonical.h in long double, with prescribed motions, as a rate for extrapolation.h. */
#pragma once

#include "canonical.h"
#include "extrapolation.h"

/* A driven particle and its initial position. */
struct long_drive {
  int64_t particle;
  double amplitude[3], frequency, phase; /* harmonic */
  int64_t samples;                       /* 0: harmonic */
  double *time, *displacement;           /* samples, 3 samples */
};

/* Displacement from there at t, and velocity. */
void long_drive_move(const struct long_drive *drive, long double t, long double d[3], long double u[3]);

/* A rigid body, whose particles are not in a line. */
struct long_body {
  int64_t count, *particle, pivot; /* the one pinned particle, or -1 */
};

struct long_force {
  const struct canonical *canonical; /* including its gravity and drag; it has no callback */
  int64_t drive_count;
  const struct long_drive *drive;
  const double *origin; /* 3n: initial positions */
  double extent;        /* [m] scale of position errors */
  const double *mass;   /* of an overdamped system, whose velocities stay as they are; NULL: inertial */
  int64_t body_count;
  const struct long_body *body;
};

/* Y is the positions, then the velocities, 6n together; both are of struct long_force. */
void long_force_rate(long double t, long double *y, long double *f, void *ctx);
void long_force_scale(const long double *y, const long double *f, long double *scale, void *ctx);

/* Half the largest distance between two of the positions, coordinate by coordinate; 1 if all coincide. */
double long_force_extent(int64_t particles, const double *q);
