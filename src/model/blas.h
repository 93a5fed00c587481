/* The optimised BLAS that CHOLMOD calls. */
#pragma once

enum { HOOKE_BLAS_SIZE = 128 };

/* Writes its name, version, kind of processor and number of threads, on which its bits depend, as they are
 * now, such as "OpenBLAS 0.3.21 Zen, 2 threads". "" in a build without CHOLMOD, and for another BLAS than
 * those that are known to be fast and to give the same bits each time. Returns `text`. */
const char *hk_blas_describe(char text[HOOKE_BLAS_SIZE]);
