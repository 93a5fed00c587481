/* Maximum memory of a scene. */
#pragma once

#include "hooke/base.h"

/* Available memory [bytes]: the physical memory, or what a limit on the address space leaves, if that is
 * less; `which` (may be NULL) receives the name of the two that applies. INFINITY if the system does not
 * tell. */
double hk_memory_limit(const char **which);

/* HOOKE_NO_MEMORY with "<what> needs 412 GB of memory; ..." if `bytes` exceeds `limit` (0:
 * hk_memory_limit()). */
int32_t hk_memory_require(double limit, double bytes, const char *what);

enum { HOOKE_BYTES_SHOWN = 32 };

/* "412 GB" */
const char *hk_show_bytes(double bytes, char shown[HOOKE_BYTES_SHOWN]);
