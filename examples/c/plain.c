/* The definition of what hooke computes: particles and springs in plain C, by three methods. It reads a scene
 * with the library and then steps it without: the numbers are those of 'hooke run', to the last bit.
 *
 *   cc -O2 -ffp-contract=off plain.c $(pkg-config --cflags --libs hooke) -lm -o plain
 *   ./plain rope.json rk4 1e-3 1000        # prints q and v of every particle after 1000 steps of 1 ms
 *
 * The compiler must not contract a*b + c into one rounding (-ffp-contract=off), and every sum has the order
 * of its parentheses. Forces are those of springs and gravity; a scene with more than these is refused.
 *
 * verlet takes damping at the velocity that it predicts, as 'hooke run --verlet-damping explicit' does.
 * Without that option hooke solves for the damping of the new velocity, which takes a linear solver and more
 * than a page; so it does, too, for springs that only pull: damped nets are for the other two methods here.
 */
#include <hooke.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the scene ---- */

struct spring {
  int64_t i, j;            /* its ends */
  double kappa, gamma, l0; /* stiffness [N/m], damping [N s/m], rest length [m] */
  int only_pulls;          /* a cable: no force while it is slack */
};

struct model {
  int64_t particles, springs;
  double *w; /* inverse masses [1/kg], 0 of a particle that is held still */
  struct spring *spring;
  double gravity[3]; /* [m/s^2] */
};

/* What the state of a model is: rows of x, y, z, one after the other. */
struct motion {
  double *q, *v; /* positions [m], velocities [m/s] */
};

/* ---- forces ---- */

/* Hooke's law with damping: along the line between the ends, s being tension over length, and positive where
 * it pulls. What the first end takes, the second gives. */
static void add_spring(const struct spring *spring, const double *q, const double *v, double *f) {
  const double *qi = q + 3 * spring->i, *qj = q + 3 * spring->j;
  const double *vi = v + 3 * spring->i, *vj = v + 3 * spring->j;
  const double dx = qi[0] - qj[0], dy = qi[1] - qj[1], dz = qi[2] - qj[2];
  const double vx = vi[0] - vj[0], vy = vi[1] - vj[1], vz = vi[2] - vj[2];
  const double r = sqrt((dx * dx + dy * dy) + dz * dz);
  if (r == 0) return; /* no direction, no force */
  const double ir = 1 / r;
  double tension = spring->kappa * (r - spring->l0) + spring->gamma * (((vx * dx + vy * dy) + vz * dz) * ir);
  if (spring->only_pulls && (r <= spring->l0 || tension < 0)) tension = 0;
  const double s = tension * ir, force[3] = {-s * dx, -s * dy, -s * dz};
  for (int a = 0; a < 3; a++) {
    f[3 * spring->i + a] += force[a];
    f[3 * spring->j + a] -= force[a];
  }
}

/* a = w f + g. Springs add to f in their order; all of them see the same q and v, the old ones. */
static void accelerate(const struct model *m, const double *q, const double *v, double *a) {
  memset(a, 0, (size_t)(3 * m->particles) * sizeof(double));
  for (int64_t k = 0; k < m->springs; k++)
    add_spring(&m->spring[k], q, v, a);
  for (int64_t k = 0; k < 3 * m->particles; k++)
    a[k] = m->w[k / 3] > 0 ? m->w[k / 3] * a[k] + m->gravity[k % 3] : 0;
}

/* out = from + h*rate, number by number: all that a method does. */
static void move(int64_t size, double *out, const double *from, double h, const double *rate) {
  for (int64_t k = 0; k < size; k++)
    out[k] = from[k] + h * rate[k];
}

/* ---- methods; `room` is theirs to write in, 9 arrays as long as q ---- */

/* Order 1: new velocities from the old forces, then new positions from the new velocities. */
static void symplectic_euler(const struct model *m, double h, struct motion *x, double *room) {
  const int64_t size = 3 * m->particles;
  double *a = room;
  accelerate(m, x->q, x->v, a);
  move(size, x->v, x->v, h, a);
  move(size, x->q, x->q, h, x->v);
}

/* Order 2: half a kick, a whole drift, and another half a kick by the forces there. These take velocities as
 * the first half predicts them. */
static void verlet(const struct model *m, double h, struct motion *x, double *room) {
  const int64_t size = 3 * m->particles;
  double *a = room, *half = room + size;
  accelerate(m, x->q, x->v, a);
  move(size, half, x->v, h / 2, a);
  move(size, x->q, x->q, h, half);
  move(size, x->v, half, h / 2, a);
  accelerate(m, x->q, x->v, a);
  move(size, x->v, half, h / 2, a);
}

/* Order 4: the rates (v, a) of the state, of two states half a step ahead and of one a whole step ahead, each
 * by the rates before; then a step by their mean with weights 1, 2, 2, 1. */
static void rk4(const struct model *m, double h, struct motion *x, double *room) {
  const int64_t size = 3 * m->particles;
  const double ahead[4] = {0, h / 2, h / 2, h};
  double *v[4], *a[4], *q = room + 8 * size;
  for (int s = 0; s < 4; s++) {
    v[s] = room + s * size;
    a[s] = room + (4 + s) * size;
    move(size, q, x->q, ahead[s], s ? v[s - 1] : x->v);
    move(size, v[s], x->v, ahead[s], s ? a[s - 1] : x->v);
    accelerate(m, q, v[s], a[s]);
  }
  for (int64_t k = 0; k < size; k++) {
    x->q[k] += h / 6 * (((v[0][k] + 2 * v[1][k]) + 2 * v[2][k]) + v[3][k]);
    x->v[k] += h / 6 * (((a[0][k] + 2 * a[1][k]) + 2 * a[2][k]) + a[3][k]);
  }
}

