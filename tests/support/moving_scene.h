/* Small moving scenes, each with something that a run has to remember: for tests that compare all methods. */
#pragma once

#include "hooke.h"

struct moving_scene {
  const char *name, *kind, *options; /* of a part: "size=6,6 mass=0.1 ..." */
  double step; /* at which every method is stable, backward Euler and forward Euler for a while */
  int32_t gravity, drag;
  int32_t driven;   /* 1: the last particle by a sine, 2: by a table, 3: by a callback */
  int32_t callback; /* a callback force with its derivative */
};

enum { MOVING_SCENES = 8, MOVING_LARGE = 8 };
extern const struct moving_scene moving_scenes[MOVING_SCENES + 1]; /* large enough for two threads */

/* A committed system. */
hooke_system *moving_system(const struct moving_scene *scene);
