/* The loops of any instruction set of this machine in place of the best, in programs of the static library
 * that are linked with --wrap=hk_spring_set. */
#pragma once

#include <stdint.h>

/* From now on those of this set, counted from the best; systems take their loops when they are committed. 0
 * past the last one, and then the best are used again: for (int32_t set = 0; use_loops(set); set++). */
int use_loops(int32_t set);
