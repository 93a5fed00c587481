/* The serial vectors of SUNDIALS with the loops of the kernel, by several threads where they are large. Sums go in blocks
 * that depend on the size alone and are added in order: their bits are the same for any number of threads. */
#ifndef HOOKE_INTEGRATE_SUNDIALS_VECTOR_H
#define HOOKE_INTEGRATE_SUNDIALS_VECTOR_H

#include "core/crew.h"

#include <nvector/nvector_serial.h>

/* `size` numbers, not set; N_VDestroy() releases it. Clones have the same loops and crew, which has to outlive them (NULL:
 * one thread). NULL without memory. */
N_Vector hooke_sundials_vector(int64_t size, struct hooke_crew *crew, SUNContext context);

#endif
