/* Observed order of convergence. */
#pragma once

#include <stdint.h>

/* log2(coarse / fine) for two errors at steps h and h/2. */
double observed_order(double coarse, double fine);

/* Fails unless every halving in `error` (count errors at h, h/2, h/4, ...) shows an order between low and
 * high. */
void check_order(const char *what, int64_t count, const double *error, double low, double high);
