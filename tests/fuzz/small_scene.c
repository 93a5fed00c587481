#include "small_scene.h"

#include "fuzz.h"

#include <math.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

/* Bits of the first byte of the head. */
enum {
  WITH_GRAVITY = 1,
  WITH_DRAG = 2,
  WITH_EXTREMES = 4,
  MANY_PARTICLES = 8,
  WITH_MASSES = 16,
  ON_A_GRID = 32
};

/* The first byte of a record. */
enum { SPRINGS, MORE_SPRINGS, TRIPLES, TETRAHEDRA, HELD, POSITION, VELOCITY, MASS, RECORDS };

/* ---- numbers ---- */

static uint64_t mix(uint64_t z) {
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

/* From 0 to 1, from a seed and an index. */
static double drawn(uint64_t seed, uint64_t place) {
  return (double)(mix(seed * UINT64_C(0x9e3779b97f4a7c15) + place) >> 11) * 0x1p-53;
}

static const double extremes[] = {5e-324, 1e-308, 1e-200, 1e-160, 1e-100, 1e-30, 1e-12, 1e12,
                                  1e30,   1e100,  1e150,  1e154,  1e200,  1e290, 1e300, 3e-162};
enum { EXTREMES = sizeof extremes / sizeof extremes[0] };

/* A number >= 0 from one byte: zero, small ones, and with `extreme` those at the ends of the range. */
static double positive(uint8_t code, int extreme) {
  if (extreme && code >= 256 - EXTREMES) return extremes[code - (256 - EXTREMES)];
  return code / 16.0;
}

static double any(uint8_t code, int extreme) {
  const uint8_t size = code & 127;
  const double whole = extreme && size >= 128 - EXTREMES ? extremes[size - (128 - EXTREMES)] : size / 16.0;
  return code & 128 ? -whole : whole;
}

/* ---- particles ---- */

/* Near a grid, so that neighbours in number are neighbours in space; no two coincide, unless a record says
 * so. */
static void place_particles(const uint8_t head[SCENE_HEAD], struct small_scene *scene) {
  const uint64_t seed = head[3];
  const int shaken = !(head[0] & ON_A_GRID);
  for (int64_t p = 0; p < scene->particles; p++) {
    const double at[3] = {(double)(p % 5), (double)(p / 5 % 5), (double)(p / 25)};
    for (int64_t a = 0; a < 3; a++) {
      const uint64_t place = (uint64_t)(3 * p + a);
      scene->q[3 * p + a] = at[a] + (shaken ? 0.4 * drawn(seed, place) : 0.0);
      scene->v[3 * p + a] = seed % 4 ? drawn(seed + 256, place) - 0.5 : 0.0;
    }
    scene->mass[p] = head[0] & WITH_MASSES ? 0.5 + drawn(seed + 512, (uint64_t)p) : 1.0;
  }
}

static void change_particle(const uint8_t *record, struct small_scene *scene) {
  const int64_t p = record[1] % scene->particles, other = record[2] % scene->particles;
  for (int a = 0; a < 3 && record[0] != MASS; a++) {
    double *to = record[0] == POSITION ? scene->q : scene->v;
    to[3 * p + a] = record[3] & 1 ? to[3 * other + a] : any(record[4 + a], scene->extreme);
  }
  const double mass = positive(record[4], scene->extreme);
  if (record[0] == MASS && mass > 0.0 && isfinite(1.0 / mass)) scene->mass[p] = mass;
}

/* Along a curve through a few points. */
static void drive_by_table(const uint8_t *record, int64_t particle, hooke_system *system) {
  double time[5], position[15];
  const int64_t samples = 2 + record[6] % 4;
  for (int64_t k = 0; k < samples; k++) {
    time[k] = record[4] / 256.0 - 0.5 + (double)k * (0.01 + record[5] / 64.0);
    for (int64_t a = 0; a < 3; a++)
      position[3 * k + a] = 0.5 * drawn(record[6], (uint64_t)(3 * k + a)) - 0.25;
  }
  hooke_system_drive_table(system, 1, &particle, samples, time, position);
}

/* Pinned, in harmonic motion or along a curve. Constraining a particle twice is refused. */
static void hold_particles(const uint8_t *record, struct small_scene *scene, hooke_system *system) {
  int64_t held[4];
  const int64_t count = 1 + record[1] % 4;
  for (int64_t k = 0; k < count; k++)
    held[k] = record[2 + k] % scene->particles;
  if ((record[7] & 3) == 3) {
    drive_by_table(record, held[0], system);
  } else if (record[7] & 1) {
    const double amplitude[] = {record[6] / 256.0, 0.1, -0.2};
    hooke_system_drive_harmonic(system, 1, held, amplitude, 0.25 * record[5], 0.1 * record[4]);
  } else {
    hooke_system_pin(system, count, held);
  }
}

/* ---- members of forces ---- */

/* `each` particles in each of `count` rows: along a run, at a constant distance from each other, both ways;
 * or at random. */
static int64_t draw_rows(const uint8_t *record, const struct small_scene *scene, int64_t each, int64_t most,
                         int64_t *row) {
  const int64_t n = scene->particles, want = 1 + record[2] % 64;
  const int64_t offset = 1 + record[4] % 8, start = record[3] % n;
  int64_t count = 0;
  for (int64_t k = 0; k < want && count < most; k++) {
    int64_t *to = row + each * count;
    int fits = 1;
    for (int64_t e = 0; e < each; e++) {
      int64_t at = (record[1] & 1 ? start - k : start + k) + (record[1] & 2 ? each - 1 - e : e) * offset;
      if (record[1] & 4) at = (int64_t)(mix((uint64_t)(record[3] * 1000 + k * 8 + e)) % (uint64_t)n);
      fits = fits && at >= 0 && at < n;
      for (int64_t f = 0; f < e; f++)
        fits = fits && to[f] != at;
      to[e] = at;
    }
    count += fits;
  }
  return count;
}

/* One number for all, or one each. */
static void set_material(hooke_options *options, const char *name, uint8_t code, int each, int64_t count,
                         int extreme) {
  double number[64];
  const double base = positive(code, extreme);
  for (int64_t k = 0; k < count; k++)
    number[k] = each ? base * (0.75 + 0.5 * drawn(code, (uint64_t)k)) : base;
  hooke_options_set_numbers(options, name, each ? count : 1, number);
}

static void add_springs(const uint8_t *record, struct small_scene *scene, int64_t *springs,
                        hooke_system *system) {
  int64_t ends[128];
  const int64_t count = draw_rows(record, scene, 2, 64, ends);
  const int pulls = (record[1] & 8) != 0, length = (record[1] & 16) != 0, each = (record[1] & 32) != 0;
  hooke_options *options = NULL;
  if (count == 0 || *springs + count > MOST_SPRINGS) return;
  hooke_fuzz_require(hooke_options_create("springs", &options) == HOOKE_OK, "options of springs");
  hooke_options_set_text(options, "law", length ? "length" : "strain");
  set_material(options, "stiffness", record[5], each, count, scene->extreme);
  set_material(options, "damping", record[6], each, count, scene->extreme);
  if (record[7])
    set_material(options, "rest_length", record[7] == 255 ? 0 : record[7], each, count, scene->extreme);
  hooke_options_set_number(options, "compression", !pulls);
  if (hooke_system_add_springs(system, pulls ? "pull" : "push", count, ends, options) == HOOKE_OK) {
    *springs += count;
    scene->pulls |= pulls;
  }
  hooke_options_destroy(options);
}

static void add_triples(const uint8_t *record, const struct small_scene *scene, hooke_system *system) {
  int64_t triple[3 * 64];
  double coefficient[64];
  const int64_t count = draw_rows(record, scene, 3, 64, triple);
  for (int64_t k = 0; k < count; k++)
    coefficient[k] =
        positive(record[5], scene->extreme) * (record[1] & 32 ? drawn(record[6], (uint64_t)k) : 1.0);
  if (count > 0)
    hooke_system_add_bending(system, "bend", count, triple, record[1] & 32 ? count : 1, coefficient);
}

static void add_tetrahedra(const uint8_t *record, struct small_scene *scene, hooke_system *system) {
  int64_t corner[4 * 64];
  const int64_t count = draw_rows(record, scene, 4, 64, corner);
  const int pulls = (record[1] & 8) != 0;
  hooke_options *options = NULL;
  if (count == 0) return;
  hooke_fuzz_require(hooke_options_create("altitude", &options) == HOOKE_OK, "options of altitude springs");
  set_material(options, "stiffness", record[5], (record[1] & 32) != 0, count, scene->extreme);
  set_material(options, "damping", record[6], (record[1] & 32) != 0, count, scene->extreme);
  hooke_options_set_number(options, "rest_scale", 0.5 + record[7] / 256.0);
  hooke_options_set_number(options, "compression", !pulls);
  if (hooke_system_add_altitude(system, pulls ? "pull" : "push", count, corner, options) == HOOKE_OK)
    scene->pulls |= pulls;
  hooke_options_destroy(options);
}

/* ---- the scene ---- */

static void fill(const uint8_t *records, int64_t count, struct small_scene *scene, hooke_system *system) {
  int64_t springs = 0;
  for (int64_t k = 0; k < count; k++) {
    const uint8_t *record = records + k * SCENE_RECORD;
    const int kind = record[0] % RECORDS;
    if (kind == SPRINGS || kind == MORE_SPRINGS) add_springs(record, scene, &springs, system);
    if (kind == TRIPLES) add_triples(record, scene, system);
    if (kind == TETRAHEDRA) add_tetrahedra(record, scene, system);
    if (kind == HELD) hold_particles(record, scene, system);
  }
}

static void place_driven(double t, double *q, double *v, void *ctx) {
  const struct small_scene *scene = ctx;
  hooke_state_set_time(scene->driven, t);
  hooke_fuzz_require(hooke_integrator_step(scene->driver, scene->driven, 0) == HOOKE_OK, "drives");
  const double *from_q = hooke_state_position(scene->driven), *from_v = hooke_state_velocity(scene->driven);
  const double *w = scene->canonical.inverse_mass;
  for (int64_t k = 0; k < 3 * scene->particles; k++) {
    if (w[k / 3] != 0.0) continue;
    q[k] = from_q[k];
    v[k] = from_v[k];
  }
}

static int32_t start_driver(struct small_scene *scene) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_create("run", &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", "forward-euler");
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "step", 1.0);
  if (status == HOOKE_OK) status = hooke_integrator_create(scene->system, options, &scene->driver);
  if (status == HOOKE_OK) status = hooke_state_create(scene->system, &scene->driven);
  hooke_options_destroy(options);
  scene->canonical.place = place_driven;
  scene->canonical.place_ctx = scene;
  return status;
}

