/* The costs of counted work [ns], as bench/costs.c measured and fitted them: docs/notes/performance.md. A
 * force that none of its scenes has keeps a nominal cost; that of a callback is of its call. */
#include "measure/counted_work/work.h"

/* On 2026-11-27, Intel(R) Xeon(R) Processor, family 6 model 167. */
const double hk_costs[HOOKE_WORKS] = {
    1.66,
    1.33,
    28.8, /* springs */
    2.21,
    2.86,
    41.5, /* bending */
    29.7,
    14.6,
    195, /* altitude */
    8.64,
    19.8,
    0.1, /* anchors */
    5,
    10,
    0.1, /* obstacles */
    50,
    100,
    100, /* drag in a fluid */
    20,
    40,
    50, /* linear */
    0.1,
    0.1,
    2.93, /* drag */
    5,
    5,
    5, /* drag of each particle, or in a wind */
    15,
    30,
    30, /* quadratic drag */
    5,
    0.1,
    0.1, /* wind */
    3.33,
    0.1,
    0.1, /* loads */
    10,
    10,
    0.1, /* callback */
    3.33,
    0.1,
    0.1, /* weight */
    0.1,
    0.1,
    0.1, /* gravity */
    [HOOKE_WORK_STEP] = 15.4,
    [HOOKE_WORK_ADAPTIVE_STEP] = 987,
    [HOOKE_WORK_ADAPTIVE_PARTICLE] = 33.9,
    [HOOKE_WORK_EVALUATION] = 76.1,
    [HOOKE_WORK_PARTICLE] = 0.576,
    [HOOKE_WORK_FAR] = 10.3,
    [HOOKE_WORK_ADAPTIVE_EVALUATED] = 10.5,
    [HOOKE_WORK_SCATTERED] = 4.75,
    [HOOKE_WORK_CURVED] = 20, /* nominal */
    [HOOKE_WORK_BODY] = 285,
    [HOOKE_WORK_BODY_PARTICLE] = 25.9,
    [HOOKE_WORK_DAMPER] = 15.4,
    [HOOKE_WORK_PRODUCT] = 97.9,
    [HOOKE_WORK_PRODUCT_PARTICLE] = 1.48,
    [HOOKE_WORK_ROWS] = 88.4,
    [HOOKE_WORK_MATRIX] = 278,
    [HOOKE_WORK_MATRIX_PARTICLE] = 38.6,
    [HOOKE_WORK_VECTOR] = 160,
    [HOOKE_WORK_VECTOR_PARTICLE] = 1.01,
    [HOOKE_WORK_FACTOR_PRODUCT] = 0.857,
    [HOOKE_WORK_FACTOR_NUMBER] = 0.479,
};
