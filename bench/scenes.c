#include "scenes.h"

#include "draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double STIFFNESS = 50.0, DAMPING = 0.01; /* N, N s: of the strain law */

/* ---- single springs ---- */

struct net {
  int64_t particles, springs;
  double *position;
  int64_t *ends;
  int uneven; /* 1: each spring has its own strength */
};

static int32_t net_create(int64_t particles, int64_t most_springs, struct net *net) {
  *net = (struct net){.particles = particles,
                      .position = calloc((size_t)(3 * particles), sizeof(double)),
                      .ends = calloc((size_t)(2 * most_springs), sizeof(int64_t))};
  return net->position && net->ends ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void join(struct net *net, int64_t i, int64_t j) {
  net->ends[2 * net->springs] = i;
  net->ends[2 * net->springs + 1] = j;
  net->springs++;
}

/* A permutation of `count` numbers; NULL without memory. */
static int64_t *shuffled(int64_t count, uint64_t seed) {
  int64_t *order = calloc((size_t)count, sizeof *order);
  for (int64_t k = 0; order && k < count; k++)
    order[k] = k;
  for (int64_t k = count - 1; order && k > 0; k--) {
    const int64_t other = (int64_t)(bench_draw(&seed) % (uint64_t)(k + 1)), kept = order[k];
    order[k] = order[other];
    order[other] = kept;
  }
  return order;
}

/* Numbers particles and springs at random. */
static int32_t net_shuffle(struct net *net, uint64_t seed) {
  if (net->springs < 1) return HOOKE_OK;
  int64_t *particle = shuffled(net->particles, seed), *spring = shuffled(net->springs, seed + 1);
  double *position = calloc((size_t)(3 * net->particles), sizeof *position);
  int64_t *ends = calloc((size_t)(2 * net->springs), sizeof *ends);
  const int done = particle && spring && position && ends;
  for (int64_t p = 0; done && p < net->particles; p++) {
    for (int a = 0; a < 3; a++)
      position[3 * particle[p] + a] = net->position[3 * p + a];
  }
  for (int64_t s = 0; done && s < net->springs; s++) {
    for (int end = 0; end < 2; end++)
      ends[2 * spring[s] + end] = particle[net->ends[2 * s + end]];
  }
  if (done) {
    free(net->position);
    free(net->ends);
    net->position = position;
    net->ends = ends;
  } else {
    free(position);
    free(ends);
  }
  free(particle);
  free(spring);
  return done ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static int32_t set_strength(const struct net *net, const char *name, double value, uint64_t seed,
                            hooke_options *options) {
  if (!net->uneven) return hooke_options_set_number(options, name, value);
  double *values = calloc((size_t)net->springs, sizeof *values);
  for (int64_t k = 0; values && k < net->springs; k++)
    values[k] = value * (0.7 + 0.6 * bench_draw_unit(&seed));
  const int32_t status =
      values ? hooke_options_set_numbers(options, name, net->springs, values) : HOOKE_NO_MEMORY;
  free(values);
  return status;
}

/* Adds the contents of the net to the system, and releases it. */
static int32_t net_finish(struct net *net, int32_t status, double mass, double damping,
                          hooke_system *system) {
  hooke_options *options = NULL;
  const double each = mass / (double)net->particles;
  if (status == HOOKE_OK) {
    status = hooke_system_add_particles(system, net->particles, net->position, NULL, 1, &each, NULL);
  }
  if (status == HOOKE_OK) status = hooke_options_create("springs", &options);
  if (status == HOOKE_OK) status = set_strength(net, "stiffness", STIFFNESS, 13, options);
  if (status == HOOKE_OK) status = set_strength(net, "damping", damping, 17, options);
  if (status == HOOKE_OK) status = hooke_system_add_springs(system, "net", net->springs, net->ends, options);
  hooke_options_destroy(options);
  free(net->position);
  free(net->ends);
  return status;
}

/* ---- the scenes ---- */

static int32_t set_family(hooke_options *options, const char *family, double damping) {
  char name[64];
  snprintf(name, sizeof name, "%s.stiffness", family);
  int32_t status = hooke_options_set_number(options, name, STIFFNESS);
  snprintf(name, sizeof name, "%s.damping", family);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, name, damping);
  return status;
}

static int32_t build_cloth(hooke_system *system, int64_t size, double damping) {
  const double edges[] = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0}, sizes[] = {(double)size, (double)size},
               origin[] = {0.0, 0.0, 0.0};
  const char *family[] = {"structural", "shear", "bend"};
  hooke_options *options = NULL;
  int32_t status = hooke_options_create("cloth", &options);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "origin", 3, origin);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "edges", 6, edges);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "size", 2, sizes);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "mass", 1.0);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "pinned", "top-corners");
  for (int k = 0; k < 3 && status == HOOKE_OK; k++)
    status = set_family(options, family[k], damping);
  if (status == HOOKE_OK) status = hooke_system_add_part(system, "cloth", NULL, options, NULL, NULL);
  hooke_options_destroy(options);
  return status;
}

