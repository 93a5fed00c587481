/* Altitude springs (kernel/altitude_loops.h): U = ks/(2 l) (h - l)^2 for the currently shortest altitude h of
 * a tetrahedron, l its rest length. Where another altitude becomes the shortest the energy jumps, since their
 * rest lengths differ. Between such changes f_j = -T g_j u is its exact derivative: dh = u.(sum of g_j
 * dq_j). */

#include "core/memory.h"
#include "core/sum.h"
#include "kernel/spring/spring_loops.h"
#include "model/check_value.h"
#include "model/force/altitude.h"
#include "model/system.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  const double *const q[3] = {motion->q[0], motion->q[1], motion->q[2]};
  const double *const still = motion->zero;
  const double *const v[3] = {still ? still : motion->v[0], still ? still : motion->v[1],
                              still ? still : motion->v[2]};
  hk_spring_set(0)->tetrahedra(system->altitudes->count, system->altitudes->tetrahedron, q, v, motion->f);
  return HOOKE_OK;
}

static double energy(const hooke_system *system, const double *q) {
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[k];
    struct hk_tautness s;
    if (!hk_tautness_find(t, q, NULL, &s)) continue;
    hk_sum_add(&sum, 0.5 * s.elastic * (s.altitude.length - t->rest[s.altitude.choice]));
  }
  return hk_sum_value(&sum);
}

static double heat(const hooke_system *system, const double *q, const double *v) {
  struct hk_sum sum = {0.0, 0.0};
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[k];
    struct hk_tautness s;
    if (t->damping == 0.0 || !hk_tautness_find(t, q, v, &s)) continue;
    if (t->pull_only) /* damping does not exceed the tension */
      hk_sum_add(&sum, (s.tension - s.elastic) * s.rate);
    else
      hk_sum_add(&sum, (t->damping / t->rest[s.altitude.choice] * s.rate) * s.rate);
  }
  return hk_sum_value(&sum);
}

static int32_t change(const hooke_system *system, int64_t number, const struct hk_point *point,
                      struct hk_member_change *out) {
  const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[number];
  struct hk_tautness s;
  struct hk_tautness_change d;
  out->count = 4;
  memcpy(out->particle, t->particle, sizeof t->particle);
  if (!hk_tautness_find(t, point->q, point->v, &s) || s.slack) return 0;
  hk_tautness_differentiate(t, &s, point->q, point->v, point->dq, point->dv, &d);
  for (int j = 0; j < 4; j++) {
    const double g = s.altitude.weight[j];
    for (int a = 0; a < 3; a++)
      out->force[j][a] =
          -((d.tension * g + s.tension * d.weight[j]) * s.altitude.u[a] + s.tension * g * d.u[a]);
  }
  return 1;
}

static void elements(const hooke_system *system, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  for (int64_t k = 0; k < wanted; k++) {
    struct hk_tetrahedron t = system->altitudes->tetrahedron[first + k];
    struct hk_tautness s;
    if (v == NULL) t.pull_only = 0;
    out[k] = (struct hk_element){.count = 4, .over = 1.0};
    memcpy(out[k].particle, t.particle, sizeof t.particle);
    if (q == NULL || !hk_tautness_find(&t, q, v, &s) || s.slack) continue;
    const double rest = t.rest[s.altitude.choice];
    memcpy(out[k].u, s.altitude.u, sizeof s.altitude.u);
    memcpy(out[k].weight, s.altitude.weight, sizeof s.altitude.weight);
    out[k].over = v ? rest : 1.0;
    out[k].k_along = v ? t.stiffness : t.stiffness / rest;
    out[k].c_along = v ? t.damping : t.damping / rest;
    out[k].pull_only = system->altitudes->tetrahedron[first + k].pull_only;
    out[k].elastic = s.elastic;
  }
}

static int32_t damped(const hooke_system *system) {
  return system->altitudes->damped;
}

