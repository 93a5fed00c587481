/* Elliptic functions of Jacobi and the complete integral K, of modulus k < 1, by the arithmetic-geometric
 * mean (Abramowitz and Stegun 1964, sections 16.4 and 17.6). */
#ifndef TESTS_SUPPORT_ELLIPTIC_H
#define TESTS_SUPPORT_ELLIPTIC_H

double elliptic_k(double k);
void elliptic_jacobi(double u, double k, double *sn, double *cn, double *dn);

#endif
