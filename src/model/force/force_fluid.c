/* Drag by shape (fluid.h), with w the mean velocity of a member's ends less the wind's. Its derivative by w
 * is symmetric, and in elements; that by positions is not, and is in products alone. */
#include "model/force/fluid.h"

#include "core/memory.h"
#include "core/sum.h"
#include "model/check_value.h"
#include "model/system.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

struct member {
  int32_t ends, particle[3];
  double normal, tangential;
};

/* ---- from groups ---- */

int32_t hk_system_add_fluid(hooke_system *system, const struct hk_addition *added, double normal,
                            double tangential) {
  struct hk_group group;
  const int32_t status = hk_group_begin(system, added, &group);
  for (int64_t k = 0; k < added->count && status == HOOKE_OK; k++) {
    group.number[HOOKE_GAMMA][k] = normal;
    group.number[HOOKE_REST_LENGTH][k] = tangential;
  }
  return hk_group_end(system, status, &group);
}

static const struct member *members_of(const hooke_system *system) {
  return system->rest->own[hk_force_number(&hk_force_fluid)];
}

static int64_t count_of(const hooke_system *system) {
  return system->rest->member_count[hk_force_number(&hk_force_fluid)];
}

static int32_t commit(hooke_system *system, const struct hk_group *group, int64_t count) {
  struct member *next = count > 0 ? hk_new(count_of(system), sizeof *next) : NULL;
  if (count > 0 && next == NULL) return HOOKE_NO_MEMORY;
  system->rest->own[hk_force_number(&hk_force_fluid)] = next;
  for (; count > 0; group++, count--) {
    for (int64_t k = 0; k < group->count; k++, next++) {
      for (int e = 0; e < 3; e++)
        next->particle[e] = group->particle[e][k];
      next->ends = next->particle[2] == next->particle[1] ? 2 : 3;
      next->normal = group->number[HOOKE_GAMMA][k];
      next->tangential = group->number[HOOKE_REST_LENGTH][k];
    }
  }
  return HOOKE_OK;
}

static void release(hooke_system *system) {
  void **own = &system->rest->own[hk_force_number(&hk_force_fluid)];
  hk_free(*own);
  *own = NULL;
}

static int64_t memory(const hooke_system *system) {
  return count_of(system) * (int64_t)sizeof(struct member);
}

static void recall(const hooke_system *system, int64_t first, struct hk_group *to) {
  const struct member *m = members_of(system) + first;
  for (int64_t k = 0; k < to->count; k++, m++) {
    for (int e = 0; e < 3; e++)
      to->particle[e][k] = m->particle[e];
    to->number[HOOKE_GAMMA][k] = m->normal;
    to->number[HOOKE_REST_LENGTH][k] = m->tangential;
  }
}

static void check(const hooke_system *system, uint32_t *value) {
  for (int64_t k = 0; k < count_of(system); k++) {
    const struct member *m = members_of(system) + k;
    hk_check_add(value, m->particle, 3, sizeof(int32_t));
    hk_check_add(value, &m->normal, 2, sizeof(double));
  }
  hk_medium_check_value(system, NULL, value);
}

/* ---- a member at a place and a velocity ---- */

/* Of a segment: its direction, its length, and the parts of w; of a triangle: its normal, twice its area, and
 * the part of w along it. */
struct shape {
  double along[3], size, w[3], rate, across[3], speed; /* `across` has this speed */
  double force[3];                                     /* on all ends together */
};

/* The sides from the first end to the second, and to the third one. */
static void find_sides(const double *const x[3], double side[2][3]) {
  for (int a = 0; a < 3; a++) {
    side[0][a] = x[1][a] - x[0][a];
    side[1][a] = x[2][a] - x[0][a];
  }
}

static void find_segment(const struct member *m, const double side[3], struct shape *s) {
  s->size = hk_length3(side);
  hk_scale3(s->size > 0.0 ? 1.0 / s->size : 0.0, side, s->along);
  s->rate = hk_dot3(s->w, s->along);
  for (int a = 0; a < 3; a++)
    s->across[a] = s->w[a] - s->rate * s->along[a];
  s->speed = hk_length3(s->across);
  const double across = m->normal * s->speed, along = m->tangential * fabs(s->rate) * s->rate;
  for (int a = 0; a < 3; a++)
    s->force[a] = -(s->size * (across * s->across[a] + along * s->along[a]));
}

