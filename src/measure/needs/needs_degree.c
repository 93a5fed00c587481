/* By degree: how soft, heavy or little damped something may be before the wanted error is exceeded. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "core/utf8.h"
#include "model/force/spring.h"
#include "model/medium.h"

#include <math.h>
#include <string.h>

static const double MOST = 1e9;  /* largest factor tried */
static const double LEAST = 1.1; /* smallest factor tried, and the first: none of the others holds without */
static const double RATIO = 1.2; /* of the first factor that is too much to the one offered */
static const double BELOW_LIMIT = 0.9; /* step of a trial that is not stable at that of the full system */
static const double LIGHT = 0.1; /* of the mean mass: particles below it are asked how heavy they may be */
static const double STIFF = 4.0; /* of the mean of its group: springs above it are asked one by one */
static const double MOST_STEPS = 2.0; /* of a trial, of those of the full run */
/* Particles; springs; work of all trials, of that of the full run. */
enum { MOST_LIGHT = 8, MOST_SINGLE = 8, MOST_WORK = 40 };

/* ---- what is asked ---- */

/* As before it is tried. */
static void forget(struct hk_needs_degree *degree) {
  degree->factor = degree->error = degree->beyond = degree->error_beyond = NAN;
  degree->step_limit = degree->work = NAN;
  degree->lean_factor = 1.0;
  degree->tried = degree->displaced = 0;
}

static int32_t add(struct hk_needs *needs, enum hk_needs_property property, int64_t number, int32_t up,
                   const char *name, const char *key) {
  const int32_t status = hk_room((void **)&needs->degree, needs->degree_count, sizeof *needs->degree);
  if (status != HOOKE_OK) return status;
  struct hk_needs_degree *degree = &needs->degree[needs->degree_count++];
  *degree = (struct hk_needs_degree){.property = property, .number = number, .up = up};
  forget(degree);
  hk_print(degree->name, sizeof degree->name, "%s", name);
  hk_utf8_make_plain(degree->name);
  hk_print(degree->quantity, sizeof degree->quantity, "%s%s%s", degree->name, key[0] ? "." : "", key);
  return HOOKE_OK;
}

/* 1 if a row leaves out the whole ingredient, and nobody needs it. */
static int32_t is_unneeded(const struct hk_needs *needs, const char *kind, int64_t group) {
  for (int64_t k = 0; k < needs->row_count; k++) {
    const struct hk_needs_row *row = &needs->row[k];
    if (row->needed == 0.0 &&
        (group < 0 ? strcmp(row->kind, kind) == 0 : hk_needs_drops(needs, &row->variant, group)))
      return 1;
  }
  return 0;
}

/* 1 if two groups have their numbers from the same options. */
static int32_t is_alike(const struct hk_group *a, const struct hk_group *b) {
  return a == b || (a->from_part && b->from_part && a->part == b->part && a->force == b->force &&
                    strcmp(a->name, b->name) == 0);
}

static int32_t is_first(const hooke_system *system, int64_t g) {
  int64_t first = 0;
  while (!is_alike(&system->group[first], &system->group[g]))
    first++;
  return first == g;
}

static int32_t is_scalable(const struct hk_group *group) {
  return group->count > 0 && group->force->width[HOOKE_KAPPA] > 0 &&
         !(group->from_part && group->force == &hk_force_anchor);
}

static void name_group(const struct hk_needs *needs, int64_t g, char name[HOOKE_NEEDS_NAME]) {
  const struct hk_group *group = &needs->m->system->group[g];
  if (group->name[0])
    hk_print(name, HOOKE_NEEDS_NAME, "%s", group->name);
  else
    hk_print(name, HOOKE_NEEDS_NAME, "%s[%lld]", group->force->name,
             (long long)(g - hk_system_first_group(needs->m->system, group->force)));
}

static int32_t add_group(struct hk_needs *needs, int64_t g, int32_t damping) {
  const struct hk_group *group = &needs->m->system->group[g];
  char name[HOOKE_NEEDS_NAME];
  name_group(needs, g, name);
  int32_t status = HOOKE_OK;
  if (!damping) return add(needs, HOOKE_NEEDS_STIFFNESS, g, 0, name, "stiffness");
  for (int up = is_unneeded(needs, "damping", -1); up < 2 && group->damped && status == HOOKE_OK; up++)
    status = add(needs, HOOKE_NEEDS_DAMPING, g, up, name, "damping");
  return status;
}

static double kappa_of(const struct hk_needs *needs, int64_t spring) {
  return hk_springs_find(needs->m->system->springs, spring, HOOKE_AS_GIVEN).kappa;
}

/* Of one single more than are asked; of equals the last. */
static void drop_softest(struct hk_needs *needs) {
  int64_t last = --needs->degree_count, softest = last;
  for (int64_t k = last - 1; k >= last - MOST_SINGLE; k--)
    if (kappa_of(needs, needs->degree[k].number) < kappa_of(needs, needs->degree[softest].number))
      softest = k;
  memmove(&needs->degree[softest], &needs->degree[softest + 1],
          (size_t)(last - softest) * sizeof *needs->degree);
}

