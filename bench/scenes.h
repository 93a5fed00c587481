/* The scenes of the table. */
#pragma once

#include "hooke.h"

struct bench_scene {
  const char *name;
  int32_t (*build)(hooke_system *system, int64_t size, double damping);
  int64_t size;
  double damping; /* [N s]; 0: none */
  int has_more;   /* 1: measured with all explicit methods by default */
};

/* NULL past the last. */
const struct bench_scene *bench_scene(int64_t number);

/* Creates the committed system, with gravity; the caller owns it. Returns a status. */
int32_t bench_scene_create(const struct bench_scene *scene, hooke_system **system);
