#include "measure/spectrum/linear_twin.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

/* A stretch below this is rounding of positions, not tension. */
static const double ROUNDING = 1e-12;
/* The longest of extents over shortest lengths that is made room for. */
static const double MOST_RATIO = 1e8;
static const double SHORTEST = 1e9;

struct hk_twin_spring hk_twin_view(const struct hk_spring *spring, const double *q) {
  struct hk_stretch s;
  hk_spring_stretch_taut(spring, q, &s);
  struct hk_twin_spring view = {spring->head,  spring->tail, {0.0, 0.0, 0.0},
                                spring->kappa, 0.0,          spring->gamma};
  memcpy(view.u, s.direction, sizeof view.u);
  if (s.length == 0.0)
    view.across = spring->kappa;
  else if (s.tension > ROUNDING * spring->kappa * s.length)
    view.across = s.tension / s.length;
  return view;
}

/* ---- making ---- */

/* What is collected on the way: the springs that are kept, in spring order. */
struct making {
  const hooke_system *system;
  const double *q;
  double middle[3], extent, shortest, factor;
  int64_t count;
  int64_t *ends;
  double *kappa, *gamma, *rest_length;
  struct hk_tetrahedron *tetrahedron; /* those that act, as many as the twin has */
};

/* Calls `see` for every spring with a free end. */
static void each_spring(struct making *making, struct hk_twin *twin,
                        void (*see)(struct making *, struct hk_twin *, const struct hk_spring *)) {
  const hooke_system *system = making->system;
  for (int64_t r = 0; r < system->springs.run_count; r++) {
    for (int64_t k = 0; k < system->springs.run[r].count; k++) {
      const struct hk_spring spring = hk_run_spring(&system->springs.run[r], k);
      if (!system->held[spring.head] || !system->held[spring.tail]) see(making, twin, &spring);
    }
  }
}

static double length_at(const struct hk_spring *spring, const double *q) {
  struct hk_stretch s;
  hk_spring_stretch(spring, q, NULL, &s);
  return s.length;
}

static void see_length(struct making *making, struct hk_twin *twin, const struct hk_spring *spring) {
  const double r = length_at(spring, making->q);
  twin->damped |= spring->gamma > 0.0;
  if (r > 0.0) making->shortest = fmin(making->shortest, r);
}

/* Those that act, each with the altitude that is shortest now for good. */
static void see_tetrahedra(struct making *making, struct hk_twin *twin) {
  const struct hk_altitudes *altitudes = &making->system->altitudes;
  for (int64_t k = 0; k < altitudes->count; k++) {
    struct hk_altitude_view *view = &twin->altitude[twin->altitude_count];
    struct hk_tetrahedron *t = &making->tetrahedron[twin->altitude_count];
    *t = altitudes->tetrahedron[k];
    if (!hk_tetrahedron_moves(making->system, t) || !hk_altitude_see(t, making->q, view)) continue;
    twin->altitude_count++;
    twin->damped |= view->gamma > 0.0;
    t->choice = view->choice;
    t->pull_only = 0;
    if (view->length < 0.0) t->side = -t->side;
    if (view->length != 0.0) making->shortest = fmin(making->shortest, fabs(view->length));
  }
}

/* Without tension where they are; one that is flat has so short a rest length that its tension is that of a
 * displacement. */
static void place_tetrahedra(const struct making *making, const struct hk_twin *twin) {
  for (int64_t k = 0; k < twin->altitude_count; k++) {
    struct hk_tetrahedron *t = &making->tetrahedron[k];
    struct hk_tautness s;
    const double length = hk_tautness_find(t, twin->place, NULL, &s) ? fabs(s.altitude.length) : 0.0;
    const double rest = t->rest[t->choice] = fmax(length, 1.0);
    t->stiffness = twin->altitude[k].kappa * rest;
    t->damping = twin->altitude[k].gamma * rest;
  }
}

static void find_extent(struct making *making) {
  for (int a = 0; a < 3; a++) {
    double low = INFINITY, high = -INFINITY;
    for (int64_t p = 0; p < making->system->particle_count; p++) {
      low = fmin(low, making->q[3 * p + a]);
      high = fmax(high, making->q[3 * p + a]);
    }
    making->middle[a] = low + 0.5 * (high - low);
    making->extent = fmax(making->extent, high - low);
  }
}

/* The shortest spring becomes 1e9/sqrt(extent over shortest) m long: the longer, the less springs turn; the
 * shorter, the less rounding of positions there is; this weighs the two. */
static void find_factor(struct making *making) {
  if (isinf(making->shortest)) {
    making->factor = 0.0; /* no spring has a direction: all of them are linear about one place */
    return;
  }
  const double shortest = fmax(making->shortest, making->extent / MOST_RATIO);
  making->factor = SHORTEST / sqrt(fmax(1.0, making->extent / shortest)) / shortest;
}

