/* Rigid bodies: their list while a system is built, what commit makes of it, and their row. */
#include "model/coordinates/body.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/check_value.h"
#include "model/coordinates/body_tangent.h"
#include "model/part_record.h"
#include "model/state.h"
#include "model/system.h"
#include "model/vector3.h"
#include "model/variant/variant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void release_frame(struct hk_body *body) {
  hk_free(body->place);
  hk_free(body->acted);
  body->place = NULL;
  body->acted = NULL;
  body->moves = 0;
}

static void release(struct hk_body *body) {
  release_frame(body);
  hk_free(body->name);
  hk_free(body->particle);
}

static void undo(hooke_system *system) {
  struct hk_bodies *bodies = system->bodies;
  for (int64_t k = 0; k < bodies->count; k++)
    release_frame(&bodies->body[k]);
  hk_free(bodies->of);
  bodies->of = NULL;
}

static void release_all(hooke_system *system) {
  for (int64_t k = 0; k < system->bodies->count; k++)
    release(&system->bodies->body[k]);
  hk_free(system->bodies->body);
}

void hk_system_remove_bodies(hooke_system *system, int64_t part) {
  struct hk_bodies *bodies = system->bodies;
  int64_t kept = 0;
  for (int64_t k = 0; k < bodies->count; k++) {
    if (bodies->body[k].part >= part)
      release(&bodies->body[k]);
    else
      bodies->body[kept++] = bodies->body[k];
  }
  bodies->count = kept;
}

static int64_t count(const hooke_system *system) {
  return system->bodies->count;
}

/* Bytes of a body and of each of its particles, at most. */
static double bytes(const hooke_system *system) {
  double sum = 2000.0 * (double)system->bodies->count;
  for (int64_t k = 0; k < system->bodies->count; k++)
    sum += 150.0 * (double)system->bodies->body[k].count;
  return sum;
}

static int64_t memory(const hooke_system *system) {
  const struct hk_bodies *bodies = system->bodies;
  int64_t bytes =
      bodies->capacity * (int64_t)sizeof *bodies->body + (bodies->of ? 4 * system->particle_count : 0);
  for (int64_t k = 0; k < bodies->count; k++)
    bytes += bodies->body[k].count * (int64_t)(2 * sizeof(int32_t) + 3 * sizeof(double));
  return bytes;
}

/* ---- adding ---- */

static int ascending(const void *a, const void *b) {
  const int32_t one = *(const int32_t *)a, other = *(const int32_t *)b;
  return (one > other) - (one < other);
}

int32_t hk_system_add_body(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                           int32_t project, int64_t part) {
  struct hk_bodies *bodies = system->bodies;
  if (bodies->count == bodies->capacity) {
    const int64_t capacity = 2 * bodies->capacity + 4;
    const int32_t status = hk_grow((void **)&bodies->body, bodies->count, capacity, sizeof *bodies->body);
    if (status != HOOKE_OK) return status;
    bodies->capacity = capacity;
  }
  struct hk_body body = {.part = part, .project = project, .count = count};
  body.name = hk_copy_text(name);
  body.particle = hk_new(count, sizeof *body.particle);
  if (body.name == NULL || body.particle == NULL) {
    release(&body);
    return HOOKE_NO_MEMORY;
  }
  for (int64_t k = 0; k < count; k++)
    body.particle[k] = (int32_t)particles[k];
  qsort(body.particle, (size_t)count, sizeof *body.particle, ascending);
  bodies->body[bodies->count++] = body;
  return HOOKE_OK;
}

int32_t hooke_system_add_body(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                              int32_t project) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK && count < 1)
    status = hk_fail(HOOKE_BAD_VALUE, "particles", "%lld of them; allowed: 1 or more", (long long)count);
  if (status == HOOKE_OK) status = hk_system_check_particles(system, "particles", count, particles, 0);
  return status == HOOKE_OK ? hk_system_add_body(system, name, count, particles, project, -1) : status;
}

/* ---- commit ---- */

/* The place of a body in a scene: bodies of parts are not in its list. */
static int32_t at_body(int32_t status, const struct hk_bodies *bodies, int64_t k) {
  int64_t number = 0;
  if (status != HOOKE_BAD_VALUE) return status;
  if (bodies->body[k].part >= 0)
    return hk_fail_within(status, "parts[%lld].rigid", (long long)bodies->body[k].part);
  for (int64_t b = 0; b < k; b++)
    number += bodies->body[b].part < 0;
  return hk_fail_within(status, "bodies[%lld]", (long long)number);
}

