#include "random_scene.h"

#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int32_t random_scene_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)ctx;
  for (int64_t p = 0; p < n; p++) {
    const double *x = q + 3 * p, *u = v + 3 * p;
    double *f = force + 3 * p;
    /* two contributions to one component: their order matters */
    for (int a = 0; a < 3; a++)
      f[a] -= 0.7 * x[a];
    f[0] += 0.3 * t - 0.2 * u[1] * x[0];
    f[1] += ((0.1 * x[2]) * x[2]) * x[2];
    f[2] -= 0.4 * u[2];
  }
  return 0;
}

int32_t random_scene_force_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                                   const double *dv, double *out, void *ctx) {
  (void)t;
  (void)ctx;
  for (int64_t p = 0; p < n; p++) {
    const double *x = q + 3 * p, *u = v + 3 * p, *dx = dq + 3 * p, *du = dv + 3 * p;
    double *f = out + 3 * p;
    for (int a = 0; a < 3; a++)
      f[a] -= 0.7 * dx[a];
    f[0] -= 0.2 * (du[1] * x[0] + u[1] * dx[0]);
    f[1] += 0.3 * x[2] * x[2] * dx[2];
    f[2] -= 0.4 * du[2];
  }
  return 0;
}

static int32_t wave(int64_t count, double t, double *q, double *v, void *ctx) {
  (void)ctx;
  for (int64_t k = 0; k < count; k++) {
    q[3 * k] = 0.5 + t * (1.0 - t), v[3 * k] = 1.0 - 2.0 * t;
    q[3 * k + 1] = 0.25 - 0.5 * t, v[3 * k + 1] = -0.5;
    q[3 * k + 2] = t * t * t, v[3 * k + 2] = 3.0 * t * t;
  }
  return 0;
}

/* ---- particles ---- */

/* By Newton's method, as the last digit of cbrt() differs between C libraries. */
static double cube_root(double x) {
  double root = 1.0;
  while (root * root * root < x)
    root *= 2.0;
  for (int k = 0; k < 60; k++)
    root -= (root * root * root - x) / (3.0 * root * root);
  return root;
}

static void add_particles(struct random_source *source, struct random_scene_request request, double *position,
                          hooke_system *system) {
  const int64_t n = request.particles;
  owned_doubles *velocity = new_doubles(3 * n), *mass = new_doubles(n);
  const double side = 0.5 * cube_root((double)n) + 0.5;
  for (int64_t p = 0; p < n; p++) {
    const int copy = (request.features & SCENE_COINCIDENT) && p > 0 && random_whole(source, 0, 7) == 0;
    for (int a = 0; a < 3; a++) {
      position[3 * p + a] = copy ? position[3 * p - 3 + a] : random_between(source, -side, side);
      velocity[3 * p + a] = p < 6 ? 0.0 : random_between(source, -1.0, 1.0); /* the first six may be held */
    }
    mass[p] = random_between(source, 0.5, 2.0);
  }
  const int64_t masses = random_whole(source, 0, 1) ? n : 1;
  check_ok(hooke_system_add_particles(system, n, position, velocity, masses, mass, NULL));
}

static void hold_particles(struct random_source *source, struct random_scene_request request,
                           struct random_scene *scene) {
  if (request.features & SCENE_PINNED) {
    const int64_t pinned[] = {0, 2, 0};
    check_ok(hooke_system_pin(scene->system, random_whole(source, 1, 3), pinned));
  }
  if (!(request.features & SCENE_DRIVEN)) return;
  const double amplitude[] = {0.1, -0.2, 0.05}, time[] = {-0.001, 0.0025, 0.004, 0.02};
  const double displacement[] = {0, 0, 0, 0.01, 0.02, -0.01, 0.015, -0.01, 0.0, 0.03, 0.01, 0.02};
  const int64_t driven[] = {1, 3, 5};
  const double frequency = random_between(source, 0.5, 30.0), phase = random_between(source, -4.0, 4.0);
  check_ok(hooke_system_drive_harmonic(scene->system, 1, driven, amplitude, frequency, phase));
  check_ok(hooke_system_drive_table(scene->system, 1, driven + 1, 4, time, displacement));
  check_ok(hooke_system_drive_callback(scene->system, 1, driven + 2, wave, NULL));
  scene->driven_count = 3;
  memcpy(scene->driven, driven, sizeof driven);
}