static void place_particles(const struct making *making, double *place) {
  for (int64_t k = 0; k < 3 * making->system->particle_count; k++)
    place[k] = making->factor * (making->q[k] - making->middle[k % 3]);
}

static void keep_spring(struct making *making, struct hk_twin *twin, const struct hk_spring *spring) {
  struct hk_twin_spring view = hk_twin_view(spring, making->q);
  const double before = length_at(spring, making->q), after = length_at(spring, twin->place);
  if (before > 0.0) twin->clamped += before < spring->rest_length * (1.0 - ROUNDING);
  if (after == 0.0 && spring->rest_length > 0.0) {
    twin->left_out++;
    return;
  }
  twin->turning += after == 0.0 && spring->gamma > 0.0;
  const int64_t k = making->count++;
  making->ends[2 * k] = spring->head;
  making->ends[2 * k + 1] = spring->tail;
  making->kappa[k] = spring->kappa;
  making->gamma[k] = spring->gamma;
  making->rest_length[k] = view.across > 0.0 && before > 0.0 ? after * (spring->rest_length / before) : after;
  twin->spring[twin->spring_count++] = view;
}

static int32_t new_thaw(struct making *making, struct hk_twin *twin) {
  const int64_t n = making->system->particle_count, springs = making->system->springs.count;
  twin->place = hk_new(3 * n, sizeof(double));
  twin->balance = hk_new(3 * n, sizeof(double));
  twin->spring = hk_new(springs, sizeof *twin->spring);
  making->ends = hk_new(2 * springs, sizeof(int64_t));
  making->tetrahedron = hk_new(making->system->altitudes.count, sizeof *making->tetrahedron);
  twin->altitude = hk_new(making->system->altitudes.count, sizeof *twin->altitude);
  making->kappa = hk_new(3 * springs, sizeof(double));
  if (!twin->place || !twin->balance || !twin->spring || !making->ends || !making->kappa ||
      !making->tetrahedron || !twin->altitude)
    return HOOKE_NO_MEMORY;
  making->gamma = making->kappa + springs;
  making->rest_length = making->gamma + springs;
  return HOOKE_OK;
}

static int32_t add_springs(const struct making *making, hooke_system *system) {
  hooke_options *options = NULL;
  int32_t status = hk_spring_options_create(&options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "law", "length");
  if (status == HOOKE_OK)
    status = hooke_options_set_numbers(options, "stiffness", making->count, making->kappa);
  if (status == HOOKE_OK)
    status = hooke_options_set_numbers(options, "damping", making->count, making->gamma);
  if (status == HOOKE_OK)
    status = hooke_options_set_numbers(options, "rest_length", making->count, making->rest_length);
  if (status == HOOKE_OK)
    status = hooke_system_add_springs(system, NULL, making->count, making->ends, options);
  hooke_options_destroy(options);
  return status;
}

static int32_t add_bending(const struct hk_bending *bending, hooke_system *system) {
  int64_t *triples = hk_new(3 * bending->count, sizeof(int64_t)), *end = triples;
  double *coefficient = hk_new(bending->count, sizeof(double)), *c = coefficient;
  int32_t status = triples && coefficient ? HOOKE_OK : HOOKE_NO_MEMORY;
  struct hk_triple triple;
  for (struct hk_triples at = {bending, 0, 0}; status == HOOKE_OK && hk_next_triple(&at, &triple);) {
    memcpy(end, triple.particle, sizeof triple.particle);
    end += 3;
    *c++ = triple.coefficient;
  }
  if (status == HOOKE_OK)
    status = hooke_system_add_bending(system, NULL, bending->count, triples, bending->count, coefficient);
  hk_free(triples);
  hk_free(coefficient);
  return status;
}

static int32_t hold(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t;
  (void)q;
  (void)v;
  const double *balance = ctx;
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] += balance[k];
  return 0;
}

static int32_t hold_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                            const double *dv, double *out, void *ctx) {
  (void)n;
  (void)t;
  (void)q;
  (void)v;
  (void)dq;
  (void)dv;
  (void)out;
  (void)ctx;
  return 0;
}

