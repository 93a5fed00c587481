/* Identifies a file by its first bytes, and checks that it is usable. */
#include "io/trajectory/record.h"

#include "core/status.h"
#include "io/file/atomic_file.h"
#include "io/file/bytes.h"

#include <string.h>
#include <unistd.h>

int32_t hk_record_is_one(const char *path) {
  static const char signature[8] = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  char begin[sizeof signature] = {0};
  const int file = hk_file_open(path);
  if (file < 0) return 0;
  const int error = hk_bytes_read(file, 0, sizeof begin, begin);
  close(file);
  return error == 0 && memcmp(begin, signature, sizeof begin) == 0;
}

int32_t hk_record_require_run(const hooke_record *record) {
  if (hk_record_is_run(record)) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of several runs; allowed: a trajectory of one run",
                 hk_record_path(record));
}
