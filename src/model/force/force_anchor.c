/* Anchors: springs of the length law from a particle to a fixed point of space, f = -(kappa (r - l0) +
 * gamma (v.u)) u with x = q - point, r = |x|, u = x/r. */

#include "core/memory.h"
#include "core/sum.h"
#include "model/check_value.h"
#include "model/system.h"

#include <string.h>

static const struct hk_option_row rows[] = {
    HOOKE_OPTION(
        "points", HOOKE_OPTION_VECTORS("m", 1, 0), "initial",
        "the point that each particle is tied to, three numbers for each; initial: where it was added",
        .words = "initial"),
    HOOKE_OPTION("stiffness", HOOKE_OPTION_EACH("N/m"), NULL, "stiffness, one number or one for each anchor",
                 .required = 1),
    HOOKE_OPTION("damping", HOOKE_OPTION_EACH("N s/m"), "0",
                 "damping along the line to the point, one number or one for each"),
    HOOKE_OPTION("rest_length", HOOKE_OPTION_EACH("m"), "0", "rest length, one number or one for each"),
};

static const struct hk_option_table options_table = {"anchors", HOOKE_OPTION_ROWS(rows)};

/* ---- adding a group ---- */

int32_t hk_system_add_anchors(hooke_system *system, const struct hk_addition *added) {
  const hooke_options *options = added->options;
  struct hk_group group;
  int32_t status = hk_group_begin(system, added, &group);
  if (status == HOOKE_OK) hk_group_fill(&group, options);
  const double *points = status == HOOKE_OK && hooke_options_number_count(options, "points") > 0
                             ? hooke_options_numbers(options, "points")
                             : NULL;
  for (int64_t k = 0; k < added->count && status == HOOKE_OK; k++)
    memcpy(group.number[HOOKE_POINT] + 3 * k,
           points ? points + 3 * k : system->position + 3 * added->particles[k], 3 * sizeof(double));
  return hk_group_end(system, status, &group);
}

int32_t hooke_system_add_anchors(hooke_system *system, const char *name, int64_t count,
                                 const int64_t *particles, const hooke_options *options) {
  return hk_system_add_anchors(system,
                               &(struct hk_addition){&hk_force_anchor, name, count, particles, options, 0});
}

/* ---- from groups ---- */

struct anchor {
  int64_t particle;
  double point[3], kappa, gamma, rest_length;
};

static const struct anchor *anchors_of(const hooke_system *system) {
  return system->rest->own[hk_force_number(&hk_force_anchor)];
}

static int64_t count_of(const hooke_system *system) {
  return hk_force_count(system, &hk_force_anchor);
}

static int32_t commit(hooke_system *system, const struct hk_group *group, int64_t count) {
  struct anchor *next = count > 0 ? hk_new(count_of(system), sizeof *next) : NULL;
  if (count > 0 && next == NULL) return HOOKE_NO_MEMORY;
  system->rest->own[hk_force_number(&hk_force_anchor)] = next;
  for (; count > 0; group++, count--) {
    for (int64_t k = 0; k < group->count; k++, next++) {
      memcpy(next->point, group->number[HOOKE_POINT] + 3 * k, sizeof next->point);
      next->particle = group->particle[0][k];
      next->kappa = group->number[HOOKE_KAPPA][k];
      next->gamma = group->number[HOOKE_GAMMA][k];
      next->rest_length = group->number[HOOKE_REST_LENGTH][k];
    }
  }
  return HOOKE_OK;
}

static void release(hooke_system *system) {
  void **own = &system->rest->own[hk_force_number(&hk_force_anchor)];
  hk_free(*own);
  *own = NULL;
}

static int64_t memory(const hooke_system *system) {
  return count_of(system) * (int64_t)sizeof(struct anchor);
}

static void check(const hooke_system *system, uint32_t *value) {
  hk_check_add(value, anchors_of(system), count_of(system), sizeof(struct anchor));
}

/* ---- the force ---- */

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  const struct anchor *all = anchors_of(system), *end = all + count_of(system);
  for (const struct anchor *a = all; a < end; a++) {
    const int64_t p = a->particle;
    double *const *q = motion->q, *const *v = motion->v;
    const double d[3] = {q[0][p] - a->point[0], q[1][p] - a->point[1], q[2][p] - a->point[2]};
    const double r = hk_spring_length(d[0], d[1], d[2]), ir = hk_spring_inverse_length(r);
    motion->near_zero |= r + r < a->rest_length;
    const double rate = ((v[0][p] * d[0] + v[1][p] * d[1]) + v[2][p] * d[2]) * ir;
    const int is_damped = a->gamma != 0.0 && motion->zero == NULL;
    const double s = hk_spring_tension(r, a->rest_length, a->kappa, a->gamma * rate, is_damped, 0) * ir;
    for (int c = 0; c < 3; c++)
      motion->f[c][p] -= s * d[c];
  }
  return HOOKE_OK;
}