/* ---- springs ---- */

/* Runs of constant offset both ways, the same with particles descending, and random pairs. */
static void draw_ends(struct random_source *source, int64_t particles, int64_t count, int64_t *ends) {
  int64_t done = 0;
  while (done < count) {
    const int64_t kind = random_whole(source, 0, 3);
    int64_t length = random_whole(source, 1, random_whole(source, 0, 3) ? 12 : 700);
    int64_t offset = random_whole(source, 1, random_whole(source, 0, 1) ? 2 : particles - 1);
    if (offset > particles - 1) offset = particles - 1;
    if (length > particles - offset) length = particles - offset;
    if (length > count - done) length = count - done;
    const int64_t start = random_whole(source, 0, particles - offset - length);
    const int swap = (int)random_whole(source, 0, 1);
    for (int64_t k = 0; k < length; k++) {
      int64_t *pair = ends + 2 * (done + k);
      int64_t low = kind == 1 ? start + length - 1 - k : start + k;
      pair[0] = swap ? low + offset : low;
      pair[1] = swap ? low : low + offset;
      if (kind == 2) {
        pair[0] = random_whole(source, 0, particles - 1);
        pair[1] = (pair[0] + random_whole(source, 1, particles - 1)) % particles;
      }
    }
    done += length;
  }
}

/* The requested springs one by one: the library has to hold exactly these, without those that have neither
 * stiffness nor damping. */
struct wanted {
  int64_t count; /* so far */
  int64_t *ends;
  double *kappa, *gamma, *rest_length;
};

/* One number for the group, or one a spring, some of them `low` itself; written out for every spring in
 * `values`. */
static void set_random(struct random_source *source, hooke_options *options, const char *name, int64_t count,
                       double low, double high, double *values) {
  const int64_t drawn = random_whole(source, 0, 1) ? count : 1;
  for (int64_t k = 0; k < drawn; k++) {
    values[k] = random_whole(source, 0, 3) ? random_between(source, low, high) : low;
  }
  check_ok(hooke_options_set_numbers(options, name, drawn, values));
  for (int64_t k = drawn; k < count; k++)
    values[k] = values[0];
}

static void set_rest_length(struct random_source *source, hooke_options *options, int64_t count,
                            const int64_t *ends, const double *position, int length_law, int apart,
                            int follows, double *rest) {
  const double drawn = random_whole(source, 0, 1) ? random_between(source, 0.8, 1.2) : 1.0;
  const double scale = follows ? 1.0 : drawn;
  if (random_whole(source, 0, 2) == 0 && (length_law || apart)) {
    check_ok(hooke_options_set_text(options, "rest_length", "initial"));
    for (int64_t k = 0; k < count; k++) {
      const double *a = position + 3 * ends[2 * k], *b = position + 3 * ends[2 * k + 1];
      const double d[] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
      rest[k] = sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]);
    }
  } else if (length_law && random_whole(source, 0, 1)) {
    check_ok(hooke_options_set_number(options, "rest_length", 0.0));
    memset(rest, 0, (size_t)count * sizeof(double));
  } else {
    set_random(source, options, "rest_length", count, 0.2, 1.5, rest);
  }
  check_ok(hooke_options_set_number(options, "rest_scale", scale));
  if (follows) canonical_follow(options, "");
  for (int64_t k = 0; k < count; k++)
    rest[k] *= scale;
}

