/* A rest: where the forces of a scene are in equilibrium, whether its energy is least there, and what one
 * watches. */
#pragma once

#include "measure/measurement.h"
#include "measure/modes/modes.h"
#include "measure/quantity/watched.h"
#include "measure/rest/rest_find.h"

/* Larger scenes have no modes here, but for the sign of the lowest: finding them may take many times as long
 * as the rest. */
enum { HOOKE_REST_PARTICLES = 4000 };

struct hk_rest_watched {
  const char *quantity, *unit;
  double value;
};

struct hk_resting {
  struct hk_modes modes; /* about the position; none before it is known */
  const hooke_measurement *m;
  struct hk_watched_list watched;
  struct hk_rest_watched *value; /* by quantity */
  double *number;                /* the same, as they are computed */
  struct hk_rest rest;
  double time;      /* of the start [s] */
  double *position; /* 3n, of the last run; NULL before */
  int32_t minimum;  /* -1: not known */
  int32_t had_friction;
};

/* 1 if it has more free particles than that. */
int32_t hk_rest_is_large(const struct hk_resting *resting);

void hk_rest_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_table hk_rest_tables[];
extern const struct hk_measurement_kind hk_rest_kind;
