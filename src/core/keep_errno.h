/* errno belongs to the caller: whoever calls what sets it, puts it back. */
#ifndef HOOKE_CORE_KEEP_ERRNO_H
#define HOOKE_CORE_KEEP_ERRNO_H

#include <errno.h>

static inline void hk_put_errno_back(const int *kept) {
  errno = *kept;
}

/* Where this stands among the declarations of a function, errno is at its end what it is here. */
#define HOOKE_KEEP_ERRNO __attribute__((cleanup(hk_put_errno_back), unused)) const int hk_kept_errno = errno

#endif
