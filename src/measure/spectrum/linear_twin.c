#include "measure/spectrum/linear_twin.h"

#include "core/memory.h"
#include "core/status.h"
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
  const double *q;
  double middle[3], extent, shortest, factor;
  int64_t *ends, *last; /* last: of each particle, 1 + the last spring whose lower end it is; 0: none */
  double *kappa, *gamma, *rest_length;
  struct hk_rigid rigid; /* of the system */
};

/* Calls `see` for every spring with a free end, with its element. */
static void each_spring(struct making *making, struct hk_twin *twin,
                        void (*see)(struct making *, struct hk_twin *, const struct hk_spring *,
                                    const struct hk_element *)) {
  const hooke_system *system = making->system;
  struct hk_elements at;
  hk_begin_elements(system, making->q, NULL, &at);
  at.by_number = 1;
  at.only = &hk_force_springs;
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    for (int64_t k = 0; k < system->springs->run[r].count; k++) {
      const struct hk_spring spring = hk_run_spring(&system->springs->run[r], k);
      const struct hk_element *e = hk_next_element(&at);
      if (hk_element_moves(system->constrained, e)) see(making, twin, &spring, e);
    }
  }
}

static double length_at(const struct hk_spring *spring, const double *q) {
  struct hk_stretch s;
  hk_spring_stretch(spring, q, NULL, &s);
  return s.length;
}

static void see_length(struct making *making, struct hk_twin *twin, const struct hk_spring *spring,
                       const struct hk_element *e) {
  const double r = length_at(spring, making->q);
  (void)e;
  twin->damped |= spring->gamma > 0.0;
  if (r > 0.0) making->shortest = fmin(making->shortest, r);
}

