/* A race on one scene: all entrants step it in turns, so that they see the same machine. */
#pragma once

#include "scenes.h"

enum { MOST_METHODS = 8, MOST_THREADS = 16, MOST_ROWS = MOST_METHODS * MOST_THREADS };

struct race_request {
  double seconds; /* for the turns of each row */
  int method_count, thread_count;
  const char *method[MOST_METHODS];
  int32_t threads[MOST_THREADS];
};

struct race_time { /* of a step [s]; NaN: none */
  double least, median;
};

struct race_row {
  const struct bench_scene *scene;
  const char *method;
  int32_t threads, is_damped, turns;
  int64_t particles, springs;
  double step;            /* [s] */
  double evaluations;     /* of forces, a step */
  struct race_time own;   /* of the library */
  struct race_time plain; /* of the plain loop, on one thread */
  double distance;        /* largest of a component [m], after the same steps; NaN without plain loop */
  double allowed;         /* the part explained by rounding [m] */
};

/* Measures a row for each number of threads and each method that has a stable step on the scene; `row` has
 * space for MOST_ROWS. Returns a status; HOOKE_DIVERGED if a timed motion did not stay finite. */
int32_t race_run(const struct bench_scene *scene, const struct race_request *request, struct race_row *row,
                 int *count);
