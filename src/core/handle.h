/* Handles: the opaque objects that callers hold. A build with HOOKE_CHECK_HANDLES keeps a list of those that
 * are alive, and the guard (src/guard) looks every handle up in it; in other builds nothing of this is
 * there. */
#ifndef HOOKE_CORE_HANDLE_H
#define HOOKE_CORE_HANDLE_H

#include "core/memory.h"

#if HOOKE_CHECK_HANDLES

/* hk_new(1, size), alive as a `type` ("hooke_state") until hk_handle_free(), which takes NULL. */
void *hk_handle_new(const char *type, size_t size);
void hk_handle_free(void *object);

/* 1 if `object`, which may be any address, is alive and of that type; else 0, with the message that
 * `function` cannot take it as `argument`. */
int32_t hk_handle_is(const void *object, const char *type, const char *function, const char *argument);

#else

#define hk_handle_new(type, size) hk_new(1, (size))
#define hk_handle_free(object)    hk_free(object)

#endif
#endif
