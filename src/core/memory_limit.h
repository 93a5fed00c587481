/* How much memory a scene may take. */
#ifndef HOOKE_CORE_MEMORY_LIMIT_H
#define HOOKE_CORE_MEMORY_LIMIT_H

#include "hooke/base.h"

/* What there is [bytes]: the physical memory, or what is left of the address space if a limit on that leaves
 * less; `which` (may be NULL) says which of the two. INFINITY where the system does not tell. */
double hk_memory_limit(const char **which);

/* HOOKE_NO_MEMORY with "<what> needs 412 GB of memory; ..." if `bytes` are more than `limit` (0:
 * hk_memory_limit()). */
int32_t hk_memory_require(double limit, double bytes, const char *what);

enum { HOOKE_BYTES_SHOWN = 32 };

/* "412 GB" */
const char *hk_show_bytes(double bytes, char shown[HOOKE_BYTES_SHOWN]);

#endif
