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

int32_t hk_system_add_bending(hooke_system *system, const struct hk_addition *added,
                              int64_t coefficient_count, const double *coefficient) {
  struct hk_group group;
  int32_t status = hk_group_begin(system, added, &group);
  if (status == HOOKE_OK) status = check_coefficients(added->count, coefficient_count, coefficient);
  for (int64_t k = 0; k < added->count && status == HOOKE_OK; k++)
    group.number[HOOKE_KAPPA][k] = coefficient[coefficient_count == 1 ? 0 : k];
  return hk_group_end(system, status, &group);
}

int32_t hooke_system_add_bending(hooke_system *system, const char *name, int64_t count,
                                 const int64_t *triples, int64_t coefficient_count,
                                 const double *coefficient) {
  const struct hk_addition added = {&hk_force_bending, name, count, triples, NULL, 0};
  return hk_system_add_bending(system, &added, coefficient_count, coefficient);
}