static double shortest_rest(const struct hk_tetrahedron *t) {
  double least = t->rest[0];
  for (int k = 1; k < HOOKE_ALTITUDES; k++)
    least = fmin(least, t->rest[k]);
  return least;
}

static void add_stiffness(const hooke_system *system, double *sum) {
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[k];
    *sum += 4.0 * (t->stiffness / shortest_rest(t));
  }
}

/* ---- from groups ---- */

static int32_t commit(hooke_system *system, const struct hk_group *group, int64_t count) {
  struct hk_altitudes *altitudes = system->altitudes;
  *altitudes = (struct hk_altitudes){
      .tetrahedron = hk_new(hk_force_count(system, &hk_force_altitude), sizeof *altitudes->tetrahedron)};
  if (altitudes->tetrahedron == NULL) return HOOKE_NO_MEMORY;
  for (; count > 0; group++, count--) {
    altitudes->damped |= group->damped;
    for (int64_t k = 0; k < group->count; k++) {
      struct hk_tetrahedron *t = &altitudes->tetrahedron[altitudes->count++];
      const double *rest = group->number[HOOKE_REST_LENGTH] + HOOKE_ALTITUDES * k;
      *t = (struct hk_tetrahedron){.choice = HOOKE_ALTITUDE_SHORTEST,
                                   .pull_only = group->pull_only,
                                   .side = signbit(rest[0]) ? -1.0 : 1.0,
                                   .stiffness = group->number[HOOKE_KAPPA][k],
                                   .damping = group->number[HOOKE_GAMMA][k]};
      for (int e = 0; e < 4; e++)
        t->particle[e] = group->particle[e][k];
      for (int a = 0; a < HOOKE_ALTITUDES; a++)
        t->rest[a] = fabs(rest[a]);
    }
  }
  return HOOKE_OK;
}

static void release(hooke_system *system) {
  hk_free(system->altitudes->tetrahedron);
  *system->altitudes = (struct hk_altitudes){0};
}

static int64_t memory(const hooke_system *system) {
  return system->altitudes->count * (int64_t)sizeof(struct hk_tetrahedron);
}

static void check(const hooke_system *system, uint32_t *value) {
  hk_check_whole(value, system->altitudes->count);
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[k];
    hk_check_add(value, t->particle, 4, sizeof *t->particle);
    hk_check_whole(value, t->choice);
    hk_check_whole(value, t->pull_only);
    hk_check_add(value, &t->side, 1, sizeof(double));
    hk_check_add(value, &t->stiffness, 1, sizeof(double));
    hk_check_add(value, &t->damping, 1, sizeof(double));
    hk_check_add(value, t->rest, HOOKE_ALTITUDES, sizeof(double));
  }
}

static void recall(const hooke_system *system, int64_t first, struct hk_group *to) {
  for (int64_t k = 0; k < to->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[first + k];
    for (int e = 0; e < 4; e++)
      to->particle[e][k] = t->particle[e];
    to->number[HOOKE_KAPPA][k] = t->stiffness;
    to->number[HOOKE_GAMMA][k] = t->damping;
    for (int a = 0; a < HOOKE_ALTITUDES; a++)
      to->number[HOOKE_REST_LENGTH][HOOKE_ALTITUDES * k + a] = t->side * t->rest[a];
  }
}

const struct hk_force_row hk_force_altitude = {.name = "altitude",
                                               .kind = HOOKE_KEPT,
                                               .title = "altitude springs",
                                               .members = "tetrahedra",
                                               .options = &hk_altitude_options,
                                               .member = "tetrahedron",
                                               .place = "tetrahedra",
                                               .width = {1, 1, HOOKE_ALTITUDES},
                                               .member_particles = 4,
                                               .recall = recall,
                                               .commit = commit,
                                               .release = release,
                                               .memory = memory,
                                               .check = check,
                                               .bytes = 170.0,
                                               .add = add,
                                               .energy = energy,
                                               .heat = heat,
                                               .change = change,
                                               .elements = elements,
                                               .add_stiffness = add_stiffness,
                                               .damped = damped};
