/* Allocations of hooke that fail by plan. The linker replaces the functions of the
 * system by these in statically linked code (--wrap). */
#pragma once

#include <stdint.h>

/* 1: allocations are points of the plan; otherwise they are only counted, and others make the points. */
void memory_faults_are_points(int32_t are);

/* Number of blocks that hooke holds. */
int64_t memory_blocks(void);
