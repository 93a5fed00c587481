/* The serial vectors of SUNDIALS with the loops of the kernel: a packaged SUNDIALS is compiled for any machine, and its
 * loops do one number at a time. */
#ifndef HOOKE_INTEGRATE_SUNDIALS_VECTOR_H
#define HOOKE_INTEGRATE_SUNDIALS_VECTOR_H

#include <nvector/nvector_serial.h>

/* `size` numbers, not set; N_VDestroy() releases it. Clones have the same loops. NULL without memory. */
N_Vector hooke_sundials_vector(int64_t size, SUNContext context);

#endif
