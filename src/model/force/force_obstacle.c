/* Obstacles. A particle at depth d > 0 is pushed along the outward normal n with N = max(0, k d + c d'), and
 * braked across it with mu N w/sqrt(w^2 + s^2), w being the tangential part of its velocity u against the
 * obstacle, d' = -u.n: Coulomb's friction, regularised at the speed s. U = k d^2/2. */
#include "model/force/obstacle.h"

#include "core/memory.h"
#include "core/status.h"
#include "core/sum.h"
#include "model/check_value.h"
#include "model/system.h"
#include "model/variant/variant.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("shape", HOOKE_OPTION_ONE_OF("plane sphere cylinder"), NULL,
                 "the half space below a plane, a ball, or a cylinder without ends", .required = 1),
    HOOKE_OPTION("point", HOOKE_OPTION_VECTOR("m"), NULL, "a point of the plane, or of the axis",
                 .required = 1, .only = "plane cylinder"),
    HOOKE_OPTION("normal", HOOKE_OPTION_VECTOR(NULL), NULL, "where the free side of the plane is; any length",
                 .required = 1, .only = "plane"),
    HOOKE_OPTION("center", HOOKE_OPTION_VECTOR("m"), NULL, "its centre", .required = 1, .only = "sphere"),
    HOOKE_OPTION("axis", HOOKE_OPTION_VECTOR(NULL), NULL, "direction of the axis; any length", .required = 1,
                 .only = "cylinder"),
    HOOKE_OPTION("radius", HOOKE_OPTION_POSITIVE("m"), NULL, "its radius", .required = 1,
                 .only = "sphere cylinder"),
    HOOKE_OPTION("stiffness", HOOKE_OPTION_POSITIVE("N/m"), NULL, "force by depth", .required = 1),
    HOOKE_OPTION("damping", HOOKE_OPTION_NOT_NEGATIVE("N s/m"), "0",
                 "along the normal; the force never pulls"),
    HOOKE_OPTION("friction", HOOKE_OPTION_NOT_NEGATIVE(NULL), "0", "Coulomb's coefficient"),
    HOOKE_OPTION("friction_speed", HOOKE_OPTION_POSITIVE("m/s"), NULL,
                 "speed at which friction has 0.7 of its force; required with friction"),
    HOOKE_OPTION("clearance", HOOKE_OPTION_NOT_NEGATIVE("m"), "0",
                 "distance from the surface at which contact begins"),
    HOOKE_OPTION("motion", HOOKE_OPTION_ONE_OF("harmonic table"), NULL,
                 "the obstacle is moved, and not turned; without it, it stays"),
    HOOKE_OPTION("amplitude", HOOKE_OPTION_VECTOR("m"), NULL, "largest displacement along each axis",
                 .required = 1, .by = "motion", .only = "harmonic"),
    HOOKE_COURSE_OPTIONS("motion", NULL, NULL),
    HOOKE_OPTION("position", HOOKE_OPTION_VECTORS("m", 2, 0), NULL, "displacement at each time",
                 .required = 1, .by = "motion", .only = "table"),
};

static const struct hk_option_table options_table = {"obstacles", HOOKE_OPTION_ROWS(rows)};

/* ---- adding ---- */

static void release_one(struct hk_obstacle *obstacle) {
  hk_free(obstacle->particle);
  hk_course_release(&obstacle->course);
  hooke_options_destroy(obstacle->options);
}

void hk_obstacles_release(struct hk_obstacles *obstacles) {
  for (int64_t k = 0; k < obstacles->count; k++)
    release_one(&obstacles->obstacle[k]);
  hk_free(obstacles->obstacle);
}

static int32_t set_place(const hooke_options *options, struct hk_obstacle *obstacle) {
  static const char *const point[] = {"point", "center", "point"}, *const axis[] = {"normal", NULL, "axis"};
  const char *const direction = axis[obstacle->shape];
  memcpy(obstacle->point, hooke_options_numbers(options, point[obstacle->shape]), sizeof obstacle->point);
  if (direction == NULL) return HOOKE_OK;
  const double *given = hooke_options_numbers(options, direction), length = hk_length3(given);
  if (!(length > 0.0 && length < INFINITY))
    return hk_fail(HOOKE_BAD_VALUE, direction, "%g %g %g has no direction; allowed: a vector of any length",
                   given[0], given[1], given[2]);
  hk_scale3(1.0 / length, given, obstacle->axis);
  return HOOKE_OK;
}

