/* Linear forces about a place: those of elements that stay as they are, f = -K (q - place) - C v. Of
 * systems that stand for another one linearised. */
#include "model/force/force.h"

#include "core/sum.h"

#include <math.h>
#include <string.h>

void hk_system_set_linear(hooke_system *system, int64_t count, const struct hk_element *element,
                          const double *place) {
  system->linear = (struct hk_linear){count, element, place};
}

static int32_t present(const hooke_system *system) {
  return system->linear.count > 0;
}

/* The element alone, with its particles numbered 0 to 3. */
static struct hk_element alone(const struct hk_element *e) {
  struct hk_element own = *e;
  for (int j = 0; j < own.count; j++)
    own.particle[j] = j;
  return own;
}

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  const struct hk_linear *linear = &system->linear;
  for (const struct hk_element *e = linear->element; e < linear->element + linear->count; e++) {
    const struct hk_element own = alone(e);
    double d[3][4], v[3][4], f[3][4] = {{0.0}};
    for (int k = 0; k < 3 * own.count; k++) {
      const int64_t p = e->particle[k / 3];
      d[k % 3][k / 3] = motion->q[k % 3][p] - linear->place[3 * p + k % 3];
      v[k % 3][k / 3] = motion->v[k % 3][p];
    }
    double *const out[3] = {f[0], f[1], f[2]};
    hk_element_multiply(&own, e->k_along, e->k_across, 1, (const double *const[]){d[0], d[1], d[2]}, out);
    hk_element_multiply(&own, e->c_along, e->c_across, 1, (const double *const[]){v[0], v[1], v[2]}, out);
    for (int k = 0; k < 3 * own.count; k++)
      motion->f[k % 3][e->particle[k / 3]] -= f[k % 3][k / 3];
  }
  return HOOKE_OK;
}

static double energy(const hooke_system *system, const double *q) {
  const struct hk_linear *linear = &system->linear;
  struct hk_sum sum = {0.0, 0.0};
  for (const struct hk_element *e = linear->element; e < linear->element + linear->count; e++) {
    const struct hk_element own = alone(e);
    double d[12];
    for (int k = 0; k < 3 * own.count; k++) {
      const int64_t at = 3 * (int64_t)e->particle[k / 3] + k % 3;
      d[k] = q[at] - linear->place[at];
    }
    const double *const x[3] = {d, d + 1, d + 2};
    hk_sum_add(&sum, 0.5 * hk_element_energy(&own, e->k_along, e->k_across, 3, x));
  }
  return hk_sum_value(&sum);
}

static double heat(const hooke_system *system, const double *q, const double *v) {
  (void)q;
  const double *const x[3] = {v, v + 1, v + 2};
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t k = 0; k < system->linear.count; k++) {
    const struct hk_element *e = &system->linear.element[k];
    hk_sum_add(&sum, hk_element_energy(e, e->c_along, e->c_across, 3, x));
  }
  return hk_sum_value(&sum);
}

static int64_t count(const hooke_system *system) {
  return system->linear.count;
}

static void elements(const hooke_system *system, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  (void)q, (void)v;
  memcpy(out, system->linear.element + first, (size_t)wanted * sizeof *out);
}

static void multiply(const hooke_system *system, double a, double b, const double *const x[3],
                     double *const out[3]) {
  for (int64_t k = 0; k < system->linear.count; k++) {
    const struct hk_element *e = &system->linear.element[k];
    hk_element_multiply(e, a * e->k_along + b * e->c_along, a * e->k_across + b * e->c_across, 1, x, out);
  }
}

static void add_stiffness(const hooke_system *system, double *sum) {
  for (int64_t k = 0; k < system->linear.count; k++) {
    const struct hk_element *e = &system->linear.element[k];
    const double weight =
        ((fabs(e->weight[0]) + fabs(e->weight[1])) + fabs(e->weight[2])) + fabs(e->weight[3]);
    *sum += weight * weight * fmax(e->k_along, e->k_across);
  }
}

static int32_t damped(const hooke_system *system) {
  int32_t some = 0;
  for (int64_t k = 0; k < system->linear.count; k++)
    some |= system->linear.element[k].c_along > 0.0 || system->linear.element[k].c_across > 0.0;
  return some;
}

const struct hk_force_row hk_force_linear = {.name = "linear",
                                             .title = "linear force",
                                             .present = present,
                                             .add = add,
                                             .energy = energy,
                                             .heat = heat,
                                             .count = count,
                                             .elements = elements,
                                             .multiply = multiply,
                                             .add_stiffness = add_stiffness,
                                             .damped = damped};
