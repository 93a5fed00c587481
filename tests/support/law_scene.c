#include "law_scene.h"

#include "check.h"
#include "small.h"
#include "random.h"
#include "random_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const struct law laws[LAW_COUNT] = {
    {.name = "strain law", .law = "strain"},
    {.name = "strain law, damped", .law = "strain", .damped = 1},
    {.name = "length law", .law = "length"},
    {.name = "length law, damped", .law = "length", .damped = 1},
    {.name = "length law, no rest length", .law = "length", .zero_rest = 1, .damped = 1},
    {.name = "strain law, pull only", .law = "strain", .pull_only = 1},
    {.name = "strain law, pull only, damped", .law = "strain", .pull_only = 1, .damped = 1},
    {.name = "length law, pull only, damped", .law = "length", .pull_only = 1, .damped = 1},
    {.name = "gravity and drag", .law = "strain", .damped = 1, .gravity = 1, .drag = 1},
    {.name = "callback", .law = "strain", .damped = 1, .callback = 1},
    {.name = "callback with product", .law = "length", .damped = 1, .gravity = 1, .drag = 1, .callback = 2},
    {.name = "bending", .law = "strain", .bending = 1},
    {.name = "bending of all kinds", .law = "length", .damped = 1, .gravity = 1, .drag = 1, .bending = 1},
    {.name = "altitude springs", .law = "strain", .altitude = 1},
    {.name = "altitude springs, damped",
     .law = "length",
     .damped = 1,
     .gravity = 1,
     .drag = 1,
     .altitude = 1},
    {.name = "altitude springs, pull only, damped",
     .law = "strain",
     .pull_only = 1,
     .damped = 1,
     .altitude = 1},
    {.name = "anchors", .law = "strain", .anchors = 1},
    {.name = "anchors, damped", .law = "length", .damped = 1, .gravity = 1, .anchors = 1},
    {.name = "loads", .law = "length", .gravity = 1, .loads = 1},
    {.name = "factors of gravity", .law = "strain", .gravity = 1, .factors = 1},
    {.name = "curve", .law = "strain", .damped = 1, .curve = 1},
    {.name = "curve, no rest length", .law = "length", .zero_rest = 1, .damped = 1, .curve = 1},
    {.name = "curve, pull only", .law = "length", .pull_only = 1, .curve = 1},
    {.name = "strain law in time, damped", .law = "strain", .damped = 1, .follows = 1},
    {.name = "length law in time, pull only, damped",
     .law = "length",
     .damped = 1,
     .pull_only = 1,
     .follows = 1},
    {.name = "obstacles", .law = "strain", .obstacles = 1},
    {.name = "obstacles, damped", .law = "length", .damped = 1, .gravity = 1, .obstacles = 1},
};

struct material {
  double stiffness[LAW_SPRINGS], damping[LAW_SPRINGS], rest_length[LAW_SPRINGS];
};

/* A spring whose force has no corner near by. */
static void draw_spring(struct random_source *source, const struct law *law, int64_t k,
                        struct material *material, struct law_scene *scene) {
  for (;;) {
    const int64_t i = random_whole(source, 0, LAW_PARTICLES - 1);
    const int64_t j = (i + random_whole(source, 1, LAW_PARTICLES - 1)) % LAW_PARTICLES;
    const double rest = law->zero_rest ? 0.0 : random_between(source, 0.4, 1.5);
    const double stiffness = random_between(source, 5.0, 30.0);
    const double damping = law->damped ? random_between(source, 0.1, k % 3 == 0 ? 40.0 : 2.0) : 0.0;
    double square = 0.0, along = 0.0;
    for (int a = 0; a < 3; a++) {
      const double d = scene->q[3 * i + a] - scene->q[3 * j + a];
      square += d * d;
      along += d * (scene->v[3 * i + a] - scene->v[3 * j + a]);
    }
    const double r = sqrt(square), divisor = strcmp(law->law, "strain") == 0 ? rest : 1.0;
    const double kappa = stiffness / divisor, gamma = damping / divisor;
    const double tension = kappa * (r - rest) + gamma * along / r;
    if (r < 0.4 || fabs(r - rest) < 0.12) continue;
    if (law->pull_only && fabs(tension) < 0.12 * kappa + 0.6 * gamma) continue;
    scene->ends[2 * k] = i;
    scene->ends[2 * k + 1] = j;
    material->stiffness[k] = stiffness;
    material->damping[k] = damping;
    material->rest_length[k] = rest;
    if (r <= rest)
      scene->slack++;
    else if (tension < 0.0)
      scene->unloaded++;
    else
      scene->taut++;
    return;
  }
}