static int32_t set_numbers(const hooke_options *options, struct hk_obstacle *obstacle) {
  obstacle->stiffness = hooke_options_number(options, "stiffness");
  obstacle->damping = hooke_options_number(options, "damping");
  obstacle->friction = hooke_options_number(options, "friction");
  obstacle->friction_speed = hooke_options_number(options, "friction_speed");
  obstacle->clearance = hooke_options_number(options, "clearance");
  obstacle->radius = obstacle->shape == HOOKE_PLANE ? 0.0 : hooke_options_number(options, "radius");
  if (obstacle->friction > 0.0 && isnan(obstacle->friction_speed))
    return hk_fail(HOOKE_BAD_VALUE, "friction_speed",
                   "is required with friction but missing; allowed: a speed > 0 [m/s]");
  obstacle->moves = hooke_options_is_set(options, "motion");
  obstacle->course.width = 3;
  if (!obstacle->moves) return HOOKE_OK;
  return hk_course_from_options(&obstacle->course, options, "", "amplitude", "position", hk_parabolic_slopes);
}

static int32_t set_particles(int64_t count, const int64_t *particles, struct hk_obstacle *obstacle) {
  obstacle->count = count;
  if (count < 0) return HOOKE_OK;
  obstacle->particle = hk_new(count, sizeof *obstacle->particle);
  for (int64_t k = 0; k < count && obstacle->particle; k++)
    obstacle->particle[k] = (int32_t)particles[k];
  return obstacle->particle ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static int32_t append(struct hk_obstacles *obstacles, const struct hk_obstacle *obstacle) {
  const int32_t status = hk_room((void **)&obstacles->obstacle, obstacles->count, sizeof *obstacle);
  if (status == HOOKE_OK) obstacles->obstacle[obstacles->count++] = *obstacle;
  return status;
}

int32_t hooke_system_add_obstacle(hooke_system *system, int64_t count, const int64_t *particles,
                                  const hooke_options *options) {
  struct hk_obstacle made = {0};
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK) status = hk_options_require(options, &options_table, "options", "obstacles");
  if (status == HOOKE_OK) status = hk_options_check_required(options);
  if (status == HOOKE_OK && count >= 0)
    status = hk_system_check_particles(system, "particles", count, particles, 0);
  if (status != HOOKE_OK) return status;
  const char *shape = hooke_options_text(options, "shape");
  made.shape = shape[0] == 'p' ? HOOKE_PLANE : shape[0] == 's' ? HOOKE_SPHERE : HOOKE_CYLINDER;
  status = set_place(options, &made);
  if (status == HOOKE_OK) status = set_numbers(options, &made);
  if (status == HOOKE_OK) status = set_particles(count, particles, &made);
  if (status == HOOKE_OK) status = hooke_options_copy(options, &made.options);
  if (status == HOOKE_OK) status = append(&system->rest->obstacles, &made);
  if (status != HOOKE_OK) release_one(&made);
  return status;
}

/* ---- contact ---- */

/* An obstacle where it is at a time. */
struct placed {
  const struct hk_obstacle *obstacle;
  double point[3], velocity[3];
};

/* A particle that touches it. */
struct contact {
  double depth, rate, normal[3],
      distance;            /* rate: of the depth; distance: from centre or axis, or infinity */
  double push;             /* N */
  double u[3], w[3], slip; /* slip: sqrt(w^2 + s^2) */
};

static struct placed place(const struct hk_obstacle *obstacle, double t) {
  struct placed at = {.obstacle = obstacle};
  if (obstacle->moves) hk_course_at(&obstacle->course, t, at.point, at.velocity);
  hk_add3(1.0, obstacle->point, at.point);
  return at;
}