static int32_t find_owners(hooke_system *system) {
  struct hk_bodies *bodies = system->bodies;
  bodies->of = hk_new(system->particle_count, sizeof *bodies->of);
  if (bodies->of == NULL) return HOOKE_NO_MEMORY;
  memset(bodies->of, 0xff, (size_t)system->particle_count * sizeof *bodies->of);
  for (int64_t k = 0; k < bodies->count; k++) {
    for (int64_t i = 0; i < bodies->body[k].count; i++) {
      const int32_t p = bodies->body[k].particle[i], before = bodies->of[p];
      bodies->of[p] = (int32_t)k;
      if (before < 0) continue;
      if (before == k)
        hk_fail(HOOKE_BAD_VALUE, NULL, "particle %d is named twice; allowed: once", (int)p);
      else
        hk_fail(HOOKE_BAD_VALUE, NULL,
                "particle %d is already in the body \"%.40s\" (number %d); a particle is in one body at most",
                (int)p, bodies->body[before].name, (int)before);
      return at_body(HOOKE_BAD_VALUE, bodies, k);
    }
  }
  return HOOKE_OK;
}

/* ---- initial velocities ---- */

/* Velocities may differ from those of a rigid motion by this part of the largest. */
static const double VELOCITY_ROUNDING = 1e-9;

/* Rows of the nearest rigid motion: with the same momentum and angular momentum. `q` and `v` have 3 numbers a
 * particle; pinned ones are at rest. */
static void find_nearest(const hooke_system *system, const struct hk_body *body, double *q, double *v) {
  double own[HOOKE_BODY_NUMBERS];
  if (body->moves) {
    hk_body_read_rows(body, hk_start_position(system), system->velocity, own);
    hk_body_fit(system, body, own);
  }
  for (int64_t k = 0; k < body->count; k++)
    memset(v + 3 * (int64_t)body->particle[k], 0, 3 * sizeof(double));
  if (body->moves) hk_body_write_rows(system, body, own, q, v);
}

/* The particle whose velocity differs most from v, by `distance`; and the largest speed. */
static int32_t farthest(const hooke_system *system, const struct hk_body *body, const double *v,
                        double *distance, double *speed) {
  int32_t found = body->particle[0];
  *distance = *speed = 0.0;
  for (int64_t k = 0; k < body->count; k++) {
    const int64_t p = body->particle[k];
    double by[3];
    for (int a = 0; a < 3; a++) {
      by[a] = system->velocity[3 * p + a] - v[3 * p + a];
      *speed = fmax(*speed, fabs(system->velocity[3 * p + a]));
    }
    const double length = hk_length3(by);
    if (!(length > *distance)) continue;
    *distance = length;
    found = (int32_t)p;
  }
  return found;
}

static int32_t check_velocities(hooke_system *system, const struct hk_body *body, double *q, double *v) {
  double distance, speed;
  find_nearest(system, body, q, v);
  const int32_t p = farthest(system, body, v, &distance, &speed);
  if (distance <= VELOCITY_ROUNDING * speed) return HOOKE_OK;
  if (!body->project)
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "the velocities of its particles are not those of a rigid motion: that of particle %d is "
                   "%.3g m/s from the nearest one; allowed: a rigid motion, or \"project\": true",
                   (int)p, distance);
  for (int64_t k = 0; k < body->count; k++) {
    const int64_t at = 3 * (int64_t)body->particle[k];
    memcpy(system->velocity + at, v + at, 3 * sizeof(double));
  }
  return HOOKE_OK;
}

static int32_t check_all_velocities(hooke_system *system) {
  const struct hk_bodies *bodies = system->bodies;
  double *work = hk_new(6 * system->particle_count, sizeof(double));
  int32_t status = work ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < bodies->count && status == HOOKE_OK; k++) {
    const struct hk_body *body = &bodies->body[k];
    if (system->constrained[body->particle[0]] == HOOKE_IS_DRIVEN) continue; /* it follows its drive */
    status = check_velocities(system, body, work, work + 3 * system->particle_count);
    if (status != HOOKE_OK) at_body(status, bodies, k);
  }
  hk_free(work);
  return status;
}

