#include "model/sum/pattern.h"

#include "core/memory.h"
#include "model/system.h"

#include <stdlib.h>
#include <string.h>

static int compare_columns(const void *a, const void *b) {
  const int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
  return (x > y) - (x < y);
}

/* Both directions of every pair of particles of an element: counts them, or stores them at `next`. */
static void visit_pairs(const struct hooke_system *system, int64_t *count, int64_t *column, int64_t *next) {
  struct hk_elements at;
  hk_begin_elements(system, 0.0, NULL, NULL, &at);
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    for (int k = 0; k < e->count * e->count; k++) {
      const int32_t row = e->particle[k / e->count], other = e->particle[k % e->count];
      if (row == other) continue;
      if (column)
        column[next[row]++] = other;
      else
        count[row]++;
    }
  }
}

/* Sorts every row and removes duplicates (two springs between the same particles). */
static void sort_rows(struct hk_pattern *pattern) {
  int64_t kept = 0;
  for (int64_t p = 0; p < pattern->rows; p++) {
    const int64_t from = pattern->row_start[p], to = pattern->row_start[p + 1];
    qsort(pattern->column + from, (size_t)(to - from), sizeof(int64_t), compare_columns);
    pattern->row_start[p] = kept;
    for (int64_t k = from; k < to; k++) {
      if (k == from || pattern->column[k] != pattern->column[k - 1])
        pattern->column[kept++] = pattern->column[k];
    }
  }
  pattern->row_start[pattern->rows] = kept;
  pattern->count = kept;
}

int32_t hk_pattern_create(const struct hooke_system *system, struct hk_pattern *pattern) {
  const int64_t n = system->particle_count;
  *pattern = (struct hk_pattern){.rows = n};
  pattern->row_start = hk_new(n + 1, sizeof(int64_t));
  int64_t *next = hk_new(n + 1, sizeof(int64_t)), most = n;
  if (next) visit_pairs(system, next, NULL, NULL);
  for (int64_t p = 0; next && p < n; p++)
    most += next[p];
  pattern->column = hk_new(most, sizeof(int64_t));
  if (pattern->row_start == NULL || pattern->column == NULL || next == NULL) {
    hk_free(next);
    hk_pattern_release(pattern);
    return HOOKE_NO_MEMORY;
  }
  for (int64_t p = 0, start = 0; p < n; p++) {
    pattern->row_start[p] = start;
    pattern->column[start] = p;
    start += next[p] + 1;
    next[p] = pattern->row_start[p] + 1;
    pattern->row_start[p + 1] = start;
  }
  visit_pairs(system, NULL, pattern->column, next);
  hk_free(next);
  sort_rows(pattern);
  return HOOKE_OK;
}

void hk_pattern_release(struct hk_pattern *pattern) {
  hk_free(pattern->row_start);
  hk_free(pattern->column);
  memset(pattern, 0, sizeof *pattern);
}

int64_t hk_pattern_block(const struct hk_pattern *pattern, int64_t row, int64_t column) {
  const int64_t *from = pattern->column + pattern->row_start[row];
  const size_t count = (size_t)(pattern->row_start[row + 1] - pattern->row_start[row]);
  const int64_t *found = bsearch(&column, from, count, sizeof(int64_t), compare_columns);
  return found - pattern->column;
}

int32_t hooke_system_derivative_pattern(const hooke_system *system, int64_t *row_start, int64_t *column) {
  struct hk_pattern pattern;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_pattern_create(system, &pattern);
  if (status != HOOKE_OK) return status;
  memcpy(row_start, pattern.row_start, (size_t)(pattern.rows + 1) * sizeof(int64_t));
  memcpy(column, pattern.column, (size_t)pattern.count * sizeof(int64_t));
  hk_pattern_release(&pattern);
  return HOOKE_OK;
}

int64_t hk_system_block_count(const hooke_system *system) {
  struct hk_pattern pattern;
  if (hk_system_require_committed(system) != HOOKE_OK) return -1;
  if (hk_pattern_create(system, &pattern) != HOOKE_OK) return -1;
  const int64_t count = pattern.count;
  hk_pattern_release(&pattern);
  return count;
}
