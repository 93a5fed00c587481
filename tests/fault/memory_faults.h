/* Allocations of hooke and of its reader of JSON that fail by plan. The linker puts the functions here in
 * place of those of the system in what is linked statically (--wrap); jansson takes its functions from its
 * caller. */
#ifndef FAULT_MEMORY_FAULTS_H
#define FAULT_MEMORY_FAULTS_H

#include <stdint.h>

/* 1: allocations here are points of the plan; else they are only counted, and others make the points. */
void memory_faults_are_points(int32_t are);

/* Blocks that hooke or jansson hold now. */
int64_t memory_blocks(void);

#endif