/* These pins are not those that somebody added to a part by number (part_record.h). */
static void pin_still(hooke_system *system) {
  for (int64_t k = 0; k < system->part_count; k++)
    system->part[k].pinned -= hk_part_record_pinned(system, &system->part[k]);
  for (int64_t k = 0; k < system->bodies->count; k++)
    hk_body_pin_if_still(system, &system->bodies->body[k]);
  for (int64_t k = 0; k < system->part_count; k++)
    system->part[k].pinned += hk_part_record_pinned(system, &system->part[k]);
}

static int32_t commit(hooke_system *system) {
  struct hk_bodies *bodies = system->bodies;
  if (bodies->count == 0) return HOOKE_OK;
  int32_t status = find_owners(system);
  for (int64_t k = 0; k < bodies->count && status == HOOKE_OK; k++) {
    struct hk_body *body = &bodies->body[k];
    status = hk_body_commit(system, body);
    if (status != HOOKE_OK)
      at_body(status, bodies, k);
    else if (body->moves)
      hk_mover_add(system, &hk_coordinates_of_bodies, body);
  }
  if (status == HOOKE_OK) status = check_all_velocities(system);
  if (status == HOOKE_OK) pin_still(system);
  return status;
}

static int32_t find_acted(hooke_system *system, const uint8_t *acted) {
  for (int64_t k = 0; k < system->bodies->count; k++) {
    struct hk_body *body = &system->bodies->body[k];
    if (!body->moves) continue;
    body->acted = hk_new(body->count, sizeof *body->acted);
    if (body->acted == NULL) return HOOKE_NO_MEMORY;
    body->acted_count = 0;
    for (int32_t i = 0; i < body->count; i++) {
      const int is_base = i == body->base[0] || i == body->base[1] || i == body->base[2];
      if (is_base || acted[body->particle[i]]) body->acted[body->acted_count++] = i;
    }
  }
  return HOOKE_OK;
}

/* ---- states ---- */

static const double STATE_ROUNDING = 1e-6;

static int32_t check_rows(const struct hk_body *body, const char *name, const char *unit, const double *found,
                          const double *rigid) {
  double scale = 0.0;
  for (int64_t i = 0; i < 3 * body->count; i++)
    scale = fmax(scale, fabs(found[3 * (int64_t)body->particle[i / 3] + i % 3]));
  for (int64_t i = 0; i < 3 * body->count; i++) {
    const int64_t p = body->particle[i / 3], at = 3 * p + i % 3;
    const double distance = fabs(found[at] - rigid[at]);
    if (distance <= STATE_ROUNDING * scale) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL,
            "the body \"%.40s\" is rigid, and this particle is %.3g %s "
            "from where three others of it say; allowed: a rigid motion",
            body->name, distance, unit);
    return hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld][%lld]", name, (long long)p, (long long)(i % 3));
  }
  return HOOKE_OK;
}

static int32_t check_state(const hooke_system *system, const hooke_state *state) {
  const int64_t size = 3 * system->particle_count;
  double *q = hk_new(2 * size, sizeof(double));
  if (q == NULL) return HOOKE_NO_MEMORY;
  memcpy(q, state->q, (size_t)(2 * size) * sizeof(double)); /* v follows */
  hk_movers_renew(system, q, q + size);
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < system->bodies->count && status == HOOKE_OK; k++) {
    const struct hk_body *body = &system->bodies->body[k];
    if (!body->moves) continue;
    status = check_rows(body, "position", "m", state->q, q);
    if (status == HOOKE_OK) status = check_rows(body, "velocity", "m/s", state->v, q + size);
  }
  hk_free(q);
  return status;
}

/* By their first particles: the order in which they were added moves nothing. */
static void check(const hooke_system *system, uint32_t *value) {
  for (int64_t p = 0; p < system->particle_count && system->bodies->of; p++) {
    if (system->bodies->of[p] < 0) continue;
    const struct hk_body *body = &system->bodies->body[system->bodies->of[p]];
    if (body->particle[0] != p) continue;
    hk_check_whole(value, body->count);
    hk_check_add(value, body->particle, body->count, sizeof *body->particle);
  }
}

/* ---- copies ---- */

/* A body keeps all its particles, or goes with them. */
static int32_t keep(const struct hk_variant_maker *maker, const struct hk_body *body) {
  int64_t same = 0, gone = 0;
  int64_t *particles = hk_new(body->count, sizeof *particles);
  if (particles == NULL) return HOOKE_NO_MEMORY;
  for (int64_t i = 0; i < body->count; i++) {
    particles[i] = maker->map->to[body->particle[i]];
    same += hk_variant_is_same(maker->map, body->particle[i]);
    gone += particles[i] < 0;
  }
  int32_t status = HOOKE_OK;
  if (same == body->count)
    status = hk_system_add_body(maker->made, body->name, body->count, particles, body->project, -1);
  else if (gone < body->count)
    status = hk_fail(HOOKE_UNSUITED, NULL, "the rigid body \"%.40s\" would lose particles", body->name);
  hk_free(particles);
  return status;
}

