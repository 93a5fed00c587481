/* What a file is, told by its first bytes. */
#include "io/record.h"

#include "io/place.h"

#include <string.h>
#include <unistd.h>

int32_t hooke_record_is_one(const char *path) {
  static const char signature[8] = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  char begin[sizeof signature] = {0};
  const int file = hooke_place_open(path);
  if (file < 0) return 0;
  const ssize_t got = read(file, begin, sizeof begin);
  close(file);
  return got == (ssize_t)sizeof begin && memcmp(begin, signature, sizeof begin) == 0;
}