/* Factors about 1.19 and 0.74 at LAW_TIME, by which what is given is divided. */
static void follow(struct material *material, hooke_options *options) {
  const double turn = 6.28318530717958647693;
  set_options(options,
              "rest_scale.motion=harmonic rest_scale.amplitude=0.2 rest_scale.frequency=1 "
              "stiffness_scale.motion=harmonic stiffness_scale.mean=0.9 stiffness_scale.amplitude=-0.2 "
              "stiffness_scale.frequency=0.5 stiffness_scale.phase=-0.1");
  for (int k = 0; k < LAW_SPRINGS; k++) {
    material->rest_length[k] /= 1.0 + 0.2 * sin(turn * LAW_TIME);
    material->stiffness[k] /= 0.9 - 0.2 * sin(turn * 0.5 * LAW_TIME - 0.1);
  }
}

static void add_springs(const struct law *law, const struct material *given, struct law_scene *scene) {
  struct material material = *given;
  owned_options *options = options_with("springs", "law=%s", law->law);
  if (law->follows) follow(&material, options);
  const double coefficients[3] = {12.0, 2.0, 0.2};
  if (law->curve)
    check_ok(hooke_options_set_numbers(options, "curve.coefficients", 3, coefficients));
  else
    check_ok(hooke_options_set_numbers(options, "stiffness", LAW_SPRINGS, material.stiffness));
  if (law->damped) check_ok(hooke_options_set_numbers(options, "damping", LAW_SPRINGS, material.damping));
  check_ok(hooke_options_set_numbers(options, "rest_length", LAW_SPRINGS, material.rest_length));
  if (law->pull_only) check_ok(hooke_options_set_number(options, "compression", 0.0));
  check_ok(hooke_system_add_springs(scene->system, "springs", LAW_SPRINGS, scene->ends, options));
}

static void add_bending(struct random_source *source, hooke_system *system) {
  int64_t triples[3 * LAW_TRIPLES];
  double coefficient[LAW_TRIPLES];
  for (int64_t k = 0; k < LAW_TRIPLES; k++) {
    int64_t *triple = triples + 3 * k;
    triple[0] = random_whole(source, 0, LAW_PARTICLES - 1);
    triple[1] = (triple[0] + random_whole(source, 1, 5)) % LAW_PARTICLES;
    triple[2] = (triple[1] + random_whole(source, 1, 5)) % LAW_PARTICLES;
    coefficient[k] = random_between(source, 2.0, 15.0);
  }
  check_ok(hooke_system_add_bending(system, "bending", LAW_TRIPLES, triples, LAW_TRIPLES, coefficient));
}

/* The shortest altitude; 0 if another one is nearly as short. */
static double clear_altitude(const double *const x[4]) {
  double square[7], first = 0.0, second = 0.0, volume = 0.0;
  canonical_altitudes(x, square);
  for (int k = 0; k < 7; k++) {
    second = fmax(second, fmin(first, square[k]));
    first = fmax(first, square[k]);
  }
  for (int a = 0; a < 3; a++) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    volume += (x[3][a] - x[0][a]) *
              ((x[1][b] - x[0][b]) * (x[2][c] - x[0][c]) - (x[1][c] - x[0][c]) * (x[2][b] - x[0][b]));
  }
  return second < 0.75 * first ? fabs(volume) / sqrt(first) : 0.0;
}

/* Both longer and shorter than at rest; damping is far from cancelling the tension of those that only pull.
 */