/* Bodies that are no parts. */
static int32_t copy(const struct hk_variant_maker *maker) {
  const struct hk_bodies *bodies = maker->from->bodies;
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < bodies->count && status == HOOKE_OK; k++)
    if (bodies->body[k].part < 0) status = keep(maker, &bodies->body[k]);
  return status;
}

static int32_t copy_one(const void *thing, hooke_system *to) {
  const struct hk_body *body = thing;
  int64_t *particles = hk_new(body->count, sizeof *particles);
  if (particles == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < body->count; k++)
    particles[k] = body->particle[k];
  const int32_t status = hk_system_add_body(to, body->name, body->count, particles, 0, -1);
  hk_free(particles);
  return status;
}

/* ---- queries ---- */

const char *hooke_system_body_name(const hooke_system *system, int64_t body) {
  return body >= 0 && body < system->bodies->count ? system->bodies->body[body].name : NULL;
}

int64_t hooke_system_body_particles(const hooke_system *system, int64_t body, int64_t *particles) {
  if (body < 0 || body >= system->bodies->count) return 0;
  const struct hk_body *found = &system->bodies->body[body];
  for (int64_t k = 0; k < found->count && particles; k++)
    particles[k] = found->particle[k];
  return found->count;
}

static int32_t find_mover(const hooke_system *system, int64_t body, const struct hk_body **found) {
  const int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  if (body < 0 || body >= system->bodies->count)
    return hk_fail(HOOKE_BAD_VALUE, "body", "there is no body %lld; the system has %lld", (long long)body,
                   (long long)system->bodies->count);
  *found = &system->bodies->body[body];
  if ((*found)->moves) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "body", "body %lld is held still or driven: it has no motion of its own",
                 (long long)body);
}

int32_t hooke_system_body_inertia(const hooke_system *system, int64_t body, double *inertia) {
  const struct hk_body *found = NULL;
  const int32_t status = find_mover(system, body, &found);
  if (status != HOOKE_OK) return status;
  inertia[0] = found->mass;
  memcpy(inertia + 1, found->inertia, 3 * sizeof(double));
  return HOOKE_OK;
}

int32_t hooke_system_body_motion(const hooke_system *system, int64_t body, const double *q, const double *v,
                                 double *motion) {
  const struct hk_body *found = NULL;
  const int32_t status = find_mover(system, body, &found);
  if (status == HOOKE_OK) hk_body_read_rows(found, q, v, motion);
  return status;
}

/* ---- the row ---- */

static const int32_t *particles_of(const void *thing, int64_t *number) {
  const struct hk_body *body = thing;
  *number = body->count;
  return body->particle;
}

static int64_t count_acted(const hooke_system *system, const void *thing) {
  const struct hk_body *body = thing;
  return system->force ? body->count : body->acted_count;
}

const struct hk_coordinates_row hk_coordinates_of_bodies = {.name = "bodies",
                                                            .numbers = HOOKE_BODY_NUMBERS,
                                                            .solved = 1,
                                                            .turns = 1,
                                                            .count = count,
                                                            .commit = commit,
                                                            .find_acted = find_acted,
                                                            .undo = undo,
                                                            .release = release_all,
                                                            .bytes = bytes,
                                                            .memory = memory,
                                                            .check = check,
                                                            .copy = copy,
                                                            .copy_one = copy_one,
                                                            .check_state = check_state,
                                                            .particles = particles_of,
                                                            .acted = count_acted,
                                                            .read = hk_body_read,
                                                            .write = hk_body_write,
                                                            .push = hk_body_push,
                                                            .clear = hk_body_clear,
                                                            .kick = hk_body_kick,
                                                            .drift = hk_body_drift,
                                                            .slope = hk_body_slope,
                                                            .accelerate = hk_body_accelerate,
                                                            .normalise = hk_body_normalise,
                                                            .tolerance = hk_body_tolerance,
                                                            .spread = hk_body_spread_unit,
                                                            .gather = hk_body_gather_unit,
                                                            .has = hk_body_has,
                                                            .reach = hk_body_reach};
