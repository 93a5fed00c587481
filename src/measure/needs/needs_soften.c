/* The lean system, softened: what has most of the mode that limits the step is changed rung by rung, as long
 * as that saves work within the wanted error. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "measure/limit/limit.h"
#include "model/force/spring.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

static const double EQUAL = 0.5;        /* of the largest share: changed together */
static const double LEAST_SHARE = 0.05; /* of the mode: less would save nothing */
static const double CLEARLY_LESS = 0.9; /* of the work: less is not worth changing anything for */
enum { MOST_RUNGS = 64 };

/* ---- the mode that limits the step ---- */

struct mode {
  const hooke_system *system;
  const struct hk_variant_map *map;
  const struct hk_participation *participation;
};

/* Share of a number in the mode, by names and by ends, since what is left out has moved the numbers of groups
 * and springs. Those of single springs are not of their group. */
static double share_of(const struct hk_needs *needs, const struct hk_needs_degree *degree,
                       const struct mode *mode) {
  const struct hk_participation *all = mode->participation;
  const int32_t damps = degree->property == HOOKE_NEEDS_DAMPING;
  const int64_t *to = mode->map->to;
  double share = 0.0;
  if (degree->property == HOOKE_NEEDS_DRAG) return all->force_share[hk_force_number(&hk_force_drag)];
  if (degree->property == HOOKE_NEEDS_SINGLE) {
    const struct hk_spring own = hk_springs_find(needs->m->system->springs, degree->number, HOOKE_AS_GIVEN);
    for (int64_t k = 0; k < all->spring_count; k++)
      if (all->spring[k].first == to[own.head] && all->spring[k].second == to[own.tail])
        share += all->spring[k].stiffness_share;
    return share;
  }
  for (int64_t k = 0; k < all->particle_count && degree->property == HOOKE_NEEDS_MASS; k++)
    if (all->particle[k].particle == to[degree->number]) share += all->particle[k].share;
  if (degree->property == HOOKE_NEEDS_MASS) return share;
  const struct hk_group *group = &needs->m->system->group[degree->number];
  for (int64_t g = 0; g < all->group_count; g++)
    if (mode->system->group[g].force == group->force &&
        strcmp(hk_participation_group_name(mode->system, g), group->name ? group->name : "") == 0)
      share += all->group_share[g];
  share *= damps ? 1.0 - all->stiffness_share : all->stiffness_share;
  for (int64_t k = 0; k < needs->degree_count && !damps; k++)
    if (needs->degree[k].property == HOOKE_NEEDS_SINGLE && needs->degree[k].group == degree->number)
      share -= share_of(needs, &needs->degree[k], mode);
  return share;
}

static int32_t look(struct hk_needs *needs, const struct mode *seen, double *share) {
  hooke_options *options = NULL;
  hooke_measurement *limit = NULL;
  hooke_state *state = NULL;
  struct mode mode = *seen;
  int32_t status = hk_options_create(hk_limit_kind.options, &options);
  if (status == HOOKE_OK)
    status = hooke_options_set_text(options, "methods", hooke_options_text(needs->m->run, "method"));
  if (status == HOOKE_OK)
    status = hk_measurement_create(&hk_limit_kind, NULL, mode.system, needs->m->run, options, &limit);
  if (status == HOOKE_OK) status = hooke_state_create(mode.system, &state);
  if (status == HOOKE_OK) status = hk_limit_look(limit->object, hooke_state_position(state), NULL, 0.0);
  if (status == HOOKE_OK) {
    mode.participation = &((struct hk_limit *)limit->object)->participation;
    for (int64_t k = 0; k < needs->degree_count; k++)
      share[k] = mode.participation->group_share ? share_of(needs, &needs->degree[k], &mode) : 0.0;
  }
  hooke_state_destroy(state);
  hooke_measurement_destroy(limit);
  hooke_options_destroy(options);
  return status;
}

/* ---- rungs ---- */

/* What the lean system leaves out, with these factors. */
static int32_t combine(const struct hk_needs *needs, const double *factor, struct hk_variant *variant) {
  const int32_t status = hk_variant_create(needs->m->system, variant);
  if (status != HOOKE_OK) return status;
  hk_variant_join(needs->m->system, variant, &needs->unchanged);
  for (int64_t k = 0; k < needs->degree_count; k++)
    if (factor[k] != 1.0) hk_needs_scale(needs, &needs->degree[k], factor[k], variant);
  return HOOKE_OK;
}

/* 1 if the number raises the limit when it is changed in its direction, and may be. */
static int32_t relieves(const struct hk_needs_degree *degree) {
  return degree->tried && degree->factor != 1.0 && (degree->property == HOOKE_NEEDS_MASS) == degree->up;
}

/* The next rung of a ladder, which ends at the factor that holds alone. */
static double next_factor(const struct hk_needs_degree *degree, double factor) {
  const double now = degree->up ? factor : 1.0 / factor,
               most = degree->up ? degree->factor : 1.0 / degree->factor;
  int32_t k = 1;
  while (hk_needs_rung(k) <= now * (1.0 + 1e-9))
    k++;
  const double times = fmin(hk_needs_rung(k), most);
  return degree->up ? times : 1.0 / times;
}

