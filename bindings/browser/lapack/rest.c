/* What the routines of LAPACK need besides f2c's translation: the functions of Fortran that f2c calls, and
 * the routines that are no Fortran 77 (Anderson 2017 for dlartg). */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* ---- Fortran ---- */

double d_lg10(const double *x) {
  return log10(*x);
}

double d_sign(const double *size, const double *sign) {
  return copysign(*size, *sign);
}

int32_t i_nint(const float *x) {
  return (int32_t)lroundf(*x);
}

int32_t i_len(const char *text, int32_t length) {
  (void)text;
  return length;
}

double pow_di(const double *base, const int32_t *exponent) {
  double result = 1.0, factor = *exponent < 0 ? 1.0 / *base : *base;
  for (uint32_t n = (uint32_t)(*exponent < 0 ? -*exponent : *exponent); n > 0; n >>= 1, factor *= factor)
    if (n & 1) result *= factor;
  return result;
}

/* Texts end with any number of blanks. */
int s_cmp(const char *a, const char *b, int32_t a_length, int32_t b_length) {
  for (int32_t k = 0; k < a_length || k < b_length; k++) {
    const int difference = (k < a_length ? a[k] : ' ') - (k < b_length ? b[k] : ' ');
    if (difference != 0) return difference;
  }
  return 0;
}

int s_copy(char *to, const char *from, int32_t to_length, int32_t from_length) {
  for (int32_t k = 0; k < to_length; k++)
    to[k] = k < from_length ? from[k] : ' ';
  return 0;
}

int s_cat(char *to, char *piece[], int32_t length[], int32_t *count, int32_t to_length) {
  int32_t at = 0;
  for (int32_t p = 0; p < *count; p++)
    for (int32_t k = 0; k < length[p] && at < to_length; k++)
      to[at++] = piece[p][k];
  while (at < to_length)
    to[at++] = ' ';
  return 0;
}

/* ---- routines that are no Fortran 77 ---- */

int32_t disnan_(const double *x) {
  return isnan(*x);
}

double dlamch_(const char *what, int32_t length) {
  static const char words[] = "ESBPNRMULO";
  static const double values[] = {DBL_EPSILON / 2, DBL_MIN, FLT_RADIX,   DBL_EPSILON, DBL_MANT_DIG, 1.0,
                                  DBL_MIN_EXP,     DBL_MIN, DBL_MAX_EXP, DBL_MAX};
  const char *word = strchr(words, *what & ~32); /* in capitals */
  (void)length;
  return word && *word ? values[word - words] : 0.0;
}

/* scale^2 sum = old scale^2 sum + the squares of x, without overflow. */
int dlassq_(const int32_t *n, const double *x, const int32_t *stride, double *scale, double *sum) {
  for (int32_t k = 0; k < *n; k++) {
    const double size = fabs(x[k * *stride]);
    if (!(size > 0.0) && !isnan(size)) continue;
    if (*scale < size) {
      *sum = 1.0 + *sum * (*scale / size) * (*scale / size);
      *scale = size;
    } else {
      *sum += (size / *scale) * (size / *scale);
    }
  }
  return 0;
}

double dnrm2_(const int32_t *n, const double *x, const int32_t *stride) {
  double scale = 0.0, sum = 1.0;
  dlassq_(n, x, stride, &scale, &sum);
  return scale * sqrt(sum);
}

/* The rotation (c s; -s c) that takes (f, g) to (r, 0). */
int dlartg_(const double *f, const double *g, double *c, double *s, double *r) {
  const double size = fmin(DBL_MAX / 4, fmax(DBL_MIN, fmax(fabs(*f), fabs(*g))));
  const double a = *f / size, b = *g / size, d = sqrt(a * a + b * b);
  *c = *g == 0.0 ? 1.0 : *f == 0.0 ? 0.0 : fabs(a) / d;
  *r = *g == 0.0 ? *f : *f == 0.0 ? fabs(*g) : copysign(d, *f) * size;
  *s = *g == 0.0 ? 0.0 : *f == 0.0 ? copysign(1.0, *g) : b / copysign(d, *f);
  return 0;
}

/* Told of a wrong argument, which the caller's `info` says as well. */
int xerbla_(const char *routine, int32_t *argument, int32_t length) {
  (void)routine, (void)argument, (void)length;
  return 0;
}