const char *hooke_system_obstacle_shape(const hooke_system *system, int64_t obstacle) {
  const struct hk_obstacles *all = &system->rest->obstacles;
  return obstacle >= 0 && obstacle < all->count ? hooke_options_text(all->obstacle[obstacle].options, "shape")
                                                : NULL;
}

int32_t hooke_system_obstacle_place(const hooke_system *system, int64_t obstacle, double t, double *out) {
  const struct hk_obstacles *all = &system->rest->obstacles;
  if (obstacle < 0 || obstacle >= all->count)
    return hk_fail(HOOKE_BAD_VALUE, "obstacle", "there is no obstacle %lld; the system has %lld",
                   (long long)obstacle, (long long)all->count);
  const struct placed at = place(&all->obstacle[obstacle], t);
  memcpy(out, at.point, sizeof at.point);
  memcpy(out + 3, at.obstacle->axis, sizeof at.obstacle->axis);
  out[6] = at.obstacle->radius;
  return HOOKE_OK;
}

/* 1 if a particle at x touches; -1 at a centre or on an axis, where there is no direction. */
static int find_depth(const struct placed *at, const double x[3], struct contact *c) {
  const struct hk_obstacle *o = at->obstacle;
  double arm[3] = {x[0] - at->point[0], x[1] - at->point[1], x[2] - at->point[2]};
  if (o->shape == HOOKE_PLANE) {
    c->distance = INFINITY;
    c->depth = o->clearance - hk_dot3(arm, o->axis);
    memcpy(c->normal, o->axis, sizeof c->normal);
    return c->depth > 0.0;
  }
  if (o->shape == HOOKE_CYLINDER) hk_add3(-hk_dot3(arm, o->axis), o->axis, arm);
  c->distance = hk_length3(arm);
  c->depth = (o->radius + o->clearance) - c->distance;
  if (!(c->depth > 0.0)) return 0;
  if (c->distance == 0.0) return -1;
  hk_scale3(1.0 / c->distance, arm, c->normal);
  return 1;
}

static void find_push(const struct placed *at, const double *v, struct contact *c) {
  const struct hk_obstacle *o = at->obstacle;
  for (int a = 0; a < 3; a++)
    c->u[a] = v ? v[a] - at->velocity[a] : 0.0;
  c->rate = -hk_dot3(c->u, c->normal);
  c->push = fmax(0.0, o->stiffness * c->depth + o->damping * c->rate);
  memcpy(c->w, c->u, sizeof c->w);
  hk_add3(c->rate, c->normal, c->w);
  c->slip = o->friction > 0.0 ? sqrt(hk_dot3(c->w, c->w) + o->friction_speed * o->friction_speed) : 1.0;
}

static void find_force(const struct placed *at, const struct contact *c, double force[3]) {
  const double brake = at->obstacle->friction * c->push / c->slip;
  for (int a = 0; a < 3; a++)
    force[a] = c->push * c->normal[a] - brake * c->w[a];
}

/* Along n the stiffness and damping of the contact, across it what N and friction make of turning and
 * sliding. Beside the axis of a cylinder N turns, along it it does not: that is an element of its own. */
static void find_elements(const struct placed *at, const struct contact *c, int moving,
                          struct hk_element out[2]) {
  const struct hk_obstacle *o = at->obstacle;
  const int acts = !moving || c->push > 0.0;
  memcpy(out[0].u, c->normal, sizeof c->normal);
  out[0].k_along = acts ? o->stiffness : 0.0;
  out[0].c_along = acts ? o->damping : 0.0;
  out[0].c_across = o->friction * c->push / c->slip;
  if (o->shape == HOOKE_SPHERE) out[0].k_across = -c->push / c->distance;
  if (o->shape != HOOKE_CYLINDER) return;
  hk_cross3(o->axis, c->normal, out[1].u);
  out[1].k_along = -c->push / c->distance;
}

/* ---- a walk over the free particles of all obstacles ---- */

struct walk {
  const hooke_system *system;
  double t;
  int64_t obstacle, particle; /* number of the obstacle; index among its particles of the next one */
  struct placed at;
};