static void add_altitude(const struct law *law, struct random_source *source, const double *q,
                         hooke_system *system) {
  for (int group = 0; group < 2; group++) {
    int64_t corners[4 * LAW_TETRAHEDRA];
    double stiffness[LAW_TETRAHEDRA], damping[LAW_TETRAHEDRA];
    for (int64_t k = 0, tries = 0; k < LAW_TETRAHEDRA; tries++) {
      const double *x[4];
      assert_true(tries < 100000);
      for (int64_t e = 0; e < 4; e++) {
        corners[4 * k + e] = random_whole(source, 0, LAW_PARTICLES - 1);
        x[e] = q + 3 * corners[4 * k + e];
      }
      if (!(clear_altitude(x) > 0.35)) continue;
      stiffness[k] = random_between(source, 15.0, 30.0);
      damping[k++] = law->pull_only ? random_between(source, 0.02, 0.08) : random_between(source, 0.1, 2.0);
    }
    owned_options *options = new_options("altitude");
    check_ok(hooke_options_set_numbers(options, "stiffness", LAW_TETRAHEDRA, stiffness));
    if (law->damped) check_ok(hooke_options_set_numbers(options, "damping", LAW_TETRAHEDRA, damping));
    if (law->pull_only) check_ok(hooke_options_set_number(options, "compression", 0.0));
    check_ok(hooke_options_set_number(options, "rest_scale", group ? 1.4 : 0.7));
    check_ok(hooke_system_add_altitude(system, "altitude", LAW_TETRAHEDRA, corners, options));
  }
}

/* The points are not near their particles; every other rest length is 0. */
static void add_anchors(const struct law *law, struct random_source *source, const double *q,
                        hooke_system *system) {
  int64_t particles[LAW_ANCHORS];
  double points[3 * LAW_ANCHORS], stiffness[LAW_ANCHORS], damping[LAW_ANCHORS], rest[LAW_ANCHORS];
  for (int64_t k = 0; k < LAW_ANCHORS; k++) {
    particles[k] = random_whole(source, 0, LAW_PARTICLES - 1);
    for (int64_t a = 0; a < 3; a++)
      points[3 * k + a] = q[3 * particles[k] + a] + random_between(source, 0.4, 1.0);
    stiffness[k] = random_between(source, 15.0, 30.0);
    damping[k] = random_between(source, 0.1, 2.0);
    rest[k] = k % 2 ? random_between(source, 0.4, 1.5) : 0.0;
  }
  owned_options *options = new_options("anchors");
  check_ok(hooke_options_set_numbers(options, "points", 3 * LAW_ANCHORS, points));
  check_ok(hooke_options_set_numbers(options, "stiffness", LAW_ANCHORS, stiffness));
  if (law->damped) check_ok(hooke_options_set_numbers(options, "damping", LAW_ANCHORS, damping));
  check_ok(hooke_options_set_numbers(options, "rest_length", LAW_ANCHORS, rest));
  check_ok(hooke_system_add_anchors(system, "anchors", LAW_ANCHORS, particles, options));
}

static void add_loads(hooke_system *system) {
  owned_options *options = options_with("loads", "force=3,-20,7");
  check_ok(hooke_system_add_loads(system, 3, (int64_t[]){2, 5, 2}, options));
  set_options(options, "force=-1,0.5,30");
  check_ok(hooke_system_add_loads(system, 2, (int64_t[]){5, 7}, options));
}

/* The depth of a particle, from a plane of this unit normal, or from the surface of a sphere or a cylinder of
 * this axis, whose distance from it is 1. */
static double depth_of(int shape, const double *x, const double point[3], const double axis[3]) {
  double along = 0.0, square = 0.0;
  for (int a = 0; a < 3; a++) {
    along += (x[a] - point[a]) * axis[a];
    square += (x[a] - point[a]) * (x[a] - point[a]);
  }
  return shape == 0 ? -along : 1.0 - sqrt(square - (shape == 2 ? along * along : 0.0));
}

/* A plane, a sphere and a cylinder of radius 1 that some particles touch, no depth being near 0, nor any
 * particle near a centre; stiff, so that damping never pulls. */
