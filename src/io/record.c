/* What a file is, told by its first bytes. */
#include "io/record.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

int32_t hooke_record_is_one(const char *path) {
  static const char signature[8] = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  char begin[sizeof signature] = {0};
  const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return 0;
  const ssize_t got = read(descriptor, begin, sizeof begin);
  close(descriptor);
  return got == (ssize_t)sizeof begin && memcmp(begin, signature, sizeof begin) == 0;
}