static int ends_apart(int64_t count, const int64_t *ends, const double *position) {
  for (int64_t k = 0; k < count; k++) {
    if (memcmp(position + 3 * ends[2 * k], position + 3 * ends[2 * k + 1], 3 * sizeof(double)) == 0) return 0;
  }
  return 1;
}

static void add_group(struct random_source *source, struct random_scene_request request, int64_t count,
                      const double *position, int64_t number, hooke_system *system, struct wanted *wanted) {
  int64_t *ends = wanted->ends + 2 * wanted->count;
  double *kappa = wanted->kappa + wanted->count, *gamma = wanted->gamma + wanted->count,
         *rest = wanted->rest_length + wanted->count;
  char name[48];
  const int length_law = (int)random_whole(source, 0, 1);
  const int pulls = (request.features & SCENE_PULL_ONLY) && random_whole(source, 0, 1);
  draw_ends(source, request.particles, count, ends);
  hooke_options *options = options_with("springs", "law=%s", length_law ? "length" : "strain");
  set_random(source, options, "stiffness", count, 0.0, 50.0, kappa);
  if ((request.features & SCENE_DAMPING) && random_whole(source, 0, 3)) {
    set_random(source, options, "damping", count, 0.0, 0.5, gamma);
  }
  const int follows = (request.features & SCENE_FOLLOWS) && number % 4;
  set_rest_length(source, options, count, ends, position, length_law, ends_apart(count, ends, position),
                  follows, rest);
  for (int64_t k = 0; k < count && !length_law; k++) {
    kappa[k] /= rest[k];
    gamma[k] /= rest[k];
  }
  if (pulls) check_ok(hooke_options_set_number(options, "compression", 0.0));
  snprintf(name, sizeof name, "%s%lld%s", pulls ? "pull" : "group", (long long)number,
           !follows     ? ""
           : length_law ? "-follows"
                        : "-follows-strain");
  check_ok(hooke_system_add_springs(system, name, count, ends, options));
  hooke_options_destroy(options);
  wanted->count += count;
}

static void add_groups(struct random_source *source, struct random_scene_request request,
                       const double *position, hooke_system *system, struct wanted *wanted) {
  wanted->ends = new_block(2 * request.springs, (int64_t)sizeof(int64_t));
  wanted->kappa = new_doubles(request.springs);
  wanted->gamma = new_doubles(request.springs);
  wanted->rest_length = new_doubles(request.springs);
  for (int64_t number = 0; wanted->count < request.springs; number++) {
    int64_t count = random_whole(source, 1, request.springs);
    if (count > request.springs - wanted->count) count = request.springs - wanted->count;
    add_group(source, request, count, position, number, system, wanted);
  }
}

static void leave_out_zeros(struct wanted *wanted) {
  int64_t acting = 0;
  for (int64_t k = 0; k < wanted->count; k++) {
    if (wanted->kappa[k] == 0.0 && wanted->gamma[k] == 0.0) continue;
    wanted->ends[2 * acting] = wanted->ends[2 * k];
    wanted->ends[2 * acting + 1] = wanted->ends[2 * k + 1];
    wanted->kappa[acting] = wanted->kappa[k];
    wanted->gamma[acting] = wanted->gamma[k];
    wanted->rest_length[acting++] = wanted->rest_length[k];
  }
  wanted->count = acting;
}

/* The springs of groups come first, whenever parts were added, and equal the requested ones to the bit. */
static void compare_wanted(const struct canonical *canonical, struct wanted *wanted) {
  leave_out_zeros(wanted);
  assert_true(canonical->spring_count >= wanted->count);
  assert_memory_equal(canonical->ends, wanted->ends, (size_t)(2 * wanted->count) * sizeof(int64_t));
  check_same_bits(wanted->count, canonical->kappa, wanted->kappa);
  check_same_bits(wanted->count, canonical->gamma, wanted->gamma);
  check_same_bits(wanted->count, canonical->rest_length, wanted->rest_length);
  free(wanted->ends);
  free(wanted->kappa);
  free(wanted->gamma);
  free(wanted->rest_length);
}

