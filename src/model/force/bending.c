/* Groups of triples: their checks, and the questions to them. */
#include "model/force/bending.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double hk_triple_row(const hooke_system *system, const struct hk_triple *triple, int e) {
  double sum = 0.0;
  for (int k = 0; k < 3; k++)
    sum += system->held[triple->particle[k]] ? 0.0 : fabs(hk_triple_factor(k));
  return fabs(hk_triple_factor(e)) * sum;
}

void hk_bending_add(const struct hk_bending *bending, double factor, const double *const x[3],
                    double *const f[3]) {
  for (int64_t k = 0; k < bending->run_count; k++)
    bending->run[k].loop(&bending->run[k], factor, x, f);
}

void hk_bending_group_release(struct hk_bending_group *group) {
  hk_free(group->name);
  for (int e = 0; e < 3; e++)
    hk_free(group->particle[e]);
  hk_free(group->coefficient);
  memset(group, 0, sizeof *group);
}

void hk_bending_group_strip(struct hk_bending_group *group) {
  struct hk_bending_group kept = {.name = group->name, .from_part = group->from_part, .part = group->part};
  for (int64_t k = 0; k < group->count; k++)
    kept.count += group->coefficient[k] != 0.0;
  group->name = NULL;
  hk_bending_group_release(group);
  *group = kept;
}

/* ---- adding a group ---- */

static int32_t check_triples(const hooke_system *system, int64_t count, const int64_t *triples) {
  if (count < 0) {
    return hk_fail(HOOKE_BAD_VALUE, "triples", "%lld triples; 0 or more are allowed", (long long)count);
  }
  const int32_t status = hk_system_check_room(system, (struct hk_more){.triples = (double)count}, NULL);
  if (status != HOOKE_OK) return hk_fail_within(status, "triples");
  for (int64_t k = 0; k < count; k++) {
    const int64_t *t = triples + 3 * k;
    for (int e = 0; e < 3; e++) {
      if (t[e] >= 0 && t[e] < system->particle_count) continue;
      hk_fail(HOOKE_BAD_VALUE, NULL, "there is no particle %lld; allowed: 0 to %lld", (long long)t[e],
              (long long)(system->particle_count - 1));
      return hk_fail_within(HOOKE_BAD_VALUE, "triples[%lld][%d]", (long long)k, e);
    }
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "particles %lld, %lld and %lld; a triple has three different ones",
            (long long)t[0], (long long)t[1], (long long)t[2]);
    return hk_fail_within(HOOKE_BAD_VALUE, "triples[%lld]", (long long)k);
  }
  return HOOKE_OK;
}

static int32_t check_coefficients(int64_t count, int64_t coefficient_count, const double *coefficient) {
  if (coefficient_count != 1 && coefficient_count != count) {
    return hk_fail(HOOKE_BAD_VALUE, "coefficient",
                   "%lld values for %lld triples; allowed: one, or one for each",
                   (long long)coefficient_count, (long long)count);
  }
  for (int64_t k = 0; k < coefficient_count; k++) {
    if (coefficient[k] >= 0.0 && coefficient[k] <= 1e300) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; a number from 0 to 1e300 (N/m) is", coefficient[k]);
    return coefficient_count == 1 ? hk_fail_within(HOOKE_BAD_VALUE, "coefficient")
                                  : hk_fail_within(HOOKE_BAD_VALUE, "coefficient[%lld]", (long long)k);
  }
  return HOOKE_OK;
}

static int32_t fill_group(const char *name, const int64_t *triples, int64_t coefficient_count,
                          const double *coefficient, struct hk_bending_group *group) {
  int there = (group->name = hk_copy_text(name)) != NULL;
  for (int e = 0; e < 3; e++)
    there &= (group->particle[e] = hk_new(group->count, sizeof(int32_t))) != NULL;
  there &= (group->coefficient = hk_new(group->count, sizeof(double))) != NULL;
  if (!there) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < group->count; k++) {
    for (int e = 0; e < 3; e++)
      group->particle[e][k] = (int32_t)triples[3 * k + e];
    group->coefficient[k] = coefficient[coefficient_count == 1 ? 0 : k];
  }
  return HOOKE_OK;
}