static const struct hk_obstacles *obstacles_of(const hooke_system *system) {
  return &system->rest->obstacles;
}

static int64_t reach(const hooke_system *system, const struct hk_obstacle *obstacle) {
  return obstacle->particle ? obstacle->count : system->particle_count;
}

/* Index of the next free particle, with its obstacle placed; -1 past the last. */
static int64_t next(struct walk *walk) {
  const struct hk_obstacles *all = obstacles_of(walk->system);
  for (; walk->obstacle < all->count; walk->obstacle++, walk->particle = 0) {
    const struct hk_obstacle *o = &all->obstacle[walk->obstacle];
    if (walk->particle == 0) walk->at = place(o, walk->t);
    while (walk->particle < reach(walk->system, o)) {
      const int64_t k = walk->particle++, p = o->particle ? o->particle[k] : k;
      if (!walk->system->constrained[p]) return p;
    }
  }
  return -1;
}

/* The next particle that touches, -1 past the last; v NULL: at rest. */
static int64_t next_contact(struct walk *walk, const double *q, const double *v, struct contact *c) {
  for (int64_t p; (p = next(walk)) >= 0;) {
    if (find_depth(&walk->at, q + 3 * p, c) <= 0) continue;
    find_push(&walk->at, v ? v + 3 * p : NULL, c);
    return p;
  }
  return -1;
}

/* ---- the force ---- */

static int32_t present(const hooke_system *system) {
  return obstacles_of(system)->count > 0;
}

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  struct walk walk = {.system = system, .t = t};
  struct contact c;
  double *const *q = motion->q, *const *v = motion->v;
  if (system->springs->count == 0) motion->coincident = 0;
  for (int64_t p; (p = next(&walk)) >= 0;) {
    const double x[3] = {q[0][p], q[1][p], q[2][p]}, u[3] = {v[0][p], v[1][p], v[2][p]};
    const int touches = find_depth(&walk.at, x, &c);
    motion->coincident += touches < 0;
    if (touches <= 0) continue;
    double force[3];
    find_push(&walk.at, motion->zero ? walk.at.velocity : u, &c);
    find_force(&walk.at, &c, force);
    for (int a = 0; a < 3; a++)
      motion->f[a][p] += force[a];
  }
  return HOOKE_OK;
}

static double energy(const hooke_system *system, double t, const double *q) {
  struct walk walk = {.system = system, .t = t};
  struct hk_sum sum = {0.0, 0.0};
  struct contact c;
  while (next_contact(&walk, q, NULL, &c) >= 0)
    hk_sum_add(&sum, 0.5 * walk.at.obstacle->stiffness * c.depth * c.depth);
  return hk_sum_value(&sum);
}

static double heat(const hooke_system *system, double t, const double *q, const double *v) {
  struct walk walk = {.system = system, .t = t};
  struct hk_sum sum = {0.0, 0.0};
  struct contact c;
  while (next_contact(&walk, q, v, &c) >= 0) {
    const struct hk_obstacle *o = walk.at.obstacle;
    hk_sum_add(&sum, (c.push - o->stiffness * c.depth) * c.rate +
                         o->friction * c.push * (hk_dot3(c.w, c.w) / c.slip));
  }
  return hk_sum_value(&sum);
}

static int32_t does_work(const hooke_system *system) {
  int32_t moves = 0;
  for (int64_t k = 0; k < obstacles_of(system)->count; k++)
    moves |= obstacles_of(system)->obstacle[k].moves;
  return moves;
}

static double power(const hooke_system *system, double t, const double *q, const double *v) {
  struct walk walk = {.system = system, .t = t};
  struct hk_sum sum = {0.0, 0.0};
  struct contact c;
  while (next_contact(&walk, q, v, &c) >= 0) {
    double force[3];
    find_force(&walk.at, &c, force);
    hk_sum_add(&sum, hk_dot3(force, walk.at.velocity));
  }
  return hk_sum_value(&sum);
}