/* An open or committed system; the caller destroys it. */
static int32_t build(const struct making *making, const struct hk_twin *twin, const double *balance,
                     hooke_system **out) {
  const hooke_system *old = making->system;
  hooke_system *system = NULL;
  int32_t status = hooke_system_create(&system);
  if (status == HOOKE_OK) system->memory_limit = old->memory_limit;
  if (status == HOOKE_OK)
    status = hooke_system_add_particles(system, old->particle_count, twin->place, NULL, old->particle_count,
                                        old->mass, NULL);
  for (int64_t p = 0; p < old->particle_count && status == HOOKE_OK; p++) {
    if (old->held[p]) status = hooke_system_pin(system, 1, &p);
  }
  if (status == HOOKE_OK && making->count > 0) status = add_springs(making, system);
  if (status == HOOKE_OK && old->bending.count > 0) status = add_bending(&old->bending, system);
  if (status == HOOKE_OK && twin->altitude_count > 0)
    status = hk_system_add_tetrahedra(system, NULL, 0, twin->altitude_count, making->tetrahedron);
  if (status == HOOKE_OK) status = hooke_system_set_drag(system, old->drag);
  if (status == HOOKE_OK && balance)
    status = hooke_system_set_force(system, hold, hold_product, (void *)balance);
  if (status == HOOKE_OK) status = hooke_system_commit(system);
  if (status == HOOKE_OK)
    *out = system;
  else
    hooke_system_destroy(system);
  return status;
}

/* The force of springs and bending at rest, taken back: the sum that the integrators form is then 0 to the
 * bit. */
static int32_t find_balance(struct hk_twin *twin, int *needed) {
  const int64_t size = 3 * twin->system->particle_count;
  double *still = hk_new(size, sizeof(double));
  if (still == NULL) return HOOKE_NO_MEMORY;
  const int32_t status = hooke_system_force(twin->system, 0.0, twin->place, still, twin->balance);
  *needed = 0;
  for (int64_t k = 0; k < size; k++) {
    *needed |= twin->balance[k] != 0.0;
    twin->balance[k] = -twin->balance[k];
  }
  hk_free(still);
  return status;
}

