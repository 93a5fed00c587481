#include "io/limit_picture.h"

#include "core/memory.h"
#include "measure/limit.h"

#include <math.h>

/* Digits of positions against the extent of the scene, and of displacements against the largest. */
static const double POSITION_DIGITS = 6.0, MOVE_SCALE = 1e4;

struct picture {
  const hooke_system *system;
  const double *q, *shape; /* the mode NULL: there is none */
  int64_t spring_count, drawn_count;
  int64_t *ends;  /* 2 spring_count */
  char *drawn;    /* of each spring */
  char *moves;    /* of each particle: it is among the movers */
  int64_t *place; /* of each particle among those drawn, from 1; 0: not drawn */
};

static int32_t make(struct picture *p, const hooke_limit *limit, const double *q) {
  const int64_t particles = hooke_system_particle_count(limit->system);
  *p = (struct picture){.system = limit->system, .q = q, .shape = hooke_limit_shape(limit)};
  p->spring_count = hooke_system_spring_count(p->system);
  p->ends = hooke_new(2 * p->spring_count, sizeof *p->ends);
  p->drawn = hooke_new(p->spring_count, 1);
  p->moves = hooke_new(particles, 1);
  p->place = hooke_new(particles, sizeof *p->place);
  if (!p->ends || !p->drawn || !p->moves || !p->place) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < hooke_limit_mover_count(limit); k++)
    p->moves[(int64_t)hooke_limit_mover_number(limit, k, "particle")] = 1;
  return hooke_system_spring_ends(p->system, p->ends);
}

static void release(struct picture *p) {
  hooke_free(p->ends);
  hooke_free(p->drawn);
  hooke_free(p->moves);
  hooke_free(p->place);
}

/* ---- which springs ---- */

static void take(struct picture *p, int64_t spring) {
  p->drawn_count += !p->drawn[spring];
  p->drawn[spring] = 1;
}

/* What is left is taken evenly by number. */
static void choose(struct picture *p, const hooke_limit *limit) {
  for (int64_t k = 0; k < hooke_limit_blame_count(limit); k++)
    take(p, (int64_t)hooke_limit_blame_number(limit, k, "spring"));
  for (int64_t k = 0; k < p->spring_count && p->drawn_count < HOOKE_PICTURE_SPRINGS / 2; k++) {
    if (p->moves[p->ends[2 * k]] || p->moves[p->ends[2 * k + 1]]) take(p, k);
  }
  const int64_t others = p->spring_count - p->drawn_count, room = HOOKE_PICTURE_SPRINGS - p->drawn_count;
  int64_t seen = 0;
  for (int64_t k = 0; k < p->spring_count; k++) {
    if (p->drawn[k]) continue;
    if (others <= room || seen * room / others != (seen + 1) * room / others) take(p, k);
    seen++;
  }
}

/* ---- what is told of them ---- */

/* 10^digits such that a coordinate rounded to 1/10^digits has enough of them; infinity: none is to be rounded. */
static double find_scale(const struct picture *p) {
  double extent = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    double low = INFINITY, high = -INFINITY;
    for (int64_t k = 0; k < 2 * p->spring_count; k++) {
      low = fmin(low, p->q[3 * p->ends[k] + axis]);
      high = fmax(high, p->q[3 * p->ends[k] + axis]);
    }
    extent = fmax(extent, high - low);
  }
  return extent > 0.0 ? pow(10.0, POSITION_DIGITS - ceil(log10(extent))) : INFINITY;
}

/* Short as text. */
static void add_rounded(struct hooke_text *data, double value, double scale) {
  const double rounded = rint(value * scale) / scale;
  hooke_text_number(data, NULL, isfinite(rounded) ? rounded + 0.0 : value);
}

static void add_springs(struct hooke_text *data, struct picture *p) {
  int64_t particles = 0;
  hooke_text_open(data, "spring", '[');
  for (int64_t k = 0; k < p->spring_count; k++) {
    if (p->drawn[k]) hooke_text_number(data, NULL, (double)k);
  }
  hooke_text_close(data, ']');
  hooke_text_open(data, "ends", '[');
  for (int64_t k = 0; k < 2 * p->spring_count; k++) {
    if (!p->drawn[k / 2]) continue;
    int64_t *place = &p->place[p->ends[k]];
    if (*place == 0) *place = ++particles;
    hooke_text_number(data, NULL, (double)(*place - 1));
  }
  hooke_text_close(data, ']');
}

/* In the order of their places. */
static int64_t *list_particles(const struct picture *p, int64_t *count) {
  const int64_t all = hooke_system_particle_count(p->system);
  int64_t *list = hooke_new(all, sizeof *list);
  *count = 0;
  for (int64_t k = 0; k < all && list; k++) {
    if (p->place[k] == 0) continue;
    list[p->place[k] - 1] = k;
    ++*count;
  }
  return list;
}

static void add_vectors(struct hooke_text *data, const char *key, const double *vectors, const int64_t *list,
                        int64_t count, double scale) {
  hooke_text_open(data, key, '[');
  for (int64_t k = 0; k < 3 * count && vectors; k++)
    add_rounded(data, vectors[3 * list[k / 3] + k % 3], scale);
  hooke_text_close(data, ']');
}

static void add_particles(struct hooke_text *data, const struct picture *p) {
  const double *weight = hooke_system_inverse_mass(p->system);
  int64_t count = 0, *list = list_particles(p, &count);
  if (list == NULL) data->status = HOOKE_NO_MEMORY;
  hooke_text_open(data, "particle", '[');
  for (int64_t k = 0; k < count; k++)
    hooke_text_number(data, NULL, (double)list[k]);
  hooke_text_close(data, ']');
  hooke_text_open(data, "held", '[');
  for (int64_t k = 0; k < count; k++)
    hooke_text_number(data, NULL, weight[list[k]] == 0.0);
  hooke_text_close(data, ']');
  add_vectors(data, "position", p->q, list, count, find_scale(p));
  add_vectors(data, "move", p->shape, list, count, MOVE_SCALE);
  hooke_free(list);
}

void hooke_limit_picture_add(struct hooke_text *data, const hooke_limit *limit, const double *q) {
  struct picture p;
  const int32_t status = make(&p, limit, q);
  if (status == HOOKE_OK) {
    choose(&p, limit);
    hooke_text_open(data, "picture", '{');
    hooke_text_number(data, "springs", (double)p.spring_count);
    hooke_text_number(data, "particles", (double)hooke_system_particle_count(p.system));
    add_springs(data, &p);
    add_particles(data, &p);
    hooke_text_close(data, '}');
  }
  if (status != HOOKE_OK && data->status == HOOKE_OK) data->status = status;
  release(&p);
}
