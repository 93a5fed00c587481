/* Eigenvalues of small matrices. */
#ifndef HOOKE_MEASURE_SPECTRUM_EIGEN_H
#define HOOKE_MEASURE_SPECTRUM_EIGEN_H

/* The largest eigenvalue of the symmetric matrix with entries xx, yy, zz, xy, xz, yz, to rounding of the
 * largest of them. NaN if one of them is. */
double hk_eigen_largest(const double matrix[6]);

#endif
