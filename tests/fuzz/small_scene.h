/* Small scenes made from any bytes: a head, records of the contents, and numbers that replace others.
 * Contents that the library refuses are left out, so the scene is valid. */
#pragma once

#include "canonical.h"

#include "hooke.h"

#include <stddef.h>
#include <stdint.h>

enum { SCENE_HEAD = 8, SCENE_RECORD = 8, MOST_PARTICLES = 128, MOST_SPRINGS = 400, MOST_RECORDS = 12 };

struct small_scene {
  hooke_system *system; /* committed */
  struct canonical canonical;
  int64_t particles;
  double q[3 * MOST_PARTICLES], v[3 * MOST_PARTICLES], mass[MOST_PARTICLES], gravity[3];
  int32_t extreme;          /* numbers of any size: forces may overflow, difference quotients fail */
  int32_t pulls;            /* some member only pulls */
  hooke_integrator *driver; /* moves driven particles to their positions; NULL: there are none */
  hooke_state *driven;
};

/* 0 if the bytes give no scene. */
int small_scene_create(const uint8_t *data, size_t size, struct small_scene *scene);
void small_scene_destroy(struct small_scene *scene);

/* For LLVMFuzzerCustomMutator: keeps records well-formed. */
size_t small_scene_mutate(uint8_t *data, size_t size, size_t most, unsigned seed);

/* For LLVMFuzzerCustomCrossOver: the head of one of two scenes and about half of the records of each. */
size_t small_scene_cross(const uint8_t *one, size_t one_size, const uint8_t *two, size_t two_size,
                         uint8_t *out, size_t most, unsigned seed);
