#include "measure/limit/limit_participation.h"

#include "core/memory.h"
#include "core/status.h"
#include "measure/spectrum/naming.h"
#include "measure/spectrum/rigid.h"
#include "model/force/spring.h"
#include "model/group.h"
#include "model/system.h"

#include <stddef.h>
#include <string.h>

/* Inserts an element into a list of at most HOOKE_MOST_LIMITING, the largest share first and equal ones in
 * the order of arrival. `share_at` is the offset of an element's share. */
static void keep(void *list, int64_t *count, size_t size, size_t share_at, const void *element) {
  unsigned char *place = list;
  double share, other;
  memcpy(&share, (const unsigned char *)element + share_at, sizeof share);
  if (!(share > 0.0)) return;
  int64_t k = *count;
  for (; k > 0; k--) {
    memcpy(&other, place + (size_t)(k - 1) * size + share_at, sizeof other);
    if (other >= share) break;
    if (k < HOOKE_MOST_LIMITING) memcpy(place + (size_t)k * size, place + (size_t)(k - 1) * size, size);
  }
  if (k == HOOKE_MOST_LIMITING) return;
  memcpy(place + (size_t)k * size, element, size);
  if (*count < HOOKE_MOST_LIMITING) ++*count;
}

static double square_of(const double *x) {
  return (x[0] * x[0] + x[1] * x[1]) + x[2] * x[2];
}

/* The total that shares of elements refer to, and its part of K; and that of particles. */
struct whole {
  double all, stiffness, kinetic;
};

/* Weights of K and of C. */
struct weights {
  double k, c;
};

static void add_element(const struct hk_elements *at, const struct hk_element *e, int64_t group,
                        const double *mode, struct weights h, struct whole *whole,
                        struct hk_participation *participation) {
  const double *const x[3] = {mode, mode + 1, mode + 2};
  const double stiffness = h.k * hk_element_energy(e, e->k_along, hk_element_across(e), 3, x);
  const double damping = h.c * hk_element_energy(e, e->c_along, e->c_across, 3, x);
  const int32_t force = hk_force_number(at->force);
  whole->all += stiffness + damping;
  whole->stiffness += stiffness;
  participation->force_share[force] += stiffness;
  const int own = group < 0 || at->force->is_drag;
  participation->force_share[own ? force : HOOKE_PARTICIPATION_DAMPING] += damping;
  if (group >= 0) participation->group_share[group] += stiffness + damping;
  if (group >= 0 && stiffness + damping > participation->heaviest.share)
    participation->heaviest = (struct hk_limiting_element){force, hk_element_number(at), stiffness + damping};
  const struct hk_limiting spring = {.spring = hk_element_number(at),
                                     .first = e->particle[0],
                                     .second = e->particle[1],
                                     .share = stiffness + damping,
                                     .stiffness_share = stiffness,
                                     .group =
                                         group < 0 ? "" : hk_participation_group_name(at->system, group)};
  if (at->force->kind & HOOKE_LOOPED)
    keep(participation->spring, &participation->spring_count, sizeof spring,
         offsetof(struct hk_limiting, share), &spring);
}

/* Shares of the elements at q; the mode is 0 at constrained particles. */
static void find_elements(const hooke_system *system, const double *q, const double *v, const double *mode,
                          struct weights h, struct whole *whole, struct hk_participation *participation) {
  struct hk_member_walk at;
  hk_begin_members(system, system->moment, q, NULL, &at);
  at.elements.flow = v;
  for (const struct hk_element *e; (e = hk_next_member(&at)) != NULL;)
    add_element(&at.elements, e, at.group, mode, h, whole, participation);
}

/* Gravity and tensions, which turn bodies. */
static int32_t find_geometric(const hooke_system *system, const double *q, const double *mode,
                              struct weights h, struct whole *whole, struct hk_participation *participation) {
  const double *const x[3] = {mode, mode + 1, mode + 2};
  struct hk_rigid rigid;
  const int32_t status = hk_rigid_create(system, q, NULL, &rigid);
  if (status != HOOKE_OK) return status;
  const double stiffness = h.k * hk_rigid_energy(&rigid, x, 3);
  whole->all += stiffness;
  whole->stiffness += stiffness;
  participation->force_share[HOOKE_PARTICIPATION_GEOMETRIC] += stiffness;
  hk_rigid_release(&rigid);
  return HOOKE_OK;
}

static void find_particles(const hooke_system *system, const double *mode, struct whole *whole,
                           struct hk_participation *participation) {
  for (int64_t p = 0; p < system->particle_count; p++) {
    const struct hk_limiting_particle particle = {p, system->inertia[p] * square_of(mode + 3 * p),
                                                  system->inertia[p]};
    if (system->constrained[p]) continue;
    whole->kinetic += particle.share;
    keep(participation->particle, &participation->particle_count, sizeof particle,
         offsetof(struct hk_limiting_particle, share), &particle);
  }
}

