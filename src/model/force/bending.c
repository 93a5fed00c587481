/* Groups of triples: checks and queries. */
#include "model/force/bending.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct hk_triples hk_triples_from(const struct hk_bending *bending, int64_t number) {
  int64_t low = 0, high = bending->run_count - 1;
  while (low < high) {
    const int64_t middle = low + (high - low + 1) / 2;
    if (bending->run[middle].first <= number)
      low = middle;
    else
      high = middle - 1;
  }
  return (struct hk_triples){bending, low, bending->run_count > 0 ? number - bending->run[low].first : 0};
}

void hk_bending_add(const struct hk_bending *bending, double factor, const double *const x[3],
                    double *const f[3]) {
  for (int64_t k = 0; k < bending->run_count; k++)
    bending->run[k].loop(&bending->run[k], factor, x, f);
}

/* ---- adding a group ---- */

static int32_t check_triples(const hooke_system *system, int64_t count, const int64_t *triples) {
  if (count < 0) {
    return hk_fail(HOOKE_BAD_VALUE, "triples", "%lld triples; 0 or more are allowed", (long long)count);
  }
  const int32_t status = hk_system_check_more(system, &hk_force_bending, count);
  if (status != HOOKE_OK) return hk_fail_within(status, "triples");
  for (int64_t k = 0; k < count; k++) {
    const int64_t *t = triples + 3 * k;
    for (int e = 0; e < 3; e++) {
      if (t[e] >= 0 && t[e] < system->particle_count) continue;
      const int32_t bad = hk_fail_index(NULL, "there is no particle", (double)t[e], system->particle_count);
      return hk_fail_within(bad, "triples[%lld][%d]", (long long)k, e);
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

static int32_t add_group(hooke_system *system, const char *name, int64_t count, const int64_t *triples,
                         int64_t coefficient_count, const double *coefficient, int32_t from_part) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK) status = check_triples(system, count, triples);
  if (status == HOOKE_OK) status = check_coefficients(count, coefficient_count, coefficient);
  if (status != HOOKE_OK) return status;
  struct hk_group group = {
      .force = &hk_force_bending, .count = count, .from_part = from_part, .part = system->part_count - 1};
  status = hk_group_allocate(&group, name, 3, 1, 0);
  if (status != HOOKE_OK) {
    hk_group_release(&group);
    return status;
  }
  for (int64_t k = 0; k < count; k++) {
    for (int e = 0; e < 3; e++)
      group.particle[e][k] = (int32_t)triples[3 * k + e];
    group.number[HOOKE_KAPPA][k] = coefficient[coefficient_count == 1 ? 0 : k];
  }
  return hk_system_add_group(system, &group);
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

/* ---- queries ---- */
