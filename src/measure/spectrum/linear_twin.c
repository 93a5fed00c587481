#include "measure/spectrum/linear_twin.h"

#include "core/memory.h"
#include "model/system.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

/* The largest ratio of extent to shortest length that is supported. */
static const double MOST_RATIO = 1e8;
static const double SHORTEST = 1e9;

/* ---- creating ---- */

/* Working data: the springs that are kept, in spring order. */
struct making {
  const hooke_system *system;
  const double *q, *v;
  double middle[3], extent, shortest, factor;
  int64_t *ends, *last;      /* last: of each particle, 1 + the last spring whose lower end it is; 0: none */
  int64_t springs, elements; /* so far */
  double *kappa, *gamma, *rest_length;
};

static double length_at(const struct hk_spring *spring, const double *q) {
  struct hk_stretch s;
  hk_spring_stretch(spring, q, NULL, &s);
  return s.length;
}

/* Bodies turn as springs do. */
static void find_shortest(struct making *making) {
  const hooke_system *system = making->system;
  for (int64_t s = 0; s < system->springs->count; s++) {
    const struct hk_spring spring = hk_springs_find(system->springs, s, system->moment);
    const double r = length_at(&spring, making->q);
    if (r > 0.0 && !(system->constrained[spring.head] && system->constrained[spring.tail]))
      making->shortest = fmin(making->shortest, r);
  }
  for (int64_t k = 0; k < system->bodies->count; k++) {
    const struct hk_body *body = &system->bodies->body[k];
    const double *first = body->place + 3 * (int64_t)body->base[0],
                 *second = body->place + 3 * (int64_t)body->base[1];
    const double d[3] = {second[0] - first[0], second[1] - first[1], second[2] - first[2]};
    if (body->moves && body->rank > 0) making->shortest = fmin(making->shortest, hk_length3(d));
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

/* The shortest spring becomes 1e9/sqrt(extent over shortest) m long: a longer one turns less, a shorter one
 * has less rounding of positions; this balances the two. */
static void find_factor(struct making *making) {
  if (isinf(making->shortest)) {
    making->factor = 0.0; /* no spring has a direction: all of them are linear about one place */
    return;
  }
  const double shortest = fmax(making->shortest, making->extent / MOST_RATIO);
  making->factor = SHORTEST / sqrt(fmax(1.0, making->extent / shortest)) / shortest;
}

static void place_particles(const struct making *making, double *origin) {
  for (int64_t k = 0; k < 3 * making->system->particle_count; k++)
    origin[k] = making->factor * (making->q[k] - making->middle[k % 3]);
}

static void keep_element(struct making *making, struct hk_twin *twin, const struct hk_element *e) {
  struct hk_element *kept = &twin->element[making->elements++];
  *kept = *e;
  kept->k_across = hk_element_across(e);
}

static int64_t lower_end(const struct hk_spring *spring) {
  return spring->head < spring->tail ? spring->head : spring->tail;
}

/* Adds a spring to the last one from its lower end, if that has the same ends: a step of the twin takes as
 * long as it has springs. 0 if it has not, or the strength overflows. */
static int join_spring(struct making *making, const struct hk_spring *spring, double rest_length) {
  const int64_t k = making->last[lower_end(spring)] - 1;
  if (k < 0 || making->ends[2 * k] + making->ends[2 * k + 1] != (int64_t)spring->head + spring->tail)
    return 0;
  const double kappa = making->kappa[k] + spring->kappa, gamma = making->gamma[k] + spring->gamma;
  if (!isfinite(kappa) || !isfinite(gamma)) return 0;
  if (kappa > 0.0) making->rest_length[k] += (rest_length - making->rest_length[k]) * (spring->kappa / kappa);
  making->kappa[k] = kappa;
  making->gamma[k] = gamma;
  return 1;
}

static void keep_spring(struct making *making, struct hk_twin *twin, int64_t number) {
  const struct hk_spring spring = hk_springs_find(making->system->springs, number, making->system->moment);
  const double before = length_at(&spring, making->q), after = length_at(&spring, twin->origin);
  struct hk_element e = {.count = 0};
  hk_spring_element(&spring, making->q, NULL, &e);
  if (!hk_element_moves(making->system->constrained, &e)) return;
  if (after == 0.0 || spring.curve) { /* it is linear as it stands, or not as a spring of a rest length is */
    keep_element(making, twin, &e);
    return;
  }
  const double rest_length = hk_element_across(&e) > 0.0 ? after * (spring.rest_length / before) : after;
  if (join_spring(making, &spring, rest_length)) return;
  const int64_t k = making->springs++;
  making->last[lower_end(&spring)] = k + 1;
  making->ends[2 * k] = spring.head;
  making->ends[2 * k + 1] = spring.tail;
  making->kappa[k] = spring.kappa;
  making->gamma[k] = spring.gamma;
  making->rest_length[k] = rest_length;
}

/* Other springs are springs in the twin, and drag is drag. */
static void keep_others(struct making *making, struct hk_twin *twin) {
  struct hk_elements at;
  hk_begin_elements(making->system, making->system->moment, making->q, NULL, &at);
  at.flow = making->v;
  at.kinds = HOOKE_OTHERS;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    if (hk_element_moves(making->system->constrained, e)) keep_element(making, twin, e);
  }
}

static int32_t new_thaw(struct making *making, struct hk_twin *twin) {
  const int64_t n = making->system->particle_count, springs = making->system->springs->count;
  const int64_t count = springs + hk_elements_of(making->system, HOOKE_OTHERS);
  twin->origin = hk_new(12 * n, sizeof(double));
  twin->element = hk_new(count, sizeof *twin->element);
  making->ends = hk_new(2 * springs + n, sizeof(int64_t));
  making->kappa = hk_new(3 * springs, sizeof(double));
  if (!twin->origin || !twin->element || !making->ends || !making->kappa) return HOOKE_NO_MEMORY;
  twin->balance = twin->origin + 3 * n;
  twin->moved = twin->balance + 3 * n;
  making->last = making->ends + 2 * springs;
  making->gamma = making->kappa + springs;
  making->rest_length = making->gamma + springs;
  return HOOKE_OK;
}

static int32_t add_springs(const struct making *making, int64_t count, hooke_system *system) {
  hooke_options *options = NULL;
  int32_t status = hk_options_create(&hk_spring_options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "law", "length");
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "stiffness", count, making->kappa);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "damping", count, making->gamma);
  if (status == HOOKE_OK)
    status = hooke_options_set_numbers(options, "rest_length", count, making->rest_length);
  if (status == HOOKE_OK) status = hooke_system_add_springs(system, NULL, count, making->ends, options);
  hooke_options_destroy(options);
  return status;
}

