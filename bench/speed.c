/* Cost of a step, per spring, against a plain loop over an array of springs, both in one run:
 *
 *   speed [--seconds S] [--threads N] [--method M] [--csv] [SCENE ...]
 *
 * For each scene the library and the plain loop take turns for S seconds (2 if not given); minimum and median are over
 * those turns. Bytes are what a step has to move when nothing stays in a cache: positions and velocities in and out, masses
 * in. The plain loop is symplectic Euler whatever the method. */
#include "bandwidth.h"
#include "baseline.h"
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_TURNS = 400, MOST_NAMES = 32, LEAST_STEPS = 25 };
static const double TURN = 0.02; /* [s] */

struct request {
  double seconds;
  const char *method;
  int32_t threads, csv;
  int name_count;
  const char *name[MOST_NAMES];
};

struct times {
  int64_t steps; /* of a turn */
  int count;
  double turn[MOST_TURNS]; /* [s] */
};

struct measured {
  int64_t particles, springs;
  struct times own, plain;
  double distance; /* largest, of the two after the same few steps */
};

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double least(const struct times *times) {
  return times->turn[0] / (double)times->steps;
}

static double median(const struct times *times) {
  return times->turn[times->count / 2] / (double)times->steps;
}

/* Steps that take about a turn, and not so few that loading and storing a state would show. */
static int64_t steps_of(double seconds_a_step) {
  const double steps = TURN / seconds_a_step;
  return steps < LEAST_STEPS ? LEAST_STEPS : (int64_t)steps;
}

struct race {
  hooke_system *system;
  hooke_options *options;
  hooke_integrator *integrator;
  hooke_state *state;
  struct baseline *plain;
  double step;
};

static int32_t own_turn(struct race *race, struct times *times) {
  const double begun = bench_seconds();
  const int32_t status = hooke_integrator_step(race->integrator, race->state, times->steps);
  times->turn[times->count++] = bench_seconds() - begun;
  return status;
}

static void plain_turn(struct race *race, struct times *times) {
  const double begun = bench_seconds();
  baseline_step(race->plain, race->step, times->steps);
  times->turn[times->count++] = bench_seconds() - begun;
}

static int32_t prepare(const struct bench_scene *scene, const struct request *request, struct race *race) {
  double bound = NAN;
  int32_t status = bench_scene_create(scene, &race->system);
  if (status == HOOKE_OK) status = hooke_state_create(race->system, &race->state);
  if (status == HOOKE_OK) {
    status = hooke_step_bound(race->system, "symplectic-euler", hooke_state_position(race->state), &bound);
  }
  race->step = 0.5 * bound;
  if (status == HOOKE_OK) status = hooke_run_options_create(&race->options);
  if (status == HOOKE_OK) status = hooke_options_set_text(race->options, "method", request->method);
  if (status == HOOKE_OK) status = hooke_options_set_number(race->options, "step", race->step);
  if (status == HOOKE_OK) status = hooke_options_set_number(race->options, "threads", request->threads);
  if (status == HOOKE_OK) status = hooke_integrator_create(race->system, race->options, &race->integrator);
  race->plain = status == HOOKE_OK ? baseline_create(race->system) : NULL;
  return status == HOOKE_OK && race->plain == NULL ? HOOKE_NO_MEMORY : status;
}

static double largest_distance(const struct race *race) {
  const double *q = hooke_state_position(race->state), *other = baseline_position(race->plain);
  double most = 0.0;
  for (int64_t k = 0; k < hooke_state_size(race->state); k++)
    most = fmax(most, fabs(q[k] - other[k]));
  return most;
}

static int32_t take_turns(struct race *race, double seconds, struct measured *found) {
  struct times *own = &found->own, *plain = &found->plain;
  own->steps = plain->steps = 3;
  int32_t status = own_turn(race, own);
  plain_turn(race, plain);
  found->distance = largest_distance(race);
  own->steps = steps_of(own->turn[0] / 3.0);
  plain->steps = steps_of(plain->turn[0] / 3.0);
  if (status == HOOKE_OK) status = own_turn(race, own); /* warm-up */
  plain_turn(race, plain);
  own->steps = steps_of(own->turn[1] / (double)own->steps);
  plain->steps = steps_of(plain->turn[1] / (double)plain->steps);
  own->count = plain->count = 0;
  const double begun = bench_seconds();
  while (status == HOOKE_OK && own->count < MOST_TURNS &&
         (own->count < 3 || bench_seconds() - begun < seconds)) {
    status = own_turn(race, own);
    plain_turn(race, plain);
  }
  qsort(own->turn, (size_t)own->count, sizeof(double), by_size);
  qsort(plain->turn, (size_t)plain->count, sizeof(double), by_size);
  return status;
}

