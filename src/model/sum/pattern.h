/* The sparsity pattern of the 3x3 blocks of the derivative of the forces: particle pairs joined by an
 * element, and the diagonal. */
#pragma once

#include <stdint.h>

struct hooke_system;

struct hk_pattern {
  int64_t rows, count;
  int64_t *row_start; /* rows + 1 */
  int64_t *column;    /* count, ascending within a row */
};

int32_t hk_pattern_create(const struct hooke_system *system, struct hk_pattern *pattern);
void hk_pattern_release(struct hk_pattern *pattern);
/* Number of blocks of the pattern; -1 before commit and without memory. */
int64_t hk_system_block_count(const struct hooke_system *system);

/* Index of the block (row, column), which must exist. */
int64_t hk_pattern_block(const struct hk_pattern *pattern, int64_t row, int64_t column);
