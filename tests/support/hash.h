/* 64-bit FNV-1a over the bytes of doubles, and the first difference of two arrays. */
#pragma once

#include <stdint.h>

#define HASH_START UINT64_C(0xcbf29ce484222325)

/* Continues a hash; begin with HASH_START. */
uint64_t hash_doubles(int64_t count, const double *values, uint64_t hash);

/* Index of the first number whose bits differ, -1 if there is none. */
int64_t first_difference(int64_t count, const double *a, const double *b);