static int32_t measure(const struct bench_scene *scene, const struct request *request,
                       struct measured *found) {
  struct race race = {0};
  int32_t status = prepare(scene, request, &race);
  if (status == HOOKE_OK) {
    found->particles = hooke_system_particle_count(race.system);
    found->springs = hooke_system_spring_count(race.system);
    status = take_turns(&race, request->seconds, found);
  }
  baseline_destroy(race.plain);
  hooke_integrator_destroy(race.integrator);
  hooke_options_destroy(race.options);
  hooke_state_destroy(race.state);
  hooke_system_destroy(race.system);
  return status;
}

static void print(const struct bench_scene *scene, const struct request *request, const struct measured *m,
                  double bandwidth) {
  const double springs = (double)m->springs, particles = (double)m->particles;
  const double bytes = 13.0 * 8.0 * particles, own = median(&m->own);
  const char *format = request->csv
                           ? "%s,%s,%d,%lld,%lld,%.4g,%.4g,%.4g,%.4g,%.4g,%.3g,%.3g,%.3g\n"
                           : "%-20s %-16s %7d %9lld %9lld %8.3f %8.3f %8.3f %8.3f %7.2f %10.3g %8.3g %9.2g\n";
  printf(format, scene->name, request->method, (int)request->threads, (long long)m->particles,
         (long long)m->springs, 1e9 * least(&m->own) / springs, 1e9 * own / springs,
         1e9 * least(&m->plain) / springs, 1e9 * median(&m->plain) / springs, median(&m->plain) / own,
         particles / own, bytes / own / bandwidth, m->distance);
  fflush(stdout);
}

static int is_wanted(const struct request *request, const char *name) {
  int wanted = request->name_count == 0;
  for (int k = 0; k < request->name_count; k++)
    wanted |= strcmp(request->name[k], name) == 0;
  return wanted;
}

static int read_request(int argc, char **argv, struct request *request) {
  *request = (struct request){.seconds = 2.0, .method = "symplectic-euler", .threads = 1};
  for (int k = 1; k < argc; k++) {
    const int more = k + 1 < argc;
    if (strcmp(argv[k], "--csv") == 0)
      request->csv = 1;
    else if (strcmp(argv[k], "--seconds") == 0 && more)
      request->seconds = strtod(argv[++k], NULL);
    else if (strcmp(argv[k], "--threads") == 0 && more)
      request->threads = (int32_t)strtol(argv[++k], NULL, 10);
    else if (strcmp(argv[k], "--method") == 0 && more)
      request->method = argv[++k];
    else if (argv[k][0] != '-' && request->name_count < MOST_NAMES)
      request->name[request->name_count++] = argv[k];
    else
      return 0;
  }
  return 1;
}

int main(int argc, char **argv) {
  struct request request;
  if (!read_request(argc, argv, &request)) {
    fprintf(stderr, "speed [--seconds S] [--threads N] [--method M] [--csv] [SCENE ...]\n");
    return 2;
  }
  const double bandwidth = bandwidth_measure();
  printf("# hooke %s (%s), %s, loops for %s, triad %.1f GB/s\n", hooke_version(), BENCH_COMMIT,
         BENCH_COMPILER, hooke_build_fact("instructions"), 1e-9 * bandwidth);
  printf(request.csv
             ? "scene,method,threads,particles,springs,ns_min,ns_median,plain_ns_min,plain_ns_median,ratio,"
               "particle_steps_per_second,bandwidth_share,distance\n"
             : "scene                method           threads particles   springs   ns min   median    "
               "plain   median   ratio  particles/s  of triad  distance\n");
  for (int64_t k = 0; bench_scene(k); k++) {
    if (!is_wanted(&request, bench_scene(k)->name)) continue;
    struct measured *found = calloc(1, sizeof *found);
    const int32_t status = found ? measure(bench_scene(k), &request, found) : HOOKE_NO_MEMORY;
    if (status == HOOKE_OK) print(bench_scene(k), &request, found, bandwidth);
    free(found);
    if (status == HOOKE_OK) continue;
    fprintf(stderr, "%s: %s\n", bench_scene(k)->name, hooke_last_error());
    return 1;
  }
  return 0;
}