int64_t hk_obstacles_untouched(const hooke_system *system, double t, const double *q, int64_t *number) {
  for (; *number < obstacles_of(system)->count; ++*number) {
    struct walk walk = {.system = system, .t = t, .obstacle = *number};
    int64_t lightest = -1, touches = 0;
    struct contact c;
    for (int64_t p; (p = next(&walk)) >= 0 && walk.obstacle == *number;) {
      touches |= find_depth(&walk.at, q + 3 * p, &c) != 0;
      if (lightest < 0 || system->inverse_mass[p] > system->inverse_mass[lightest]) lightest = p;
    }
    if (lightest >= 0 && !touches) return lightest;
  }
  return -1;
}

int64_t hk_obstacles_without_direction(const hooke_system *system, double t, const double *q) {
  struct walk walk = {.system = system, .t = t};
  struct contact c;
  int64_t count = 0;
  for (int64_t p; (p = next(&walk)) >= 0;)
    count += find_depth(&walk.at, q + 3 * p, &c) < 0;
  return count;
}

/* ---- derivatives ---- */

/* Change of the normal as a particle moves by dq. */
static void turn_normal(const struct placed *at, const struct contact *c, const double dq[3], double dn[3]) {
  const struct hk_obstacle *o = at->obstacle;
  hk_scale3(1.0, dq, dn);
  hk_add3(-hk_dot3(dq, c->normal), c->normal, dn);
  if (o->shape == HOOKE_CYLINDER) hk_add3(-hk_dot3(dn, o->axis), o->axis, dn);
  hk_scale3(1.0 / c->distance, dn, dn);
}

static void add_change(const struct placed *at, const struct contact *c, const double dq[3],
                       const double dv[3], double out[3]) {
  const struct hk_obstacle *o = at->obstacle;
  double dn[3], dw[3];
  turn_normal(at, c, dq, dn);
  const double faster = -hk_dot3(dv, c->normal) - hk_dot3(c->u, dn);
  const double more = c->push > 0.0 ? o->damping * faster - o->stiffness * hk_dot3(c->normal, dq) : 0.0;
  hk_scale3(1.0, dv, dw);
  hk_add3(faster, c->normal, dw);
  hk_add3(c->rate, dn, dw);
  const double slower = hk_dot3(c->w, dw) / (c->slip * c->slip), brake = o->friction / c->slip;
  for (int a = 0; a < 3; a++)
    out[a] += more * c->normal[a] + c->push * dn[a] -
              brake * (more * c->w[a] + c->push * (dw[a] - slower * c->w[a]));
}

static int32_t add_product(const hooke_system *system, const struct hk_point *point, double *out) {
  struct walk walk = {.system = system, .t = point->t};
  struct contact c;
  for (int64_t p; (p = next_contact(&walk, point->q, point->v, &c)) >= 0;)
    add_change(&walk.at, &c, point->dq + 3 * p, point->dv + 3 * p, out + 3 * p);
  return HOOKE_OK;
}

/* Elements: one for each particle of an obstacle, two of a cylinder; zero where nothing touches. */
static int64_t elements_a_particle(const struct hk_obstacle *obstacle) {
  return obstacle->shape == HOOKE_CYLINDER ? 2 : 1;
}

static int64_t count(const hooke_system *system) {
  int64_t sum = 0;
  for (int64_t k = 0; k < obstacles_of(system)->count; k++)
    sum += elements_a_particle(&obstacles_of(system)->obstacle[k]) *
           reach(system, &obstacles_of(system)->obstacle[k]);
  return sum;
}

/* Element `number` of an obstacle. */
static void fill_element(const hooke_system *system, const struct placed *at, int64_t number, const double *q,
                         const double *v, struct hk_element *out) {
  const struct hk_obstacle *o = at->obstacle;
  const int64_t a_particle = elements_a_particle(o), k = number / a_particle;
  const int64_t p = o->particle ? o->particle[k] : k;
  struct hk_element pair[2] = {{.over = 1.0}, {.over = 1.0}};
  struct contact c;
  for (int j = 0; j < 2; j++)
    pair[j].count = 1, pair[j].particle[0] = (int32_t)p, pair[j].weight[0] = 1.0;
  if (q && !system->constrained[p] && find_depth(at, q + 3 * p, &c) > 0) {
    find_push(at, v ? v + 3 * p : at->velocity, &c);
    find_elements(at, &c, v != NULL, pair);
  }
  *out = pair[number % a_particle];
}