static int64_t passed(const hooke_system *system, const double *before, const double *now, int64_t ends[2]) {
  const struct anchor *all = anchors_of(system), *end = all + count_of(system);
  int64_t count = 0;
  for (const struct anchor *a = all; a < end; a++) {
    const int64_t i = 3 * a->particle;
    if (!(a->rest_length > 0.0) || !hk_spring_turned(before + i, a->point, now + i, a->point)) continue;
    if (count++ > 0) continue;
    ends[0] = a->particle;
    ends[1] = -1;
  }
  return count;
}

/* The anchor as a spring from end 0 to end 1, with the point at rest: x and u hold both. */
static struct hk_spring spring_of(const struct anchor *a, const double *q, const double *v, double x[6],
                                  double u[6]) {
  memcpy(x, q + 3 * a->particle, 3 * sizeof(double));
  memcpy(x + 3, a->point, sizeof a->point);
  memset(u, 0, 6 * sizeof(double));
  if (v) memcpy(u, v + 3 * a->particle, 3 * sizeof(double));
  return (struct hk_spring){0, 1, a->kappa, a->gamma, a->rest_length, 0, NULL, 1.0};
}

static double energy(const hooke_system *system, double t, const double *q) {
  (void)t;
  struct hk_sum sum = {0.0, 0.0};
  const struct anchor *all = anchors_of(system), *end = all + count_of(system);
  for (const struct anchor *a = all; a < end; a++) {
    double x[6], u[6];
    struct hk_stretch s;
    const struct hk_spring spring = spring_of(a, q, NULL, x, u);
    hk_spring_stretch(&spring, x, NULL, &s);
    hk_sum_add(&sum, 0.5 * s.elastic * (s.length - spring.rest_length));
  }
  return hk_sum_value(&sum);
}

static int32_t change(const hooke_system *system, int64_t number, const struct hk_point *point,
                      struct hk_member_change *out) {
  const struct anchor *a = &anchors_of(system)[number];
  double x[6], u[6];
  struct hk_spring_slope s;
  const struct hk_spring spring = spring_of(a, point->q, point->v, x, u);
  out->count = 1;
  out->particle[0] = (int32_t)a->particle;
  if (!hk_spring_slope_find(&spring, x, u, &s)) return 0;
  hk_spring_slope_change(&s, point->dq + 3 * a->particle, point->dv + 3 * a->particle, out->force[0]);
  for (int c = 0; c < 3; c++)
    out->force[0][c] = -out->force[0][c];
  return 1;
}

static void elements(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  (void)t;
  for (int64_t k = 0; k < wanted; k++) {
    double x[6], u[6];
    const struct anchor *a = anchors_of(system) + first + k;
    if (q) {
      const struct hk_spring spring = spring_of(a, q, v, x, u);
      hk_spring_element(&spring, x, v ? u : NULL, &out[k]);
    }
    out[k].count = 1;
    out[k].particle[0] = (int32_t)a->particle;
  }
}

static void add_stiffness(const hooke_system *system, double *sum) {
  const struct anchor *all = anchors_of(system), *end = all + count_of(system);
  for (const struct anchor *a = all; a < end; a++)
    *sum += a->kappa;
}

static void recall(const hooke_system *system, int64_t first, struct hk_group *to) {
  const struct anchor *a = anchors_of(system) + first;
  for (int64_t k = 0; k < to->count; k++, a++) {
    to->particle[0][k] = (int32_t)a->particle;
    to->number[HOOKE_KAPPA][k] = a->kappa;
    to->number[HOOKE_GAMMA][k] = a->gamma;
    to->number[HOOKE_REST_LENGTH][k] = a->rest_length;
    memcpy(to->number[HOOKE_POINT] + 3 * k, a->point, sizeof a->point);
  }
}

const struct hk_force_row hk_force_anchor = {.name = "anchors",
                                             .kind = HOOKE_KEPT,
                                             .in_scenes = 1,
                                             .members = "anchors",
                                             .title = "anchor",
                                             .bytes = 130.0,
                                             .options = &options_table,
                                             .member = "anchor",
                                             .place = "particles",
                                             .width = {1, 1, 1, 3},
                                             .member_particles = 1,
                                             HOOKE_FORCE_OF_GROUPS,
                                             .add = add,
                                             .passed = passed,
                                             .energy = energy,
                                             .change = change,
                                             .elements = elements,
                                             .add_stiffness = add_stiffness};

/* ---- queries ---- */

int32_t hooke_system_anchor_points(const hooke_system *system, double *points) {
  const int32_t status = hk_system_require_committed(system);
  for (int64_t k = 0; status == HOOKE_OK && k < count_of(system); k++)
    memcpy(points + 3 * k, anchors_of(system)[k].point, 3 * sizeof(double));
  return status;
}