/* Room for one more, before the groups of parts unless it is of one. */
static int32_t open_place(hooke_system *system, int32_t from_part, int64_t *place) {
  const int64_t count = system->bending_group_count, capacity = 2 * system->bending_group_capacity + 4;
  if (count == system->bending_group_capacity) {
    const int32_t status =
        hk_grow((void **)&system->bending_group, count, capacity, sizeof *system->bending_group);
    if (status != HOOKE_OK) return status;
    system->bending_group_capacity = capacity;
  }
  *place = count;
  while (!from_part && *place > 0 && system->bending_group[*place - 1].from_part)
    --*place;
  memmove(system->bending_group + *place + 1, system->bending_group + *place,
          (size_t)(count - *place) * sizeof *system->bending_group);
  system->bending_group_count++;
  return HOOKE_OK;
}

static int32_t add_group(hooke_system *system, const char *name, int64_t count, const int64_t *triples,
                         int64_t coefficient_count, const double *coefficient, int32_t from_part) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK) status = check_triples(system, count, triples);
  if (status == HOOKE_OK) status = check_coefficients(count, coefficient_count, coefficient);
  if (status != HOOKE_OK) return status;
  struct hk_bending_group group = {.count = count, .from_part = from_part, .part = system->part_count - 1};
  int64_t place;
  status = fill_group(name, triples, coefficient_count, coefficient, &group);
  if (status == HOOKE_OK) status = open_place(system, from_part, &place);
  if (status == HOOKE_OK) {
    system->bending_group[place] = group;
    system->triple_total += count;
  } else {
    hk_bending_group_release(&group);
  }
  return status;
}

int32_t hooke_system_add_bending(hooke_system *system, const char *name, int64_t count,
                                 const int64_t *triples, int64_t coefficient_count,
                                 const double *coefficient) {
  return add_group(system, name, count, triples, coefficient_count, coefficient, 0);
}

int32_t hk_system_add_part_bending(hooke_system *system, const char *name, int64_t count,
                                   const int64_t *triples, int64_t coefficient_count,
                                   const double *coefficient) {
  return add_group(system, name, count, triples, coefficient_count, coefficient, 1);
}

/* ---- asking ---- */

int64_t hooke_system_bending_count(const hooke_system *system) {
  int64_t count = 0;
  for (int64_t k = 0; k < system->bending_group_count; k++)
    count += system->bending_group[k].count;
  return count;
}

int64_t hooke_system_bending_group_count(const hooke_system *system) {
  return system->bending_group_count;
}

const char *hooke_system_bending_group_name(const hooke_system *system, int64_t group) {
  return group >= 0 && group < system->bending_group_count ? system->bending_group[group].name : NULL;
}

int64_t hooke_system_bending_group_size(const hooke_system *system, int64_t group) {
  return group >= 0 && group < system->bending_group_count ? system->bending_group[group].count : 0;
}

int32_t hooke_system_bending_ends(const hooke_system *system, int64_t *triples) {
  const int32_t status = hk_system_require_committed(system);
  struct hk_triple triple;
  if (status != HOOKE_OK) return status;
  for (struct hk_triples at = {&system->bending, 0, 0}; hk_next_triple(&at, &triple); triples += 3)
    memcpy(triples, triple.particle, sizeof triple.particle);
  return HOOKE_OK;
}

int32_t hooke_system_bending_coefficient(const hooke_system *system, double *coefficient) {
  const int32_t status = hk_system_require_committed(system);
  struct hk_triple triple;
  if (status != HOOKE_OK) return status;
  for (struct hk_triples at = {&system->bending, 0, 0}; hk_next_triple(&at, &triple);)
    *coefficient++ = triple.coefficient;
  return HOOKE_OK;
}
