/* The costs of counted work [ns], as bench/costs.c measured and fitted them: docs/notes/performance.md. A
 * force that none of its scenes has keeps a nominal cost; that of a callback is of its call. */
#include "measure/work/work.h"

/* On 2026-11-27, Intel(R) Xeon(R) Processor, family 6 model 167. */
const double hk_costs[HOOKE_WORKS] = {
    1.75,
    1.04,
    29.5, /* springs */
    2.23,
    2.44,
    38.7, /* bending */
    29.5,
    12.7,
    217, /* altitude */
    13.4,
    22.1,
    0.1, /* anchors */
    20,
    40,
    50, /* linear */
    0.1,
    0.1,
    0.1, /* drag */
    10,
    10,
    0.1, /* callback */
    3.6,
    0.1,
    0.1, /* weight */
    0.1,
    0.1,
    0.1, /* gravity */
    [HOOKE_WORK_STEP] = 16.6,
    [HOOKE_WORK_ADAPTIVE_STEP] = 1.03e+03,
    [HOOKE_WORK_ADAPTIVE_PARTICLE] = 33.5,
    [HOOKE_WORK_EVALUATION] = 76.8,
    [HOOKE_WORK_PARTICLE] = 0.206,
    [HOOKE_WORK_FAR] = 10.3,
    [HOOKE_WORK_ADAPTIVE_EVALUATED] = 10.2,
    [HOOKE_WORK_SCATTERED] = 5.17,
    [HOOKE_WORK_BODY] = 324,
    [HOOKE_WORK_BODY_PARTICLE] = 25.5,
    [HOOKE_WORK_DAMPER] = 15.3,
    [HOOKE_WORK_PRODUCT] = 76.8,
    [HOOKE_WORK_PRODUCT_PARTICLE] = 2.26,
    [HOOKE_WORK_ROWS] = 84.1,
    [HOOKE_WORK_MATRIX] = 487,
    [HOOKE_WORK_MATRIX_PARTICLE] = 39.7,
    [HOOKE_WORK_VECTOR] = 50,
    [HOOKE_WORK_VECTOR_PARTICLE] = 1.9,
    [HOOKE_WORK_FACTOR_PRODUCT] = 0.86,
    [HOOKE_WORK_FACTOR_NUMBER] = 0.433,
};