static void elements(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  const struct hk_obstacle *o = obstacles_of(system)->obstacle;
  int64_t of_it = elements_a_particle(o) * reach(system, o);
  struct placed at = place(o, t);
  for (int64_t k = first; wanted > 0; wanted--, k++) {
    for (; k >= of_it; of_it = elements_a_particle(o) * reach(system, o), at = place(o, t)) {
      k -= of_it;
      o++;
    }
    fill_element(system, &at, k, q, v, out++);
  }
}

static void add_stiffness(const hooke_system *system, double *sum) {
  for (int64_t k = 0; k < obstacles_of(system)->count; k++)
    *sum += obstacles_of(system)->obstacle[k].stiffness *
            (double)reach(system, &obstacles_of(system)->obstacle[k]);
}

static int32_t damped(const hooke_system *system) {
  int32_t some = 0;
  for (int64_t k = 0; k < obstacles_of(system)->count; k++)
    some |=
        obstacles_of(system)->obstacle[k].damping > 0.0 || obstacles_of(system)->obstacle[k].friction > 0.0;
  return some;
}

/* ---- the row ---- */

static int64_t memory(const hooke_system *system) {
  int64_t bytes = 0;
  for (int64_t k = 0; k < obstacles_of(system)->count; k++) {
    const struct hk_obstacle *o = &obstacles_of(system)->obstacle[k];
    bytes += (int64_t)sizeof *o + (o->particle ? o->count * (int64_t)sizeof *o->particle : 0) +
             7 * o->course.samples * (int64_t)sizeof(double);
  }
  return bytes;
}

static void check(const hooke_system *system, uint32_t *value) {
  for (int64_t k = 0; k < obstacles_of(system)->count; k++) {
    const struct hk_obstacle *o = &obstacles_of(system)->obstacle[k];
    const double number[] = {o->radius,   o->stiffness,      o->damping,
                             o->friction, o->friction_speed, o->clearance};
    hk_check_whole(value, o->shape);
    hk_check_add(value, o->point, 3, sizeof(double));
    hk_check_add(value, o->axis, 3, sizeof(double));
    hk_check_add(value, number, 6, sizeof(double));
    hk_course_check(&o->course, value);
    hk_check_whole(value, o->count);
    if (o->particle) hk_check_add(value, o->particle, o->count, sizeof *o->particle);
  }
}

/* The particles that a variant keeps. */
static int32_t copy_one(const struct hk_variant_maker *maker, const struct hk_obstacle *obstacle) {
  int64_t kept = 0, *list = obstacle->particle ? hk_new(obstacle->count, sizeof *list) : NULL;
  if (obstacle->particle && list == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; list && k < obstacle->count; k++) {
    const int64_t to = maker->map->to[obstacle->particle[k]];
    if (to >= 0) list[kept++] = to;
  }
  const int32_t status = hooke_system_add_obstacle(maker->made, list ? kept : -1, list, obstacle->options);
  hk_free(list);
  return status;
}

static int32_t copy(const struct hk_variant_maker *maker) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < obstacles_of(maker->from)->count && status == HOOKE_OK; k++)
    status = copy_one(maker, &obstacles_of(maker->from)->obstacle[k]);
  return status;
}

const struct hk_force_row hk_force_obstacles = {.name = "obstacles",
                                                .kind = HOOKE_KEPT,
                                                .not_linear = 1,
                                                .in_scenes = 1,
                                                .title = "contact",
                                                .options = &options_table,
                                                .memory = memory,
                                                .check = check,
                                                .copy = copy,
                                                .present = present,
                                                .add = add,
                                                .energy = energy,
                                                .heat = heat,
                                                .does_work = does_work,
                                                .power = power,
                                                .add_product = add_product,
                                                .count = count,
                                                .elements = elements,
                                                .add_stiffness = add_stiffness,
                                                .damped = damped};