/* Springs that are far stiffer than the others of their group, one by one, where no part adds it. */
static int32_t add_singles(struct hk_needs *needs) {
  const hooke_system *system = needs->m->system;
  int32_t status = HOOKE_OK;
  int64_t first = 0, found = 0;
  for (int64_t g = 0; g < hk_system_groups_of(system, &hk_force_springs); first += system->group[g++].count) {
    const struct hk_group *group = &system->group[g];
    if (group->from_part || group->curve || needs->kept[g] || is_unneeded(needs, "", g)) continue;
    const double stiff = STIFF * hk_springs_mean(system->springs, first, group->count, HOOKE_AS_GIVEN);
    for (int64_t s = first; s < first + group->count && status == HOOKE_OK; s++) {
      char name[HOOKE_NEEDS_NAME];
      if (!(kappa_of(needs, s) > stiff)) continue;
      name_group(needs, g, name);
      hk_append(name, sizeof name, ":%lld", (long long)(s - first));
      status = add(needs, HOOKE_NEEDS_SINGLE, s, 0, name, "stiffness");
      if (status == HOOKE_OK) needs->degree[needs->degree_count - 1].group = g;
      if (status == HOOKE_OK && ++found > MOST_SINGLE) drop_softest(needs);
    }
  }
  return status;
}

/* The lightest ones of no part and no body. */
static int32_t add_masses(struct hk_needs *needs) {
  const hooke_system *system = needs->m->system;
  double sum = 0.0;
  int64_t count = 0, found = 0;
  for (int64_t p = 0; p < system->particle_count; p++)
    if (!system->constrained[p]) sum += log(system->mass[p]), count++;
  uint8_t *in_part = hk_new(system->particle_count, 1);
  int32_t status = in_part ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < system->part_count && in_part; k++)
    memset(in_part + system->part[k].first, 1, (size_t)system->part[k].count);
  for (int64_t p = 0; p < system->particle_count && status == HOOKE_OK && found < MOST_LIGHT; p++) {
    char name[32];
    if (in_part[p] || system->constrained[p] || hk_is_carried(system, p)) continue;
    if (!(system->mass[p] < LIGHT * exp(sum / (double)count))) continue;
    found++;
    hk_print(name, sizeof name, "%lld", (long long)p);
    status = add(needs, HOOKE_NEEDS_MASS, p, 1, name, "mass");
  }
  hk_free(in_part);
  return status;
}

static int32_t list(struct hk_needs *needs) {
  const hooke_system *system = needs->m->system;
  int32_t status = HOOKE_OK;
  if (!system->overdamped) status = add_masses(needs);
  if (status == HOOKE_OK) status = add_singles(needs);
  for (int64_t k = 0; k < 2 * system->group_count && status == HOOKE_OK; k++) {
    const int64_t g = k % system->group_count;
    if (!needs->kept[g] && is_scalable(&system->group[g]) && is_first(system, g) &&
        !is_unneeded(needs, "", g))
      status = add_group(needs, g, k >= system->group_count);
  }
  const int32_t brakes = system->medium->drag.most > 0.0 && !system->overdamped;
  for (int up = is_unneeded(needs, "drag", -1); up < 2 && brakes && status == HOOKE_OK; up++)
    status = add(needs, HOOKE_NEEDS_DRAG, 0, up, "drag", "");
  return status;
}

void hk_needs_scale(const struct hk_needs *needs, const struct hk_needs_degree *degree, double factor,
                    struct hk_variant *variant) {
  const hooke_system *system = needs->m->system;
  if (degree->property == HOOKE_NEEDS_SINGLE) variant->single[HOOKE_KAPPA][degree->number] *= factor;
  const int what = degree->property == HOOKE_NEEDS_STIFFNESS ? HOOKE_KAPPA : HOOKE_GAMMA;
  if (degree->property == HOOKE_NEEDS_DRAG) variant->drag *= factor;
  if (degree->property == HOOKE_NEEDS_MASS) variant->mass[degree->number] *= factor;
  if (degree->property != HOOKE_NEEDS_STIFFNESS && degree->property != HOOKE_NEEDS_DAMPING) return;
  for (int64_t g = 0; g < system->group_count; g++)
    if (is_alike(&system->group[g], &system->group[degree->number])) variant->factor[what][g] *= factor;
}

/* ---- trials ---- */

int32_t hk_needs_try(struct hk_needs *needs, const struct hk_variant *variant, int32_t displaced,
                     double *error, double *limit) {
  struct hk_needs_cost cost = needs->full;
  struct hk_variant_map map;
  hooke_system *made = NULL;
  *error = INFINITY;
  int32_t status = hk_variant_make(needs->m->system, variant, &made, &map);
  if (status == HOOKE_BAD_VALUE || status == HOOKE_UNSUITED) return HOOKE_OK;
  if (status != HOOKE_OK) return status;
  const struct hk_needs_trial trial = {made, &map};
  if (limit) cost.step_limit = *limit = hk_needs_step_limit(needs, made);
  if (limit && cost.step > BELOW_LIMIT * *limit)
    cost.step = needs->unit / ceil(needs->unit / (BELOW_LIMIT * *limit));
  if (cost.step * MOST_STEPS < needs->full.step)
    *error = NAN;
  else
    status = hk_needs_compare(needs, &trial, &cost, displaced, error);
  hk_variant_map_release(&map);
  hooke_system_destroy(made);
  return status;
}

