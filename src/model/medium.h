/* The medium that particles move in: coefficients of its drag, and the wind. */
#pragma once

#include "model/course.h"

struct hk_variant_maker;
struct hooke_system;

/* A number >= 0 of all particles, or one of each. */
struct hk_each {
  double most; /* the largest */
  int64_t count;
  double *value; /* `count`; NULL: all have `most` */
};

struct hk_medium {
  struct hk_each drag, quadratic_drag; /* [N s/m], [kg/m] */
  int32_t blows;                       /* 1: there is a wind */
  struct hk_course wind;               /* [m/s] */
};

static inline double hk_each_at(const struct hk_each *each, int64_t k) {
  return each->value ? each->value[k] : each->most;
}

/* Take one number, or one a particle. HOOKE_BAD_VALUE at "drag[k]" and so on, HOOKE_NO_MEMORY. */
int32_t hk_medium_set_drag(struct hooke_system *system, int64_t count, const double *value);
int32_t hk_medium_set_quadratic_drag(struct hooke_system *system, int64_t count, const double *value);
/* `velocity` of all times, without samples, or one for each. HOOKE_BAD_VALUE at "wind.time[k]" and so on. */
int32_t hk_medium_set_wind(struct hooke_system *system, int64_t samples, const double *time,
                           const double *velocity);

/* HOOKE_BAD_VALUE unless there is one number, or one for each particle. */
int32_t hk_medium_check(const struct hooke_system *system);
void hk_medium_release(struct hk_medium *medium);

/* Give them to a variant. HOOKE_UNSUITED where it has particles that lie between those of the system. */
int32_t hk_medium_copy_drag(const struct hk_variant_maker *maker);
int32_t hk_medium_copy_quadratic_drag(const struct hk_variant_maker *maker);
int32_t hk_medium_copy_wind(const struct hk_variant_maker *maker);

/* The velocity of the medium. */
void hk_wind_at(const struct hooke_system *system, double t, double wind[3]);

/* Adds coefficients (NULL: none), and the wind, to a check value. */
void hk_medium_check_value(const struct hooke_system *system, const struct hk_each *each, uint32_t *value);
