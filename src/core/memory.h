/* Allocation of every block of the library. */
#pragma once

#include "hooke/base.h"

#include <float.h>
#include <stddef.h>

/* WebAssembly is let through: hk_reserve() refuses a block that its addresses cannot hold, and no offset is
 * larger than its block. */
#if (UINTPTR_MAX < UINT64_MAX && !defined __wasm__) || FLT_EVAL_METHOD == 2 || FLT_EVAL_METHOD < 0
#error "hooke needs addresses of 64 bits, and double precision that no wider register rounds twice"
#endif

/* `count` zeroed elements of `size` bytes, aligned to 64 bytes and padded to a multiple of them; NULL, with
 * the message recorded, if there is no memory or the product does not fit. A count of 0 gives a valid block.
 */
void *hk_new(int64_t count, size_t size);

/* The same, not zeroed: pages are placed near the processor of the thread that first writes to them. */
void *hk_reserve(int64_t count, size_t size);

/* Like realloc(): grows `*block` to `capacity` elements of `size`, keeping the first `used`. HOOKE_NO_MEMORY
 * leaves it unchanged. */
int32_t hk_grow(void **block, int64_t used, int64_t capacity, size_t size);

/* Likewise, where `count` elements may fill it: there is room for one more in a block that all grew by this.
 */
int32_t hk_room(void **block, int64_t count, size_t size);
/* The elements that such a block of `count` has room for. */
int64_t hk_room_of(int64_t count);

/* Copy of a string, "" for NULL, aligned as by malloc(); NULL, with the message recorded, without memory. */
char *hk_copy_text(const char *text);

void hk_free(void *block);

/* Hands over what was made or, where the status is a failure, releases it; the status. */
#define HOOKE_HAND_OVER(status, made, out, release)                                                          \
  ((status) == HOOKE_OK ? (void)(*(out) = (made)) : release(made), (status))

/* The first `count` numbers of what is left of a block. */
static inline double *hk_part(double **block, int64_t count) {
  double *start = *block;
  *block += count;
  return start;
}
