/* The largest eigenvalue of M^-1 (a K + b C), and its mode. */
#pragma once

#include "measure/spectrum/linearised.h"

/* Up to this many unknowns an iteration is cheap, and values are found far beyond the accuracy. */
enum { HOOKE_FEW_UNKNOWNS = 10000 };

/* The largest eigenvalue, in the units of the linearised system, to about the relative `accuracy`; and its
 * mode (3n, x.Mx = 1). `start` (3n) is the mode of a nearby problem, or NULL. Dense by LAPACK for few
 * unknowns, by plain Lanczos for more, which adds an estimate of part of the remainder. HOOKE_NOT_BUILT
 * without LAPACK; HOOKE_NO_MEMORY. */
int32_t hk_dominant_mode(struct hk_linearised *linearised, double a, double b, const double *start,
                         double accuracy, double *value, double *mode);

/* The same by Lanczos's recurrence without orthogonalisation (Lanczos 1950; Paige 1971: the extreme values
 * are right), for the last hk_linearised_combine(); `mode` holds the start. */
int32_t hk_dominant_mode_lanczos(struct hk_linearised *linearised, double accuracy, double *value,
                                 double *mode);