/* ---- bending ---- */

/* Lines of constant distance both ways, the same with particles descending, and random triples. */
static void draw_triples(struct random_source *source, int64_t particles, int64_t count, int64_t *triples) {
  int64_t done = 0;
  while (done < count) {
    const int64_t kind = random_whole(source, 0, 3), most = (particles - 1) / 2;
    int64_t length = random_whole(source, 1, random_whole(source, 0, 3) ? 12 : 700);
    int64_t offset = random_whole(source, 1, random_whole(source, 0, 1) ? 2 : most);
    if (length > particles - 2 * offset) length = particles - 2 * offset;
    if (length > count - done) length = count - done;
    const int64_t start = random_whole(source, 0, particles - 2 * offset - length);
    const int swap = random_whole(source, 0, 3) == 0;
    for (int64_t k = 0; k < length; k++) {
      int64_t *triple = triples + 3 * (done + k);
      const int64_t low = kind == 1 ? start + length - 1 - k : start + k;
      for (int e = 0; e < 3; e++)
        triple[e] = low + (swap ? 2 - e : e) * offset;
      if (kind == 2) {
        triple[0] = random_whole(source, 0, particles - 1);
        triple[1] = (triple[0] + random_whole(source, 1, most)) % particles;
        triple[2] = (triple[1] + random_whole(source, 1, most)) % particles;
      }
    }
    done += length;
  }
}

/* One for all, one each, or a few values that change now and then; some of them 0. */
static int64_t draw_coefficients(struct random_source *source, int64_t count, double *coefficient) {
  const int64_t kind = random_whole(source, 0, 2);
  for (int64_t k = 0; k < count; k++) {
    const int keep = k > 0 && kind != 1 && (kind == 0 || random_whole(source, 0, 30) != 0);
    const double drawn = random_whole(source, 0, 9) ? random_between(source, 0.0, 20.0) : 0.0;
    coefficient[k] = keep ? coefficient[k - 1] : drawn;
  }
  return kind == 0 ? 1 : count;
}

/* Groups of triples, recording those with stiffness: the library has to hold exactly these. */
static int64_t add_triples(struct random_source *source, struct random_scene_request request,
                           hooke_system *system, int64_t *kept, double *kept_coefficient) {
  int64_t *triples = new_block(3 * request.triples, (int64_t)sizeof(int64_t)), kept_count = 0;
  owned_doubles *coefficient = new_doubles(request.triples);
  for (int64_t done = 0, count; done < request.triples; done += count) {
    count = random_whole(source, 1, request.triples - done);
    draw_triples(source, request.particles, count, triples);
    const int64_t coefficients = draw_coefficients(source, count, coefficient);
    check_ok(hooke_system_add_bending(system, "bends", count, triples, coefficients, coefficient));
    for (int64_t k = 0; k < count; k++) {
      if (coefficient[k] == 0.0) continue;
      memcpy(kept + 3 * kept_count, triples + 3 * k, 3 * sizeof *kept);
      kept_coefficient[kept_count++] = coefficient[k];
    }
  }
  free(triples);
  return kept_count;
}

/* ---- altitude springs ---- */

/* Four particles far from a common plane: the altitudes are above a tenth. */
static void draw_corners(struct random_source *source, int64_t particles, const double *position,
                         int64_t *corner) {
  for (int tries = 0;; tries++) {
    assert_true(tries < 10000);
    const int64_t first = random_whole(source, 0, particles - 1);
    const double *x[4];
    double square[7], most = 0.0;
    for (int64_t e = 0; e < 4; e++) {
      corner[e] = (first + (e ? random_whole(source, 1, 7) : 0)) % particles;
      x[e] = position + 3 * corner[e];
    }
    canonical_altitudes(x, square);
    for (int k = 0; k < 7; k++)
      most = fmax(most, square[k]);
    double n[3], d[3], volume = 0.0;
    for (int a = 0; a < 3; a++) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      n[a] = (x[1][b] - x[0][b]) * (x[2][c] - x[0][c]) - (x[1][c] - x[0][c]) * (x[2][b] - x[0][b]);
      d[a] = x[3][a] - x[0][a];
      volume += n[a] * d[a];
    }
    if (fabs(volume) > 0.1 * sqrt(most)) return;
  }
}

