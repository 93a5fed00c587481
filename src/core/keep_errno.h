/* errno belongs to the caller: code that may set it restores it. */
#pragma once

#include <errno.h>

static inline void hk_put_errno_back(const int *kept) {
  errno = *kept;
}

/* Declared at the start of a block, it restores errno at the end of the block. */
#define HOOKE_KEEP_ERRNO __attribute__((cleanup(hk_put_errno_back), unused)) const int hk_kept_errno = errno
