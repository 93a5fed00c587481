#include "limits.h"

#include "clock.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

enum {
  TRIAD = 1 << 23,     /* elements of an array of a thread */
  SMALL = 480,         /* elements of an array that stays in the first-level cache */
  SWEEPS = 4000,       /* over a small array, a turn */
  OPERATIONS = 2 * 64, /* per element in a sweep of arithmetic() */
  SIDE = 48,           /* elements side by side there */
  TURNS = 7
};

struct worker {
  pthread_t thread;
  double *a, *b, *c;
};

/* ---- the loops: a turn of one thread ---- */

static void *fill(void *ctx) {
  const struct worker *w = ctx;
  for (size_t k = 0; k < TRIAD; k++) {
    w->a[k] = 0.0;
    w->b[k] = 1.0 + (double)(k % 7);
    w->c[k] = 2.0 + (double)(k % 5);
  }
  return NULL;
}

static void *triad(void *ctx) {
  const struct worker *w = ctx;
  double *restrict a = w->a;
  const double *restrict b = w->b, *restrict c = w->c;
  const double s = w->b[0];
  for (size_t k = 0; k < TRIAD; k++)
    a[k] = b[k] + s * c[k];
  return NULL;
}

/* Each sweep reads the results of the previous one, so that none can be optimised away. */
static void *root(void *ctx) {
  const struct worker *w = ctx;
  double *restrict a = w->a;
  const double *restrict b = w->b;
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    for (int k = 0; k < SMALL; k++)
      a[k] = b[k] / sqrt(a[k]);
  }
  return NULL;
}

/* Chains of operations, as many side by side as hide their latency. */
static void *arithmetic(void *ctx) {
  const struct worker *w = ctx;
  double *restrict a = w->a;
  const double s = w->b[0] * 0.5, t = w->b[0] * 0.25;
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    for (int k = 0; k < SMALL; k += SIDE) {
      double x[SIDE];
      for (int i = 0; i < SIDE; i++)
        x[i] = a[k + i];
      for (int operation = 0; operation < OPERATIONS / 2; operation++) {
        for (int i = 0; i < SIDE; i++)
          x[i] = x[i] * s + t;
      }
      for (int i = 0; i < SIDE; i++)
        a[k + i] = x[i];
    }
  }
  return NULL;
}

/* ---- all threads ---- */

/* Time until all threads have done `work` once [s]; 0 if they could not be started. */
static double together(struct worker *worker, int32_t threads, void *(*work)(void *)) {
  int32_t started = 0;
  const double begun = bench_work_seconds(threads);
  while (started + 1 < threads && pthread_create(&worker[started].thread, NULL, work, &worker[started]) == 0)
    started++;
  if (started + 1 == threads) work(&worker[started]);
  for (int32_t k = 0; k < started; k++)
    pthread_join(worker[k].thread, NULL);
  return started + 1 == threads ? bench_work_seconds(threads) - begun : 0.0;
}

/* Minimum time of a turn, over the `count` operations that all threads do in it; 0 if threads could not be
 * started. */
static double least(struct worker *worker, int32_t threads, void *(*work)(void *), double count) {
  double best = INFINITY;
  for (int turn = 0; turn < TURNS; turn++)
    best = fmin(best, together(worker, threads, work));
  return best / (count * threads);
}

int limits_measure(int32_t threads, struct limits *limits) {
  struct worker *worker = calloc((size_t)threads, sizeof *worker);
  double *room = malloc(3 * sizeof(double) * TRIAD * (size_t)threads);
  int done = worker && room;
  for (int32_t k = 0; done && k < threads; k++) {
    worker[k].a = room + 3 * (size_t)TRIAD * (size_t)k;
    worker[k].b = worker[k].a + TRIAD;
    worker[k].c = worker[k].b + TRIAD;
  }
  done = done && together(worker, threads, fill) > 0.0;
  if (done) {
    limits->bandwidth = 24.0 / least(worker, threads, triad, TRIAD);
    limits->root = least(worker, threads, root, (double)SMALL * SWEEPS);
    limits->arithmetic = least(worker, threads, arithmetic, (double)SMALL * SWEEPS * OPERATIONS);
    done = isfinite(limits->bandwidth) && limits->root > 0.0 && limits->arithmetic > 0.0;
  }
  free(room);
  free(worker);
  return done;
}