static int32_t find_slow_step(struct hk_twin *twin) {
  const hooke_system *system = twin->system;
  double *sum = hk_new(2 * system->particle_count, sizeof(double));
  if (sum == NULL) return HOOKE_NO_MEMORY;
  double stiff = 0.0, damp = 0.0;
  for (int64_t k = 0; k < twin->spring_count; k++) {
    const struct hk_twin_spring *s = &twin->spring[k];
    sum[2 * s->head] += s->kappa, sum[2 * s->tail] += s->kappa;
    sum[2 * s->head + 1] += s->gamma, sum[2 * s->tail + 1] += s->gamma;
  }
  struct hk_triple triple;
  for (struct hk_triples at = {&system->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    for (int e = 0; e < 3; e++)
      sum[2 * triple.particle[e]] += 0.5 * hk_triple_row(system, &triple, e) * triple.coefficient;
  }
  for (int64_t k = 0; k < twin->altitude_count; k++) {
    const struct hk_altitude_view *view = &twin->altitude[k];
    for (int j = 0; j < 4; j++) {
      const int64_t p = view->tangent.particle[j];
      const double row = 0.5 * hk_altitude_row(system, view->tangent.particle, view->tangent.weight, j);
      sum[2 * p] += row * view->kappa, sum[2 * p + 1] += row * view->gamma;
    }
  }
  for (int64_t p = 0; p < system->particle_count; p++) {
    stiff = fmax(stiff, 2.0 * sum[2 * p] * system->inverse_mass[p]);
    damp = fmax(damp, (2.0 * sum[2 * p + 1] + system->drag) * system->inverse_mass[p]);
  }
  hk_free(sum);
  twin->slow_step = fmin(stiff > 0.0 ? 1.0 / sqrt(stiff) : INFINITY, damp > 0.0 ? 1.0 / damp : INFINITY);
  return HOOKE_OK;
}

static int32_t freeze(struct making *making, struct hk_twin *twin) {
  int32_t status = new_thaw(making, twin);
  if (status != HOOKE_OK) return status;
  find_extent(making);
  each_spring(making, twin, see_length);
  see_tetrahedra(making, twin);
  find_factor(making);
  place_particles(making, twin->place);
  each_spring(making, twin, keep_spring);
  place_tetrahedra(making, twin);
  int needed = 0;
  status = build(making, twin, NULL, &twin->system);
  if (status == HOOKE_OK) status = find_balance(twin, &needed);
  if (status == HOOKE_OK && needed) {
    hooke_system_destroy(twin->system);
    twin->system = NULL;
    status = build(making, twin, twin->balance, &twin->system);
  }
  return status == HOOKE_OK ? find_slow_step(twin) : status;
}

int32_t hk_twin_create(const hooke_system *system, const double *q, struct hk_twin *twin) {
  struct making making = {.system = system, .q = q, .shortest = INFINITY};
  *twin = (struct hk_twin){.damped = system->drag > 0.0};
  const int32_t status = freeze(&making, twin);
  hk_free(making.ends);
  hk_free(making.kappa);
  hk_free(making.tetrahedron);
  if (status != HOOKE_OK) hk_twin_release(twin);
  return status;
}

void hk_twin_release(struct hk_twin *twin) {
  hooke_system_destroy(twin->system);
  hk_free(twin->place);
  hk_free(twin->balance);
  hk_free(twin->spring);
  hk_free(twin->altitude);
  memset(twin, 0, sizeof *twin);
}

/* ---- asking ---- */

/* Twice the energy of bending of a displacement from `place`. */
static double bending_energy(const struct hk_twin *twin, const double *q) {
  struct hk_triple triple;
  double sum = 0.0;
  for (struct hk_triples at = {&twin->system->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    for (int a = 0; a < 3; a++) {
      double d = 0.0;
      for (int e = 0; e < 3; e++) {
        const int64_t k = 3 * triple.particle[e] + a;
        d += hk_triple_factor(e) * (q[k] - twin->place[k]);
      }
      sum += triple.coefficient * (d * d);
    }
  }
  return sum;
}

/* How far displacements x (rows), from `place` (NULL: none), stretch an altitude. */
static double stretch_of(const struct hk_altitude_view *view, const double *x, const double *place) {
  double sum = 0.0;
  for (int j = 0; j < 4; j++) {
    const int64_t k = 3 * (int64_t)view->tangent.particle[j];
    for (int a = 0; a < 3; a++)
      sum += view->tangent.weight[j] * view->tangent.u[a] * (x[k + a] - (place ? place[k + a] : 0.0));
  }
  return sum;
}

double hk_twin_energy(const struct hk_twin *twin, const double *q, const double *v) {
  const double *mass = twin->system->mass, *place = twin->place;
  double sum = bending_energy(twin, q);
  for (int64_t p = 0; p < twin->system->particle_count; p++) {
    const double *u = v + 3 * p;
    sum += mass[p] * ((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
  }
  for (int64_t k = 0; k < twin->spring_count; k++) {
    const struct hk_twin_spring *s = &twin->spring[k];
    const int64_t i = 3 * s->head, j = 3 * s->tail;
    double along = 0.0, square = 0.0;
    for (int a = 0; a < 3; a++) {
      const double d = (q[i + a] - place[i + a]) - (q[j + a] - place[j + a]);
      along += s->u[a] * d;
      square += d * d;
    }
    sum += s->across * square + (s->kappa - s->across) * along * along;
  }
  for (int64_t k = 0; k < twin->altitude_count; k++) {
    const double along = stretch_of(&twin->altitude[k], q, place);
    sum += twin->altitude[k].kappa * along * along;
  }
  return sum;
}

void hk_twin_push(const struct hk_twin *twin, const double *x, double *out) {
  const hooke_system *system = twin->system;
  const double t = twin->slow_step, *w = system->inverse_mass;
  for (int64_t k = 0; k < 3 * system->particle_count; k++)
    out[k] = t * system->drag * w[k / 3] * x[k];
  struct hk_triple triple;
  for (struct hk_triples at = {&system->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    double d[3];
    hk_triple_bend(&triple, x, d);
    for (int e = 0; e < 3; e++) {
      const double factor = t * t * triple.coefficient * hk_triple_factor(e) * w[triple.particle[e]];
      for (int a = 0; a < 3; a++)
        out[3 * triple.particle[e] + a] += factor * d[a];
    }
  }
  for (int64_t k = 0; k < twin->altitude_count; k++) {
    const struct hk_altitude_view *view = &twin->altitude[k];
    const double f = t * (t * view->kappa + view->gamma) * stretch_of(view, x, NULL);
    for (int j = 0; j < 4; j++) {
      const int64_t p = view->tangent.particle[j];
      for (int b = 0; b < 3; b++)
        out[3 * p + b] += w[p] * f * view->tangent.weight[j] * view->tangent.u[b];
    }
  }
  for (int64_t k = 0; k < twin->spring_count; k++) {
    const struct hk_twin_spring *s = &twin->spring[k];
    const int64_t i = 3 * s->head, j = 3 * s->tail;
    const double d[3] = {x[i] - x[j], x[i + 1] - x[j + 1], x[i + 2] - x[j + 2]};
    const double along = (s->u[0] * d[0] + s->u[1] * d[1]) + s->u[2] * d[2];
    for (int a = 0; a < 3; a++) {
      const double f = t * (t * (s->across * d[a] + (s->kappa - s->across) * along * s->u[a]) +
                            s->gamma * along * s->u[a]);
      out[i + a] += w[s->head] * f;
      out[j + a] -= w[s->tail] * f;
    }
  }
}
