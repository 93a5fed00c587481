#include "fuzz.h"

#include <stdio.h>
#include <unistd.h>

/* One unnamed file, rewritten each time; open files of a process have a path under /proc. */
const char *hooke_fuzz_file(const void *data, size_t size) {
  static FILE *file;
  static char path[64];
  if (file == NULL) file = tmpfile();
  hooke_fuzz_require(file != NULL, "there is room for a file");
  const int number = fileno(file);
  hooke_fuzz_require(ftruncate(number, 0) == 0 && pwrite(number, data, size, 0) == (ssize_t)size,
                     "the file can be written");
  snprintf(path, sizeof path, "/proc/self/fd/%d", number);
  return path;
}

int hooke_fuzz_is_chosen(const void *data, size_t size, uint32_t of) {
  const unsigned char *byte = data;
  uint32_t sum = 0;
  for (size_t k = 0; k < size; k++)
    sum = 31 * sum + byte[k];
  return (sum >> 7) % of == 0;
}