/* Forces on bodies become those that move them alike, less geometric stiffness. */
static void turn(const struct hk_twin *twin, const double *x, double *f) {
  hk_rigid_reduce(&twin->lin.rigid, -1.0, (const double *const[3]){x, x + 1, x + 2},
                  (double *const[3]){f, f + 1, f + 2}, 3);
}

static int32_t hold(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t;
  (void)v;
  const struct hk_twin *twin = ctx;
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] += twin->balance[k];
  if (!(twin->lin.rigid.stiffest > 0.0)) return 0;
  for (int64_t k = 0; k < 3 * n; k++)
    twin->moved[k] = q[k] - twin->origin[k];
  turn(twin, twin->moved, force);
  return 0;
}

static int32_t hold_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                            const double *dv, double *out, void *ctx) {
  (void)n;
  (void)t;
  (void)q;
  (void)v;
  (void)dv;
  turn(ctx, dq, out);
  return 0;
}

/* One number, or in an overdamped system one of each particle; elements have all other drag. */
static int32_t set_drag(const hooke_system *old, hooke_system *system) {
  const struct hk_each *drag = &old->medium->drag;
  return old->overdamped && drag->value
             ? hk_medium_set_drag(system, drag->count, drag->value)
             : hooke_system_set_drag(system, old->overdamped ? old->drag : old->brake);
}

/* An open or committed system; the caller destroys it. */
static int32_t build(const struct making *making, struct hk_twin *twin, int held, hooke_system **out) {
  const hooke_system *old = making->system;
  hooke_system *system = NULL;
  int32_t status = hooke_system_create(&system);
  if (status == HOOKE_OK) system->rest->memory_limit = old->rest->memory_limit;
  if (status == HOOKE_OK) status = hooke_system_set_dynamics(system, hooke_system_dynamics(old));
  if (status == HOOKE_OK)
    status = hooke_system_add_particles(system, old->particle_count, twin->origin, NULL, old->particle_count,
                                        old->mass, NULL);
  for (int64_t p = 0; p < old->particle_count && status == HOOKE_OK; p++) {
    if (old->constrained[p]) status = hooke_system_pin(system, 1, &p);
  }
  if (status == HOOKE_OK && making->springs > 0) status = add_springs(making, making->springs, system);
  for (int64_t k = 0; k < old->mover_count && status == HOOKE_OK; k++)
    status = old->mover[k].row->copy_one(old->mover[k].thing, system);
  if (status == HOOKE_OK) hk_system_set_linear(system, making->elements, twin->element, twin->origin);
  if (status == HOOKE_OK) system->rest->linear.of_velocities = hk_system_is_not_linear(old);
  if (status == HOOKE_OK) status = set_drag(old, system);
  if (status == HOOKE_OK && held) status = hooke_system_set_force(system, hold, hold_product, twin);
  if (status == HOOKE_OK) status = hooke_system_commit(system);
  return HOOKE_HAND_OVER(status, system, out, hooke_system_destroy);
}

