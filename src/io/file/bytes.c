#include "io/file/bytes.h"

#include "core/os/os_file.h"

#include <errno.h>

/* Writes `from`, or reads into `to`. */
static int transfer(int descriptor, int64_t at, int64_t count, const char *from, char *to) {
  for (int64_t all = 0; all < count;) {
    const int64_t left = count - all, done = from ? hk_os_write_at(descriptor, at + all, left, from + all)
                                                  : hk_os_read_at(descriptor, at + all, left, to + all);
    if (done < 0 && errno != EINTR) return errno;
    if (done == 0) return from ? ENOSPC : EIO;
    if (done > 0) all += done;
  }
  return 0;
}

int hk_bytes_write(int descriptor, int64_t at, int64_t count, const void *bytes) {
  return transfer(descriptor, at, count, bytes, NULL);
}

int hk_bytes_read(int descriptor, int64_t at, int64_t count, void *bytes) {
  return transfer(descriptor, at, count, NULL, bytes);
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