static void add_obstacle(const struct law *law, struct random_source *source, int shape, const double *q,
                         hooke_system *system) {
  static const char *const words[] = {
      "shape=plane normal=%.17g,%.17g,%.17g point=%.17g,%.17g,%.17g",
      "shape=sphere radius=0.9 clearance=0.1 center=%.17g,%.17g,%.17g",
      "shape=cylinder radius=1 axis=%.17g,%.17g,%.17g point=%.17g,%.17g,%.17g"};
  const double angle = random_between(source, 0.0, 6.0), axis[3] = {0.6 * cos(angle), 0.6 * sin(angle), 0.8};
  double point[3];
  for (int touching = 0, clear = 0; touching < 3 || !clear;) {
    touching = 0;
    clear = 1;
    for (int a = 0; a < 3; a++)
      point[a] = random_between(source, -0.5, 0.5);
    for (int p = 0; p < LAW_PARTICLES; p++) {
      const double depth = depth_of(shape, q + 3 * p, point, axis);
      touching += depth > 0.0;
      clear &= fabs(depth) > 0.06 && depth < 0.85 + 10.0 * (shape == 0);
    }
  }
  owned_options *options = new_options("obstacles");
  if (shape == 1)
    set_options(options, words[1], point[0], point[1], point[2]);
  else
    set_options(options, words[shape], axis[0], axis[1], axis[2], point[0], point[1], point[2]);
  set_options(options, "stiffness=40");
  if (law->damped) set_options(options, "damping=0.4 friction=0.6 friction_speed=0.7");
  check_ok(hooke_system_add_obstacle(system, -1, NULL, options));
}

void law_scene_create(const struct law *law, uint64_t seed, struct law_scene *scene) {
  struct random_source source = {seed};
  struct material material;
  double mass[LAW_PARTICLES];
  const int64_t last = LAW_PARTICLES - 1;
  memset(scene, 0, sizeof *scene);
  for (int k = 0; k < LAW_SIZE; k++) {
    scene->q[k] = random_between(&source, -1.0, 1.0);
    scene->v[k] = k / 3 == last ? 0.0 : random_between(&source, -2.0, 2.0);
  }
  for (int p = 0; p < LAW_PARTICLES; p++)
    mass[p] = random_between(&source, 0.5, 2.0);
  for (int64_t k = 0; k < LAW_SPRINGS; k++)
    draw_spring(&source, law, k, &material, scene);
  check_ok(hooke_system_create(&scene->system));
  check_ok(hooke_system_add_particles(scene->system, LAW_PARTICLES, scene->q, scene->v, LAW_PARTICLES, mass,
                                      NULL));
  check_ok(hooke_system_pin(scene->system, 1, &last));
  add_springs(law, &material, scene);
  if (law->bending) add_bending(&source, scene->system);
  if (law->altitude) add_altitude(law, &source, scene->q, scene->system);
  if (law->anchors) add_anchors(law, &source, scene->q, scene->system);
  if (law->loads) add_loads(scene->system);
  for (int p = 0; p < LAW_PARTICLES && law->factors; p++)
    check_ok(hooke_system_set_gravity_factor(scene->system, p, 1, 1, (double[]){0.5 * p - 2.0}));
  for (int shape = 0; shape < 3 && law->obstacles; shape++)
    add_obstacle(law, &source, shape, scene->q, scene->system);
  const double gravity[] = {0.3, -9.81, 1.7};
  if (law->gravity) check_ok(hooke_system_set_gravity(scene->system, gravity));
  if (law->drag) check_ok(hooke_system_set_drag(scene->system, 0.37));
  if (law->callback) {
    check_ok(hooke_system_set_force(scene->system, random_scene_force,
                                    law->callback == 2 ? random_scene_force_product : NULL, NULL));
  }
  check_ok(hooke_system_commit(scene->system));
}

void law_scene_destroy(struct law_scene *scene) {
  hooke_system_destroy(scene->system);
  scene->system = NULL;
}

void differentiate(int64_t count, law_curve *curve, double h, void *ctx, double *derivative) {
  enum { LEVELS = 4 };
  double *table[LEVELS], *other = new_doubles(count);
  for (int level = 0; level < LEVELS; level++) {
    const double step = ldexp(h, -level);
    table[level] = new_doubles(count);
    curve(step, table[level], ctx);
    curve(-step, other, ctx);
    for (int64_t k = 0; k < count; k++)
      table[level][k] = (table[level][k] - other[k]) / (2.0 * step);
  }
  for (int order = 1; order < LEVELS; order++) {
    const double factor = ldexp(1.0, 2 * order);
    for (int level = LEVELS - 1; level >= order; level--) {
      double *fine = table[level], *coarse = table[level - 1];
      for (int64_t k = 0; k < count; k++)
        fine[k] += (fine[k] - coarse[k]) / (factor - 1.0);
    }
  }
  memcpy(derivative, table[LEVELS - 1], (size_t)count * sizeof(double));
  for (int level = 0; level < LEVELS; level++)
    free(table[level]);
  free(other);
}