static void add_tetrahedra(struct random_source *source, struct random_scene_request request,
                           const double *position, hooke_system *system) {
  owned_wholes *corners = new_block(4 * request.tetrahedra, (int64_t)sizeof(int64_t));
  owned_doubles *stiffness = new_doubles(request.tetrahedra), *damping = new_doubles(request.tetrahedra);
  for (int64_t done = 0, count; done < request.tetrahedra; done += count) {
    count = random_whole(source, 1, request.tetrahedra - done);
    for (int64_t k = 0; k < count; k++) {
      draw_corners(source, request.particles, position, corners + 4 * k);
      stiffness[k] = random_whole(source, 0, 5) ? random_between(source, 1.0, 9.0) : 0.0;
      damping[k] = random_whole(source, 0, 3) ? random_between(source, 0.0, 0.2) : 0.0;
    }
    const int pulls = request.features & SCENE_PULL_ONLY && random_whole(source, 0, 1);
    owned_options *options = new_options("altitude");
    check_ok(hooke_options_set_numbers(options, "stiffness", count, stiffness));
    if (request.features & SCENE_DAMPING)
      check_ok(hooke_options_set_numbers(options, "damping", count, damping));
    check_ok(hooke_options_set_number(options, "rest_scale", random_between(source, 0.8, 1.2)));
    check_ok(hooke_options_set_number(options, "compression", !pulls));
    check_ok(
        hooke_system_add_altitude(system, pulls ? "pull altitude" : "altitude", count, corners, options));
  }
}

/* ---- loads ---- */

/* Load k alone on particle k of the twin; particles from 6 on are never held. */
static void add_loads(struct random_scene_request request, struct random_scene *scene) {
  static const char *const words[] = {"force=3,-20,7", "motion=harmonic force=9,2,-30 frequency=40 phase=0.3",
                                      "motion=table force=0,0,0;30,10,-9;1,2,3 time=-0.01,0.002,0.01"};
  owned_doubles *place = new_doubles(3 * request.loads);
  scene->loads = small_system(request.loads, place, NULL, 1.0, 0);
  for (int64_t k = 0; k < request.loads; k++) {
    const int64_t particle = 6 + k * 7 % (request.particles - 6);
    owned_options *options = options_with("loads", "%s", words[k % 3]);
    check_ok(hooke_system_add_loads(scene->system, 1, &particle, options));
    check_ok(hooke_system_add_loads(scene->loads, 1, &k, options));
  }
  check_ok(hooke_system_commit(scene->loads));
}

/* ---- anchors ---- */

static void add_anchors(struct random_source *source, struct random_scene_request request,
                        const double *position, hooke_system *system) {
  for (int64_t done = 0, count; done < request.anchors; done += count) {
    count = random_whole(source, 1, request.anchors - done);
    owned_wholes *particles = new_block(count, (int64_t)sizeof(int64_t));
    double *number = new_doubles(6 * count), *stiffness = number + 3 * count, *damping = stiffness + count;
    for (int64_t k = 0; k < count; k++) {
      particles[k] = random_whole(source, 0, request.particles - 1);
      for (int64_t a = 0; a < 3; a++)
        number[3 * k + a] = position[3 * particles[k] + a] + random_between(source, -1.0, 1.0);
      stiffness[k] = random_whole(source, 0, 5) ? random_between(source, 1.0, 9.0) : 0.0;
      damping[k] = random_whole(source, 0, 3) ? random_between(source, 0.0, 0.2) : 0.0;
      damping[count + k] = random_whole(source, 0, 1) ? random_between(source, 0.1, 1.0) : 0.0;
    }
    owned_options *options = new_options("anchors");
    if (random_whole(source, 0, 2)) check_ok(hooke_options_set_numbers(options, "points", 3 * count, number));
    check_ok(hooke_options_set_numbers(options, "stiffness", count, stiffness));
    if (request.features & SCENE_DAMPING)
      check_ok(hooke_options_set_numbers(options, "damping", count, damping));
    check_ok(hooke_options_set_numbers(options, "rest_length", count, damping + count));
    check_ok(hooke_system_add_anchors(system, "anchors", count, particles, options));
    free(number);
  }
}

