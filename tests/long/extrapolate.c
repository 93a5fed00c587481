/* The motion of a scene by extrapolation in long double: extrapolate SCENE TOLERANCE EVALUATIONS TIME ... <
 * FACTS Prints JSON: times, positions (one row of 3n numbers a time), free particles, steps and evaluations;
 * returns 1 if the evaluations do not suffice.
 *
 * Facts that a system has no queries for are passed from the scene as FACTS, one a line:
 *   gravity X Y Z | drag C | pulls NUMBER | pulls-named NAME | harmonic PARTICLE X Y Z FREQUENCY PHASE
 *   table PARTICLE SAMPLES, then TIME X Y Z for each of them */
#include "canonical.h"
#include "check.h"
#include "long_force.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct facts {
  double gravity[3];
  struct long_drive *drive;
  int64_t drive_count;
};

static void leave(const char *what) {
  fprintf(stderr, "extrapolate: %s\n", what);
  exit(2);
}

static void need(int held, const char *what) {
  if (!held) leave(what);
}

static double number(void) {
  double value = 0.0;
  need(scanf("%lf", &value) == 1, "a number is missing");
  return value;
}

/* Groups of springs or tetrahedra of that name, or the spring group of that number. */
static void let_pull(const hooke_system *system, struct canonical *canonical, const char *name,
                     int64_t number) {
  int64_t found = 0, at = 0;
  for (int64_t g = 0; g < hooke_system_group_count(system, "springs"); g++) {
    const int64_t size = hooke_system_group_size(system, "springs", g);
    const int asked =
        name != NULL ? strcmp(hooke_system_group_name(system, "springs", g), name) == 0 : g == number;
    if (asked) memset(canonical->pull_only + at, 1, (size_t)size);
    found += asked;
    at += size;
  }
  at = 0;
  for (int64_t g = 0; name != NULL && g < hooke_system_group_count(system, "altitude"); g++) {
    const int64_t size = hooke_system_group_size(system, "altitude", g);
    const int asked = strcmp(hooke_system_group_name(system, "altitude", g), name) == 0;
    if (asked) memset(canonical->altitude_pull_only + at, 1, (size_t)size);
    found += asked;
    at += size;
  }
  need(found == 1, "there is no such group");
}

static void read_drive(struct facts *facts, int by_table) {
  facts->drive = realloc(facts->drive, (size_t)(facts->drive_count + 1) * sizeof *facts->drive);
  need(facts->drive != NULL, "no memory");
  struct long_drive *drive = &facts->drive[facts->drive_count++];
  memset(drive, 0, sizeof *drive);
  drive->particle = (int64_t)number();
  if (!by_table) {
    for (int a = 0; a < 3; a++)
      drive->amplitude[a] = number();
    drive->frequency = number();
    drive->phase = number();
    return;
  }
  drive->samples = (int64_t)number();
  need(drive->samples >= 2, "a table has two samples or more");
  drive->time = new_doubles(drive->samples);
  drive->displacement = new_doubles(3 * drive->samples);
  for (int64_t k = 0; k < drive->samples; k++) {
    drive->time[k] = number();
    for (int a = 0; a < 3; a++)
      drive->displacement[3 * k + a] = number();
  }
}

static void read_facts(const hooke_system *system, struct canonical *canonical, struct facts *facts) {
  char word[32], name[512];
  while (scanf("%31s", word) == 1) {
    if (strcmp(word, "gravity") == 0) {
      for (int a = 0; a < 3; a++)
        facts->gravity[a] = number();
      canonical->gravity = facts->gravity;
    } else if (strcmp(word, "drag") == 0) {
      canonical->drag = number();
    } else if (strcmp(word, "pulls") == 0) {
      let_pull(system, canonical, NULL, (int64_t)number());
    } else if (strcmp(word, "pulls-named") == 0) {
      need(scanf(" %511[^\n]", name) == 1, "a name is missing");
      let_pull(system, canonical, name, -1);
    } else if (strcmp(word, "harmonic") == 0 || strcmp(word, "table") == 0) {
      read_drive(facts, strcmp(word, "table") == 0);
    } else {
      leave(word);
    }
  }
}

/* Of positions, or of springs, where the motion begins with particles side by side. */
static double find_extent(const struct canonical *canonical, const double *q) {
  double extent = long_force_extent(canonical->particle_count, q);
  for (int64_t k = 0; k < canonical->spring_count; k++)
    extent = fmax(extent, 0.5 * canonical->rest_length[k]);
  return extent;
}

