#include "io/file/bytes.h"

#include "core/os/os_file.h"

#include <errno.h>

int hk_bytes_write(int descriptor, int64_t at, int64_t count, const void *bytes) {
  const char *rest = bytes;
  while (count > 0) {
    const int64_t done = hk_os_write_at(descriptor, at, count, rest);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return done < 0 ? errno : ENOSPC;
    rest += done;
    at += done;
    count -= done;
  }
  return 0;
}

int hk_bytes_read(int descriptor, int64_t at, int64_t count, void *bytes) {
  char *rest = bytes;
  while (count > 0) {
    const int64_t done = hk_os_read_at(descriptor, at, count, rest);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return done < 0 ? errno : EIO;
    rest += done;
    at += done;
    count -= done;
  }
  return 0;
}

int hk_bytes_copy(int from, int64_t from_at, int to, int64_t to_at, int64_t count, void *block,
                  int64_t capacity) {
  int error = 0;
  for (int64_t done = 0; error == 0 && done < count; done += capacity) {
    const int64_t part = count - done < capacity ? count - done : capacity;
    error = hk_bytes_read(from, from_at + done, part, block);
    if (error == 0) error = hk_bytes_write(to, to_at + done, part, block);
  }
  return error;
}
