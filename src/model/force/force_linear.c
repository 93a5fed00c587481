/* Linear forces about a place, f = -K (q - place) - C v, from constant elements. Used by systems that are the
 * linear twin of another one. */

#include "core/sum.h"
#include "model/check_value.h"
#include "model/system.h"
#include "model/variant/variant.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

void hk_system_set_linear(hooke_system *system, int64_t count, const struct hk_element *element,
                          const double *origin) {
  system->rest->linear = (struct hk_linear){count, element, origin, 0};
}

static int64_t count(const hooke_system *system) {
  return system->rest->linear.count;
}

/* A twin and its elements stay within one process, where they are known by their addresses. */
static void check(const hooke_system *system, uint32_t *value) {
  hk_check_add(value, &system->rest->linear, 1, sizeof system->rest->linear);
}

static int32_t copy(const struct hk_variant_maker *maker) {
  maker->made->rest->linear = maker->from->rest->linear;
  return count(maker->from) > 0 ? hk_variant_require_numbers(maker, "a linear force") : HOOKE_OK;
}

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  const struct hk_linear *linear = &system->rest->linear;
  for (const struct hk_element *e = linear->element; e < linear->element + linear->count; e++) {
    double x[3] = {0.0}, v[3] = {0.0};
    for (int j = 0; j < e->count; j++) {
      const int64_t p = e->particle[j];
      for (int a = 0; a < 3; a++) {
        x[a] += e->weight[j] * (motion->q[a][p] - linear->origin[3 * p + a]);
        v[a] += e->weight[j] * (motion->zero ? 0.0 : motion->v[a][p]);
      }
    }
    const double along =
        (e->k_along - e->k_across) * hk_dot3(e->u, x) + (e->c_along - e->c_across) * hk_dot3(e->u, v);
    for (int a = 0; a < 3; a++) {
      const double force = along * e->u[a] + (e->k_across * x[a] + e->c_across * v[a]);
      for (int j = 0; j < e->count; j++)
        motion->f[a][e->particle[j]] -= e->weight[j] * force;
    }
  }
  return HOOKE_OK;
}

static double energy(const hooke_system *system, double t, const double *q) {
  (void)t;
  const struct hk_linear *linear = &system->rest->linear;
  struct hk_sum sum = {0.0, 0.0};
  for (const struct hk_element *e = linear->element; e < linear->element + linear->count; e++) {
    double x[3] = {0.0};
    for (int k = 0; k < 3 * e->count; k++) {
      const int64_t at = 3 * (int64_t)e->particle[k / 3] + k % 3;
      x[k % 3] += e->weight[k / 3] * (q[at] - linear->origin[at]);
    }
    const double along = hk_dot3(e->u, x);
    hk_sum_add(&sum, 0.5 * ((e->k_along - e->k_across) * along * along + e->k_across * hk_dot3(x, x)));
  }
  return hk_sum_value(&sum);
}

static void elements(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  (void)t, (void)q, (void)v;
  memcpy(out, system->rest->linear.element + first, (size_t)wanted * sizeof *out);
  for (int64_t k = 0; k < wanted; k++)
    out[k].pull_only = 0;
}

static void multiply(const hooke_system *system, double a, double b, const double *const x[3],
                     double *const out[3]) {
  for (int64_t k = 0; k < system->rest->linear.count; k++) {
    const struct hk_element *e = &system->rest->linear.element[k];
    hk_element_multiply(e, a * e->k_along + b * e->c_along, a * e->k_across + b * e->c_across, 1, x, out);
  }
}

static void add_stiffness(const hooke_system *system, double *sum) {
  for (int64_t k = 0; k < system->rest->linear.count; k++) {
    const struct hk_element *e = &system->rest->linear.element[k];
    const double weight =
        ((fabs(e->weight[0]) + fabs(e->weight[1])) + fabs(e->weight[2])) + fabs(e->weight[3]);
    *sum += weight * weight * fmax(e->k_along, e->k_across);
  }
}

static int32_t damped(const hooke_system *system) {
  int32_t some = 0;
  for (int64_t k = 0; k < system->rest->linear.count; k++)
    some |= system->rest->linear.element[k].c_along > 0.0 || system->rest->linear.element[k].c_across > 0.0;
  return some;
}

const struct hk_force_row hk_force_linear = {.name = "linear",
                                             .kind = HOOKE_CONSTANT,
                                             .title = "linear force",
                                             .check = check,
                                             .copy = copy,
                                             .add = add,
                                             .energy = energy,
                                             .count = count,
                                             .elements = elements,
                                             .multiply = multiply,
                                             .add_stiffness = add_stiffness,
                                             .damped = damped};
