/* SHA-256 (FIPS 180-4). */
#include "force.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = 64, ROUNDS = 64, WORDS = 8, LENGTH = 8 };

static uint32_t turn(uint32_t x, int by) {
  return x >> by | x << (32 - by);
}

static uint32_t fraction(double root) {
  return (uint32_t)((root - floor(root)) * 4294967296.0);
}

/* The constants are 32 bits of square and cube roots of the first prime numbers. */
static void find_constants(uint32_t hash[WORDS], uint32_t key[ROUNDS]) {
  for (int number = 2, k = 0; k < ROUNDS; number++) {
    int divisor = 2;
    while (number % divisor != 0)
      divisor++;
    if (divisor < number) continue;
    if (k < WORDS) hash[k] = fraction(sqrt(number));
    key[k++] = fraction(cbrt(number));
  }
}

static void add_block(uint32_t hash[WORDS], const uint32_t key[ROUNDS], const unsigned char *block) {
  uint32_t w[ROUNDS], s[WORDS];
  for (int k = 0; k < 16; k++)
    w[k] = (uint32_t)block[4 * k] << 24 | (uint32_t)block[4 * k + 1] << 16 | (uint32_t)block[4 * k + 2] << 8 |
           block[4 * k + 3];
  for (int k = 16; k < ROUNDS; k++)
    w[k] = w[k - 16] + (turn(w[k - 15], 7) ^ turn(w[k - 15], 18) ^ w[k - 15] >> 3) + w[k - 7] +
           (turn(w[k - 2], 17) ^ turn(w[k - 2], 19) ^ w[k - 2] >> 10);
  memcpy(s, hash, sizeof s);
  for (int k = 0; k < ROUNDS; k++) {
    const uint32_t one = s[7] + (turn(s[4], 6) ^ turn(s[4], 11) ^ turn(s[4], 25)) +
                         ((s[4] & s[5]) ^ (~s[4] & s[6])) + key[k] + w[k];
    const uint32_t two =
        (turn(s[0], 2) ^ turn(s[0], 13) ^ turn(s[0], 22)) + ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
    memmove(s + 1, s, 7 * sizeof *s);
    s[4] += one;
    s[0] = one + two;
  }
  for (int k = 0; k < WORDS; k++)
    hash[k] += s[k];
}

int32_t cli_digest_file(const char *path, char digest[HOOKE_DIGEST_SIZE]) {
  unsigned char block[BLOCK];
  uint32_t hash[WORDS], key[ROUNDS];
  uint64_t bytes = 0;
  FILE *file = fopen(path, "rb");
  find_constants(hash, key);
  for (int open = file != NULL, ended = 0; open;) { /* the last block ends with the length in bits */
    size_t got = fread(block, 1, BLOCK, file);
    bytes += got;
    memset(block + got, 0, BLOCK - got);
    if (got < BLOCK && !ended) block[got] = 0x80;
    open = got + !ended > BLOCK - LENGTH;
    ended |= got < BLOCK;
    for (int k = 0; k < LENGTH && !open; k++)
      block[BLOCK - 1 - k] = (unsigned char)(bytes << 3 >> 8 * k);
    add_block(hash, key, block);
  }
  const int32_t is_read = file && !ferror(file);
  if (file) fclose(file);
  for (int k = 0; k < WORDS && is_read; k++)
    snprintf(digest + 8 * k, 9, "%08x", (unsigned)hash[k]);
  return is_read;
}
