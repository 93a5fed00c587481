#include "measure/spectrum/frozen.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

/* A stretch below this is rounding of positions, not tension. */
static const double ROUNDING = 1e-12;
/* The longest of extents over shortest lengths that is made room for. */
static const double MOST_RATIO = 1e8;
static const double SHORTEST = 1e9;

struct hk_frozen_spring hk_frozen_view(const struct hk_spring *spring, const double *q) {
  struct hk_stretch s;
  hk_spring_stretch_taut(spring, q, &s);
  struct hk_frozen_spring view = {spring->head,  spring->tail, {0.0, 0.0, 0.0},
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
struct thaw {
  const hooke_system *system;
  const double *q;
  double middle[3], extent, shortest, factor;
  int64_t count;
  int64_t *ends;
  double *kappa, *gamma, *rest_length;
  struct hk_tetrahedron *tetrahedron; /* those that act, as many as the frozen ones */
};

/* Calls `see` for every spring with a free end. */
static void each_spring(struct thaw *thaw, struct hk_frozen *frozen,
                        void (*see)(struct thaw *, struct hk_frozen *, const struct hk_spring *)) {
  const hooke_system *system = thaw->system;
  for (int64_t r = 0; r < system->springs.run_count; r++) {
    for (int64_t k = 0; k < system->springs.run[r].count; k++) {
      const struct hk_spring spring = hk_run_spring(&system->springs.run[r], k);
      if (!system->held[spring.head] || !system->held[spring.tail]) see(thaw, frozen, &spring);
    }
  }
}

static double length_at(const struct hk_spring *spring, const double *q) {
  struct hk_stretch s;
  hk_spring_stretch(spring, q, NULL, &s);
  return s.length;
}

static void see_length(struct thaw *thaw, struct hk_frozen *frozen, const struct hk_spring *spring) {
  const double r = length_at(spring, thaw->q);
  frozen->damped |= spring->gamma > 0.0;
  if (r > 0.0) thaw->shortest = fmin(thaw->shortest, r);
}

/* Those that act, each with the altitude that is shortest now for good. */
static void see_tetrahedra(struct thaw *thaw, struct hk_frozen *frozen) {
  const struct hk_altitudes *altitudes = &thaw->system->altitudes;
  for (int64_t k = 0; k < altitudes->count; k++) {
    struct hk_altitude_view *view = &frozen->altitude[frozen->altitude_count];
    struct hk_tetrahedron *t = &thaw->tetrahedron[frozen->altitude_count];
    *t = altitudes->tetrahedron[k];
    if (!hk_tetrahedron_moves(thaw->system, t) || !hk_altitude_see(t, thaw->q, view)) continue;
    frozen->altitude_count++;
    frozen->damped |= view->gamma > 0.0;
    t->choice = view->choice;
    t->pull_only = 0;
    if (view->length < 0.0) t->side = -t->side;
    if (view->length != 0.0) thaw->shortest = fmin(thaw->shortest, fabs(view->length));
  }
}

/* Without tension where they are; one that is flat has so short a rest length that its tension is that of a
 * displacement. */
static void place_tetrahedra(const struct thaw *thaw, const struct hk_frozen *frozen) {
  for (int64_t k = 0; k < frozen->altitude_count; k++) {
    struct hk_tetrahedron *t = &thaw->tetrahedron[k];
    struct hk_tautness s;
    const double length = hk_tautness_find(t, frozen->place, NULL, &s) ? fabs(s.altitude.length) : 0.0;
    const double rest = t->rest[t->choice] = fmax(length, 1.0);
    t->stiffness = frozen->altitude[k].kappa * rest;
    t->damping = frozen->altitude[k].gamma * rest;
  }
}

static void find_extent(struct thaw *thaw) {
  for (int a = 0; a < 3; a++) {
    double low = INFINITY, high = -INFINITY;
    for (int64_t p = 0; p < thaw->system->particle_count; p++) {
      low = fmin(low, thaw->q[3 * p + a]);
      high = fmax(high, thaw->q[3 * p + a]);
    }
    thaw->middle[a] = low + 0.5 * (high - low);
    thaw->extent = fmax(thaw->extent, high - low);
  }
}

/* The shortest spring becomes 1e9/sqrt(extent over shortest) m long: the longer, the less springs turn; the
 * shorter, the less rounding of positions there is; this weighs the two. */
static void find_factor(struct thaw *thaw) {
  if (isinf(thaw->shortest)) {
    thaw->factor = 0.0; /* no spring has a direction: all of them are linear about one place */
    return;
  }
  const double shortest = fmax(thaw->shortest, thaw->extent / MOST_RATIO);
  thaw->factor = SHORTEST / sqrt(fmax(1.0, thaw->extent / shortest)) / shortest;
}

static void place_particles(const struct thaw *thaw, double *place) {
  for (int64_t k = 0; k < 3 * thaw->system->particle_count; k++)
    place[k] = thaw->factor * (thaw->q[k] - thaw->middle[k % 3]);
}

static void keep_spring(struct thaw *thaw, struct hk_frozen *frozen, const struct hk_spring *spring) {
  struct hk_frozen_spring view = hk_frozen_view(spring, thaw->q);
  const double before = length_at(spring, thaw->q), after = length_at(spring, frozen->place);
  if (before > 0.0) frozen->clamped += before < spring->rest_length * (1.0 - ROUNDING);
  if (after == 0.0 && spring->rest_length > 0.0) {
    frozen->left_out++;
    return;
  }
  frozen->turning += after == 0.0 && spring->gamma > 0.0;
  const int64_t k = thaw->count++;
  thaw->ends[2 * k] = spring->head;
  thaw->ends[2 * k + 1] = spring->tail;
  thaw->kappa[k] = spring->kappa;
  thaw->gamma[k] = spring->gamma;
  thaw->rest_length[k] = view.across > 0.0 && before > 0.0 ? after * (spring->rest_length / before) : after;
  frozen->spring[frozen->spring_count++] = view;
}

static int32_t new_thaw(struct thaw *thaw, struct hk_frozen *frozen) {
  const int64_t n = thaw->system->particle_count, springs = thaw->system->springs.count;
  frozen->place = hk_new(3 * n, sizeof(double));
  frozen->balance = hk_new(3 * n, sizeof(double));
  frozen->spring = hk_new(springs, sizeof *frozen->spring);
  thaw->ends = hk_new(2 * springs, sizeof(int64_t));
  thaw->tetrahedron = hk_new(thaw->system->altitudes.count, sizeof *thaw->tetrahedron);
  frozen->altitude = hk_new(thaw->system->altitudes.count, sizeof *frozen->altitude);
  thaw->kappa = hk_new(3 * springs, sizeof(double));
  if (!frozen->place || !frozen->balance || !frozen->spring || !thaw->ends || !thaw->kappa ||
      !thaw->tetrahedron || !frozen->altitude)
    return HOOKE_NO_MEMORY;
  thaw->gamma = thaw->kappa + springs;
  thaw->rest_length = thaw->gamma + springs;
  return HOOKE_OK;
}

static int32_t add_springs(const struct thaw *thaw, hooke_system *system) {
  hooke_options *options = NULL;
  int32_t status = hooke_spring_options_create(&options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "law", "length");
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "stiffness", thaw->count, thaw->kappa);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "damping", thaw->count, thaw->gamma);
  if (status == HOOKE_OK)
    status = hooke_options_set_numbers(options, "rest_length", thaw->count, thaw->rest_length);
  if (status == HOOKE_OK) status = hooke_system_add_springs(system, NULL, thaw->count, thaw->ends, options);
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
static int32_t build(const struct thaw *thaw, const struct hk_frozen *frozen, const double *balance,
                     hooke_system **out) {
  const hooke_system *old = thaw->system;
  hooke_system *system = NULL;
  int32_t status = hooke_system_create(&system);
  if (status == HOOKE_OK) system->memory_limit = old->memory_limit;
  if (status == HOOKE_OK)
    status = hooke_system_add_particles(system, old->particle_count, frozen->place, NULL, old->particle_count,
                                        old->mass, NULL);
  for (int64_t p = 0; p < old->particle_count && status == HOOKE_OK; p++) {
    if (old->held[p]) status = hooke_system_pin(system, 1, &p);
  }
  if (status == HOOKE_OK && thaw->count > 0) status = add_springs(thaw, system);
  if (status == HOOKE_OK && old->bending.count > 0) status = add_bending(&old->bending, system);
  if (status == HOOKE_OK && frozen->altitude_count > 0)
    status = hk_system_add_tetrahedra(system, NULL, 0, frozen->altitude_count, thaw->tetrahedron);
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
static int32_t find_balance(struct hk_frozen *frozen, int *needed) {
  const int64_t size = 3 * frozen->system->particle_count;
  double *still = hk_new(size, sizeof(double));
  if (still == NULL) return HOOKE_NO_MEMORY;
  const int32_t status = hooke_system_force(frozen->system, 0.0, frozen->place, still, frozen->balance);
  *needed = 0;
  for (int64_t k = 0; k < size; k++) {
    *needed |= frozen->balance[k] != 0.0;
    frozen->balance[k] = -frozen->balance[k];
  }
  hk_free(still);
  return status;
}

static int32_t find_slow_step(struct hk_frozen *frozen) {
  const hooke_system *system = frozen->system;
  double *sum = hk_new(2 * system->particle_count, sizeof(double));
  if (sum == NULL) return HOOKE_NO_MEMORY;
  double stiff = 0.0, damp = 0.0;
  for (int64_t k = 0; k < frozen->spring_count; k++) {
    const struct hk_frozen_spring *s = &frozen->spring[k];
    sum[2 * s->head] += s->kappa, sum[2 * s->tail] += s->kappa;
    sum[2 * s->head + 1] += s->gamma, sum[2 * s->tail + 1] += s->gamma;
  }
  struct hk_triple triple;
  for (struct hk_triples at = {&system->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    for (int e = 0; e < 3; e++)
      sum[2 * triple.particle[e]] += 0.5 * hk_triple_row(system, &triple, e) * triple.coefficient;
  }
  for (int64_t k = 0; k < frozen->altitude_count; k++) {
    const struct hk_altitude_view *view = &frozen->altitude[k];
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
  frozen->slow_step = fmin(stiff > 0.0 ? 1.0 / sqrt(stiff) : INFINITY, damp > 0.0 ? 1.0 / damp : INFINITY);
  return HOOKE_OK;
}

static int32_t freeze(struct thaw *thaw, struct hk_frozen *frozen) {
  int32_t status = new_thaw(thaw, frozen);
  if (status != HOOKE_OK) return status;
  find_extent(thaw);
  each_spring(thaw, frozen, see_length);
  see_tetrahedra(thaw, frozen);
  find_factor(thaw);
  place_particles(thaw, frozen->place);
  each_spring(thaw, frozen, keep_spring);
  place_tetrahedra(thaw, frozen);
  int needed = 0;
  status = build(thaw, frozen, NULL, &frozen->system);
  if (status == HOOKE_OK) status = find_balance(frozen, &needed);
  if (status == HOOKE_OK && needed) {
    hooke_system_destroy(frozen->system);
    frozen->system = NULL;
    status = build(thaw, frozen, frozen->balance, &frozen->system);
  }
  return status == HOOKE_OK ? find_slow_step(frozen) : status;
}

int32_t hk_frozen_create(const hooke_system *system, const double *q, struct hk_frozen *frozen) {
  struct thaw thaw = {.system = system, .q = q, .shortest = INFINITY};
  *frozen = (struct hk_frozen){.damped = system->drag > 0.0};
  const int32_t status = freeze(&thaw, frozen);
  hk_free(thaw.ends);
  hk_free(thaw.kappa);
  hk_free(thaw.tetrahedron);
  if (status != HOOKE_OK) hk_frozen_release(frozen);
  return status;
}

void hk_frozen_release(struct hk_frozen *frozen) {
  hooke_system_destroy(frozen->system);
  hk_free(frozen->place);
  hk_free(frozen->balance);
  hk_free(frozen->spring);
  hk_free(frozen->altitude);
  memset(frozen, 0, sizeof *frozen);
}

/* ---- asking ---- */

/* Twice the energy of bending of a displacement from `place`. */
static double bending_energy(const struct hk_frozen *frozen, const double *q) {
  struct hk_triple triple;
  double sum = 0.0;
  for (struct hk_triples at = {&frozen->system->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    for (int a = 0; a < 3; a++) {
      double d = 0.0;
      for (int e = 0; e < 3; e++) {
        const int64_t k = 3 * triple.particle[e] + a;
        d += hk_triple_factor(e) * (q[k] - frozen->place[k]);
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

double hk_frozen_energy(const struct hk_frozen *frozen, const double *q, const double *v) {
  const double *mass = frozen->system->mass, *place = frozen->place;
  double sum = bending_energy(frozen, q);
  for (int64_t p = 0; p < frozen->system->particle_count; p++) {
    const double *u = v + 3 * p;
    sum += mass[p] * ((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
  }
  for (int64_t k = 0; k < frozen->spring_count; k++) {
    const struct hk_frozen_spring *s = &frozen->spring[k];
    const int64_t i = 3 * s->head, j = 3 * s->tail;
    double along = 0.0, square = 0.0;
    for (int a = 0; a < 3; a++) {
      const double d = (q[i + a] - place[i + a]) - (q[j + a] - place[j + a]);
      along += s->u[a] * d;
      square += d * d;
    }
    sum += s->across * square + (s->kappa - s->across) * along * along;
  }
  for (int64_t k = 0; k < frozen->altitude_count; k++) {
    const double along = stretch_of(&frozen->altitude[k], q, place);
    sum += frozen->altitude[k].kappa * along * along;
  }
  return sum;
}

void hk_frozen_push(const struct hk_frozen *frozen, const double *x, double *out) {
  const hooke_system *system = frozen->system;
  const double t = frozen->slow_step, *w = system->inverse_mass;
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
  for (int64_t k = 0; k < frozen->altitude_count; k++) {
    const struct hk_altitude_view *view = &frozen->altitude[k];
    const double f = t * (t * view->kappa + view->gamma) * stretch_of(view, x, NULL);
    for (int j = 0; j < 4; j++) {
      const int64_t p = view->tangent.particle[j];
      for (int b = 0; b < 3; b++)
        out[3 * p + b] += w[p] * f * view->tangent.weight[j] * view->tangent.u[b];
    }
  }
  for (int64_t k = 0; k < frozen->spring_count; k++) {
    const struct hk_frozen_spring *s = &frozen->spring[k];
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