/* ---- parts ---- */

static void set_family(struct random_source *source, hooke_options *options, const char *family,
                       int32_t features) {
  char name[64];
  snprintf(name, sizeof name, "%s.stiffness", family);
  check_ok(hooke_options_set_number(options, name, random_between(source, 5.0, 50.0)));
  if (features & SCENE_DAMPING) {
    snprintf(name, sizeof name, "%s.damping", family);
    check_ok(hooke_options_set_number(options, name, random_between(source, 0.0, 0.2)));
  }
  if (features & SCENE_PULL_ONLY) {
    snprintf(name, sizeof name, "%s.compression", family);
    check_ok(hooke_options_set_number(options, name, 0.0));
  }
}

static void set_shape(struct random_scene_request request, const char *kind, hooke_options *options) {
  const double origin[] = {-1, 2, 0.5}, edges[] = {2, 0.1, 0, 0, 0.2, 3, 0.1, 2.5, 0};
  const double sizes[] = {(double)request.cloth[0], (double)request.cloth[1]};
  const double lattice[] = {(double)request.lattice[0], (double)request.lattice[1],
                            (double)request.lattice[2]};
  const double from[] = {0, 1, 0}, to[] = {3, 1.5, -0.7};
  const int axes = strcmp(kind, "lattice") == 0 ? 3 : 2;
  if (strcmp(kind, "rope") == 0) {
    check_ok(hooke_options_set_numbers(options, "from", 3, from));
    check_ok(hooke_options_set_numbers(options, "to", 3, to));
    check_ok(hooke_options_set_number(options, "segments", (double)request.rope));
    return;
  }
  check_ok(hooke_options_set_numbers(options, "origin", 3, origin));
  check_ok(hooke_options_set_numbers(options, "edges", 3 * axes, edges));
  check_ok(hooke_options_set_numbers(options, "size", axes, axes == 3 ? lattice : sizes));
}

static void add_part(struct random_source *source, struct random_scene_request request, const char *kind,
                     hooke_system *system) {
  const int rope = strcmp(kind, "rope") == 0;
  owned_options *options = new_options(kind);
  check_ok(hooke_options_set_number(options, "mass", random_between(source, 1.0, 5.0)));
  set_shape(request, kind, options);
  const char *family[2][3] = {{"structural", "shear", "bend"}, {"stretch", "bend", NULL}};
  for (int k = 0; k < 3 && family[rope][k] != NULL; k++) {
    char dotted[32];
    snprintf(dotted, sizeof dotted, "%s.", family[rope][k]);
    if (k == 0 || random_whole(source, 0, 3)) set_family(source, options, family[rope][k], request.features);
    if (request.features & SCENE_FOLLOWS && hooke_options_is_set(options, family[rope][k]))
      canonical_follow(options, dotted);
  }
  if (request.triples > 0 && strcmp(kind, "lattice") != 0)
    check_ok(hooke_options_set_number(options, "bending", 0.3));
  if (request.medium & MEDIUM_FLUID && strcmp(kind, "lattice") != 0) {
    const char *key[2][3] = {{"coefficient", NULL}, {"diameter", "normal", "tangential"}};
    check_ok(hooke_options_set_number(options, "fluid_drag.density", random_between(source, 1.0, 4.0)));
    for (int k = 0; k < 3 && key[rope][k]; k++) {
      char dotted[32];
      snprintf(dotted, sizeof dotted, "fluid_drag.%s", key[rope][k]);
      check_ok(hooke_options_set_number(options, dotted, random_between(source, 0.1, 1.5)));
    }
  }
  char name[32];
  snprintf(name, sizeof name, "%s-%s%s", request.features & SCENE_PULL_ONLY ? "pull" : "part", kind,
           request.features & SCENE_FOLLOWS ? "-follows-strain" : "");
  check_ok(hooke_system_add_part(system, kind, name, options, NULL, NULL));
}