/* Neighbours along the three axes and all diagonals of faces and cells, direction by direction. */
static int32_t build_lattice(hooke_system *system, int64_t size, double damping) {
  struct net net;
  int32_t status = net_create(size * size * size, 13 * size * size * size, &net);
  const double side = 1.0 / (double)(size - 1);
  for (int64_t p = 0; status == HOOKE_OK && p < net.particles; p++) {
    const int64_t x = p % size, y = p / size % size, z = p / size / size;
    net.position[3 * p] = side * (double)x;
    net.position[3 * p + 1] = side * (double)y;
    net.position[3 * p + 2] = side * (double)z;
  }
  for (int direction = 14; status == HOOKE_OK && direction < 27; direction++) {
    const int64_t dx = direction % 3 - 1, dy = direction / 3 % 3 - 1, dz = direction / 9 - 1;
    for (int64_t p = 0; p < net.particles; p++) {
      const int64_t x = p % size + dx, y = p / size % size + dy, z = p / size / size + dz;
      if (x >= 0 && x < size && y >= 0 && y < size && z >= 0 && z < size)
        join(&net, p, (z * size + y) * size + x);
    }
  }
  return net_finish(&net, status, 1.0, damping, system);
}

static void lay_triangles(struct net *net, int64_t size) {
  uint64_t seed = 7;
  for (int64_t p = 0; p < net->particles; p++) {
    const int64_t x = p % size, z = p / size;
    net->position[3 * p] = ((double)x + 0.3 * bench_draw_unit(&seed)) / (double)size;
    net->position[3 * p + 2] = ((double)z + 0.3 * bench_draw_unit(&seed)) / (double)size;
    if (x + 1 < size) join(net, p, p + 1);
    if (z + 1 < size) join(net, p, p + size);
    if (x + 1 < size && z + 1 < size) join(net, p, p + size + 1);
  }
}

/* The edges of a triangle mesh with vertices and edges in random order. */
static int32_t build_mesh(hooke_system *system, int64_t size, double damping) {
  struct net net;
  int32_t status = net_create(size * size, 3 * size * size, &net);
  if (status == HOOKE_OK) {
    lay_triangles(&net, size);
    status = net_shuffle(&net, 11);
  }
  return net_finish(&net, status, 1.0, damping, system);
}

/* The springs of a cloth, listed particle by particle. */
static int32_t list_cloth(int64_t size, struct net *net) {
  const int64_t step[6][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}};
  const int32_t status = net_create(size * size, 6 * size * size, net);
  for (int64_t p = 0; status == HOOKE_OK && p < net->particles; p++) {
    const int64_t row = p / size, column = p % size;
    net->position[3 * p] = (double)column / (double)(size - 1);
    net->position[3 * p + 2] = (double)row / (double)(size - 1);
    for (int k = 0; k < 6; k++) {
      const int64_t r = row + step[k][0], c = column + step[k][1];
      if (r < size && c >= 0 && c < size) join(net, p, r * size + c);
    }
  }
  return status;
}

static int32_t build_listed_cloth(hooke_system *system, int64_t size, double damping) {
  struct net net;
  const int32_t status = list_cloth(size, &net);
  return net_finish(&net, status, 1.0, damping, system);
}

