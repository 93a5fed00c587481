/* Handles: the opaque objects that callers hold. A build with HOOKE_CHECK_HANDLES keeps a list of the live
 * ones, and the guard (src/guard) checks every handle against it. Other builds have none of this. */
#pragma once

#include "core/memory.h"

#if HOOKE_CHECK_HANDLES

/* hk_new(1, size), registered as a live `type` ("hooke_state") until hk_handle_free(), which accepts NULL. */
void *hk_handle_new(const char *type, size_t size);
void hk_handle_free(void *object);

/* 1 if `object`, which may be any address, is a live object of that type; otherwise 0, with a message that
 * names `function` and `argument`. */
int32_t hk_handle_is(const void *object, const char *type, const char *function, const char *argument);

#else

#define hk_handle_new(type, size) hk_new(1, (size))
#define hk_handle_free(object)    hk_free(object)

#endif
