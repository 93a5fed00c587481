/* Reads and writes of whole blocks at an offset of a file. */
#pragma once

#include <stdint.h>

/* Each returns 0 or an errno; a file that ends too early is EIO. */
int hk_bytes_write(int descriptor, int64_t at, int64_t count, const void *bytes);
int hk_bytes_read(int descriptor, int64_t at, int64_t count, void *bytes);

/* Copies from one file to another through `block` of `capacity` bytes. */
int hk_bytes_copy(int from, int64_t from_at, int to, int64_t to_at, int64_t count, void *block,
                  int64_t capacity);