static int is_driven(const uint8_t *records, int64_t count) {
  int driven = 0;
  for (int64_t k = 0; k < count; k++)
    driven |= records[k * SCENE_RECORD] % RECORDS == HELD && (records[k * SCENE_RECORD + 7] & 1);
  return driven;
}

/* Particles with velocity must not be pinned: their velocity is zeroed before they are added. */
static void stop_pinned(const uint8_t *records, int64_t count, struct small_scene *scene) {
  for (int64_t k = 0; k < count; k++) {
    const uint8_t *record = records + k * SCENE_RECORD;
    if (record[0] % RECORDS != HELD || (record[7] & 1)) continue;
    for (int e = 0; e <= record[1] % 4; e++)
      memset(scene->v + 3 * (record[2 + e] % scene->particles), 0, 3 * sizeof(double));
  }
}

static void set_fields(const uint8_t head[SCENE_HEAD], struct small_scene *scene, double *drag) {
  for (int a = 0; a < 3; a++)
    scene->gravity[a] = head[0] & WITH_GRAVITY ? any(head[4 + a], scene->extreme) : 0.0;
  *drag = head[0] & WITH_DRAG ? positive(head[7], scene->extreme) : 0.0;
}

int small_scene_create(const uint8_t *data, size_t size, struct small_scene *scene) {
  memset(scene, 0, sizeof *scene);
  if (size < SCENE_HEAD) return 0;
  const uint8_t *head = data, *records = data + SCENE_HEAD;
  int64_t count = (int64_t)((size - SCENE_HEAD) / SCENE_RECORD);
  if (count > MOST_RECORDS) count = MOST_RECORDS;
  double drag;
  scene->extreme = (head[0] & WITH_EXTREMES) != 0;
  scene->particles = head[0] & MANY_PARTICLES ? 64 + head[1] % 64 : 1 + head[1] % 40;
  place_particles(head, scene);
  for (int64_t k = 0; k < count; k++) {
    uint8_t record[SCENE_RECORD];
    memcpy(record, records + k * SCENE_RECORD, sizeof record);
    record[0] %= RECORDS;
    if (record[0] >= POSITION) change_particle(record, scene);
  }
  stop_pinned(records, count, scene);
  set_fields(head, scene, &drag);
  hooke_system *system = NULL;
  hooke_fuzz_require(hooke_system_create(&system) == HOOKE_OK, "a system");
  scene->system = system;
  hooke_fuzz_require(hooke_system_add_particles(system, scene->particles, scene->q, scene->v,
                                                scene->particles, scene->mass, NULL) == HOOKE_OK,
                     "particles");
  fill(records, count, scene, system);
  hooke_fuzz_require(hooke_system_set_gravity(system, scene->gravity) == HOOKE_OK, "gravity");
  hooke_fuzz_require(hooke_system_set_drag(system, drag) == HOOKE_OK, "drag");
  if (hooke_system_commit(system) != HOOKE_OK) {
    small_scene_destroy(scene);
    return 0;
  }
  canonical_create(system, &scene->canonical);
  const double *g = scene->gravity;
  scene->canonical.gravity = g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0 ? g : NULL;
  scene->canonical.drag = drag;
  if (is_driven(records, count) && start_driver(scene) != HOOKE_OK) {
    small_scene_destroy(scene);
    return 0;
  }
  return 1;
}

