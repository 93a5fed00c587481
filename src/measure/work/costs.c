/* Rough numbers. */
#include "measure/work/work.h"

const double hk_costs[HOOKE_WORKS] = {
    1.2,
    3.0,
    30.0, /* springs */
    2.0,
    4.0,
    30.0, /* bending */
    40.0,
    200.0,
    300.0, /* altitude */
    3.0,
    20.0,
    50.0, /* anchors */
    20.0,
    40.0,
    50.0, /* linear */
    0.5,
    1.0,
    5.0, /* drag */
    10.0,
    10.0,
    0.1, /* callback */
    0.5,
    0.1,
    0.1, /* weight */
    0.1,
    0.1,
    0.1, /* gravity */
    [HOOKE_WORK_STEP] = 60.0,
    [HOOKE_WORK_ADAPTIVE_STEP] = 3000.0,
    [HOOKE_WORK_ADAPTIVE_PARTICLE] = 20.0,
    [HOOKE_WORK_EVALUATION] = 60.0,
    [HOOKE_WORK_PARTICLE] = 3.0,
    [HOOKE_WORK_ADAPTIVE_EVALUATED] = 5.0,
    [HOOKE_WORK_UNORDERED] = 1.0,
    [HOOKE_WORK_SCATTERED] = 3.0,
    [HOOKE_WORK_BODY] = 150.0,
    [HOOKE_WORK_DAMPER] = 15.0,
    [HOOKE_WORK_PRODUCT] = 100.0,
    [HOOKE_WORK_PRODUCT_PARTICLE] = 10.0,
    [HOOKE_WORK_MATRIX] = 500.0,
    [HOOKE_WORK_MATRIX_PARTICLE] = 50.0,
    [HOOKE_WORK_ITERATION] = 10.0,
    [HOOKE_WORK_SPACE] = 10.0,
    [HOOKE_WORK_FACTOR_PRODUCT] = 0.84,
    [HOOKE_WORK_FACTOR_NUMBER] = 0.7,
};
