/* Points of one attempt by their call paths through the code of hooke: of equal paths, as in a loop or within
 * another library, the first, the 16th, the 256th ... With HOOKE_FAULT_PLACES=1 each of them fails, besides
 * the scenario's share of all points: a short way to as many branches as failures reach. */
#pragma once

#include <stdint.h>

/* Starts recording, also in processes that are forked from this one; 0 on success. Without the variable
 * nothing is recorded. */
int places_prepare(void);

/* Clears the record, for the next attempt. */
void places_begin(void);
void places_end(void);

/* Records the place of fault_strikes() as point `k`. */
void places_note(int64_t k);

/* Number `i` = 0, 1, ... of them; 0: no more. */
int64_t places_point(int64_t i);
