/* Drag of free particles in a medium: f = -c w, where every particle has its own c or a wind blows, and
 * f = -c |w| w, with w = v - u. In an overdamped system c is gamma, and the wind alone is a force, gamma u.
 */
#include "core/sum.h"
#include "model/system.h"
#include "model/variant/variant.h"
#include "model/vector3.h"

#include <stddef.h>

/* A kind of drag at a time: what it is proportional to at the speed. */
struct drag {
  const hooke_system *system;
  const struct hk_each *each;
  int32_t squared; /* 1: to the square of the speed */
  double wind[3];
};

static struct drag linear_at(const hooke_system *system, double t) {
  struct drag drag = {system, &system->medium->drag, 0, {0.0}};
  hk_wind_at(system, t, drag.wind);
  return drag;
}

static struct drag quadratic_at(const hooke_system *system, double t) {
  struct drag drag = {system, &system->medium->quadratic_drag, 1, {0.0}};
  hk_wind_at(system, t, drag.wind);
  return drag;
}

/* w, and the force over -w: c or c |w|; 0 if the particle is constrained. */
static double strength_of(const struct drag *drag, int64_t p, const double v[3], double w[3]) {
  for (int a = 0; a < 3; a++)
    w[a] = v[a] - drag->wind[a];
  const double c = drag->system->constrained[p] ? 0.0 : hk_each_at(drag->each, p);
  return drag->squared ? c * hk_length3(w) : c;
}

static void add_drag(const struct drag *drag, struct hk_motion *motion) {
  for (int64_t p = 0; p < motion->n && motion->zero == NULL; p++) {
    double w[3];
    const double c = strength_of(drag, p, (double[]){motion->v[0][p], motion->v[1][p], motion->v[2][p]}, w);
    for (int a = 0; a < 3 && !drag->system->constrained[p]; a++)
      motion->f[a][p] -= c * w[a];
  }
}

/* Of all particles: the heat c w^2, or the work of the wind, -c w.u. */
static double power_of(const struct drag *drag, const double *v, int heat) {
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t p = 0; p < drag->system->particle_count; p++) {
    double w[3];
    const double c = strength_of(drag, p, v + 3 * p, w);
    hk_sum_add(&sum, heat ? c * hk_dot3(w, w) : -c * hk_dot3(w, drag->wind));
  }
  return hk_sum_value(&sum);
}

/* One for each particle. Quadratic drag changes by 2 c |w| along w and by c |w| across; without velocities
 * particles are at rest. */
static void find_elements(const struct drag *drag, const double *v, int64_t first, int64_t wanted,
                          struct hk_element *out) {
  static const double still[3] = {0.0};
  for (int64_t k = 0; k < wanted; k++) {
    double w[3], *u = out[k].u;
    const double c = strength_of(drag, first + k, v ? v + 3 * (first + k) : still, w), speed = hk_length3(w);
    out[k] = (struct hk_element){.count = 1,
                                 .particle = {(int32_t)(first + k)},
                                 .weight = {1.0},
                                 .c_along = drag->squared ? 2.0 * c : c,
                                 .c_across = c,
                                 .over = 1.0};
    for (int a = 0; a < 3 && drag->squared && speed > 0.0; a++)
      u[a] = w[a] / speed;
  }
}

static int64_t count(const hooke_system *system) {
  return system->particle_count;
}

static int32_t blows(const hooke_system *system) {
  return system->medium->blows;
}

/* ---- linear ---- */

static int32_t is_linear(const hooke_system *system) {
  const struct hk_medium *medium = system->medium;
  return !system->overdamped && medium->drag.most > 0.0 && (medium->drag.value || medium->blows);
}

static void check_linear(const hooke_system *system, uint32_t *value) {
  hk_medium_check_value(system, &system->medium->drag, value);
}

/* Each of the two rows of linear drag copies what it is the force of. */
static int32_t copy_linear(const struct hk_variant_maker *maker) {
  return is_linear(maker->from) ? hk_medium_copy_drag(maker) : HOOKE_OK;
}

static int32_t add_linear(const hooke_system *system, struct hk_motion *motion, double t) {
  const struct drag drag = linear_at(system, t);
  add_drag(&drag, motion);
  return HOOKE_OK;
}

static double linear_heat(const hooke_system *system, double t, const double *q, const double *v) {
  (void)q;
  const struct drag drag = linear_at(system, t);
  return power_of(&drag, v, 1);
}