static void find_triangle(const struct member *m, double side[2][3], struct shape *s) {
  double normal[3];
  hk_cross3(side[0], side[1], normal);
  s->size = hk_length3(normal);
  hk_scale3(s->size > 0.0 ? 1.0 / s->size : 0.0, normal, s->along);
  s->rate = hk_dot3(s->w, s->along);
  hk_scale3(-(m->normal * s->size * fabs(s->rate) * s->rate), s->along, s->force);
}

/* The places and velocities of its ends. */
static void find_shape(const struct member *m, const double *const x[3], const double *const v[3],
                       const double wind[3], struct shape *s) {
  double side[2][3];
  *s = (struct shape){.size = 0.0};
  find_sides(x, side);
  for (int a = 0; a < 3; a++) {
    const double pair = v[0][a] + v[1][a];
    s->w[a] = (m->ends == 2 ? 0.5 * pair : (pair + v[2][a]) / 3.0) - wind[a];
  }
  if (m->ends == 2)
    find_segment(m, side[0], s);
  else
    find_triangle(m, side, s);
}

static void ends_in_rows(const struct member *m, const double *rows, const double *end[3]) {
  for (int e = 0; e < 3; e++)
    end[e] = rows + 3 * (int64_t)m->particle[e];
}

static void shape_in_rows(const hooke_system *system, const struct member *m, double t, const double *q,
                          const double *v, struct shape *s) {
  static const double still[3] = {0.0};
  const double *x[3], *u[3] = {still, still, still};
  double wind[3];
  hk_wind_at(system, t, wind);
  ends_in_rows(m, q, x);
  if (v) ends_in_rows(m, v, u);
  find_shape(m, x, u, wind, s);
}

/* ---- the force ---- */

static void add_member(const struct member *m, const double wind[3], struct hk_motion *motion) {
  double place[3][3], velocity[3][3];
  struct shape s;
  for (int e = 0; e < 3; e++) {
    for (int a = 0; a < 3; a++) {
      place[e][a] = motion->q[a][m->particle[e]];
      velocity[e][a] = motion->v[a][m->particle[e]];
    }
  }
  find_shape(m, (const double *const[3]){place[0], place[1], place[2]},
             (const double *const[3]){velocity[0], velocity[1], velocity[2]}, wind, &s);
  for (int e = 0; e < m->ends; e++) {
    for (int a = 0; a < 3; a++)
      motion->f[a][m->particle[e]] += m->ends == 2 ? 0.5 * s.force[a] : s.force[a] / 3.0;
  }
}

/* Segments first. */
static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  const struct member *all = members_of(system), *end = all + count_of(system);
  double wind[3];
  hk_wind_at(system, t, wind);
  for (int32_t ends = 2; ends <= 3; ends++) {
    for (const struct member *m = all; m < end; m++)
      if (m->ends == ends) add_member(m, wind, motion);
  }
  return HOOKE_OK;
}

/* -F.w as heat, or F.u as the work of the wind. */
static double sum_powers(const hooke_system *system, double t, const double *q, const double *v, int heat) {
  struct hk_sum sum = {0.0, 0.0};
  double wind[3];
  hk_wind_at(system, t, wind);
  for (int64_t k = 0; k < count_of(system); k++) {
    struct shape s;
    shape_in_rows(system, members_of(system) + k, t, q, v, &s);
    hk_sum_add(&sum, heat ? -hk_dot3(s.force, s.w) : hk_dot3(s.force, wind));
  }
  return hk_sum_value(&sum);
}

static double heat(const hooke_system *system, double t, const double *q, const double *v) {
  return sum_powers(system, t, q, v, 1);
}

static double power(const hooke_system *system, double t, const double *q, const double *v) {
  return sum_powers(system, t, q, v, 0);
}

static int32_t blows(const hooke_system *system) {
  return system->medium->blows;
}

/* ---- derivatives ---- */

static void change_segment(const struct member *m, const struct shape *s, const double side[3],
                           const double dw[3], double force[3]) {
  if (!(s->size > 0.0)) return;
  const double longer = hk_dot3(s->along, side);
  double turn[3], across[3];
  for (int a = 0; a < 3; a++)
    turn[a] = (side[a] - longer * s->along[a]) / s->size;
  const double rate = hk_dot3(dw, s->along) + hk_dot3(s->w, turn);
  for (int a = 0; a < 3; a++)
    across[a] = dw[a] - rate * s->along[a] - s->rate * turn[a];
  const double faster = s->speed > 0.0 ? hk_dot3(s->across, across) / s->speed : 0.0;
  for (int a = 0; a < 3; a++) {
    const double by_normal = s->speed * across[a] + faster * s->across[a],
                 by_tangential = fabs(s->rate) * (2.0 * rate * s->along[a] + s->rate * turn[a]);
    force[a] =
        longer / s->size * s->force[a] - s->size * (m->normal * by_normal + m->tangential * by_tangential);
  }
}

