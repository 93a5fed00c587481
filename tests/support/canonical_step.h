/* Pieces of the canonical steps that the equations of solved steps are made of, too. */
#ifndef HOOKE_TESTS_SUPPORT_CANONICAL_STEP_H
#define HOOKE_TESTS_SUPPORT_CANONICAL_STEP_H

#include "canonical.h"

void canonical_accelerate(const struct canonical *canonical, double t, const double *q, const double *v,
                          const double *seen, double *acceleration);

void canonical_place(const struct canonical *canonical, double t, double *q, double *v);

int canonical_is_free(const struct canonical *canonical, int64_t k);

void canonical_predict(const struct canonical *canonical, double t, double end, double h, double *q,
                       double *v, double *half, double *a);

#endif