void small_scene_destroy(struct small_scene *scene) {
  canonical_destroy(&scene->canonical);
  hooke_integrator_destroy(scene->driver);
  hooke_state_destroy(scene->driven);
  hooke_system_destroy(scene->system);
  scene->system = NULL;
}

/* ---- mutating ---- */

static size_t records_in(size_t size) {
  const size_t count = size < SCENE_HEAD ? 0 : (size - SCENE_HEAD) / SCENE_RECORD;
  return count < MOST_RECORDS ? count : MOST_RECORDS;
}

size_t small_scene_mutate(uint8_t *data, size_t size, size_t most, unsigned seed) {
  uint64_t state = seed, bytes;
  if (most < SCENE_HEAD) return 0;
  if (size < SCENE_HEAD) memset(data + size, 0, SCENE_HEAD - size);
  const size_t room = records_in(most);
  size_t count = records_in(size);
  if (count > room) count = room;
  uint8_t *list = data + SCENE_HEAD;
  for (uint64_t times = 1 + mix(++state) % 3; times > 0; times--) {
    const uint64_t what = mix(state += 7) % 12;
    uint8_t *at = count > 0 ? list + mix(state + 1) % count * SCENE_RECORD : list;
    const uint8_t *other = count > 0 ? list + mix(state + 4) % count * SCENE_RECORD : list;
    bytes = mix(state + 2);
    if (what == 0) {
      data[mix(state + 3) % SCENE_HEAD] = (uint8_t)bytes;
    } else if ((what == 1 || count == 0) && count < room) {
      memcpy(list + count++ * SCENE_RECORD, &bytes, SCENE_RECORD);
    } else if (what == 2 && count > 0) {
      memmove(at, list + --count * SCENE_RECORD, SCENE_RECORD);
    } else if (what == 3 && count > 0) {
      LLVMFuzzerMutate(at, SCENE_RECORD, SCENE_RECORD);
    } else if (what < 6 && count > 0 && count < room) {
      /* a nearly equal record: members that the library groups differ in few properties */
      at = memcpy(list + count++ * SCENE_RECORD, other, SCENE_RECORD);
      at[1 + mix(state + 3) % (SCENE_RECORD - 1)] = (uint8_t)bytes;
    } else if (what < 8 && count > 0) {
      const uint64_t k = mix(state + 3) % SCENE_RECORD;
      at[k] = other[k];
    } else if (count > 0) {
      at[mix(state + 3) % SCENE_RECORD] = (uint8_t)bytes;
    }
  }
  return SCENE_HEAD + count * SCENE_RECORD;
}

size_t small_scene_cross(const uint8_t *one, size_t one_size, const uint8_t *two, size_t two_size,
                         uint8_t *out, size_t most, unsigned seed) {
  const size_t room = records_in(most), first = records_in(one_size), second = records_in(two_size);
  size_t count = 0;
  if (most < SCENE_HEAD || one_size < SCENE_HEAD || two_size < SCENE_HEAD) return 0;
  memcpy(out, mix(seed) & 1 ? one : two, SCENE_HEAD);
  for (size_t k = 0; k < first + second && count < room; k++) {
    if (mix(seed + 1 + k) & 1) continue;
    const uint8_t *from = k < first ? one + k * SCENE_RECORD : two + (k - first) * SCENE_RECORD;
    memcpy(out + SCENE_HEAD + count++ * SCENE_RECORD, from + SCENE_HEAD, SCENE_RECORD);
  }
  return SCENE_HEAD + count * SCENE_RECORD;
}