/* The force of springs at rest, negated: the sum that the integrators form is then 0 to the bit. */
static int32_t find_balance(struct hk_twin *twin, int *needed) {
  const int64_t size = 3 * twin->system->particle_count;
  double *still = hk_new(size, sizeof(double));
  if (still == NULL) return HOOKE_NO_MEMORY;
  const int32_t status = hooke_system_force(twin->system, 0.0, twin->origin, still, twin->balance);
  *needed = 0;
  for (int64_t k = 0; k < size; k++) {
    *needed |= twin->balance[k] != 0.0;
    twin->balance[k] = -twin->balance[k];
  }
  hk_free(still);
  return status;
}

static int32_t freeze(struct making *making, struct hk_twin *twin) {
  int32_t status = new_thaw(making, twin);
  if (status != HOOKE_OK) return status;
  find_extent(making);
  find_shortest(making);
  find_factor(making);
  place_particles(making, twin->origin);
  for (int64_t s = 0; s < making->system->springs->count; s++)
    keep_spring(making, twin, s);
  keep_others(making, twin);
  int needed = 0;
  status = build(making, twin, 0, &twin->system);
  if (status == HOOKE_OK) status = find_balance(twin, &needed);
  if (status == HOOKE_OK && (needed || twin->lin.rigid.stiffest > 0.0)) {
    hooke_system_destroy(twin->system);
    twin->system = NULL;
    status = build(making, twin, 1, &twin->system);
  }
  return status;
}

int32_t hk_twin_create(const hooke_system *system, const double *q, const double *v, struct hk_twin *twin) {
  struct making making = {.system = system, .q = q, .v = v, .shortest = INFINITY};
  memset(twin, 0, sizeof *twin);
  int32_t status = hk_linearised_create(system, q, v, NULL, NULL, &twin->lin);
  if (status == HOOKE_OK) status = freeze(&making, twin);
  if (status == HOOKE_OK) hk_linearised_combine(&twin->lin, 1.0, 0.0);
  hk_free(making.ends);
  hk_free(making.kappa);
  if (status != HOOKE_OK) hk_twin_release(twin);
  return status;
}

void hk_twin_release(struct hk_twin *twin) {
  hk_linearised_release(&twin->lin);
  hooke_system_destroy(twin->system);
  hk_free(twin->origin);
  hk_free(twin->element);
  memset(twin, 0, sizeof *twin);
}

/* ---- queries ---- */

double hk_twin_energy(const struct hk_twin *twin, const double *q, const double *v) {
  const int64_t n = twin->system->particle_count;
  const double *mass = twin->system->mass, rate = twin->lin.rate;
  double sum = 0.0;
  for (int64_t p = 0; p < n; p++) {
    const double *u = v + 3 * p;
    for (int64_t a = 0; a < 3; a++)
      twin->moved[a * n + p] = q[3 * p + a] - twin->origin[3 * p + a];
    if (!twin->system->overdamped) sum += mass[p] * ((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
  }
  return sum + rate * (rate * hk_linearised_energy(&twin->lin, twin->moved));
}

void hk_twin_push(struct hk_twin *twin, const double *x, double *out) {
  const int64_t n = twin->system->particle_count;
  const double t = twin->lin.slow_step * twin->lin.rate;
  double *moved = twin->moved, *pushed = moved + 3 * n;
  for (int64_t k = 0; k < 3 * n; k++)
    moved[k % 3 * n + k / 3] = x[k];
  hk_linearised_combine(&twin->lin, t * t, t);
  hk_linearised_multiply(&twin->lin, moved, pushed);
  for (int64_t k = 0; k < 3 * n; k++)
    out[k] = pushed[k % 3 * n + k / 3];
  hk_linearised_combine(&twin->lin, 1.0, 0.0);
}
