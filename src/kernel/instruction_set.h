/* For files that are compiled once per instruction set: HOOKE_ISA names it, and what such a file exports. */
#ifndef HOOKE_KERNEL_INSTRUCTION_SET_H
#define HOOKE_KERNEL_INSTRUCTION_SET_H

#include "kernel/spring_loops.h"

#define JOIN_NAMES(a, b) a##b
#define JOIN(a, b)       JOIN_NAMES(a, b)

#define HOOKE_SPRING_SET    JOIN(hooke_spring_set_, HOOKE_ISA)
#define HOOKE_BENDING_LOOPS JOIN(hooke_bending_loops_, HOOKE_ISA)

extern const struct hooke_spring_set HOOKE_SPRING_SET;
extern hooke_bending_loop *const HOOKE_BENDING_LOOPS[HOOKE_BENDING_SHAPES];

#endif
