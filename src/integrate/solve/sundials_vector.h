/* The serial vectors of SUNDIALS with the loops of the kernel, by several threads if they are large. Sums go
 * in blocks that depend on the size alone and are added in order: their bits are the same for any number of
 * threads. */
#pragma once

#include "core/thread_pool.h"

#include <nvector/nvector_serial.h>

/* `size` numbers, uninitialised; N_VDestroy() releases it. Clones have the same loops and pool, which must
 * outlive them (NULL: one thread). NULL without memory. */
N_Vector hk_sundials_vector(int64_t size, struct hk_pool *pool, SUNContext context);

/* SUNDIALS assumes that a clone can always be allocated. Without memory all its clones are this one vector,
 * which N_VDestroy() leaves alone, and `taken` says that their numbers mean nothing. */
struct hk_sundials_spare {
  N_Vector vector;
  int32_t taken;
};

/* A spare for the clones of `v` and for theirs, which must stay until all of them are gone. 0 without memory.
 */
int32_t hk_sundials_spare_create(N_Vector v, struct hk_sundials_spare *spare);
void hk_sundials_spare_release(struct hk_sundials_spare *spare);
