/* Points of one attempt by the ways in which they were come to, through the code of hooke: of those that are
 * alike, as in a loop or within another library, the first, the 16th, the 256th ... With HOOKE_FAULT_PLACES=1
 * each of them fails, besides the share of all points that a scenario has: a short way to as many branches as
 * failures reach. */
#ifndef FAULT_PLACES_H
#define FAULT_PLACES_H

#include <stdint.h>

/* For what follows, in processes that are forked from this one, too; 0 if that went well. Without the
 * variable nothing is kept. */
int places_prepare(void);

/* Forgets them, and keeps those of what comes next. */
void places_begin(void);
void places_end(void);

/* From where fault_strikes() was called, as point `k`. */
void places_note(int64_t k);

/* Number `i` = 0, 1, ... of them; 0: there are no more. */
int64_t places_point(int64_t i);

#endif
