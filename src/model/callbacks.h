/* Which callbacks of the caller act on a system, as a sum of these; and as files name them. */
#pragma once

#include "hooke/system.h"

#include <stddef.h>

enum { HOOKE_CALLS_FORCE = 1, HOOKE_CALLS_DERIVATIVE = 2, HOOKE_CALLS_DRIVE = 4, HOOKE_CALLS_ALL = 7 };

/* Texts of where a force is from. */
enum { HOOKE_FORCE_FILE, HOOKE_FORCE_NAME, HOOKE_FORCE_DIGEST, HOOKE_FORCE_TEXTS };
extern const char *const hk_force_texts[HOOKE_FORCE_TEXTS]; /* their names in results and files */

int32_t hk_system_calls_back(const hooke_system *system);

/* "none", "force", "force and drive", ... And back: -1 for any other text. */
const char *hk_callbacks_text(int32_t calls);
int32_t hk_callbacks_find(const char *text);

/* Where the force callback is from: HOOKE_FORCE_TEXTS texts; NULL if nobody has said. And by which name
 * messages call it. */
char *const *hk_force_from(const hooke_system *system);
const char *hk_force_called(const hooke_system *system, char *name, size_t size);
/* HOOKE_UNSUITED if the system's force is known to be another one than that of a run, by its texts. */
int32_t hk_force_check(char *const *had, const hooke_system *system);

/* HOOKE_UNSUITED unless a run with the callbacks `had` (-1: unknown) goes on in a system with those of
 * `own`. */
int32_t hk_callbacks_check(int32_t had, int32_t own);
/* HOOKE_UNSUITED if the system is from the file of a run with callbacks that it lacks, or with
 * another force. */
int32_t hk_callbacks_require(const hooke_system *system);