/* Bodies turn as springs do. */
static void see_bodies(struct making *making) {
  const struct hk_bodies *bodies = making->system->bodies;
  for (int64_t k = 0; k < making->system->moving_bodies; k++) {
    const struct hk_body *body = bodies->mover[k];
    const double *first = body->place + 3 * (int64_t)body->base[0],
                 *second = body->place + 3 * (int64_t)body->base[1];
    const double d[3] = {second[0] - first[0], second[1] - first[1], second[2] - first[2]};
    if (body->rank > 0) making->shortest = fmin(making->shortest, hk_length3(d));
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

static void place_particles(const struct making *making, double *place) {
  for (int64_t k = 0; k < 3 * making->system->particle_count; k++)
    place[k] = making->factor * (making->q[k] - making->middle[k % 3]);
}

static void keep_element(struct hk_twin *twin, const struct hk_element *e) {
  struct hk_element *kept = &twin->element[twin->element_count++];
  *kept = *e;
  kept->k_across = hk_element_across(e);
}

static struct hk_twin_spring spring_of(const struct hk_element *e) {
  return (struct hk_twin_spring){
      e->particle[0], e->particle[1], {e->u[0], e->u[1], e->u[2]}, e->k_along - e->k_across, e->k_across};
}

static int64_t lower_end(const struct hk_spring *spring) {
  return spring->head < spring->tail ? spring->head : spring->tail;
}

/* Adds a spring to the last one from its lower end, if that has the same ends: a step of the twin takes as
 * long as it has springs. 0 if it has not, or the strength overflows. */
static int join_spring(struct making *making, struct hk_twin *twin, const struct hk_spring *spring,
                       const struct hk_element *e, double rest_length) {
  const int64_t k = making->last[lower_end(spring)] - 1;
  if (k < 0 || making->ends[2 * k] + making->ends[2 * k + 1] != (int64_t)spring->head + spring->tail)
    return 0;
  const double kappa = making->kappa[k] + spring->kappa, gamma = making->gamma[k] + spring->gamma;
  if (!isfinite(kappa) || !isfinite(gamma)) return 0;
  if (kappa > 0.0) making->rest_length[k] += (rest_length - making->rest_length[k]) * (spring->kappa / kappa);
  making->kappa[k] = kappa;
  making->gamma[k] = gamma;
  twin->element[k].k_along += e->k_along;
  twin->element[k].k_across += hk_element_across(e);
  twin->element[k].c_along += e->c_along;
  twin->spring[k] = spring_of(&twin->element[k]);
  return 1;
}

static void keep_spring(struct making *making, struct hk_twin *twin, const struct hk_spring *spring,
                        const struct hk_element *e) {
  const double before = length_at(spring, making->q), after = length_at(spring, twin->place);
  twin->clamped += e->k_across < -HOOKE_STRETCH_ROUNDING * e->k_along;
  if (after == 0.0) return;
  const double rest_length = hk_element_across(e) > 0.0 ? after * (spring->rest_length / before) : after;
  if (join_spring(making, twin, spring, e, rest_length)) return;
  const int64_t k = twin->spring_count++;
  making->last[lower_end(spring)] = k + 1;
  making->ends[2 * k] = spring->head;
  making->ends[2 * k + 1] = spring->tail;
  making->kappa[k] = spring->kappa;
  making->gamma[k] = spring->gamma;
  making->rest_length[k] = rest_length;
  keep_element(twin, e);
  twin->spring[k] = spring_of(&twin->element[k]);
}

/* A spring of no length is linear as it stands. */
static void keep_point(struct making *making, struct hk_twin *twin, const struct hk_spring *spring,
                       const struct hk_element *e) {
  (void)making;
  if (length_at(spring, twin->place) == 0.0) keep_element(twin, e);
}

/* Other springs are springs in the twin, and drag is drag. */
static void keep_others(const struct making *making, struct hk_twin *twin) {
  struct hk_elements at;
  hk_begin_elements(making->system, making->q, NULL, &at);
  at.kinds = HOOKE_OTHERS;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    if (!hk_element_moves(making->system->constrained, e)) continue;
    twin->clamped += e->k_across < -HOOKE_STRETCH_ROUNDING * e->k_along;
    twin->damped |= e->c_along > 0.0 || e->c_across > 0.0;
    keep_element(twin, e);
  }
}

static int32_t new_thaw(struct making *making, struct hk_twin *twin) {
  const int64_t n = making->system->particle_count, springs = making->system->springs->count;
  const int64_t count = springs + hk_elements_of(making->system, HOOKE_OTHERS);
  twin->place = hk_new(3 * n, sizeof(double));
  twin->balance = hk_new(3 * n, sizeof(double));
  twin->moved = hk_new(3 * n, sizeof(double));
  twin->element = hk_new(count, sizeof *twin->element);
  twin->spring = hk_new(springs, sizeof *twin->spring);
  making->ends = hk_new(2 * springs + n, sizeof(int64_t));
  making->kappa = hk_new(3 * springs, sizeof(double));
  if (!twin->place || !twin->balance || !twin->moved || !twin->element || !twin->spring || !making->ends ||
      !making->kappa)
    return HOOKE_NO_MEMORY;
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
  hk_rigid_reduce(&twin->rigid, -1.0, (const double *const[3]){x, x + 1, x + 2},
                  (double *const[3]){f, f + 1, f + 2}, 3);
}

static int32_t hold(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t;
  (void)v;
  const struct hk_twin *twin = ctx;
  for (int64_t k = 0; k < 3 * n; k++)
    force[k] += twin->balance[k];
  if (!(twin->rigid.stiffest > 0.0)) return 0;
  for (int64_t k = 0; k < 3 * n; k++)
    twin->moved[k] = q[k] - twin->place[k];
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

static int32_t add_body(const struct hk_body *body, hooke_system *system) {
  int64_t *particles = hk_new(body->count, sizeof *particles);
  if (particles == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < body->count; k++)
    particles[k] = body->particle[k];
  const int32_t status = hk_system_add_body(system, body->name, body->count, particles, 0, -1);
  hk_free(particles);
  return status;
}

/* An open or committed system; the caller destroys it. */
static int32_t build(const struct making *making, struct hk_twin *twin, int held, hooke_system **out) {
  const hooke_system *old = making->system;
  const int64_t springs = twin->spring_count;
  hooke_system *system = NULL;
  int32_t status = hooke_system_create(&system);
  if (status == HOOKE_OK) system->rest->memory_limit = old->rest->memory_limit;
  if (status == HOOKE_OK) status = hooke_system_set_dynamics(system, hooke_system_dynamics(old));
  if (status == HOOKE_OK)
    status = hooke_system_add_particles(system, old->particle_count, twin->place, NULL, old->particle_count,
                                        old->mass, NULL);
  for (int64_t p = 0; p < old->particle_count && status == HOOKE_OK; p++) {
    if (old->constrained[p]) status = hooke_system_pin(system, 1, &p);
  }
  if (status == HOOKE_OK && springs > 0) status = add_springs(making, springs, system);
  for (int64_t k = 0; k < old->moving_bodies && status == HOOKE_OK; k++)
    status = add_body(old->bodies->mover[k], system);
  if (status == HOOKE_OK)
    hk_system_set_linear(system, twin->element_count - springs, twin->element + springs, twin->place);
  if (status == HOOKE_OK) status = hooke_system_set_drag(system, old->drag);
  if (status == HOOKE_OK && held) status = hooke_system_set_force(system, hold, hold_product, twin);
  if (status == HOOKE_OK) status = hooke_system_commit(system);
  if (status == HOOKE_OK)
    *out = system;
  else
    hooke_system_destroy(system);
  return status;
}

/* The force of springs at rest, negated: the sum that the integrators form is then 0 to the bit. */
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

/* The sum over a body's particles of `row` (two numbers a particle) over the mass and inertia that resist
 * it. */
static double body_rate(const hooke_system *system, const struct hk_body_tangent *t, const double *row,
                        double more) {
  const double *inverse = t->body->inverse_inertia, turning = fmax(inverse[0], fmax(inverse[1], inverse[2]));
  double sum = 0.0;
  for (int64_t i = 0; i < t->body->count; i++) {
    const int64_t p = t->body->particle[i];
    const double *arm = t->arm + 3 * i;
    if (!system->constrained[p])
      sum += (row[2 * p] + more) * (t->body->inverse_mass + hk_dot3(arm, arm) * turning);
  }
  return sum;
}

static int32_t find_slow_step(struct hk_twin *twin) {
  const hooke_system *system = twin->system;
  double *sum = hk_new(2 * system->particle_count, sizeof(double));
  if (sum == NULL) return HOOKE_NO_MEMORY;
  double stiff = 0.0, damp = 0.0;
  for (const struct hk_element *e = twin->element; e < twin->element + twin->element_count; e++) {
    const int spring = e < twin->element + twin->spring_count;
    for (int j = 0; j < e->count; j++) {
      const double row = spring ? 2.0 : hk_element_row(system->constrained, e, j);
      sum[2 * e->particle[j]] += row * e->k_along;
      sum[2 * e->particle[j] + 1] += row * e->c_along;
    }
  }
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (hk_bodies_move(system->bodies, p)) continue;
    stiff = fmax(stiff, sum[2 * p] * system->inverse_mass[p]);
    damp = fmax(damp, (sum[2 * p + 1] + system->brake) * system->inverse_mass[p]);
  }
  for (int64_t k = 0; k < twin->rigid.tangents.count; k++) {
    const struct hk_body_tangent *t = &twin->rigid.tangents.body[k];
    stiff = fmax(stiff, body_rate(system, t, sum, 0.0) + twin->rigid.stiffest);
    damp = fmax(damp, body_rate(system, t, sum + 1, system->brake));
  }
  hk_free(sum);
  const double rate = system->overdamped ? stiff : sqrt(stiff);
  twin->slow_step = fmin(rate > 0.0 ? 1.0 / rate : INFINITY, damp > 0.0 ? 1.0 / damp : INFINITY);
  return HOOKE_OK;
}

static int32_t freeze(struct making *making, struct hk_twin *twin) {
  int32_t status = new_thaw(making, twin);
  if (status != HOOKE_OK) return status;
  find_extent(making);
  each_spring(making, twin, see_length);
  see_bodies(making);
  find_factor(making);
  place_particles(making, twin->place);
  each_spring(making, twin, keep_spring);
  each_spring(making, twin, keep_point);
  keep_others(making, twin);
  int needed = 0;
  status = build(making, twin, 0, &twin->system);
  if (status == HOOKE_OK) status = find_balance(twin, &needed);
  if (status == HOOKE_OK && (needed || making->rigid.stiffest > 0.0)) {
    hooke_system_destroy(twin->system);
    twin->system = NULL;
    status = build(making, twin, 1, &twin->system);
  }
  if (status == HOOKE_OK) status = hk_rigid_enlarge(&making->rigid, twin->system, twin->place, &twin->rigid);
  return status == HOOKE_OK ? find_slow_step(twin) : status;
}

int32_t hk_twin_create(const hooke_system *system, const double *q, struct hk_twin *twin) {
  struct making making = {.system = system, .q = q, .shortest = INFINITY};
  *twin = (struct hk_twin){.damped = system->brake > 0.0};
  int32_t status = hk_rigid_create(system, q, NULL, &making.rigid);
  if (status == HOOKE_OK) status = freeze(&making, twin);
  hk_rigid_release(&making.rigid);
  hk_free(making.ends);
  hk_free(making.kappa);
  if (status != HOOKE_OK) hk_twin_release(twin);
  return status;
}

void hk_twin_release(struct hk_twin *twin) {
  hk_rigid_release(&twin->rigid);
  hooke_system_destroy(twin->system);
  hk_free(twin->place);
  hk_free(twin->balance);
  hk_free(twin->moved);
  hk_free(twin->element);
  hk_free(twin->spring);
  memset(twin, 0, sizeof *twin);
}

/* ---- queries ---- */

static double spring_energy(const struct hk_twin_spring *s, const double *moved) {
  const double *x = moved + 3 * (int64_t)s->head, *y = moved + 3 * (int64_t)s->tail;
  const double d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
  const double stretch = (s->u[0] * d[0] + s->u[1] * d[1]) + s->u[2] * d[2];
  return s->across * ((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]) + s->along * stretch * stretch;
}

double hk_twin_energy(const struct hk_twin *twin, const double *q, const double *v) {
  const double *mass = twin->system->mass, *const x[3] = {twin->moved, twin->moved + 1, twin->moved + 2};
  double sum = 0.0;
  for (int64_t p = 0; p < twin->system->particle_count; p++) {
    const double *u = v + 3 * p;
    for (int64_t k = 3 * p; k < 3 * p + 3; k++)
      twin->moved[k] = q[k] - twin->place[k];
    if (!twin->system->overdamped) sum += mass[p] * ((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
  }
  for (int64_t k = 0; k < twin->spring_count; k++)
    sum += spring_energy(&twin->spring[k], twin->moved);
  for (int64_t k = twin->spring_count; k < twin->element_count; k++) {
    const struct hk_element *e = &twin->element[k];
    sum += hk_element_energy(e, e->k_along, e->k_across, 3, x);
  }
  sum += hk_rigid_energy(&twin->rigid, x, 3);
  return sum;
}

void hk_twin_push(const struct hk_twin *twin, const double *x, double *out) {
  const hooke_system *system = twin->system;
  const double t = twin->slow_step, *const from[3] = {x, x + 1, x + 2};
  double *const to[3] = {out, out + 1, out + 2};
  for (int64_t k = 0; k < 3 * system->particle_count; k++)
    out[k] = t * system->brake * x[k];
  for (const struct hk_element *e = twin->element; e < twin->element + twin->element_count; e++)
    hk_element_multiply(e, t * (t * e->k_along + e->c_along), t * (t * e->k_across + e->c_across), 3, from,
                        to);
  hk_rigid_reduce(&twin->rigid, t * t, from, to, 3);
  for (int64_t k = 0; k < 3 * system->particle_count; k++)
    out[k] *= system->inverse_mass[k / 3];
}
