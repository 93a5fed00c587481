/* Rows of numbers for callbacks, which may keep them. */
#include "model/force/force.h"

#include "core/memory.h"

#include <stdatomic.h>
#include <string.h>

/* In front of the numbers. */
struct holders {
  _Alignas(64) _Atomic int64_t count;
};

double *hk_rows_new(int64_t numbers) {
  struct holders *rows = hk_new(numbers + (int64_t)(sizeof *rows / sizeof(double)), sizeof(double));
  if (rows == NULL) return NULL;
  rows->count = 1;
  return (double *)(rows + 1);
}

int64_t hooke_rows_hold(const double *q, int32_t more) {
  if (q == NULL) return 0;
  struct holders *rows = (struct holders *)(uintptr_t)q - 1;
  const int64_t left = atomic_fetch_add(&rows->count, more) + more;
  if (left == 0) hk_free(rows);
  return left;
}

int32_t hk_rows_renew(int64_t numbers, double **rows) {
  if (hooke_rows_hold(*rows, 0) == 1) return HOOKE_OK;
  double *made = hk_rows_new(numbers);
  if (made == NULL) return HOOKE_NO_MEMORY;
  memcpy(made, *rows, (size_t)numbers * sizeof *made);
  hooke_rows_hold(*rows, -1);
  *rows = made;
  return HOOKE_OK;
}