/* Moves the largest of all shares, and those that equal it, by a rung; 0 if it may not be moved. */
static int32_t advance(const struct hk_needs *needs, const double *share, const double *from, double *to) {
  double most = LEAST_SHARE;
  int32_t moved = 0;
  for (int64_t k = 0; k < needs->degree_count; k++)
    most = fmax(most, share[k]);
  for (int64_t k = 0; k < needs->degree_count; k++) {
    const struct hk_needs_degree *degree = &needs->degree[k];
    to[k] = from[k];
    if (share[k] < EQUAL * most || !relieves(degree)) continue;
    to[k] = next_factor(degree, from[k]);
    moved |= to[k] != from[k];
  }
  return moved;
}

static int32_t find_shares(struct hk_needs *needs, const double *factor, double *share) {
  struct hk_variant variant;
  struct hk_variant_map map;
  hooke_system *made = NULL;
  int32_t status = combine(needs, factor, &variant);
  if (status != HOOKE_OK) return status;
  status = hk_variant_make(needs->m->system, &variant, &made, &map);
  hk_variant_release(&variant);
  if (status != HOOKE_OK) return status;
  status = look(needs, &(struct mode){.system = made, .map = &map}, share);
  hk_variant_map_release(&map);
  hooke_system_destroy(made);
  return status;
}

/* Rows of factors, by degree, each within the wanted error by the step of the full system. */
static int32_t find_rungs(struct hk_needs *needs, double *row, double *share, int64_t *rungs) {
  const int64_t size = needs->degree_count;
  double error = 0.0;
  int32_t status = HOOKE_OK;
  for (*rungs = 0; *rungs + 1 < MOST_RUNGS; ++*rungs) {
    double *at = row + *rungs * size;
    struct hk_variant variant;
    status = find_shares(needs, at, share);
    if (status != HOOKE_OK || !advance(needs, share, at, at + size)) break;
    status = combine(needs, at + size, &variant);
    if (status != HOOKE_OK) break;
    status = hk_needs_try(needs, &variant, 0, &error, NULL);
    hk_variant_release(&variant);
    if (status != HOOKE_OK || !(error <= needs->want)) break;
  }
  return status;
}

/* ---- the run that is cheapest ---- */

/* Takes the system with these factors if its recommended run is cheaper than that of the lean one by `share`.
 */
static int32_t take_if_cheaper(struct hk_needs *needs, const double *factor, double share, int32_t *taken) {
  struct hk_needs_lean candidate = {.system = NULL};
  int32_t status = combine(needs, factor, &candidate.variant);
  if (status == HOOKE_OK) status = hk_needs_try_lean(needs, &candidate);
  *taken = status == HOOKE_OK && candidate.error <= needs->want &&
           hk_needs_work(&candidate.cost) <= share * hk_needs_work(&needs->lean.cost);
  if (*taken) {
    for (int64_t k = 0; k < needs->degree_count; k++)
      needs->degree[k].lean_factor = factor[k];
    status = hk_needs_take(needs, &candidate);
  }
  hk_needs_release(&candidate);
  return status;
}

/* From the last rung down, to the first that is no cheaper than the one taken: errors of the step share the
 * wanted error with those of the change. */
static int32_t take_rung(struct hk_needs *needs, const double *row, int64_t rungs) {
  int32_t status = HOOKE_OK, taken = 0, before = 0;
  for (int64_t k = rungs; k > 0 && status == HOOKE_OK; k--) {
    status = take_if_cheaper(needs, row + k * needs->degree_count, before ? 1.0 : CLEARLY_LESS, &taken);
    if (before && !taken) break;
    before |= taken;
  }
  return status;
}

static int32_t put_back(struct hk_needs *needs, double *factor) {
  int32_t status = HOOKE_OK, taken;
  for (int64_t k = 0; k < needs->degree_count && status == HOOKE_OK; k++) {
    int64_t others = 0;
    for (int64_t j = 0; j < needs->degree_count; j++) {
      factor[j] = j == k ? 1.0 : needs->degree[j].lean_factor;
      others += factor[j] != 1.0;
    }
    if (needs->degree[k].lean_factor != 1.0 && others > 0)
      status = take_if_cheaper(needs, factor, 1.0, &taken);
  }
  return status;
}

int32_t hk_needs_soften(struct hk_needs *needs) {
  const int64_t size = needs->degree_count;
  int64_t rungs = 0;
  /* implicit and error-controlled methods have no limit that could be raised */
  if (size == 0 || !(needs->full.step > 0.0) || !isfinite(needs->lean.cost.step_limit) ||
      isnan(needs->lean.error) || !HOOKE_HAVE_LAPACK)
    return HOOKE_OK;
  int32_t status = hk_variant_create(needs->m->system, &needs->unchanged);
  double *row = hk_new(size * (MOST_RUNGS + 1), sizeof *row), *share = hk_new(size, sizeof *share);
  if (status == HOOKE_OK && !(row && share)) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    hk_variant_join(needs->m->system, &needs->unchanged, &needs->lean.variant);
    for (int64_t k = 0; k < size; k++)
      row[k] = 1.0;
    status = find_rungs(needs, row, share, &rungs);
  }
  if (status == HOOKE_OK) status = take_rung(needs, row, rungs);
  if (status == HOOKE_OK) status = put_back(needs, row);
  hk_variant_release(&needs->unchanged);
  hk_free(row);
  hk_free(share);
  return status == HOOKE_UNSUITED || status == HOOKE_NOT_BUILT || status == HOOKE_SOLVER_FAILED ? HOOKE_OK
                                                                                                : status;
}
