/* Small scenes, one a law or force, at points where the forces are smooth. */
#pragma once

#include "hooke/system.h"

enum {
  LAW_PARTICLES = 12,
  LAW_SPRINGS = 24,
  LAW_TRIPLES = 10,
  LAW_TETRAHEDRA = 6,
  LAW_ANCHORS = 8,
  LAW_SIZE = 3 * LAW_PARTICLES
};

struct law {
  const char *name, *law;
  int32_t zero_rest, damped, pull_only, gravity, drag;
  int32_t callback; /* 1: without a product, 2: with one */
  int32_t bending, altitude, anchors, loads, factors, obstacles;
  int32_t curve;   /* 1: by coefficients, in place of the stiffness */
  int32_t follows; /* 1: springs follow time, and are those of the others at LAW_TIME */
};

#define LAW_TIME 0.3
enum { LAW_COUNT = 27 };
extern const struct law laws[LAW_COUNT];

struct law_scene {
  hooke_system *system; /* committed; the last particle is pinned */
  double q[LAW_SIZE], v[LAW_SIZE];
  int64_t ends[2 * LAW_SPRINGS];
  int64_t slack, unloaded, taut; /* springs that only pull: short, long but pushed by damping, pulling */
};

/* Every point closer than 0.03 to (q, v) in each component is on the same side of every switch of a spring
 * that only pulls. */
void law_scene_create(const struct law *law, uint64_t seed, struct law_scene *scene);
void law_scene_destroy(struct law_scene *scene);
/* Destroyed where its block ends. */
#define owned_law_scene __attribute__((cleanup(law_scene_destroy))) struct law_scene

/* Derivative at 0 of g(s) (count numbers), by central differences at h, h/2, h/4, h/8 extrapolated to order
 * 8. */
typedef void law_curve(double s, double *value, void *ctx);
void differentiate(int64_t count, law_curve *curve, double h, void *ctx, double *derivative);