/* The bodies of a system, each with one pinned particle at most. */
static struct long_body *find_bodies(const hooke_system *system, struct long_force *force) {
  force->body_count = hooke_system_count(system, "bodies");
  struct long_body *bodies = new_block(force->body_count, (int64_t)sizeof *bodies);
  for (int64_t b = 0; b < force->body_count; b++) {
    struct long_body *body = &bodies[b];
    body->count = hooke_system_body_particles(system, b, NULL);
    body->particle = new_block(body->count, (int64_t)sizeof(int64_t));
    hooke_system_body_particles(system, b, body->particle);
    body->pivot = -1;
    for (int64_t k = 0; k < body->count; k++) {
      if (force->canonical->inverse_mass[body->particle[k]] != 0.0) continue;
      need(body->pivot < 0, "a body has two pinned particles");
      body->pivot = body->particle[k];
    }
  }
  force->body = bodies;
  return bodies;
}

static void free_bodies(struct long_body *bodies, int64_t count) {
  for (int64_t b = 0; b < count; b++)
    free(bodies[b].particle);
  free(bodies);
}

static void print_state(double time, int64_t size, const long double *q, int first) {
  printf("%s{\"time\": %.17g, \"position\": [", first ? "" : ", ", time);
  for (int64_t k = 0; k < size; k++)
    printf("%s%.21Lg", k > 0 ? ", " : "", q[k]);
  printf("]}");
}

/* A state begins at the prescribed positions of driven particles; these are the positions they were added at.
 */
static double *origin(const struct facts *facts, const hooke_state *state, int64_t size) {
  double *q = new_doubles(size);
  memcpy(q, hooke_state_position(state), (size_t)size * sizeof *q);
  for (int64_t k = 0; k < facts->drive_count; k++) {
    long double d[3], u[3];
    long_drive_move(&facts->drive[k], 0.0L, d, u);
    for (int a = 0; a < 3; a++)
      q[3 * facts->drive[k].particle + a] -= (double)d[a];
  }
  return q;
}

static int32_t follow(struct long_force *force, const hooke_state *state, char **words, int count) {
  const int64_t size = 3 * force->canonical->particle_count;
  struct extrapolation problem = {.size = 2 * size,
                                  .rate = long_force_rate,
                                  .scale = long_force_scale,
                                  .ctx = force,
                                  .tolerance = strtold(words[0], NULL),
                                  .most_evaluations = (int64_t)strtod(words[1], NULL)};
  long double *y = new_block(2 * size, (int64_t)sizeof *y), t = 0.0L, step = 1e-6L;
  int32_t result = 0;
  for (int64_t k = 0; k < size; k++) {
    y[k] = force->origin[k];
    y[size + k] = hooke_state_velocity(state)[k];
  }
  printf("{\"states\": [");
  for (int k = 2; k < count && result == 0; k++) {
    const double end = strtod(words[k], NULL);
    result = extrapolate(&problem, t, end, &step, y);
    if (result == 0) print_state(end, size, y, k == 2);
    t = end;
  }
  printf("], \"free\": [");
  for (int64_t p = 0, some = 0; p < size / 3; p++) {
    if (force->canonical->inverse_mass[p] != 0.0) printf("%s%lld", some++ ? ", " : "", (long long)p);
  }
  printf("], \"steps\": %lld, \"rejected\": %lld, \"evaluations\": %lld}\n", (long long)problem.steps,
         (long long)problem.rejected, (long long)problem.evaluations);
  free(y);
  return result;
}

int main(int argc, char **argv) {
  need(argc > 4, "needs a scene, a tolerance, the evaluations it may take and a time");
  owned_scene *scene = NULL;
  owned_state *state = NULL;
  need(hooke_scene_load(argv[1], NULL, &scene) == HOOKE_OK && hooke_scene_commit(scene) == HOOKE_OK,
       hooke_last_error());
  const hooke_system *system = hooke_scene_system(scene);
  need(hooke_state_create(system, &state) == HOOKE_OK, hooke_last_error());
  owned_canonical canonical;
  struct facts facts = {0};
  canonical_create(system, &canonical);
  memset(canonical.pull_only, 0, (size_t)canonical.spring_count);
  memset(canonical.altitude_pull_only, 0, (size_t)canonical.tetrahedron_count);
  read_facts(system, &canonical, &facts);
  owned_doubles *q = origin(&facts, state, 3 * canonical.particle_count);
  struct long_force force = {.canonical = &canonical,
                             .drive_count = facts.drive_count,
                             .drive = facts.drive,
                             .origin = q,
                             .extent = find_extent(&canonical, q)};
  if (strcmp(hooke_system_dynamics(system), "overdamped") == 0) force.mass = hooke_system_mass(system);
  struct long_body *bodies = find_bodies(system, &force);
  const int32_t result = follow(&force, state, argv + 2, argc - 2);
  for (int64_t k = 0; k < facts.drive_count; k++) {
    free(facts.drive[k].time);
    free(facts.drive[k].displacement);
  }
  free(facts.drive);
  free_bodies(bodies, force.body_count);
  return result == 0 ? 0 : 1;
}
