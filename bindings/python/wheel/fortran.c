/* The functions of a Fortran runtime that LAPACK's archive uses, so that the wheel needs none. */
#include <stddef.h>
#include <string.h>

void _gfortran_concat_string(size_t to_length, char *to, size_t length, const char *text, size_t other_length,
                             const char *other);
void xerbla_(const char *routine, const int *argument, size_t length);

/* to = text // other, truncated or padded with blanks. */
void _gfortran_concat_string(size_t to_length, char *to, size_t length, const char *text, size_t other_length,
                             const char *other) {
  const size_t first = length < to_length ? length : to_length;
  const size_t left = to_length - first, second = other_length < left ? other_length : left;
  memcpy(to, text, first);
  memcpy(to + first, other, second);
  memset(to + first + second, ' ', left - second);
}

/* LAPACK's own prints and ends the process over an argument out of range; the caller gets its info in any
 * case. */
void xerbla_(const char *routine, const int *argument, size_t length) {
  (void)routine, (void)argument, (void)length;
}