static int32_t try_factor(struct hk_needs *needs, const struct hk_needs_degree *degree, double factor,
                          double *error, double *limit) {
  struct hk_variant variant;
  int32_t status = hk_variant_create(needs->m->system, &variant);
  if (status != HOOKE_OK) return status;
  hk_needs_scale(needs, degree, factor, &variant);
  status = hk_needs_try(needs, &variant, degree->displaced, error, limit);
  hk_variant_release(&variant);
  return status;
}

/* `holds`: 1, 0, or -1 where it was not run. */
static int32_t take_rung(struct hk_needs *needs, struct hk_needs_degree *degree, double times,
                         int32_t *holds) {
  const int32_t relieves = degree->property <= HOOKE_NEEDS_STIFFNESS || degree->property == HOOKE_NEEDS_MASS;
  const double factor = degree->up ? times : 1.0 / times;
  double error = NAN, limit;
  const int32_t status = try_factor(needs, degree, factor, &error, relieves ? NULL : &limit);
  *holds = isnan(error) ? -1 : error <= needs->want;
  if (*holds == 1) {
    degree->factor = factor;
    degree->error = error;
  } else if (*holds == 0) {
    degree->beyond = factor;
    degree->error_beyond = isfinite(error) ? error : (double)NAN;
  }
  return status;
}

double hk_needs_rung(int32_t k) {
  static const double first[] = {1.0, 2.0, 5.0};
  return first[k % 3] * pow(10.0, k / 3);
}

/* Two digits between two numbers. */
static double between(double low, double high) {
  const double middle = sqrt(low * high), unit = pow(10.0, floor(log10(middle)) - 1.0);
  return round(middle / unit) * unit;
}

static int32_t climb(struct hk_needs *needs, struct hk_needs_degree *degree) {
  const int32_t may_vanish = !degree->up && degree->property > HOOKE_NEEDS_STIFFNESS;
  double good = 1.0, bad = INFINITY;
  int32_t holds;
  degree->factor = 1.0;
  degree->error = 0.0;
  int32_t status = take_rung(needs, degree, LEAST, &holds);
  if (holds != 1) return status;
  if (may_vanish) status = take_rung(needs, degree, INFINITY, &holds);
  if (may_vanish && holds == 1) return status;
  for (int32_t k = 1; status == HOOKE_OK; k++) {
    const double next = isinf(bad) ? hk_needs_rung(k) : between(good, bad);
    if (isinf(bad) ? good >= MOST : bad / good <= RATIO || next <= fmax(good, LEAST) || next >= bad) break;
    status = take_rung(needs, degree, next, &holds);
    if (holds < 0) break;
    *(holds ? &good : &bad) = next;
  }
  return status;
}

/* The factor that holds from the exact start has to hold from a displaced one, which excites all that it
 * holds. */
static int32_t run_degree(struct hk_needs *needs, int64_t number) {
  struct hk_needs_degree *degree = &needs->degree[number];
  double error = 0.0;
  hk_needs_name(needs, degree->quantity);
  int32_t status = climb(needs, degree);
  for (degree->displaced = 1; degree->factor != 1.0 && status == HOOKE_OK;) {
    status = try_factor(needs, degree, degree->factor, &error, &degree->step_limit);
    if (status != HOOKE_OK || error <= needs->want) break;
    status = climb(needs, degree);
  }
  if (degree->factor == 1.0) degree->step_limit = needs->full.step_limit;
  degree->work = needs->full.unlimited != 0.0 ? 1.0 : needs->full.step_limit / degree->step_limit;
  degree->tried = status == HOOKE_OK;
  return status;
}

int32_t hk_needs_run_degrees(struct hk_needs *needs) {
  if (hk_needs_rests(needs)) return HOOKE_OK;
  int32_t status = list(needs);
  const double most = MOST_WORK * needs->full.work;
  const int64_t threads = (int64_t)hooke_options_number(needs->m->run, "threads"), all = needs->degree_count;
  int64_t counted = 0;
  if (status == HOOKE_OK && all > 0) status = hk_needs_prepare(needs, 0);
  if (status == HOOKE_OK && all > 0) status = hk_needs_prepare(needs, 1);
  for (int64_t k = 0, some; k < all && status == HOOKE_OK && needs->trial_work < most; k += some) {
    some = threads < all - k ? threads : all - k;
    hk_stage_begin(&needs->stage, "numbers that are changed", 0.5 + 0.3 * (double)(k + some) / (double)all);
    status = hk_needs_run_pieces(needs, k, some, run_degree, most, &counted);
    for (int64_t j = k + counted; j < k + some; j++)
      forget(&needs->degree[j]);
  }
  return status;
}

int64_t hk_needs_next_changed(const struct hk_needs *needs, int64_t k) {
  while (k < needs->degree_count && needs->degree[k].lean_factor == 1.0)
    k++;
  return k;
}