static double linear_power(const hooke_system *system, double t, const double *q, const double *v) {
  (void)q;
  const struct drag drag = linear_at(system, t);
  return power_of(&drag, v, 0);
}

static void linear_elements(const hooke_system *system, double t, const double *q, const double *v,
                            int64_t first, int64_t wanted, struct hk_element *out) {
  (void)q;
  const struct drag drag = linear_at(system, t);
  find_elements(&drag, v, first, wanted, out);
}

static void multiply(const hooke_system *system, double a, double b, const double *const x[3],
                     double *const out[3]) {
  (void)a;
  for (int c = 0; c < 3 && b != 0.0; c++) {
    for (int64_t p = 0; p < system->particle_count; p++)
      out[c][p] += system->constrained[p] ? 0.0 : b * hk_each_at(&system->medium->drag, p) * x[c][p];
  }
}

const struct hk_force_row hk_force_medium = {.name = "drag",
                                             .kind = HOOKE_CONSTANT,
                                             .is_drag = 1,
                                             .in_scenes = 1,
                                             .title = "drag",
                                             .check = check_linear,
                                             .copy = copy_linear,
                                             .present = is_linear,
                                             .add = add_linear,
                                             .heat = linear_heat,
                                             .does_work = blows,
                                             .power = linear_power,
                                             .count = count,
                                             .elements = linear_elements,
                                             .multiply = multiply,
                                             .damped = is_linear};

/* ---- quadratic ---- */

static int32_t is_quadratic(const hooke_system *system) {
  return system->medium->quadratic_drag.most > 0.0;
}

static void check_quadratic(const hooke_system *system, uint32_t *value) {
  hk_medium_check_value(system, &system->medium->quadratic_drag, value);
}

static int32_t add_quadratic(const hooke_system *system, struct hk_motion *motion, double t) {
  const struct drag drag = quadratic_at(system, t);
  add_drag(&drag, motion);
  return HOOKE_OK;
}

static double quadratic_heat(const hooke_system *system, double t, const double *q, const double *v) {
  (void)q;
  const struct drag drag = quadratic_at(system, t);
  return power_of(&drag, v, 1);
}

static double quadratic_power(const hooke_system *system, double t, const double *q, const double *v) {
  (void)q;
  const struct drag drag = quadratic_at(system, t);
  return power_of(&drag, v, 0);
}

static void quadratic_elements(const hooke_system *system, double t, const double *q, const double *v,
                               int64_t first, int64_t wanted, struct hk_element *out) {
  (void)q;
  const struct drag drag = quadratic_at(system, t);
  find_elements(&drag, v, first, wanted, out);
}

const struct hk_force_row hk_force_quadratic = {.name = "quadratic_drag",
                                                .kind = HOOKE_KEPT,
                                                .is_drag = 1,
                                                .not_linear = 1,
                                                .in_scenes = 1,
                                                .title = "quadratic drag",
                                                .check = check_quadratic,
                                                .copy = hk_medium_copy_quadratic_drag,
                                                .present = is_quadratic,
                                                .add = add_quadratic,
                                                .heat = quadratic_heat,
                                                .does_work = blows,
                                                .power = quadratic_power,
                                                .count = count,
                                                .elements = quadratic_elements,
                                                .damped = is_quadratic};

/* ---- in an overdamped system ---- */

static int32_t pushes(const hooke_system *system) {
  return system->overdamped && system->medium->blows;
}

/* Elsewhere a variant has the wind even without this force. */
static int32_t copy_wind(const struct hk_variant_maker *maker) {
  return maker->from->overdamped ? hk_medium_copy_wind(maker) : HOOKE_OK;
}

static int32_t add_wind(const hooke_system *system, struct hk_motion *motion, double t) {
  double wind[3];
  hk_wind_at(system, t, wind);
  for (int a = 0; a < 3; a++) {
    for (int64_t p = 0; p < motion->n; p++)
      motion->f[a][p] += system->constrained[p] ? 0.0 : system->inertia[p] * wind[a];
  }
  return HOOKE_OK;
}

const struct hk_force_row hk_force_wind = {.name = "wind",
                                           .in_scenes = 1,
                                           .check = check_linear,
                                           .copy = copy_wind,
                                           .present = pushes,
                                           .add = add_wind,
                                           .does_work = pushes,
                                           .power = linear_power};
