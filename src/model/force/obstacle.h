/* Obstacles: planes, spheres and cylinders that push particles out along their normal (force_obstacle.c). */
#pragma once

#include "model/course.h"

struct hooke_system;

enum hk_shape { HOOKE_PLANE, HOOKE_SPHERE, HOOKE_CYLINDER };

struct hk_obstacle {
  enum hk_shape shape;
  double point[3], axis[3]; /* a point of the plane or of the axis, or the centre; the unit normal or axis */
  double radius, stiffness, damping, friction, friction_speed, clearance;
  int32_t moves; /* 1: by `course`, the displacement */
  struct hk_course course;
  int64_t count;          /* of its particles; -1: all free ones */
  int32_t *particle;      /* `count`; NULL: all */
  hooke_options *options; /* as given */
};

struct hk_obstacles {
  int64_t count;
  struct hk_obstacle *obstacle;
};

/* The lightest free particle of the first obstacle from `number` on that none touches at q (3n) and time t;
 * -1 if there is none. `number` becomes that of the obstacle. */
int64_t hk_obstacles_untouched(const struct hooke_system *system, double t, const double *q, int64_t *number);

/* Free particles at the centre or on the axis of an obstacle at time t, where there is no direction. */
int64_t hk_obstacles_without_direction(const struct hooke_system *system, double t, const double *q);

void hk_obstacles_release(struct hk_obstacles *obstacles);
