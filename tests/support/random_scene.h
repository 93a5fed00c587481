/* Random valid systems, built through the public interface, with their canonical twin. */
#pragma once

#include "hooke.h"
#include "canonical.h"

/* Features of a scene; the rest is drawn from the seed. */
enum {
  SCENE_GRAVITY = 1,
  SCENE_DRAG = 2,
  SCENE_DAMPING = 4,
  SCENE_PULL_ONLY = 8,
  SCENE_PINNED = 16,
  SCENE_DRIVEN = 32, /* up to three particles: harmonic, table, callback */
  SCENE_CALLBACK = 64,
  SCENE_COINCIDENT = 128, /* some coincident particles */
  SCENE_EVERYTHING = 255,
  SCENE_FOLLOWS = 256 /* beyond everything: springs that follow time, as canonical.h has them */
};

/* What particles move in: drag of each, a wind, quadratic drag of each, and parts in a fluid. */
enum { MEDIUM_DRAG = 1, MEDIUM_WIND = 2, MEDIUM_QUADRATIC = 4, MEDIUM_FLUID = 8 };

struct random_scene_request {
  uint64_t seed;
  int64_t particles, springs;
  int64_t triples;    /* of bending; if there are any, parts have bending as well */
  int64_t tetrahedra; /* of altitude springs; damped and pulling only like springs */
  int64_t anchors;    /* damped like springs */
  int64_t loads;      /* constant, harmonic and by tables, in turn */
  int32_t factors;    /* 1: factors of gravity */
  int32_t features;
  int32_t cloth[2];     /* size of a cloth that is added as a part; 0: none */
  int32_t lattice[3];   /* size of a lattice that is added as a part; 0: none */
  int32_t rope;         /* segments of a rope that is added as a part; 0: none */
  int32_t with_product; /* the callback has its derivative */
  int32_t medium;
};

struct random_scene {
  hooke_system *system; /* committed */
  struct canonical canonical;
  int64_t driven_count;
  int64_t driven[3];
  hooke_integrator
      *driver; /* of any method: it moves driven particles to their positions at the time of a state */
  hooke_state *driven_state;
  double gravity[3], wind[3];
  hooke_system *loads;       /* of canonical.loads */
  double *factor;            /* canonical.factor */
  double *drags, *quadratic; /* NULL: none */
};

void random_scene_create(struct random_scene_request request, struct random_scene *scene);
void random_scene_destroy(struct random_scene *scene);
/* By the members of a request: random_scene_with(&scene, .seed = 5, .particles = 10). */
#define random_scene_with(scene, ...) random_scene_create((struct random_scene_request){__VA_ARGS__}, (scene))
/* Destroyed where its block ends. */
#define owned_random_scene __attribute__((cleanup(random_scene_destroy))) struct random_scene

/* Positions and velocities (3n each) near the initial ones; coincident ends still coincide, constrained
 * particles stay. */
void random_scene_shake(const struct random_scene *scene, uint64_t seed, double *q, double *v);

/* The callback of scenes with SCENE_CALLBACK: a pull to the origin, a push that grows with time, and a brake.
 * It reads its arguments only, so it may run in many threads. */
int32_t random_scene_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx);
int32_t random_scene_force_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                                   const double *dv, double *out, void *ctx);