static const struct {
  const char *name;
  void (*step)(const struct model *m, double h, struct motion *x, double *room);
} methods[] = {{"symplectic-euler", symplectic_euler}, {"verlet", verlet}, {"rk4", rk4}};
enum { METHODS = sizeof methods / sizeof methods[0] };

/* ---- reading a scene, for which the library is used ---- */

static void stop(const char *why) {
  fprintf(stderr, "plain: %s\n", why);
  exit(1);
}

static void check(int32_t status) {
  if (status != HOOKE_OK) stop(hooke_last_error());
}

static double *numbers(int64_t count) {
  double *made = calloc((size_t)count + 1, sizeof *made);
  if (!made) stop("out of memory");
  return made;
}

static void take_springs(const hooke_system *system, struct model *m) {
  const int64_t count = m->springs = hooke_system_count(system, "springs");
  double *kappa = numbers(count), *gamma = numbers(count), *l0 = numbers(count), *resists = numbers(count);
  int64_t *ends = malloc((size_t)(2 * count + 1) * sizeof *ends);
  m->spring = malloc((size_t)(count + 1) * sizeof *m->spring);
  if (!ends || !m->spring) stop("out of memory");
  check(hooke_system_members(system, "springs", ends, kappa, gamma, l0));
  check(hooke_system_compression(system, resists));
  for (int64_t k = 0; k < count; k++)
    m->spring[k] = (struct spring){ends[2 * k], ends[2 * k + 1], kappa[k], gamma[k], l0[k], resists[k] == 0};
  free(kappa), free(gamma), free(l0), free(resists), free(ends);
}

/* With all particles at one place no spring has a direction, and what is left of the acceleration is gravity.
 */
static void take_gravity(const hooke_system *system, struct model *m) {
  double *zeros = numbers(3 * m->particles), *a = numbers(3 * m->particles);
  check(hooke_system_acceleration(system, 0, zeros, zeros, a));
  for (int64_t k = 0; k < 3 * m->particles; k++)
    if (m->w[k / 3] > 0) m->gravity[k % 3] = a[k];
  free(zeros), free(a);
}

static void take(const hooke_system *system, struct model *m, struct motion *x) {
  const int64_t n = m->particles = hooke_system_particle_count(system);
  hooke_state *start;
  check(hooke_state_create(system, &start));
  x->q = numbers(3 * n), x->v = numbers(3 * n), m->w = numbers(n);
  memcpy(x->q, hooke_state_position(start), (size_t)(3 * n) * sizeof(double));
  memcpy(x->v, hooke_state_velocity(start), (size_t)(3 * n) * sizeof(double));
  memcpy(m->w, hooke_system_inverse_mass(system), (size_t)n * sizeof(double));
  hooke_state_destroy(start);
  take_springs(system, m);
  take_gravity(system, m);
}

/* This file is no definition of what it leaves out: other forces and laws, rigid bodies, first-order motion.
 * Nor of driven particles and of springs that follow time, which do not show in the forces at the start. */
static void refuse_others(const hooke_system *system, const struct model *m, const struct motion *x) {
  const int64_t size = 3 * m->particles;
  double *a = numbers(size), *of_hooke = numbers(size);
  const char *name;
  for (int64_t k = 0; (name = hooke_system_force_name(system, k)); k++)
    if (strcmp(name, "springs") != 0 && strcmp(name, "gravity") != 0)
      stop("the scene has a force that is not in this file; springs and gravity are");
  if (strcmp(hooke_system_dynamics(system), "inertial") != 0) stop("the scene is overdamped");
  accelerate(m, x->q, x->v, a);
  check(hooke_system_acceleration(system, 0, x->q, x->v, of_hooke));
  for (int64_t k = 0; k < size; k++)
    if (a[k] != of_hooke[k]) stop("the scene has a law or a body that is not in this file");
  free(a), free(of_hooke);
}

/* ---- the program ---- */

int main(int argc, char **argv) {
  int method = 0;
  hooke_scene *scene;
  struct model m = {0, 0, NULL, NULL, {0, 0, 0}};
  struct motion x;
  if (argc != 5) stop("usage: plain SCENE METHOD STEP STEPS");
  while (method < METHODS && strcmp(argv[2], methods[method].name) != 0)
    method++;
  if (method == METHODS) stop("the methods are symplectic-euler, verlet and rk4");
  const double h = strtod(argv[3], NULL);
  const long steps = strtol(argv[4], NULL, 10);
  check(hooke_scene_load(argv[1], NULL, &scene));
  check(hooke_scene_commit(scene));
  take(hooke_scene_system(scene), &m, &x);
  refuse_others(hooke_scene_system(scene), &m, &x);
  hooke_scene_destroy(scene);
  double *room = numbers(9 * 3 * m.particles);
  for (long k = 0; k < steps; k++) /* nothing of hooke from here on */
    methods[method].step(&m, h, &x, room);
  for (int64_t p = 0; p < m.particles; p++) {
    const double *q = x.q + 3 * p, *v = x.v + 3 * p;
    printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", q[0], q[1], q[2], v[0], v[1], v[2]);
  }
  free(x.q), free(x.v), free(m.w), free(m.spring), free(room);
  return 0;
}