static void add_factors(struct random_scene *scene) {
  const int64_t n = hooke_system_particle_count(scene->system);
  scene->factor = new_doubles(n);
  for (int64_t p = 0; p < n; p++)
    scene->factor[p] = 0.3 * (double)(p % 11) - 1.1;
  check_ok(hooke_system_set_gravity_factor(scene->system, 0, n, n, scene->factor));
}

/* ---- whole ---- */

static void place_driven(double t, double *q, double *v, void *ctx) {
  const struct random_scene *scene = ctx;
  hooke_state_set_time(scene->driven_state, t);
  check_ok(hooke_integrator_step(scene->driver, scene->driven_state, 0));
  const double *from_q = hooke_state_position(scene->driven_state);
  const double *from_v = hooke_state_velocity(scene->driven_state);
  for (int64_t k = 0; k < scene->driven_count; k++) {
    memcpy(q + 3 * scene->driven[k], from_q + 3 * scene->driven[k], 3 * sizeof(double));
    memcpy(v + 3 * scene->driven[k], from_v + 3 * scene->driven[k], 3 * sizeof(double));
  }
}

/* A quarter of the particles has none. */
static double *draw_drags(struct random_source *source, int64_t n, double most, const char *name,
                          hooke_options *options) {
  double *drags = new_doubles(n);
  for (int64_t p = 0; p < n; p++)
    drags[p] = random_whole(source, 0, 3) ? random_between(source, 0.0, most) : 0.0;
  check_ok(hooke_options_set_numbers(options, name, n, drags));
  return drags;
}

/* In a wind without drag of each particle all have the number of the scene. */
static void add_medium(struct random_scene_request request, double drag, struct random_scene *scene) {
  struct random_source source = {request.seed + 377};
  const int64_t n = hooke_system_particle_count(scene->system);
  owned_options *options = new_options("scene");
  if (request.medium & MEDIUM_DRAG) {
    scene->drags = draw_drags(&source, n, 0.5, "drag", options);
  } else if (request.medium & MEDIUM_WIND && request.features & SCENE_DRAG) {
    scene->drags = new_doubles(n);
    for (int64_t p = 0; p < n; p++)
      scene->drags[p] = drag;
    check_ok(hooke_options_set_number(options, "drag", drag));
  }
  if (request.medium & MEDIUM_QUADRATIC)
    scene->quadratic = draw_drags(&source, n, 0.1, "quadratic_drag", options);
  for (int a = 0; a < 3; a++)
    scene->wind[a] = random_between(&source, -2.0, 2.0);
  if (request.medium & MEDIUM_WIND) check_ok(hooke_options_set_numbers(options, "wind", 3, scene->wind));
  check_ok(hooke_scene_options_apply(options, scene->system));
}