static void change_triangle(const struct member *m, const struct shape *s, double side[2][3],
                            double moved[2][3], const double dw[3], double force[3]) {
  double one[3], other[3], turn[3];
  if (!(s->size > 0.0)) return;
  hk_cross3(moved[0], side[1], one);
  hk_cross3(side[0], moved[1], other);
  hk_add3(1.0, other, one); /* the change of the normal times twice the area */
  const double larger = hk_dot3(s->along, one);
  for (int a = 0; a < 3; a++)
    turn[a] = (one[a] - larger * s->along[a]) / s->size;
  const double rate = hk_dot3(dw, s->along) + hk_dot3(s->w, turn);
  for (int a = 0; a < 3; a++)
    force[a] = -m->normal * fabs(s->rate) * (2.0 * rate * s->size * s->along[a] + s->rate * one[a]);
}

static int32_t add_product(const hooke_system *system, const struct hk_point *point, double *out) {
  for (const struct member *m = members_of(system), *end = m + count_of(system); m < end; m++) {
    const double *x[3], *dx[3], *dv[3];
    double side[2][3], moved[2][3], dw[3], force[3] = {0.0};
    struct shape s;
    shape_in_rows(system, m, point->t, point->q, point->v, &s);
    ends_in_rows(m, point->q, x);
    ends_in_rows(m, point->dq, dx);
    ends_in_rows(m, point->dv, dv);
    find_sides(x, side);
    find_sides(dx, moved);
    for (int a = 0; a < 3; a++)
      dw[a] = m->ends == 2 ? 0.5 * (dv[0][a] + dv[1][a]) : (dv[0][a] + dv[1][a] + dv[2][a]) / 3.0;
    if (m->ends == 2)
      change_segment(m, &s, moved[0], dw, force);
    else
      change_triangle(m, &s, side, moved, dw, force);
    for (int k = 0; k < 3 * m->ends; k++)
      out[3 * m->particle[k / 3] + k % 3] += force[k % 3] / (double)m->ends;
  }
  return HOOKE_OK;
}

/* Two of each member. The first is along a segment, with what both directions across it have alike, or along
 * the normal of a triangle; the second is along the flow across a segment. */
static int64_t count(const hooke_system *system) {
  return 2 * count_of(system);
}

static void find_damping(const struct member *m, const struct shape *s, int second, struct hk_element *e) {
  const double normal = m->normal * s->size * (m->ends == 2 ? s->speed : 2.0 * fabs(s->rate));
  if (!second) {
    memcpy(e->u, s->along, sizeof e->u);
    e->c_along = m->ends == 2 ? 2.0 * m->tangential * s->size * fabs(s->rate) : normal;
    e->c_across = m->ends == 2 ? normal : 0.0;
  } else if (m->ends == 2 && s->speed > 0.0) {
    hk_scale3(1.0 / s->speed, s->across, e->u);
    e->c_along = normal;
  }
}

static void elements(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  const int64_t members = count_of(system);
  for (int64_t k = 0; k < wanted; k++) {
    const struct member *m = members_of(system) + (first + k) % members;
    const double weight = 1.0 / (double)m->ends;
    struct shape s;
    out[k] = (struct hk_element){
        .count = m->ends,
        .particle = {m->particle[0], m->particle[1], m->particle[2]},
        .weight = {weight, weight, m->ends == 2 ? 0.0 : weight},
        .over = 1.0,
    };
    if (q == NULL) continue;
    shape_in_rows(system, m, t, q, v, &s);
    find_damping(m, &s, first + k >= members, &out[k]);
  }
}

static int32_t damped(const hooke_system *system) {
  return count_of(system) > 0;
}

const struct hk_force_row hk_force_fluid = {.name = "fluid_drag",
                                            .kind = HOOKE_KEPT,
                                            .is_drag = 1,
                                            .not_linear = 1,
                                            .members = "pieces in a fluid",
                                            .member = "piece in a fluid",
                                            .title = "fluid drag",
                                            .place = "pieces",
                                            .bytes = 130.0,
                                            .width = {[HOOKE_GAMMA] = 1, [HOOKE_REST_LENGTH] = 1},
                                            .member_particles = 3,
                                            HOOKE_FORCE_OF_GROUPS,
                                            .add = add,
                                            .heat = heat,
                                            .does_work = blows,
                                            .power = power,
                                            .add_product = add_product,
                                            .count = count,
                                            .elements = elements,
                                            .damped = damped};