static void divide(struct hk_participation *participation, const struct whole *whole) {
  for (int64_t k = 0; k < participation->spring_count; k++) {
    participation->spring[k].share /= whole->all;
    participation->spring[k].stiffness_share /= whole->all;
  }
  if (whole->all > 0.0) participation->heaviest.share /= whole->all;
  for (int64_t k = 0; k < participation->particle_count; k++)
    participation->particle[k].share /= whole->kinetic;
  for (int64_t k = 0; k < participation->group_count && whole->all > 0.0; k++)
    participation->group_share[k] /= whole->all;
  for (int k = 0; k < HOOKE_PARTICIPATION_SHARES && whole->all > 0.0; k++)
    participation->force_share[k] /= whole->all;
  participation->stiffness_share = whole->all > 0.0 ? whole->stiffness / whole->all : 0.0;
}

int32_t hk_participation_find(const hooke_system *system, const double *q, const double *v,
                              const double *mode, double h2, double h,
                              struct hk_participation *participation) {
  struct whole whole = {0.0, 0.0, 0.0};
  *participation = (struct hk_participation){.group_share = hk_new(system->group_count, sizeof(double))};
  if (participation->group_share == NULL) return HOOKE_NO_MEMORY;
  participation->group_count = system->group_count;
  if (mode == NULL) return HOOKE_OK;
  double *moves = hk_new(3 * system->particle_count, sizeof(double));
  if (moves == NULL) {
    hk_participation_release(participation);
    return HOOKE_NO_MEMORY;
  }
  for (int64_t k = 0; k < 3 * system->particle_count; k++)
    moves[k] = system->constrained[k / 3] ? 0.0 : mode[k];
  const struct weights weights = {h2, 2.0 * h};
  find_elements(system, q, v, moves, weights, &whole, participation);
  const int32_t status = find_geometric(system, q, moves, weights, &whole, participation);
  find_particles(system, moves, &whole, participation);
  divide(participation, &whole);
  hk_free(moves);
  if (status != HOOKE_OK) hk_participation_release(participation);
  return status;
}

int64_t hk_participation_group(const struct hk_participation *participation) {
  int64_t best = -1;
  for (int64_t g = 0; g < participation->group_count; g++) {
    if (participation->group_share[g] > (best < 0 ? 0.0 : participation->group_share[best])) best = g;
  }
  return best;
}

const char *hk_participation_group_name(const hooke_system *system, int64_t group) {
  return system->group[group].name ? system->group[group].name : "";
}

static int32_t is_of(int32_t force, int32_t kinds) {
  const struct hk_force_row *row = hk_force_table(force);
  return row && row->kind & kinds;
}

int32_t hk_participation_force(const struct hk_participation *participation) {
  for (int32_t k = 0; k < HOOKE_PARTICIPATION_SHARES; k++) {
    if (participation->force_share[k] >= 0.5 && !is_of(k, HOOKE_LOOPED)) return k;
  }
  return -1;
}

int32_t hk_participation_is_drag(int32_t force) {
  return hk_force_table(force) && hk_force_table(force)->is_drag;
}

static const char *force_name(int32_t force) {
  if (force == HOOKE_PARTICIPATION_GEOMETRIC) return "geometric";
  return force == HOOKE_PARTICIPATION_DAMPING ? "damping" : hk_force_table(force)->name;
}

void hk_limiting_add(const hooke_system *system, int64_t spring, double share,
                     struct hk_limiting_list *list) {
  if (spring < 0 || list->count > HOOKE_MOST_LIMITING) return;
  const struct hk_spring found = hk_springs_find(system->springs, spring, system->moment);
  list->row[list->count++] =
      (struct hk_limiting){.spring = spring,
                           .first = found.head,
                           .second = found.tail,
                           .share = share,
                           .group = hk_naming_group(system, &hk_force_springs, spring)};
}

void hk_limiting_take(const struct hk_participation *participation, struct hk_limiting_list *list) {
  const int32_t force = hk_participation_force(participation);
  list->count = force >= 0;
  if (force >= 0)
    list->row[0] = (struct hk_limiting){.spring = -1,
                                        .first = -1,
                                        .second = -1,
                                        .share = participation->force_share[force],
                                        .group = "",
                                        .force = force_name(force)};
  for (int64_t k = 0; k < participation->spring_count; k++)
    list->row[list->count++] = participation->spring[k];
}

void hk_participation_release(struct hk_participation *participation) {
  hk_free(participation->group_share);
  memset(participation, 0, sizeof *participation);
}
