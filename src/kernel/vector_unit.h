/* The vectors of an instruction set, for loops that are written on whole vectors. HOOKE_WIDTH numbers each;
 * operations without a compiler operator on vectors are functions here. */
#pragma once

#include "kernel/spring/spring_body.h"

#include <stdint.h>

#if defined(__AVX512F__)
#define HOOKE_WIDTH 8
#elif defined(__AVX2__)
#define HOOKE_WIDTH 4
#else
#define HOOKE_WIDTH 2
#endif

#if HOOKE_WIDTH > 2
#include <immintrin.h>
#endif

/* Loads and stores through these need no alignment. */
typedef double hk_vector __attribute__((vector_size(8 * HOOKE_WIDTH), aligned(8), may_alias));
typedef int64_t hk_vector_mask __attribute__((vector_size(8 * HOOKE_WIDTH), aligned(8), may_alias));

HOOKE_INLINE hk_vector hk_load(const double *at) {
  return *(const hk_vector *)at;
}

HOOKE_INLINE void hk_store(double *at, hk_vector x) {
  *(hk_vector *)at = x;
}

HOOKE_INLINE hk_vector hk_all(double x) {
  return x - (hk_vector){0}; /* x - 0 is x, the sign of a zero included */
}

/* ---- square root, the lesser of two (b if one is NaN), x where a bit is set and 0 elsewhere, 1 if some
 * number is 0 or less ---- */

#if HOOKE_WIDTH == 8

HOOKE_INLINE hk_vector hk_vector_sqrt(hk_vector x) {
  return (hk_vector)_mm512_sqrt_pd((__m512d)x);
}

HOOKE_INLINE hk_vector hk_lesser(hk_vector a, hk_vector b) {
  return (hk_vector)_mm512_min_pd((__m512d)a, (__m512d)b);
}

HOOKE_INLINE hk_vector hk_keep(uint32_t bits, hk_vector x) {
  return (hk_vector)_mm512_maskz_mov_pd((__mmask8)bits, (__m512d)x);
}

HOOKE_INLINE int hk_has_none_left(hk_vector x) {
  return _mm512_cmp_pd_mask((__m512d)x, _mm512_setzero_pd(), _CMP_LE_OQ) != 0;
}

#elif HOOKE_WIDTH == 4

HOOKE_INLINE hk_vector hk_vector_sqrt(hk_vector x) {
  return (hk_vector)_mm256_sqrt_pd((__m256d)x);
}

HOOKE_INLINE hk_vector hk_lesser(hk_vector a, hk_vector b) {
  return (hk_vector)_mm256_min_pd((__m256d)a, (__m256d)b);
}

#define HOOKE_BIT(bits, k) -(((bits) >> (k)) & 1)
#define HOOKE_ROW(bits)                                                                                      \
  { HOOKE_BIT(bits, 0), HOOKE_BIT(bits, 1), HOOKE_BIT(bits, 2), HOOKE_BIT(bits, 3) }

/* One load instead of four operations. */
static const int64_t hk_masks[16][4] __attribute__((aligned(32))) = {
    HOOKE_ROW(0),  HOOKE_ROW(1),  HOOKE_ROW(2),  HOOKE_ROW(3), HOOKE_ROW(4),  HOOKE_ROW(5),
    HOOKE_ROW(6),  HOOKE_ROW(7),  HOOKE_ROW(8),  HOOKE_ROW(9), HOOKE_ROW(10), HOOKE_ROW(11),
    HOOKE_ROW(12), HOOKE_ROW(13), HOOKE_ROW(14), HOOKE_ROW(15)};

HOOKE_INLINE hk_vector hk_keep(uint32_t bits, hk_vector x) {
  return (hk_vector)((hk_vector_mask)x & *(const hk_vector_mask *)hk_masks[bits]);
}

HOOKE_INLINE int hk_has_none_left(hk_vector x) {
  return _mm256_movemask_pd(_mm256_cmp_pd((__m256d)x, _mm256_setzero_pd(), _CMP_LE_OQ)) != 0;
}

#else

HOOKE_INLINE hk_vector hk_vector_sqrt(hk_vector x) {
  return (hk_vector){sqrt(x[0]), sqrt(x[1])};
}

HOOKE_INLINE hk_vector hk_lesser(hk_vector a, hk_vector b) {
  return (hk_vector){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
}

HOOKE_INLINE hk_vector hk_keep(uint32_t bits, hk_vector x) {
  const hk_vector_mask mask = {-(int64_t)(bits & 1), -(int64_t)(bits >> 1)};
  return (hk_vector)((hk_vector_mask)x & mask);
}

HOOKE_INLINE int hk_has_none_left(hk_vector x) {
  return (x[0] <= 0.0) | (x[1] <= 0.0);
}

#endif
