/* Which callbacks of the caller act on a system, as a sum of these; and as files name them. */
#ifndef HOOKE_MODEL_CALLBACKS_H
#define HOOKE_MODEL_CALLBACKS_H

#include "hooke/system.h"

enum { HOOKE_CALLS_FORCE = 1, HOOKE_CALLS_DERIVATIVE = 2, HOOKE_CALLS_DRIVE = 4, HOOKE_CALLS_ALL = 7 };

int32_t hk_system_calls_back(const hooke_system *system);

/* "none", "force", "force and drive", ... And back: -1 for any other text. */
const char *hk_callbacks_text(int32_t calls);
int32_t hk_callbacks_find(const char *text);

/* HOOKE_UNSUITED unless a run with the callbacks `had` (-1: unknown) goes on in a system with those of
 * `own`. */
int32_t hk_callbacks_check(int32_t had, int32_t own);
/* HOOKE_UNSUITED if the system is from the file of a run with callbacks that it lacks. */
int32_t hk_callbacks_require(const hooke_system *system);

#endif