void random_scene_create(struct random_scene_request request, struct random_scene *scene) {
  struct random_source source = {request.seed};
  memset(scene, 0, sizeof *scene);
  owned_doubles *position = new_doubles(3 * request.particles);
  check_ok(hooke_system_create(&scene->system));
  add_particles(&source, request, position, scene->system);
  hold_particles(&source, request, scene);
  if (request.rope > 0) add_part(&source, request, "rope", scene->system);
  if (request.cloth[0] > 0) add_part(&source, request, "cloth", scene->system);
  if (request.lattice[0] > 0) add_part(&source, request, "lattice", scene->system);
  struct wanted wanted = {0};
  add_groups(&source, request, position, scene->system, &wanted);
  struct random_source heights = {request.seed + 177};
  add_tetrahedra(&heights, request, position, scene->system);
  struct random_source points = {request.seed + 277};
  add_anchors(&points, request, position, scene->system);
  if (request.loads > 0) add_loads(request, scene);
  struct random_source bends = {request.seed + 77};
  owned_wholes *triples = new_block(3 * request.triples, (int64_t)sizeof(int64_t));
  owned_doubles *coefficient = new_doubles(request.triples);
  const int64_t kept = add_triples(&bends, request, scene->system, triples, coefficient);
  for (int a = 0; a < 3; a++)
    scene->gravity[a] = random_between(&source, -10.0, 10.0);
  const double drag = random_between(&source, 0.01, 0.5);
  if (request.features & SCENE_GRAVITY) check_ok(hooke_system_set_gravity(scene->system, scene->gravity));
  if (request.factors) add_factors(scene);
  if (request.features & SCENE_DRAG) check_ok(hooke_system_set_drag(scene->system, drag));
  if (request.medium) add_medium(request, drag, scene);
  if (request.features & SCENE_CALLBACK) {
    check_ok(hooke_system_set_force(scene->system, random_scene_force,
                                    request.with_product ? random_scene_force_product : NULL, NULL));
  }
  check_ok(hooke_system_commit(scene->system));
  canonical_create(scene->system, &scene->canonical);
  compare_wanted(&scene->canonical, &wanted);
  assert_true(scene->canonical.triple_count >= kept);
  assert_memory_equal(scene->canonical.triples, triples, (size_t)(3 * kept) * sizeof *triples);
  check_same_bits(kept, scene->canonical.coefficient, coefficient);
  scene->canonical.gravity = request.features & SCENE_GRAVITY ? scene->gravity : NULL;
  scene->canonical.drag = request.features & SCENE_DRAG && !scene->drags ? drag : 0.0;
  scene->canonical.drags = scene->drags;
  scene->canonical.quadratic = scene->quadratic;
  scene->canonical.wind = request.medium & MEDIUM_WIND ? scene->wind : NULL;
  scene->canonical.force = request.features & SCENE_CALLBACK ? random_scene_force : NULL;
  scene->canonical.loads = scene->loads;
  scene->canonical.factor = scene->factor;
  if (scene->driven_count == 0) return;
  scene->driver = start_with(scene->system, .method = "forward-euler", .step = 1.0);
  scene->driven_state = start_state(scene->system);
  scene->canonical.place = place_driven;
  scene->canonical.place_ctx = scene;
}

void random_scene_destroy(struct random_scene *scene) {
  canonical_destroy(&scene->canonical);
  hooke_integrator_destroy(scene->driver);
  hooke_state_destroy(scene->driven_state);
  hooke_system_destroy(scene->system);
  hooke_system_destroy(scene->loads);
  free(scene->factor);
  free(scene->drags);
  free(scene->quadratic);
  scene->system = scene->loads = NULL;
}

void random_scene_shake(const struct random_scene *scene, uint64_t seed, double *q, double *v) {
  struct random_source source = {seed};
  const double *w = scene->canonical.inverse_mass;
  owned_state *state = start_state(scene->system);
  const double *q0 = hooke_state_position(state), *v0 = hooke_state_velocity(state);
  for (int64_t p = 0; p < scene->canonical.particle_count; p++) {
    const int copy = p > 0 && w[p] != 0.0 && memcmp(q0 + 3 * p, q0 + 3 * p - 3, 3 * sizeof(double)) == 0;
    for (int64_t k = 3 * p; k < 3 * p + 3; k++) {
      q[k] = copy ? q[k - 3] : q0[k] + (w[p] != 0.0 ? random_between(&source, -0.2, 0.2) : 0.0);
      v[k] = v0[k] + (w[p] != 0.0 ? random_between(&source, -0.2, 0.2) : 0.0);
    }
  }
}
