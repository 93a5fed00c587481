/* Eigenvalues, by GSL. */
#ifndef HOOKE_MEASURE_EIGEN_H
#define HOOKE_MEASURE_EIGEN_H

#include "hooke/base.h"

/* Room for eigenvalues of symmetric 3x3 matrices. HOOKE_NOT_BUILT without GSL; HOOKE_NO_MEMORY. */
struct hooke_eigen;
int32_t hooke_eigen_create(struct hooke_eigen **eigen);
void hooke_eigen_destroy(struct hooke_eigen *eigen);

/* The largest eigenvalue of the symmetric matrix with entries xx, yy, zz, xy, xz, yz. */
double hooke_eigen_largest(struct hooke_eigen *eigen, const double matrix[6]);

#endif
