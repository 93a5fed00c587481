/* What a file is, told by its first bytes. */
#include "io/record.h"

#include <stdio.h>
#include <string.h>

int32_t hooke_record_is_one(const char *path) {
  static const char signature[8] = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  char begin[sizeof signature] = {0};
  FILE *file = fopen(path, "rb");
  if (file == NULL) return 0;
  const size_t got = fread(begin, 1, sizeof begin, file);
  fclose(file);
  return got == sizeof begin && memcmp(begin, signature, sizeof begin) == 0;
}