/* Each spring has a stiffness and damping of its own. */
static int32_t build_uneven_cloth(hooke_system *system, int64_t size, double damping) {
  struct net net;
  const int32_t status = list_cloth(size, &net);
  net.uneven = 1;
  return net_finish(&net, status, 1.0, damping, system);
}

/* The same in random order. */
static int32_t build_shuffled_cloth(hooke_system *system, int64_t size, double damping) {
  struct net net;
  int32_t status = list_cloth(size, &net);
  if (status == HOOKE_OK) status = net_shuffle(&net, 5);
  return net_finish(&net, status, 1.0, damping, system);
}

/* Many small ones. */
static int32_t build_cloths(hooke_system *system, int64_t count, double damping) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; status == HOOKE_OK && k < count; k++)
    status = build_cloth(system, 8, damping);
  return status;
}

static int32_t build_rope(hooke_system *system, int64_t size, double damping) {
  struct net net;
  int32_t status = net_create(size + 1, 2 * size, &net);
  for (int64_t p = 0; status == HOOKE_OK && p <= size; p++)
    net.position[3 * p] = (double)p / (double)size;
  for (int64_t offset = 1; status == HOOKE_OK && offset <= 2; offset++) {
    for (int64_t p = 0; p + offset <= size; p++)
      join(&net, p, p + offset);
  }
  return net_finish(&net, status, 1.0, damping, system);
}

static int32_t build_six(hooke_system *system, int64_t size, double damping) {
  struct net net;
  int32_t status = net_create(size, size * size, &net);
  for (int64_t p = 0; status == HOOKE_OK && p < size; p++) {
    net.position[3 * p] = cos((double)p);
    net.position[3 * p + 1] = sin((double)p);
    net.position[3 * p + 2] = 0.1 * (double)p;
    for (int64_t other = 0; other < p; other++)
      join(&net, other, p);
  }
  return net_finish(&net, status, 1.0, damping, system);
}

static const struct bench_scene table[] = {
    {"six-particles", build_six, 6, DAMPING, 1},
    {"cloth-16", build_cloth, 16, DAMPING, 0},
    {"cloth-32", build_cloth, 32, DAMPING, 0},
    {"cloth-64", build_cloth, 64, DAMPING, 0},
    {"cloth-128", build_cloth, 128, DAMPING, 1},
    {"cloth-256", build_cloth, 256, DAMPING, 0},
    {"cloth-512", build_cloth, 512, DAMPING, 0},
    {"cloth-1024", build_cloth, 1024, DAMPING, 0},
    {"cloth-128-undamped", build_cloth, 128, 0.0, 1},
    {"cloth-512-undamped", build_cloth, 512, 0.0, 0},
    {"cloth-1024-undamped", build_cloth, 1024, 0.0, 0},
    {"cloth-128-listed", build_listed_cloth, 128, DAMPING, 0},
    {"cloth-128-uneven", build_uneven_cloth, 128, DAMPING, 0},
    {"cloth-512-listed", build_listed_cloth, 512, DAMPING, 0},
    {"cloth-512-uneven", build_uneven_cloth, 512, DAMPING, 0},
    {"cloths-400", build_cloths, 400, DAMPING, 0},
    {"cloth-128-shuffled", build_shuffled_cloth, 128, DAMPING, 0},
    {"cloth-512-shuffled", build_shuffled_cloth, 512, DAMPING, 0},
    {"mesh-200000", build_mesh, 448, DAMPING, 1},
    {"rope-100000", build_rope, 100000, DAMPING, 0},
    {"lattice-64", build_lattice, 64, DAMPING, 0},
};

const struct bench_scene *bench_scene(int64_t number) {
  return number >= 0 && number < (int64_t)(sizeof table / sizeof table[0]) ? &table[number] : NULL;
}

int32_t bench_scene_create(const struct bench_scene *scene, hooke_system **system) {
  const double gravity[] = {0.0, -9.81, 0.0};
  int32_t status = hooke_system_create(system);
  if (status == HOOKE_OK) status = scene->build(*system, scene->size, scene->damping);
  if (status == HOOKE_OK) status = hooke_system_set_gravity(*system, gravity);
  return status == HOOKE_OK ? hooke_system_commit(*system) : status;
}
